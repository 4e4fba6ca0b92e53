// SPDX-License-Identifier: MIT
// Body of plane_cut.hpp, for the source that instantiates it for a kernel.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "topology/base/assert.hpp"
#include "topology/base/point_math.hpp"
#include "topology/cells/plane_cut.hpp"
#include "topology/cells/subdivide_impl.hpp"
#include "topology/kernel/fan_impl.hpp"

namespace sunder::detail {

/// Distances of the file's points from a plane, times the length of its normal and a power of two
/// that brings it to about 1, so that none overflows; 0 on it.
inline std::vector<double> distances(std::span<const Point> points, const CuttingPlane& plane) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  std::vector<double> distance;
  distance.reserve(points.size());
  double largest = 0;
  for (const double n : plane.normal) largest = std::max(largest, std::abs(n));
  const int scale = -std::ilogb(largest);
  constexpr double most = std::numeric_limits<double>::max();
  const double offset = std::clamp(std::ldexp(plane.offset, scale), -most, most);
  Point normal;
  for (std::size_t i = 0; i < 3; ++i) normal[i] = std::ldexp(plane.normal[i], scale);
  for (const Point& x : points) {
    double size = std::abs(offset);
    for (std::size_t i = 0; i < 3; ++i) size += std::abs(normal[i] * x[i]);
    const double d = dot(normal, x) - offset;
    distance.push_back(std::abs(d) <= rounding * size ? 0 : d);
  }
  return distance;
}

}  // namespace sunder::detail

namespace sunder {

template <CellKernel K>
Result<PlaneCut> cut_cells(K& map, const CuttingPlane& plane, double tolerance) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return cut_cells(kernel, plane, tolerance); });
  } else {
    SUNDER_ASSERT(tolerance >= 0 && tolerance < 0.5, "a part of an edge that leaves its middle");
    if (!read_plane(plane)) return detail::not_a_direction();
    std::vector<double> distance = detail::distances(map.points(), plane);
    const auto at = [&](VertexId v) -> double& { return distance[map.point_of_vertex(v)]; };
    const auto ends = [&](TetId t, int e) {
      const auto corners = map.corners(t);
      const auto& [a, b] = edge_ends[static_cast<std::size_t>(e)];
      return std::array<VertexId, 2>{corners[a], corners[b]};
    };
    const auto crosses = [&](const std::array<VertexId, 2>& e) {
      return (at(e[0]) < 0 && at(e[1]) > 0) || (at(e[0]) > 0 && at(e[1]) < 0);
    };
    const EdgeRows edges = edge_rows(map);
    // First the ends that an edge would be divided at, then the edges that still cross.
    std::vector<VertexId> near;
    for (const auto& [t, e] : edges.first) {
      const auto rows = ends(t, e);
      if (!crosses(rows)) continue;
      const double a = std::abs(at(rows[0])), b = std::abs(at(rows[1]));
      if (a <= tolerance * (a + b)) near.push_back(rows[0]);
      if (b <= tolerance * (a + b)) near.push_back(rows[1]);
    }
    for (const VertexId v : near) at(v) = 0;
    PlaneCut cut;
    for (std::size_t v = 0; v < map.vertices(); ++v) {
      cut.on_plane += !map.incident_tetrahedron(VertexId{v}).is_none() && at(VertexId{v}) == 0;
    }
    std::vector<EdgeMark> marks;
    for (const CellEdge& edge : edges.first) {
      auto rows = ends(edge.tetrahedron, edge.place);
      if (!crosses(rows)) continue;
      if (map.point_of_vertex(rows[1]) < map.point_of_vertex(rows[0])) std::swap(rows[0], rows[1]);
      marks.push_back({edge, at(rows[0]) / (at(rows[0]) - at(rows[1]))});
    }
    cut.edit = divide_edges(map, marks);
    distance.resize(map.points().size(), 0);

    const auto side = [&](TetId t) {
      double farthest = 0;
      for (const VertexId v : map.corners(t)) {
        if (std::abs(at(v)) > std::abs(farthest)) farthest = at(v);
      }
      return farthest;
    };
    for (std::size_t f = 0; f < 4 * map.tetrahedra(); ++f) {
      const HalfFaceId face{f}, other = map.neighbour(face);
      if (other.is_none() || side(tetrahedron_of(face)) <= 0) continue;
      // No tetrahedron has corners on both sides: the shared face lies in the plane.
      if (side(tetrahedron_of(other)) <= 0) cut.faces.push_back(face);
    }
    return cut;
  }
}

}  // namespace sunder
