// SPDX-License-Identifier: MIT
// Which vertices may meet which tetrahedra in a step: by balls, and by boxes where ways are long.
#include "mechanics/contact/detection/contact_detect.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/contact/detection/pairs/solid_pairs.hpp"
#include "topology/base/sort_unique.hpp"

namespace sunder {

void measure_balls(DetectScratch& scratch, const StepPaths& paths, double share) {
  const std::size_t count = paths.corners.size();
  const std::vector<Vec3>& rest = paths.state.vertices.rest_position;
  scratch.centre_start.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    scratch.centre_start[t] = centre_of(paths.corners[t], paths.state.vertices.position);
  }
  if (scratch.radius.size() == count && scratch.ball_share == share) return;
  scratch.ball_share = share;
  scratch.radius.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    const Vec3 centre = centre_of(paths.corners[t], rest);
    double squared = 0;
    for (VertexId v : paths.corners[t]) {
      squared = std::max(squared, (rest[v.index()] - centre).squaredNorm());
    }
    scratch.radius[t] = share * std::sqrt(squared);
  }
}

namespace {

/// `DetectScratch::beside_share` of boxes on ways.
constexpr double share_on_ways = 0.1;

/// Pairs of vertices and tetrahedra by the boxes of tetrahedra and corners on their ways.
void pair_up_by_boxes(DetectScratch& scratch, const StepPaths& paths) {
  SolidPairs& pairs = scratch.solid_pairs;
  pairs.boxes.clear();
  pairs.body.clear();
  pairs.ways.clear();
  pairs.tetrahedra.clear();
  const MechanicsState& state = paths.state;
  const std::size_t components = state.components.size();
  mark_inside(pairs.moves, paths);
  pairs.moves.resize(components + paths.obstacles.size(), 0);
  for (std::size_t t = 0; t < paths.corners.size(); ++t) {
    const ComponentId id = state.elements.component[t];
    if (!paths.is_searched(id)) continue;
    const Vec3 way = centre_of(paths.corners[t], paths.predicted) - scratch.centre_start[t];
    Bounds box{paths.at_start(paths.corners[t][0]), paths.at_start(paths.corners[t][0])};
    for (const VertexId v : paths.corners[t]) {
      const Vec3 start = paths.at_start(v), end = paths.at_end(v) - way;
      box.low = box.low.cwiseMin(start).cwiseMin(end);
      box.high = box.high.cwiseMax(start).cwiseMax(end);
    }
    // Vertices count as near within rounding and the penetration that is left alone.
    const Vec3 beside = Vec3::Constant(scratch.beside_share * scratch.radius[t]);
    pairs.tetrahedra.emplace_back(t);
    pairs.boxes.push_back({box.low - beside, box.high + beside});
    pairs.ways.push_back(way);
    pairs.body.push_back(id.value);
  }
  const std::size_t count = pairs.tetrahedra.size();
  for (const CornerPath& corner : paths.corner) {
    pairs.boxes.push_back({corner.start, corner.start});
    pairs.ways.push_back(corner.end - corner.start);
    pairs.body.push_back(static_cast<std::uint32_t>(components) + corner.obstacle);
  }
  find_box_pairs(pairs.found, pairs.grid, {pairs.boxes, pairs.body, pairs.moves, pairs.ways});
  scratch.pairs.clear();
  const auto add_if_met = [&](std::size_t row, VertexId v) {
    const Vec3 way = paths.at_end(v) - paths.at_start(v) - pairs.ways[row];
    if (meet({paths.at_start(v), paths.at_start(v)}, pairs.boxes[row], way)) {
      scratch.pairs.push_back({pairs.tetrahedra[row], v});
    }
  };
  const auto corners_of = [&](std::size_t row) -> const Corners& {
    return paths.corners[pairs.tetrahedra[row].index()];
  };
  for (const auto& [a, b] : pairs.found) {
    if (a >= count) continue;
    if (b >= count) {
      add_if_met(a, VertexId{paths.predicted.size() + b - count});
      continue;
    }
    for (const VertexId v : corners_of(a)) add_if_met(b, v);
    for (const VertexId v : corners_of(b)) add_if_met(a, v);
  }
  sort_unique(scratch.pairs);
}

}  // namespace

/// Every pair with paths that come within a radius of each other lies, half-way, within the radius
/// and half their relative motion. Where that is more than two radii, boxes on their ways are
/// smaller.
void pair_up(DetectScratch& scratch, const StepPaths& paths) {
  if (!paths.scope.empty()) {
    scratch.beside_share = share_on_ways;
    return pair_up_by_boxes(scratch, paths);
  }
  const std::vector<Vec3>& start = paths.state.vertices.position;
  const std::size_t points = start.size(), all = points + paths.corner.size();
  Vec3 mean = Vec3::Zero();
  for (std::size_t v = 0; v < points; ++v) mean += paths.predicted[v] - start[v];
  mean /= static_cast<double>(std::max<std::size_t>(points, 1));
  double largest = 0;
  scratch.point_middle.resize(all);
  for (std::size_t v = 0; v < points; ++v) {
    largest = std::max(largest, (paths.predicted[v] - start[v] - mean).norm());
    scratch.point_middle[v] = 0.5 * (start[v] + paths.predicted[v]);
  }
  std::span<const ComponentId> component = paths.state.vertices.component;
  if (!paths.corner.empty()) {
    scratch.point_component.assign(component.begin(), component.end());
    scratch.point_component.resize(all, ComponentId::none());
    component = scratch.point_component;
  }
  for (std::size_t k = 0; k < paths.corner.size(); ++k) {
    const CornerPath& path = paths.corner[k];
    largest = std::max(largest, (path.end - path.start - mean).norm());
    scratch.point_middle[points + k] = 0.5 * (path.start + path.end);
  }
  bool is_fast = false;
  const std::size_t count = paths.corners.size();
  scratch.reach.resize(count);
  scratch.centre_middle.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    const Vec3 end = centre_of(paths.corners[t], paths.predicted);
    const double motion = (end - scratch.centre_start[t] - mean).norm() + largest;
    scratch.centre_middle[t] = 0.5 * (scratch.centre_start[t] + end);
    // Only members meet.
    const bool is_member = paths.members.has(paths.state.elements.component[t]);
    scratch.reach[t] = is_member ? scratch.radius[t] + 0.5 * motion : 0;
    if (is_member && !(motion < 2 * scratch.radius[t])) is_fast = true;
  }
  scratch.beside_share = is_fast ? share_on_ways : std::numeric_limits<double>::infinity();
  if (is_fast) return pair_up_by_boxes(scratch, paths);
  find_sphere_pairs(scratch.pairs, scratch.grid, scratch.cache,
                    {scratch.point_middle, component, scratch.centre_middle, scratch.reach,
                     paths.state.elements.component});
}

}  // namespace sunder
