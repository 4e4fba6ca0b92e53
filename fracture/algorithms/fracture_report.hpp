// SPDX-License-Identifier: MIT
// What one search for fractures found and did.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fracture/algorithms/fan_event.hpp"

namespace sunder {

/// What one search for fractures found and did.
struct FractureReport {
  /// Fans that split at least one face, in the order in which they were split.
  std::vector<FanEvent> fans;
  /// Vertices tested; those that Gershgorin's bound let through; those of them that reach their
  /// threshold. The last two give the bound's efficiency (table 3).
  std::size_t tested = 0, suspects = 0, reached = 0;
  /// Vertices newly found over their threshold that cannot split: with all tetrahedra on one side
  /// of every allowed plane, or refused by the limits on pieces; and those counted as either
  /// before, which are not tested again until their stress changes.
  std::size_t empty_fans = 0, refused_fans = 0, still_empty = 0;
  /// Vertices over their threshold that fell below it, or lost their faces to a neighbour's fan,
  /// before they were split.
  std::size_t relieved = 0;
  /// Vertices over their threshold that the budget left for a later step.
  std::size_t waiting = 0;
  /// Vertices for which the node stress `fit` fell back to `volume`.
  std::size_t unfitted = 0;
  /// A vertex whose stress is not a number: nothing was split, the simulation has failed.
  std::optional<VertexId> not_a_number;
};

}  // namespace sunder
