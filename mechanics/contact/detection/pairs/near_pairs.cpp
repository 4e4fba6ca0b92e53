// SPDX-License-Identifier: MIT
// Which pairs still hold, and searches for the rest.
#include "mechanics/contact/detection/pairs/near_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/contact/detection/contact_detect.hpp"

namespace sunder {
namespace {

/// Row = component: the farthest that one of its vertices goes from `from` to `to`, against the
/// mean of all.
template <class Add>
void measure_ways(std::span<const Vec3> from, std::span<const Vec3> to,
                  std::span<const ComponentId> component, Add add) {
  const std::size_t count = std::min(from.size(), to.size());
  Vec3 mean = Vec3::Zero();
  for (std::size_t v = 0; v < count; ++v) mean += to[v] - from[v];
  mean /= static_cast<double>(std::max<std::size_t>(count, 1));
  for (std::size_t v = 0; v < count; ++v) {
    add(component[v].index(), (to[v] - from[v] - mean).squaredNorm());
  }
}

bool by_numbers(const NearPair& p, const NearPair& q) {
  return std::pair(p.a, p.b) < std::pair(q.a, q.b);
}

}  // namespace

void update_travel(Travel& travel, const StepPaths& paths) {
  const VertexColumns& v = paths.state.vertices;
  const std::size_t components = paths.state.components.size();
  travel.so_far.resize(components, 0);
  travel.parted.resize(components, 0);
  travel.in_step.assign(components, 0);
  const auto largest = [&](std::size_t c, double squared) {
    travel.in_step[c] = std::max(travel.in_step[c], squared);
  };
  measure_ways(travel.position, v.position, v.component, largest);
  for (std::size_t c = 0; c < components; ++c) {
    travel.so_far[c] += std::sqrt(travel.in_step[c]);
    travel.in_step[c] = 0;
  }
  measure_ways(v.position, paths.predicted, v.component, largest);
  travel.farthest = 0;
  for (double& way : travel.in_step) {
    way = std::sqrt(way);
    travel.farthest = std::max(travel.farthest, way);
  }
  travel.position = v.position;
}

double width_of(const NearQuery& query, std::uint32_t component) {
  return std::max(0.5 * query.margin, 2 * query.travel.in_step[component]);
}

bool find_stale(NearPairs& pairs, const NearQuery& query) {
  const Travel& travel = query.travel;
  const std::size_t components = travel.so_far.size();
  pairs.limit.resize(components, -std::numeric_limits<double>::infinity());
  pairs.shape.resize(components, 0);
  pairs.is_stale.assign(components, 0);
  const auto is_over = [&](std::size_t c, double ahead) {
    return !(travel.so_far[c] + ahead <= pairs.limit[c]) || pairs.shape[c] != query.shape[c];
  };
  bool any = false;
  for (std::size_t c = 0; c < components && !any; ++c) any = is_over(c, travel.in_step[c]);
  if (!any) return false;
  // With those that are over, those that soon will be: a search costs as much for one as for many.
  for (std::size_t c = 0; c < components; ++c) {
    if (!is_over(c, std::max(travel.in_step[c], 0.25 * query.margin))) continue;
    pairs.is_stale[c] = 1;
    pairs.shape[c] = query.shape[c];
    pairs.limit[c] = travel.so_far[c] + width_of(query, static_cast<std::uint32_t>(c));
  }
  std::erase_if(pairs.found, [&](const NearPair& p) {
    return pairs.is_stale[p.body_a] || pairs.is_stale[p.body_b];
  });
  return true;
}

void add_pairs(NearPairs& pairs, BoxScratch& grid, std::span<const Bounds> boxes,
               std::span<const std::uint32_t> body, std::span<const std::uint32_t> number) {
  ++pairs.searches;
  std::vector<RowPair> found;
  find_box_pairs(found, grid, {boxes, body, pairs.is_stale, {}});
  const auto kept = static_cast<std::ptrdiff_t>(pairs.found.size());
  for (const auto& [p, q] : found) {
    NearPair pair{.a = number[p], .b = number[q], .body_a = body[p], .body_b = body[q]};
    if (pair.b < pair.a) {
      std::swap(pair.a, pair.b);
      std::swap(pair.body_a, pair.body_b);
    }
    pairs.found.push_back(pair);
  }
  std::sort(pairs.found.begin() + kept, pairs.found.end(), by_numbers);
  std::inplace_merge(pairs.found.begin(), pairs.found.begin() + kept, pairs.found.end(),
                     by_numbers);
}

bool is_due(const NearPair& pair, const Travel& travel) {
  if (pair.facing > 0) {
    return pair.facing != 1 + travel.parted[pair.body_a] + travel.parted[pair.body_b];
  }
  return travel.end_of(pair.body_a, pair.body_b) >= pair.quiet;
}

void measure_shapes(std::vector<std::uint64_t>& shape, const PieceSurface& surface,
                    const ElementColumns& elements, std::size_t components) {
  // Cracks add faces to a component, pieces that come off take tetrahedra away.
  shape.assign(components, 1);
  for (const ComponentId id : elements.component) shape[id.index()] += 1ull << 32;
  for (const HalfFaceId face : surface.faces) {
    ++shape[elements.component[tetrahedron_of(face).index()].index()];
  }
}

}  // namespace sunder
