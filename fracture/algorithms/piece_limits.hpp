// SPDX-License-Identifier: MIT
// Whether a fan would make a piece too small or one too many: looked at before it is split.
#pragma once

#include <span>

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fracture_settings.hpp"

namespace sunder {

/// Whether there is any limit.
inline bool limits_pieces(const FractureSettings& settings) {
  return settings.smallest_piece > 0 || settings.max_pieces > 0;
}

/// Whether unsewing `faces` (the fan of `vertex`) would part a piece lighter than
/// `settings.smallest_piece`, or leave more pieces than `settings.max_pieces` in the scene. Nothing
/// is changed. Exact: a face can only part something if its sides are in different orbits at all
/// three vertices. This is tested with the whole fan unsewn (the oracle, looking ahead). From such
/// faces alone parts grow in lockstep, as in `Detection::exact`.
/// With `CrackMode::cohesive` a piece is a component of the map without ties: a piece after all
/// ties are spent. So no release has to be refused, in any order of spent ties.
/// Cost: nothing where both limits are 0. Else the stars of the faces' vertices, and the smaller
/// sides of the parts that would come off. With a smallest piece, more of the rest where all these
/// are light. With ties and a number of pieces O(|T|) for fans that part something.
bool exceeds_limits(const Cells& cells, const MechanicsState& mechanics,
                    std::span<const HalfFaceId> faces, const FractureSettings& settings,
                    ComponentScratch& scratch);

}  // namespace sunder
