// SPDX-License-Identifier: MIT
#include "tests/experiments/rubble/outside_judge.hpp"

#include <algorithm>
#include <numeric>

#include "mechanics/contact/shapes/manifold.hpp"

namespace sunder::test {
namespace {

/// The least value below which nine tenths of the mass lie.
double nine_tenths(std::vector<std::pair<double, double>> value_and_mass, double total) {
  std::ranges::sort(value_and_mass);
  double sum = 0;
  for (const auto& [value, mass] : value_and_mass) {
    sum += mass;
    if (sum >= 0.9 * total) return value;
  }
  return 0;
}

double mean_edge(std::span<const SeenPart> parts) {
  double sum = 0;
  std::size_t edges = 0;
  for (const SeenPart& part : parts) {
    for (std::size_t e = 0; e < part.solid.kind->edges; ++e) sum += part.solid.edge[e].norm();
    edges += part.solid.kind->edges;
  }
  return edges > 0 ? sum / static_cast<double>(edges) : 0;
}

/// Adds one pair of rows; `seen.mean` holds the sum until all are seen.
void see_pair(SeenOverlaps& seen, std::span<const SeenPart> parts, std::size_t a, std::size_t b) {
  if (a > b) std::swap(a, b);
  if (parts[a].piece == parts[b].piece) return;
  const double depth = -separation_by_all_axes(parts[a].solid, parts[b].solid);
  if (!(depth > 1e-6 * seen.edge)) return;
  ++seen.pairs;
  seen.mean += depth;
  if (depth <= seen.deepest) return;
  seen.deepest = depth;
  seen.where = {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)};
}

}  // namespace

SeenOverlaps see_overlaps(std::span<const SeenPart> parts) {
  SeenOverlaps seen{.edge = mean_edge(parts)};
  std::vector<Vec3> low(parts.size()), high(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Polytope& p = parts[i].solid;
    low[i] = high[i] = p.vertex[0];
    for (std::size_t v = 1; v < p.kind->vertices; ++v) {
      low[i] = low[i].cwiseMin(p.vertex[v]);
      high[i] = high[i].cwiseMax(p.vertex[v]);
    }
  }
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return low[i].x(); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t a = order[k];
    for (std::size_t l = k + 1; l < order.size(); ++l) {
      const std::size_t b = order[l];
      if (low[b].x() > high[a].x()) break;
      if ((low[a].array() <= high[b].array()).all() && (low[b].array() <= high[a].array()).all()) {
        see_pair(seen, parts, a, b);
      }
    }
  }
  if (seen.pairs > 0) seen.mean /= static_cast<double>(seen.pairs);
  return seen;
}

SeenOverlaps see_overlaps_slowly(std::span<const SeenPart> parts) {
  SeenOverlaps seen{.edge = mean_edge(parts)};
  for (std::size_t a = 0; a < parts.size(); ++a) {
    for (std::size_t b = a + 1; b < parts.size(); ++b) see_pair(seen, parts, a, b);
  }
  if (seen.pairs > 0) seen.mean /= static_cast<double>(seen.pairs);
  return seen;
}

HeapShape see_heap(std::span<const SeenMass> masses) {
  double total = 0;
  Vec3 centre = Vec3::Zero();
  for (const SeenMass& m : masses) {
    total += m.mass;
    centre += m.mass * m.place;
  }
  centre /= total;
  std::vector<std::pair<double, double>> heights, radii;
  for (const SeenMass& m : masses) {
    heights.emplace_back(m.place.z(), m.mass);
    radii.emplace_back((m.place - centre).head<2>().norm(), m.mass);
  }
  return {nine_tenths(std::move(heights), total), nine_tenths(std::move(radii), total), centre.z()};
}

}  // namespace sunder::test
