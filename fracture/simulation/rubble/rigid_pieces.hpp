// SPDX-License-Identifier: MIT
// Pieces that are declared never to break: which ones they are, and their change into rigid bodies.
#pragma once

#include <span>
#include <vector>

#include "fracture/simulation/simulation.hpp"
#include "fracture/simulation/state.hpp"
#include "mechanics/rebuild.hpp"

namespace sunder {

/// Why a component can never break. Stored in rows of chars; 0 means it can.
enum class Unbreakable : char {
  no,
  declared,  ///< `LadderSettings::declared_rubble`, where rubble is on
  rigid,     ///< `BodySettings::rigid`
};

/// Marks components that never break: those of rigid bodies, and, where rubble is on, those with no
/// more than `declared_rubble` of their body's mass once it has lost some; values of `Unbreakable`.
/// `body_mass` (kg) is filled at the first call.
void note_unbreakable(std::vector<char>& unbreakable, std::vector<double>& body_mass,
                      const Simulation& sim);

/// Makes rigid bodies (`turn_rigid`) of marked components that are free and without ties, and
/// elastic ones of rigid components that are marked no more. In contact rigid bodies have six
/// unknowns, and no windows open for them. Gives the sum of the energies given up. Rows of
/// `unbreakable` = ComponentId. O(components + the size of those that change).
RebuildReport turn_pieces_rigid(Simulation& sim, std::span<const char> unbreakable);

/// Both, at the start of a step and when pieces have come off; adds the changes of energies.
void harden_pieces(StepReport& report, Simulation& sim);

}  // namespace sunder
