// SPDX-License-Identifier: MIT
#include "apps/sunder/break/budget.hpp"

#include <algorithm>
#include <utility>

#include "topology/base/elementary.hpp"

namespace sunder {
namespace {

constexpr int most_tries = 5;
/// Predicted times grow with this power of the number of cells: their number, shorter sub-steps,
/// longer walks through memory.
constexpr double growth_of_time = 1.5;
/// A mesh that takes this share of the time left is near enough.
constexpr double near_enough_share = 0.6;

double power(double x, double exponent) { return exponential(exponent * logarithm(x)); }

/// Whether the first mesh is the better one: the finer of two that fit, else the cheaper.
bool is_better(const Costed& a, const Costed& b, double seconds) {
  const bool fits = a.seconds <= seconds;
  if (fits != (b.seconds <= seconds)) return fits;
  return fits ? a.mesh.tetrahedra.size() > b.mesh.tetrahedra.size() : a.seconds < b.seconds;
}

}  // namespace

double drawing_time(double pictures, double megapixels, double tetrahedra) {
  // Measured on Mesa's llvmpipe with a vase of 5 000 and a ball of 30 000 tetrahedra.
  return pictures * (0.1 + 0.65 * megapixels + 1e-5 * tetrahedra);
}

std::optional<Costed> finest_within(const std::function<double()>& left, const CostedFill& make) {
  std::optional<Costed> best;
  double wanted = 2000;
  for (int tries = 0; tries < most_tries; ++tries) {
    std::optional<Costed> next = make(wanted);
    if (!next) return best;
    const double seconds = std::max(left(), 1e-3), cost = std::max(next->seconds, 1e-3);
    const bool is_near = cost <= seconds && cost >= near_enough_share * seconds;
    if (!best || is_better(*next, *best, seconds)) best = std::move(next);
    if (is_near) break;
    const double factor = power(0.8 * seconds / cost, 1 / growth_of_time);
    const double before = wanted;
    wanted = std::clamp(wanted * std::clamp(factor, 1.0 / 8, 8.0), fewest_cells, most_cells);
    if (wanted == before) break;
  }
  return best;
}

}  // namespace sunder
