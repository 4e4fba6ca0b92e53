// SPDX-License-Identifier: MIT
// Bodies of fan.hpp, for the sources that instantiate them for a kernel.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "topology/kernel/fan.hpp"
#include "topology/kernel/point_math.hpp"
#include "topology/kernel/split_face_impl.hpp"

namespace sunder::detail {

inline double largest_magnitude(const Point& a) {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

/// Whether the rest centre of `t` is on the positive side of the plane through `at`, or on it.
/// On the plane: within 1e-10 of the distance between centre and `at` (eigenvectors are not better
/// than that), plus the rounding of the centre itself (4 additions at the size of coordinates).
template <Kernel K>
bool is_positive(const K& map, TetId t, const Point& n, const Point& at) {
  Point away = {0, 0, 0};
  double size = largest_magnitude(at);
  for (const VertexId v : map.corners(t)) {
    const Point x = map.point(v);
    size = std::max(size, largest_magnitude(x));
    for (int i = 0; i < 3; ++i) away[i] += (x[i] - at[i]) / 4;
  }
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const double length = std::sqrt(dot(n, n));
  const double tolerance = length * (1e-10 * std::sqrt(dot(away, away)) + rounding * size);
  return dot(n, away) >= -tolerance;
}

inline Finding not_a_direction() {
  Finding finding;
  finding.code = "not_a_direction";
  finding.text = "the normal is zero or not finite (or the plane's offset is not finite)";
  finding.remedy = "give a normal of three finite numbers, not all zero";
  return finding;
}

inline Finding no_such_vertex(VertexId vertex, std::size_t vertices) {
  Finding finding;
  finding.code = "no_such_vertex";
  finding.ids = {static_cast<std::int64_t>(vertex.value)};
  finding.text = "vertex " + std::to_string(vertex.value) +
                 " is not a vertex of the body, which has rows 0 to " +
                 std::to_string(vertices == 0 ? 0 : vertices - 1);
  finding.remedy = "give the row of a vertex that belongs to a tetrahedron";
  return finding;
}

using PointTriple = std::array<std::uint32_t, 3>;

inline PointTriple sorted(PointTriple triple) {
  std::sort(triple.begin(), triple.end());
  return triple;
}

}  // namespace sunder::detail

namespace sunder {

template <Kernel K>
std::vector<TetId> star(const K& map, VertexId vertex) {
  const TetId t = map.incident_tetrahedron(vertex);
  std::vector<TetId> tetrahedra;
  if (t.is_none()) return tetrahedra;
  const CornerId start = corner(t, place_of_vertex(map.corners(t), vertex));
  for (const CornerId c : detail::orbit_corners(map, vertex, start)) {
    tetrahedra.push_back(tetrahedron_of(c));
  }
  std::sort(tetrahedra.begin(), tetrahedra.end());
  return tetrahedra;
}

template <Kernel K>
std::vector<HalfFaceId> fan_faces(const K& map, VertexId vertex, std::span<const TetId> star,
                                  std::span<const char> positive) {
  SUNDER_ASSERT(star.size() == positive.size(), "one sign for each tetrahedron of the star");
  std::vector<HalfFaceId> fan;
  for (std::size_t i = 0; i < star.size(); ++i) {
    if (!positive[i]) continue;
    const int at = place_of_vertex(map.corners(star[i]), vertex);
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId across = map.neighbour(half_face(star[i], p));
      if (p == at || across.is_none()) continue;
      const auto other = std::lower_bound(star.begin(), star.end(), tetrahedron_of(across));
      SUNDER_ASSERT(other != star.end() && *other == tetrahedron_of(across), "a whole star");
      if (!positive[static_cast<std::size_t>(other - star.begin())]) {
        fan.push_back(half_face(star[i], p));
      }
    }
  }
  return fan;
}

template <Kernel K>
Result<std::vector<HalfFaceId>> fan_faces(const K& map, VertexId vertex, const Point& normal) {
  const std::optional<Point> n = canonical_direction(normal);
  if (!n) return detail::not_a_direction();
  if (vertex.index() >= map.vertices() || map.incident_tetrahedron(vertex).is_none()) {
    return detail::no_such_vertex(vertex, map.vertices());
  }
  const std::vector<TetId> around = star(map, vertex);
  std::vector<char> positive(around.size());
  for (std::size_t i = 0; i < around.size(); ++i) {
    positive[i] = detail::is_positive(map, around[i], *n, map.point(vertex)) ? 1 : 0;
  }
  return fan_faces(map, vertex, around, positive);
}

template <Kernel K>
Result<std::vector<HalfFaceId>> plane_faces(const K& map, const CuttingPlane& plane) {
  const std::optional<Point> n = canonical_direction(plane.normal);
  if (!n || !std::isfinite(plane.offset)) return detail::not_a_direction();
  // The foot of the origin on the plane: any point of it would do, this one is nearest.
  // Its square is taken of the scaled normal, which cannot overflow.
  const double scale =
      *std::max_element(plane.normal.begin(), plane.normal.end(),
                        [](double a, double b) { return std::abs(a) < std::abs(b); });
  const double s = plane.offset / scale / detail::dot(*n, *n);
  const Point at = {s * (*n)[0], s * (*n)[1], s * (*n)[2]};
  std::vector<char> positive(map.tetrahedra());
  for (std::size_t t = 0; t < positive.size(); ++t) {
    positive[t] = detail::is_positive(map, TetId{t}, *n, at) ? 1 : 0;
  }
  std::vector<HalfFaceId> faces;
  for (std::size_t t = 0; t < positive.size(); ++t) {
    for (int p = 0; positive[t] && p < 4; ++p) {
      const HalfFaceId across = map.neighbour(half_face(TetId{t}, p));
      if (across.is_none() || positive[tetrahedron_of(across).index()]) continue;
      faces.push_back(half_face(TetId{t}, p));
    }
  }
  return faces;
}

template <Kernel K>
void order_faces(const K& map, FaceOrder order, std::vector<HalfFaceId>& faces) {
  if (order == FaceOrder::given) return;
  std::stable_partition(faces.begin(), faces.end(), [&map](HalfFaceId f) {
    const auto corners = map.corners(tetrahedron_of(f));
    const auto& places = dart_order::face_corners[place_of(f)];
    for (int i = 0; i < 3; ++i) {
      const VertexId a = corners[places[i]], b = corners[places[(i + 1) % 3]];
      if (detail::walk_round_edge(map, f, a, b).is_open) return true;
    }
    return false;
  });
}

template <Kernel K>
std::vector<HalfFaceId> find_faces(const K& map, std::span<const detail::PointTriple> points) {
  std::vector<HalfFaceId> found(points.size());
  std::vector<std::pair<detail::PointTriple, std::size_t>> wanted;
  for (std::size_t i = 0; i < points.size(); ++i) wanted.push_back({detail::sorted(points[i]), i});
  std::sort(wanted.begin(), wanted.end());
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
    const auto corners = map.corners(TetId{t});
    for (int p = 0; p < 4; ++p) {
      detail::PointTriple face;
      for (int i = 0; i < 3; ++i) {
        face[i] = map.point_of_vertex(corners[dart_order::face_corners[p][i]]);
      }
      face = detail::sorted(face);
      auto match = std::lower_bound(wanted.begin(), wanted.end(), std::pair{face, std::size_t{0}});
      for (; match != wanted.end() && match->first == face; ++match) {
        if (found[match->second].is_none()) found[match->second] = half_face(TetId{t}, p);
      }
    }
  }
  return found;
}

}  // namespace sunder
