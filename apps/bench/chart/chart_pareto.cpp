// SPDX-License-Identifier: MIT
// Pareto front in two dimensions: by cost, then a running least of error.
#include "apps/bench/chart/chart_pareto.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace sunder {

bool dominates(const CostError& a, const CostError& b) {
  return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

std::vector<std::size_t> pareto_front(std::span<const CostError> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {},
                    [&](std::size_t i) { return std::tuple(points[i].cost, points[i].error, i); });
  std::vector<std::size_t> front;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (points[i].error >= least) continue;
    least = points[i].error;
    front.push_back(i);
  }
  return front;
}

std::optional<std::size_t> cheapest_within(std::span<const CostError> points, double error) {
  // The cheapest of all is on the front, and there errors fall with cost.
  for (const std::size_t i : pareto_front(points)) {
    if (points[i].error <= error) return i;
  }
  return std::nullopt;
}

}  // namespace sunder
