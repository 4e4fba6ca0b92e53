// SPDX-License-Identifier: MIT
// Bodies that come and go while a simulation runs.
#pragma once

#include <cstddef>
#include <vector>

#include "fracture/simulation/simulation.hpp"
#include "mechanics/state/impulse.hpp"

namespace sunder {

/// A body that came or went, and what it brought or took. Ledgers of steps do not count it.
struct BodyChange {
  std::size_t body = 0;             ///< its row in `Simulation::bodies`
  std::vector<ComponentId> pieces;  ///< its pieces, ascending
  double mass = 0;                  ///< kg
  double kinetic = 0;               ///< J
  double strain = 0;                ///< J, in its elements
  /// N s and N m s: momentum, and angular momentum about the origin.
  Impulse momentum = Impulse::Zero();
};

/// Adds a body between two steps, where its settings place it: as if it were one of the scene's,
/// behind the others. Its rows follow those that are there, and ids of pieces go on. Ramps of its
/// loads and supports count from the start of the simulation. Errors, which change nothing: those
/// of `build_simulation` for a scene with this body alone ("bodies.0" in the texts); `has_failed`
/// is up to the caller. is_replay: the fans of a simulation are those of a script; nodes_of_edges:
/// a body of order 2 is there, and rows of points end with its nodes. Warnings: those of
/// `build_simulation`, with obstacles where they are now; overlap_with_pieces. O(state).
Result<BodyChange> add_body(Simulation& simulation, BodySettings body);

/// Removes a body with all of its pieces between two steps. Ids of other pieces and rows of other
/// bodies stay. Rows of vertices and tetrahedra close up in their order: those of bodies behind it
/// become smaller. Its row stays, with a mesh without cells. Sleeping pieces wake. A pull at it
/// ends. Errors, which change nothing: no_such_body (also for one that is gone), last_body,
/// is_replay. O(state).
Result<BodyChange> remove_body(Simulation& simulation, std::size_t body);

}  // namespace sunder
