// SPDX-License-Identifier: MIT
// What one search for fractures found and did.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fracture/algorithms/fan_event.hpp"
#include "topology/base/counters.hpp"

namespace sunder {

/// What searches for fractures counted.
struct SearchCounts {
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
  /// Vertices over their threshold that wait on the flank of a crack (`CrackMode::object`).
  std::size_t on_flanks = 0;
  /// Vertices for which the node stress `fit` fell back to `volume`.
  std::size_t unfitted = 0;
};

constexpr auto counters_of(const SearchCounts*) {
  return std::tuple{Counter{"tested", &SearchCounts::tested},
                    Counter{"suspects", &SearchCounts::suspects},
                    Counter{"reached", &SearchCounts::reached},
                    Counter{"empty_fans", &SearchCounts::empty_fans},
                    Counter{"still_empty", &SearchCounts::still_empty, Adds::last},
                    Counter{"unfitted", &SearchCounts::unfitted, Adds::most},
                    Counter{"refused_fans", &SearchCounts::refused_fans},
                    Counter{"on_flanks", &SearchCounts::on_flanks, Adds::last},
                    Counter{"relieved", &SearchCounts::relieved},
                    Counter{"waiting", &SearchCounts::waiting, Adds::last}};
}

/// What one `find_fractures` found and did.
struct FractureReport : SearchCounts {
  /// Fans that split at least one face, in the order in which they were split.
  std::vector<FanEvent> fans;
  /// A vertex whose stress is not a number: nothing was split, the simulation has failed.
  std::optional<VertexId> not_a_number;
};

}  // namespace sunder
