// SPDX-License-Identifier: MIT
// Candidate planes of a vertex, the faces each of them parts, and which is best.
#include "fracture/algorithms/choose_fan.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "topology/kernel/fan.hpp"

namespace sunder {
namespace {

/// A vertex with its surroundings, as its candidates see them.
struct Place {
  const Cells& cells;
  VertexId vertex;
  std::vector<TetId> star;
  std::vector<Vec3> away;  // from the vertex to each rest centre of the star, m
  Vec3 octant;
};

Vec3 point_of(const VolumeMap& map, VertexId v) {
  const Point& p = map.point(v);
  return {p[0], p[1], p[2]};
}

Place look_around(const Cells& cells, VertexId vertex, const Vec3& centre) {
  const Vec3 at = point_of(cells.map, vertex);
  Place place{cells, vertex, star(cells.map, vertex), {}, {}};
  Vec3 middle = at;
  for (const TetId t : place.star) {
    Vec3 away = Vec3::Zero();
    for (const VertexId v : cells.map.corners(t)) away += (point_of(cells.map, v) - at) / 4;
    place.away.push_back(away);
    middle += away / static_cast<double>(place.star.size());
  }
  // Not by the vertex itself: copies on a mirror's plane have their images there too.
  place.octant = octant_of(middle, centre);
  return place;
}

/// Whether walking round one of the half-face's edges, away from the face, ends at a crack.
bool borders_crack(const Cells& cells, HalfFaceId face) {
  const VolumeMap& map = cells.map;
  for (const int place : dart_order::face_corners[place_of(face)]) {
    const DartId start = map.dart(face, corner(tetrahedron_of(face), place));
    DartId d = start;
    do {
      d = map.beta2(d);
      if (map.is_free(d)) {
        // Three darts a half-face, in the same order.
        if (is_crack_face(cells, HalfFaceId{map.id(d).index() / 3})) return true;
        break;
      }
      d = map.beta3(d);
    } while (d != start);
  }
  return false;
}

bool touches_unbreakable(const Cells& cells, HalfFaceId face) {
  const auto& corners = cells.map.corners(tetrahedron_of(face));
  return std::ranges::any_of(dart_order::face_corners[place_of(face)], [&](int place) {
    return cells.unbreakable[corners[place].index()] != 0;
  });
}

/// The fan of a plane, but for faces that nothing may split.
FanPlane fan_of(const Place& place, const Vec3& normal) {
  std::vector<char> positive(place.star.size());
  for (std::size_t i = 0; i < place.star.size(); ++i) {
    const Vec3& away = place.away[i];
    positive[i] = normal.dot(away) >= -equal_directions * normal.norm() * away.norm();
  }
  FanPlane fan{normal, fan_faces(place.cells.map, place.vertex, place.star, positive)};
  std::erase_if(fan.faces, [&](HalfFaceId f) { return touches_unbreakable(place.cells, f); });
  return fan;
}

/// A fan and how good it is.
struct Candidate {
  FanPlane fan;
  double alignment = 0;
  int on_crack = 0;
};

Candidate judge_fan(const Cells& cells, FanPlane fan) {
  Candidate candidate{std::move(fan)};
  double area = 0, aligned = 0;
  for (const HalfFaceId f : candidate.fan.faces) {
    const Vec3 a = rest_area_vector(cells, f);
    area += a.norm();
    aligned += std::abs(a.dot(candidate.fan.normal));
    candidate.on_crack += borders_crack(cells, f) || borders_crack(cells, cells.map.neighbour(f));
  }
  candidate.alignment = aligned / area;
  return candidate;
}

/// Leaves the candidates whose value is largest, and those tied with it. Not pairwise: ties are not
/// transitive, and what wins must not depend on the order.
template <class Value>
void keep_largest(std::vector<Candidate>& candidates, const Value& value) {
  double largest = value(candidates.front());
  for (const Candidate& c : candidates) largest = std::max(largest, value(c));
  std::erase_if(candidates,
                [&](const Candidate& c) { return value(c) < largest - equal_directions; });
}

/// The best of the candidates; the first of those on the same plane. Needs one at least.
Candidate& best_of(std::vector<Candidate>& candidates, const Vec3& octant) {
  keep_largest(candidates, [](const Candidate& c) { return c.alignment; });
  keep_largest(candidates, [](const Candidate& c) { return double(c.on_crack); });
  for (int i = 0; i < 3; ++i) {
    keep_largest(candidates, [i](const Candidate& c) { return std::abs(c.fan.normal(i)); });
  }
  for (int i = 0; i < 3; ++i) {
    keep_largest(candidates, [&](const Candidate& c) { return c.fan.normal(i) * octant(i); });
  }
  return candidates.front();
}

/// Adds the fan of a normal and, where anything lies on the plane, that of its opposite.
void add_fans(std::vector<Candidate>& candidates, const Place& place, const Vec3& normal) {
  const bool touched = std::ranges::any_of(place.away, [&](const Vec3& away) {
    return std::abs(normal.dot(away)) <= equal_directions * away.norm();
  });
  for (const double sign : {1.0, -1.0}) {
    FanPlane fan = fan_of(place, sign * normal);
    if (!fan.faces.empty()) candidates.push_back(judge_fan(place.cells, std::move(fan)));
    if (!touched) return;
  }
}

/// Normals of the interior faces at a vertex, in rising order of half-face.
std::vector<Vec3> interior_face_normals(const Place& place) {
  const VolumeMap& map = place.cells.map;
  std::vector<Vec3> normals;
  for (const TetId t : place.star) {
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId f = half_face(t, p);
      if (map.corners(t)[p] == place.vertex) continue;
      const HalfFaceId other = map.neighbour(f);
      if (!other.is_none() && f < other) {
        normals.push_back(rest_area_vector(place.cells, f).normalized());
      }
    }
  }
  return normals;
}

double wall_us() {
  return std::chrono::duration<double, std::micro>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

FanPlane choose_fan(const Cells& cells, VertexId vertex, const PrincipalTension& tension,
                    const Vec3& centre) {
  const Place place = look_around(cells, vertex, centre);
  std::vector<Vec3> face_normals;
  if (tension.directions.cols() > 1) face_normals = interior_face_normals(place);
  std::vector<Candidate> candidates;
  for (const Vec3& normal : candidate_normals(tension, face_normals, place.octant)) {
    add_fans(candidates, place, normal);
  }
  if (candidates.empty()) return {};
  return std::move(best_of(candidates, place.octant).fan);
}

PlannedFan plan_fan(const Cells& cells, VertexId vertex, const PrincipalTension& tension,
                    const Vec3& centre) {
  // Signs of the tetrahedra around v relatively to the plane, and the faces between them.
  const double start = wall_us();
  PlannedFan fan{vertex, choose_fan(cells, vertex, tension, centre), tension.value,
                 cells.strength[vertex.index()]};
  fan.choose_us = wall_us() - start;
  return fan;
}

PlannedFan plan_known_fan(const Cells& cells, VertexId vertex, const Vec3& normal, double stress) {
  const double start = wall_us();
  PlannedFan fan{vertex, fan_of(look_around(cells, vertex, Vec3::Zero()), normal), stress,
                 cells.strength[vertex.index()]};
  fan.choose_us = wall_us() - start;
  return fan;
}

}  // namespace sunder
