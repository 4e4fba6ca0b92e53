// SPDX-License-Identifier: MIT
// Pieces that never break by somebody's word: who they are, and that they are rigid bodies.
#pragma once

#include <span>
#include <vector>

#include "fracture/simulation/simulation.hpp"
#include "fracture/simulation/state.hpp"
#include "mechanics/rebuild.hpp"

namespace sunder {

/// By whose word a component never breaks; rows of chars, so that 0 is no word.
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

/// Makes rigid bodies (`turn_rigid`) of those that are free and without ties, and elastic ones of
/// what is rigid no more. In contact they then have six unknowns, and no windows open for them. What
/// they give up, in all. Rows of `unbreakable` = ComponentId. O(components + the size of those that
/// change).
RebuildReport turn_pieces_rigid(Simulation& sim, std::span<const char> unbreakable);

/// Both, at the start of a step and when pieces have come off, with what it did to energies.
void harden_pieces(StepReport& report, Simulation& sim);

}  // namespace sunder
