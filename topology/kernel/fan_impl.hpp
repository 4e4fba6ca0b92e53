// SPDX-License-Identifier: MIT
// Bodies of fan.hpp, for the sources that instantiate them for a kernel.
#pragma once

#include <algorithm>
#include <string>

#include "topology/kernel/fan.hpp"
#include "topology/kernel/split_face_impl.hpp"

namespace sunder::detail {

template <Kernel K>
std::array<Point, 4> rest_positions(const K& map, TetId t) {
  const auto corners = map.corners(t);
  return {map.point(corners[0]), map.point(corners[1]), map.point(corners[2]),
          map.point(corners[3])};
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
VertexStar vertex_star(const K& map, VertexId vertex) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return vertex_star(kernel, vertex); });
  }
  const TetId t = map.incident_tetrahedron(vertex);
  if (t.is_none()) return {vertex, {}};
  const CornerId start = corner(t, place_of_vertex(map.corners(t), vertex));
  VertexStar around{vertex, detail::orbit_corners(map, vertex, start)};
  std::sort(around.corners.begin(), around.corners.end());
  return around;
}

template <Kernel K>
std::vector<TetId> star(const K& map, VertexId vertex) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return star(kernel, vertex); });
  }
  std::vector<TetId> tetrahedra;
  for (const CornerId c : vertex_star(map, vertex).corners) tetrahedra.push_back(tetrahedron_of(c));
  return tetrahedra;
}

template <Kernel K>
std::vector<char> plane_signs(const K& map, const VertexStar& around, const Point& normal) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return plane_signs(kernel, around, normal); });
  }
  const PlaneThrough plane{map.point(around.vertex), normal};
  std::vector<char> positive;
  for (const CornerId c : around.corners) {
    positive.push_back(is_positive(plane, detail::rest_positions(map, tetrahedron_of(c))) ? 1 : 0);
  }
  return positive;
}

template <Kernel K>
std::vector<HalfFaceId> fan_faces(const K& map, const VertexStar& around,
                                  std::span<const char> positive) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return fan_faces(kernel, around, positive); });
  }
  const std::vector<CornerId>& star = around.corners;
  SUNDER_ASSERT(star.size() == positive.size(), "one sign for each tetrahedron of the star");
  std::vector<HalfFaceId> fan;
  for (std::size_t i = 0; i < star.size(); ++i) {
    if (!positive[i]) continue;
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId face = half_face(tetrahedron_of(star[i]), p), across = map.neighbour(face);
      if (p == place_of(star[i]) || across.is_none()) continue;
      const auto other = std::ranges::lower_bound(star, corner(tetrahedron_of(across), 0));
      SUNDER_ASSERT(other != star.end() && tetrahedron_of(*other) == tetrahedron_of(across),
                    "a whole star");
      if (!positive[static_cast<std::size_t>(other - star.begin())]) fan.push_back(face);
    }
  }
  return fan;
}

template <Kernel K>
Result<std::vector<HalfFaceId>> fan_faces(const K& map, VertexId vertex, const Point& normal) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return fan_faces(kernel, vertex, normal); });
  }
  const std::optional<Point> n = read_direction(normal);
  if (!n) return detail::not_a_direction();
  if (vertex.index() >= map.vertices() || map.incident_tetrahedron(vertex).is_none()) {
    return detail::no_such_vertex(vertex, map.vertices());
  }
  const VertexStar around = vertex_star(map, vertex);
  return fan_faces(map, around, plane_signs(map, around, *n));
}

template <Kernel K>
Result<std::vector<HalfFaceId>> plane_faces(const K& map, const CuttingPlane& plane) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return plane_faces(kernel, plane); });
  }
  const std::optional<PlaneThrough> through = read_plane(plane);
  if (!through) return detail::not_a_direction();
  std::vector<char> positive(map.tetrahedra());
  for (std::size_t t = 0; t < positive.size(); ++t) {
    positive[t] = is_positive(*through, detail::rest_positions(map, TetId{t})) ? 1 : 0;
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
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return order_faces(kernel, order, faces); });
  }
  if (order == FaceOrder::given) return;
  std::stable_partition(faces.begin(), faces.end(), [&map](HalfFaceId f) {
    const auto v = corners_of_face(map.corners(tetrahedron_of(f)), f);
    for (int i = 0; i < 3; ++i) {
      if (detail::walk_round_edge(map, f, v[i], v[(i + 1) % 3]).is_open) return true;
    }
    return false;
  });
}

template <Kernel K>
std::vector<HalfFaceId> find_faces(const K& map, std::span<const detail::PointTriple> points) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return find_faces(kernel, points); });
  }
  std::vector<HalfFaceId> found(points.size());
  std::vector<std::pair<detail::PointTriple, std::size_t>> wanted;
  for (std::size_t i = 0; i < points.size(); ++i) wanted.push_back({detail::sorted(points[i]), i});
  std::sort(wanted.begin(), wanted.end());
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
    for (int p = 0; p < 4; ++p) {
      const auto v = corners_of_face(map.corners(TetId{t}), half_face(TetId{t}, p));
      const detail::PointTriple face = detail::sorted(
          {map.point_of_vertex(v[0]), map.point_of_vertex(v[1]), map.point_of_vertex(v[2])});
      auto match = std::lower_bound(wanted.begin(), wanted.end(), std::pair{face, std::size_t{0}});
      for (; match != wanted.end() && match->first == face; ++match) {
        if (found[match->second].is_none()) found[match->second] = half_face(TetId{t}, p);
      }
    }
  }
  return found;
}

}  // namespace sunder
