// SPDX-License-Identifier: MIT
// Internal to judge_truth: a fixture's expectations, compared with the twin.
#pragma once

#include <optional>
#include <vector>

#include "topology/suite/judge/judge_truth.hpp"

namespace sunder::suite {

/// Counts and Euler characteristic.
void check_counts(Checks& checks, const Expected& expected, const CellCounts& counts);

/// Betti numbers, homology over Z and orientability of the body as it is. Gives the homology over Z
/// where that is expected, and for small bodies where any is: to ask kernels for.
std::optional<IntegerHomology> check_homology(Checks& checks, const Expected& expected,
                                              const GlueTwin& twin);

/// Single splits, their tally, the oracle's answers, and separations of one operation.
void check_splits(Checks& checks, const Expected& expected, const std::vector<TrueStep>& steps,
                  const GlueTwin& twin);

}  // namespace sunder::suite
