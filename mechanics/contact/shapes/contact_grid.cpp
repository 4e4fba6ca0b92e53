// SPDX-License-Identifier: MIT
// The uniform grid behind `find_sphere_pairs`, and its slow twin.
#include "mechanics/contact/shapes/contact_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "topology/base/assert.hpp"

namespace sunder {
namespace {

using Cell = GridScratch::Cell;

struct Grid {
  double cell_width = 1;
  std::uint32_t bucket_mask = 0;
};

std::int32_t cell_index(double coordinate, double width) {
  // Far beyond any scene; keeps the conversion defined for every finite number, and for NaN.
  constexpr double limit = 1e9;
  const double cell = std::floor(coordinate / width);
  return static_cast<std::int32_t>(cell >= -limit ? std::min(cell, limit) : -limit);
}

Cell cell_at(const Vec3& point, double width) {
  return {cell_index(point.x(), width), cell_index(point.y(), width), cell_index(point.z(), width)};
}

std::uint32_t bucket_of(const Cell& cell, const Grid& grid) {
  // Multipliers of Teschner et al. 2003: cells of a row go to different buckets.
  const auto x = static_cast<std::uint32_t>(cell[0]) * 73856093u;
  const auto y = static_cast<std::uint32_t>(cell[1]) * 19349663u;
  const auto z = static_cast<std::uint32_t>(cell[2]) * 83492791u;
  return (x ^ y ^ z) & grid.bucket_mask;
}

double mean_diameter(std::span<const double> radii) {
  double sum = 0;
  std::size_t counted = 0;
  for (const double r : radii) {
    if (!std::isfinite(r) || r <= 0) continue;
    sum += r;
    ++counted;
  }
  return counted > 0 ? 2 * sum / static_cast<double>(counted) : 1.0;
}

Grid fill_grid(GridScratch& scratch, const SphereQuery& query) {
  const std::size_t count = query.points.size();
  const std::uint32_t buckets = std::bit_ceil(static_cast<std::uint32_t>(2 * count + 1));
  const Grid grid{mean_diameter(query.radii), buckets - 1};
  scratch.cell_of.resize(count);
  scratch.sorted.resize(count);
  scratch.first_of.assign(buckets + 1, 0);
  for (std::size_t v = 0; v < count; ++v) {
    scratch.cell_of[v] = cell_at(query.points[v], grid.cell_width);
    ++scratch.first_of[bucket_of(scratch.cell_of[v], grid) + 1];
  }
  for (std::size_t b = 0; b < buckets; ++b) scratch.first_of[b + 1] += scratch.first_of[b];
  // Filling from the last vertex down turns ends into beginnings and keeps vertices ascending.
  for (std::size_t v = count; v-- > 0;) {
    std::uint32_t& slot = scratch.first_of[bucket_of(scratch.cell_of[v], grid) + 1];
    scratch.sorted[--slot] = VertexId{v};
  }
  // Now first_of[b + 1] is where bucket b begins: shift down by one.
  for (std::size_t b = 0; b < buckets; ++b) scratch.first_of[b] = scratch.first_of[b + 1];
  scratch.first_of[buckets] = static_cast<std::uint32_t>(count);
  return grid;
}

bool overlaps(const SphereQuery& query, std::size_t t, std::size_t v) {
  const double r = query.radii[t];
  return query.point_component[v] != query.centre_component[t] &&
         (query.points[v] - query.centres[t]).squaredNorm() < r * r;
}

void compare_all_points(std::vector<SpherePair>& pairs, const SphereQuery& query, std::size_t t) {
  for (std::size_t v = 0; v < query.points.size(); ++v) {
    if (overlaps(query, t, v)) pairs.push_back({TetId{t}, VertexId{v}});
  }
}

void visit_cells(std::vector<SpherePair>& pairs, const GridScratch& scratch, const Grid& grid,
                 const SphereQuery& query, std::size_t t) {
  const Vec3 reach = Vec3::Constant(query.radii[t]);
  const Cell low = cell_at(query.centres[t] - reach, grid.cell_width);
  const Cell high = cell_at(query.centres[t] + reach, grid.cell_width);
  double covered = 1;
  for (int k = 0; k < 3; ++k) covered *= static_cast<double>(high[k]) - low[k] + 1;
  if (covered > static_cast<double>(query.points.size())) {
    compare_all_points(pairs, query, t);
    return;
  }
  const std::size_t first = pairs.size();
  for (std::int32_t x = low[0]; x <= high[0]; ++x) {
    for (std::int32_t y = low[1]; y <= high[1]; ++y) {
      for (std::int32_t z = low[2]; z <= high[2]; ++z) {
        const Cell cell{x, y, z};
        const std::uint32_t bucket = bucket_of(cell, grid);
        for (std::uint32_t k = scratch.first_of[bucket]; k < scratch.first_of[bucket + 1]; ++k) {
          const std::size_t v = scratch.sorted[k].index();
          // Two cells may share a bucket: the cell itself keeps a vertex from being met twice.
          if (scratch.cell_of[v] == cell && overlaps(query, t, v)) {
            pairs.push_back({TetId{t}, VertexId{v}});
          }
        }
      }
    }
  }
  std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end());
}

}  // namespace

void find_sphere_pairs(std::vector<SpherePair>& pairs, GridScratch& scratch,
                       const SphereQuery& query) {
  SUNDER_ASSERT(query.points.size() == query.point_component.size(), "one component a vertex");
  SUNDER_ASSERT(query.centres.size() == query.radii.size() &&
                    query.centres.size() == query.centre_component.size(),
                "one radius and one component a ball");
  pairs.clear();
  const Grid grid = fill_grid(scratch, query);
  for (std::size_t t = 0; t < query.centres.size(); ++t) {
    if (!query.centres[t].allFinite() || !std::isfinite(query.radii[t])) continue;
    if (query.radii[t] <= 0) continue;
    visit_cells(pairs, scratch, grid, query, t);
  }
}

void find_sphere_pairs_brute_force(std::vector<SpherePair>& pairs, const SphereQuery& query) {
  pairs.clear();
  for (std::size_t t = 0; t < query.centres.size(); ++t) {
    if (!query.centres[t].allFinite() || !std::isfinite(query.radii[t])) continue;
    compare_all_points(pairs, query, t);
  }
}

}  // namespace sunder
