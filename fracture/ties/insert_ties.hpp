// SPDX-License-Identifier: MIT
// From faces that a fan unsewed to ties: corners that come apart begin at the force they had.
#pragma once

#include <span>
#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fan_event.hpp"
#include "mechanics/ties/tie.hpp"

namespace sunder {

/// Ties the faces of fans with the fracture energy of the weaker side, along the normal of each
/// fan. Areas of corners are A |n . n_f| / 3, so that a crack takes the same energy on any mesh it
/// zigzags through. Needs: `CrackMode::cohesive`.
void add_ties(std::vector<Tie>& ties, const Cells& cells, const MechanicsState& mechanics,
              std::span<const FanEvent> fans);

/// Begins corners with vertices that have come apart since the last call. Their strength is the
/// threshold of the vertex or, if that is more, the traction just before. So the force on both
/// copies does not change and their acceleration does not jump. Needs: masses of the copies
/// (`rebuild`).
void begin_corners(std::vector<Tie>& ties, const Cells& cells, const MechanicsState& mechanics);

}  // namespace sunder
