// SPDX-License-Identifier: MIT
// Results of a search for fractures.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fracture/algorithms/fan_event.hpp"
#include "topology/base/counters.hpp"

namespace sunder {

/// Counts of searches for fractures.
struct SearchCounts {
  /// Vertices tested, vertices over Gershgorin's bound, and vertices that reach their threshold.
  /// The last two give the bound's efficiency (table 3 of the paper).
  std::size_t tested = 0, suspects = 0, reached = 0;
  /// Vertices over their threshold that cannot split: `empty_fans` have all tetrahedra on one side
  /// of every allowed plane, and `refused_fans` violate the limits on pieces. `still_empty` counts
  /// earlier ones, which are tested again when their stress changes.
  std::size_t empty_fans = 0, refused_fans = 0, still_empty = 0;
  /// Vertices over their threshold that fell below it before their split, or lost their faces to a
  /// neighbour's fan.
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

/// Results of one `find_fractures`.
struct FractureReport : SearchCounts {
  /// Fans that split at least one face, in the order in which they were split.
  std::vector<FanEvent> fans;
  /// A vertex with a stress that is not a number. Nothing was split, and the simulation has failed.
  std::optional<VertexId> not_a_number;
};

}  // namespace sunder
