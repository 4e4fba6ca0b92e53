// SPDX-License-Identifier: MIT
// Which pieces may be stepped as rubble in a tick: by their own state, and by the bodies that they
// could meet.
#pragma once

#include <cstdint>
#include <vector>

#include "fracture/scene/scene.hpp"
#include "fracture/simulation/simulation.hpp"
#include "fracture/simulation/state.hpp"

namespace sunder {

/// Input of a choice, rows = ComponentId.
struct RubbleInput {
  const std::vector<double>& threshold;  ///< J (`note_break_energies`)
  const std::vector<char>& declared;     ///< `note_unbreakable`
  const std::vector<char>& watched;      ///< rubble until a blow: needs no certificate
  Vec3 gravity = Vec3::Zero();           ///< m/s^2
  double tick = 0;                       ///< s
};

/// Result of `choose_rubble`.
struct RubbleChoice {
  /// Rows = ComponentId, obstacles: in an island of rubble alone, be it asleep.
  std::vector<char> component, ball;
  static constexpr std::uint32_t no_island = ~0u;
  /// Rows = ComponentId, then obstacles: the name of their island of rubble, if that is awake.
  std::vector<std::uint32_t> island;
  bool any_awake = false;
  std::uint32_t refused = 0;  ///< islands with a failed certificate
  std::uint32_t mixed = 0;    ///< islands of candidates and other bodies
  std::uint32_t solids = 0;   ///< islands near obstacles that are meshes
};

/// Groups bodies that could meet in a tick into islands. Those have overlapping boxes of surface
/// tetrahedra along their ways, twice as far for deformable bodies. Driven obstacles do not join
/// islands. Near obstacles that are meshes no island is rubble. An island is rubble if rubble is on
/// and all bodies in it can be rubble: free, without loads, ties and windows. In addition no vertex
/// of theirs can break, or the certificate says so.
///
/// The certificate (`RubbleMode::certified`) bounds the energy that the island could put into a
/// piece in the tick. It must be below the energy that the piece must hold before a vertex of it
/// can break (`note_break_energies`). The bound is the sum of
/// - kinetic energy against the obstacles that the island touches, or else against its mass centre,
/// - strain energy in the island, and the work of gravity in the tick,
/// - the energy that contacts took from the piece's islands since it has been rubble.
/// Pieces that are watched need none (`RubbleMode::until_struck`).
/// Not for `NodeStress::fit`. Where an island meets obstacles of different velocities there is no
/// bound.
RubbleChoice choose_rubble(const Simulation& sim, const RubbleInput& input);

}  // namespace sunder
