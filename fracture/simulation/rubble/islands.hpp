// SPDX-License-Identifier: MIT
// Which pieces may be stepped as rubble in a tick: by what they are, and by whom they could meet.
#pragma once

#include <vector>

#include "fracture/scene/scene.hpp"
#include "fracture/simulation/simulation.hpp"
#include "fracture/simulation/state.hpp"

namespace sunder {

/// What a choice looks at, rows = ComponentId.
struct RubbleInput {
  const std::vector<double>& threshold;  ///< J (`note_break_energies`)
  const std::vector<char>& declared;  ///< `note_unbreakable`
  Vec3 gravity = Vec3::Zero();  ///< m/s^2
  double tick = 0;              ///< s
};

/// What `choose_rubble` found.
struct RubbleChoice {
  /// Rows = ComponentId, obstacles: in an island of rubble alone, be it asleep.
  std::vector<char> component, ball;
  bool any_awake = false;
  std::uint32_t refused = 0;   ///< islands whose certificate failed
  std::uint32_t mixed = 0;     ///< islands of candidates and of what is none
  std::uint32_t solids = 0;    ///< islands near obstacles that are meshes
};

/// Islands of what could meet in a tick, by the boxes of surface tetrahedra along the ways of their
/// bodies, twice as far for what deforms; what is driven joins nobody. Near obstacles that are meshes
/// no island is rubble. An island is rubble where
/// all in it can be (free, without loads, ties and windows; no vertex of theirs can break, or the
/// certificate says so) and rubble is on.
///
/// The certificate (`RubbleMode::certified`): all the energy that the island could put into a piece
/// in the tick is below what the piece must hold before a vertex of it can break
/// (`note_break_energies`): kinetic energy against what the island touches, or against its mass
/// centre; strain energy in it; the work of gravity in the tick; and what contacts took from the
/// piece's islands since it has been rubble. Not for `NodeStress::fit`. Where an island meets
/// obstacles of different velocities there is no bound.
RubbleChoice choose_rubble(const Simulation& sim, const RubbleInput& input);

}  // namespace sunder
