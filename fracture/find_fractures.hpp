// SPDX-License-Identifier: MIT
// Algorithm 3: which vertices break in this step, in which order, and what became of the others.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fracture/split_fan.hpp"
#include "mechanics/step.hpp"

namespace sunder {

/// What one `find_fractures` found and did.
struct FractureReport {
  /// Fans that split at least one face, in the order in which they were split.
  std::vector<FanEvent> fans;
  /// Vertices tested, those that Gershgorin's bound let through, and those of them that really
  /// reach their threshold: the last two give the bound's efficiency (table 3).
  std::size_t tested = 0, suspects = 0, reached = 0;
  /// Vertices over their threshold with every tetrahedron on one side of every allowed plane.
  std::size_t empty_fans = 0;
  /// Fans that the limits on pieces refused.
  std::size_t refused_fans = 0;
  /// Vertices that waited for a fan and fell below their threshold before their turn came.
  std::size_t relieved = 0;
  /// Vertices over their threshold that the budget left for a later step.
  std::size_t waiting = 0;
  /// A vertex whose stress is not a number: nothing was split, the simulation has failed.
  std::optional<VertexId> not_a_number;
};

/// Working memory of `find_fractures`.
struct FractureScratch {
  /// |V|, Pa, as it stands after the fans of the last call; for display too.
  std::vector<Mat3> node_stress;
  std::vector<double> weight;      ///< |V|, of `average_node_stress`
  std::vector<char> rows, broken;  ///< |V|: looked at; broken in this call
  FanScratch fan;
};

/// Algorithm 3, on the element stresses in `mechanics` (Pa, rest frame of each component):
/// node stress (eq. 6), Gershgorin's bound (eq. 7), the exact test, and for the vertices that reach
/// their threshold a fan each (algorithm 4), most overstressed first, ties by row.
///
/// After a fan the node stress of every vertex it split is averaged again over its own star, and so
/// decides anew when its turn comes. A vertex and its copies break once a step at most: the element
/// stresses are those from before, and breaking on them again would grind the star to single
/// tetrahedra. Copies of a vertex whose turn has not come yet do take part.
/// Leaves `mechanics.elements.component`, masses and frames to the caller (`rebuild`).
/// Only vertices of `members` are looked at: the others' time has not come.
FractureReport find_fractures(Cells& cells, MechanicsState& mechanics,
                              const FractureSettings& settings, FractureScratch& scratch,
                              const StepMembers& members = {});

}  // namespace sunder
