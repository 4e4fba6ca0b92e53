// SPDX-License-Identifier: MIT
// Random operations on cells of random bodies, on both kernels, each checked by laws and the twin.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "topology/kernel/counts.hpp"
#include "topology/suite/judge/glue_twin.hpp"

namespace sunder::test {

/// A body as an operation has left it.
struct CellMoment {
  enum class After { beginning, division, split, undo };
  After after;
  /// As the twin has it, and as the map counts it.
  const suite::GlueTwin& body;
  const Counts& counts;
};

/// Looks at a moment; gives the fault found, nothing when all is well.
using CellWatch = std::function<std::string(const CellMoment&)>;

struct RandomCells {
  /// The first fault, empty when there was none.
  std::string failure;
  std::size_t inserted = 0, refined = 0, cut = 0, splits = 0, undone = 0, redone = 0;
  std::size_t comparisons = 0;
};

/// At least `operations`, not counting those undone and done again, over ten bodies. After each:
/// rows of both kernels equal, darts equal to rows, the tetrahedra and all cells as the twin has
/// them, Euler characteristic and Betti numbers as before (except after splits), volumes, columns
/// by every rule, and rows as they were after undoing; and the faults that `watch` finds.
RandomCells random_cells(std::size_t operations, std::uint64_t seed, const CellWatch& watch = {});

}  // namespace sunder::test
