// SPDX-License-Identifier: MIT
// Which points of cost and error are worth having.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sunder {

/// The cost and the error of a setting; less is better in both.
struct CostError {
  double cost = 0, error = 0;
};

/// Whether `a` is no worse than `b` in both and better in one.
bool dominates(const CostError& a, const CostError& b);

/// Rows that no row dominates, ascending in cost and so falling in error; of equal rows the first.
/// O(n log n). Needs: no NaN.
std::vector<std::size_t> pareto_front(std::span<const CostError> points);

/// The cheapest row with an error of at most `error`; the more exact, then the first of equals.
std::optional<std::size_t> cheapest_within(std::span<const CostError> points, double error);

}  // namespace sunder
