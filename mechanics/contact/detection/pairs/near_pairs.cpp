// SPDX-License-Identifier: MIT
// Which pairs still hold, and searches for the rest.
#include "mechanics/contact/detection/pairs/near_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/contact/detection/contact_detect.hpp"
#include "mechanics/frame/affine_motion.hpp"

namespace sunder {
namespace {

/// Row = component, into `way`: the farthest that one of its vertices goes from `from` to `to`
/// against the field of all, and half of the approach by the field within `reach`, m.
void measure_ways(std::vector<double>& way, std::span<const Vec3> from, std::span<const Vec3> to,
                  std::span<const ComponentId> component, double reach) {
  const std::size_t count = std::min(from.size(), to.size());
  const AffineMotion field = fit_affine_motion(
      count, [&](std::size_t v) -> const Vec3& { return from[v]; },
      [&](std::size_t v) { return Vec3(to[v] - from[v]); });
  std::ranges::fill(way, 0.0);
  for (std::size_t v = 0; v < count; ++v) {
    double& largest = way[component[v].index()];
    largest = std::max(largest, (to[v] - from[v] - field.at(from[v])).squaredNorm());
  }
  const double by_field = 0.5 * reach * largest_approach(field);
  for (double& largest : way) largest = std::sqrt(largest) + by_field;
}

}  // namespace

void update_travel(Travel& travel, const StepPaths& paths) {
  const VertexColumns& v = paths.state.vertices;
  const std::size_t components = paths.state.components.size();
  travel.so_far.resize(components, 0);
  travel.parted.resize(components, 0);
  travel.in_step.assign(components, 0);
  measure_ways(travel.in_step, travel.position, v.position, v.component, travel.reach);
  for (std::size_t c = 0; c < components; ++c) travel.so_far[c] += travel.in_step[c];
  measure_ways(travel.in_step, v.position, paths.predicted, v.component, travel.reach);
  travel.farthest = 0;
  for (const double way : travel.in_step) travel.farthest = std::max(travel.farthest, way);
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
    if (!is_over(c, 2 * travel.in_step[c])) continue;
    pairs.is_stale[c] = 1;
    pairs.shape[c] = query.shape[c];
    pairs.limit[c] = travel.so_far[c] + width_of(query, static_cast<std::uint32_t>(c));
  }
  std::erase_if(pairs.found, [&](const NearPair& p) {
    return pairs.is_stale[p.body_a] || pairs.is_stale[p.body_b];
  });
  return true;
}

void find_stale_pairs(std::vector<RowPair>& found, NearPairs& pairs, SolidPairs& boxes) {
  ++pairs.searches;
  find_box_pairs(
      found, boxes.grid,
      {.boxes = boxes.boxes, .body = boxes.body, .moves = pairs.is_stale, .sorts = false});
}

void add_pairs(NearPairs& pairs, std::span<const RowPair> found,
               std::span<const std::uint32_t> body, std::span<const std::uint32_t> number) {
  for (const auto& [p, q] : found) {
    NearPair pair{.a = number[p], .b = number[q], .body_a = body[p], .body_b = body[q]};
    if (pair.b < pair.a) {
      std::swap(pair.a, pair.b);
      std::swap(pair.body_a, pair.body_b);
    }
    pairs.found.push_back(pair);
  }
}

void note_contacts(std::vector<PairContacts>& noted, const NearPair& pair,
                   const DetectScratch& scratch, std::size_t first) {
  const std::size_t end = scratch.found.size();
  if (end > first) noted.push_back({pair.a, pair.b, first, end});
}

void sort_contacts(DetectScratch& scratch, std::vector<PairContacts>& noted) {
  if (noted.empty()) return;
  const std::size_t first = noted.front().first;
  const auto at = static_cast<std::ptrdiff_t>(first);
  const std::vector<ContactPoint> found(scratch.found.begin() + at, scratch.found.end());
  const std::vector<double> gap(scratch.found_gap.begin() + at, scratch.found_gap.end());
  std::ranges::sort(noted, {}, [](const PairContacts& p) { return std::pair(p.a, p.b); });
  std::size_t row = first;
  for (const PairContacts& pair : noted) {
    for (std::size_t k = pair.first; k < pair.end; ++k, ++row) {
      scratch.found[row] = found[k - first];
      scratch.found_gap[row] = gap[k - first];
    }
  }
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
