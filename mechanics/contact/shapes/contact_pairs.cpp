// SPDX-License-Identifier: MIT
// When pairs found before will do, and when to search with a margin.
#include "mechanics/contact/shapes/contact_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sunder {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Largest distance between rows of two columns; infinite where they cannot be compared.
double largest_motion(std::span<const Vec3> before, std::span<const Vec3> now) {
  if (before.size() != now.size()) return infinity;
  double squared = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double moved = (now[i] - before[i]).squaredNorm();
    if (!(moved < infinity)) return infinity;
    squared = std::max(squared, moved);
  }
  return std::sqrt(squared);
}

/// Whether every pair that is to be found is among those found with the margin.
bool still_holds(const PairCache& cache, const SphereQuery& query) {
  if (!std::ranges::equal(cache.point_component, query.point_component) ||
      !std::ranges::equal(cache.centre_component, query.centre_component)) {
    return false;
  }
  const double moved = largest_motion(cache.points, query.points);
  if (!(moved < infinity)) return false;
  for (std::size_t t = 0; t < query.centres.size(); ++t) {
    const double shift = (query.centres[t] - cache.centres[t]).norm();
    if (!(query.radii[t] + moved + shift < cache.reach[t])) return false;
  }
  return true;
}

template <class T>
void copy(std::vector<T>& to, std::span<const T> from) {
  to.assign(from.begin(), from.end());
}

void search_with_margin(GridScratch& grid, PairCache& cache, const SphereQuery& query,
                        double margin) {
  copy(cache.points, query.points);
  copy(cache.centres, query.centres);
  copy(cache.point_component, query.point_component);
  copy(cache.centre_component, query.centre_component);
  cache.reach.resize(query.radii.size());
  std::ranges::transform(query.radii, cache.reach.begin(), [&](double r) { return r + margin; });
  SphereQuery wide = query;
  wide.radii = cache.reach;
  find_sphere_pairs(cache.near, grid, wide);
}

}  // namespace

void find_sphere_pairs(std::vector<SpherePair>& pairs, GridScratch& grid, PairCache& cache,
                       const SphereQuery& query) {
  const double motion = largest_motion(cache.last_points, query.points);
  copy(cache.last_points, query.points);
  if (!still_holds(cache, query)) {
    ++cache.searches;
    const double radii = std::accumulate(query.radii.begin(), query.radii.end(), 0.0);
    const double margin =
        0.25 * radii / static_cast<double>(std::max<std::size_t>(query.radii.size(), 1));
    if (!(8 * motion < margin)) {
      cache.point_component.clear();
      find_sphere_pairs(pairs, grid, query);
      return;
    }
    search_with_margin(grid, cache, query, margin);
  }
  pairs.clear();
  for (const SpherePair& pair : cache.near) {
    const std::size_t t = pair.tetrahedron.index(), v = pair.vertex.index();
    const double r = query.radii[t];
    if ((query.points[v] - query.centres[t]).squaredNorm() < r * r) pairs.push_back(pair);
  }
}

}  // namespace sunder
