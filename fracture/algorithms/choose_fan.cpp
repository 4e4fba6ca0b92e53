// SPDX-License-Identifier: MIT
// Candidate planes of a vertex, the faces each of them parts, and which is best.
#include "fracture/algorithms/choose_fan.hpp"

#include <algorithm>
#include <cmath>

namespace sunder {
namespace {

/// A vertex with its surroundings, as its candidates see them.
struct Place {
  const Cells& cells;
  const VertexStar& star;
  std::vector<CentreOffset> centres;  // of the star's tetrahedra, from the vertex
  Vec3 octant;
};

Place look_around(const Cells& cells, const VertexStar& v, const Vec3& centre) {
  const VolumeMap& map = cells.map;
  const Point& at = map.point(v.vertex);
  Place place{cells, v, {}, {}};
  Vec3 middle = {at[0], at[1], at[2]};
  for (const CornerId c : v.corners) {
    const Corners& rows = map.corners(tetrahedron_of(c));
    place.centres.push_back(centre_offset(
        {map.point(rows[0]), map.point(rows[1]), map.point(rows[2]), map.point(rows[3])}, at));
    middle += Vec3(place.centres.back().away.data()) / static_cast<double>(v.corners.size());
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

/// The fan of a plane, by the signs of algorithm 4.
FanPlane fan_of(const Place& place, const Vec3& normal) {
  std::vector<char> positive;
  for (const CentreOffset& centre : place.centres) {
    const PlaneSide side = plane_side({normal.x(), normal.y(), normal.z()}, centre);
    positive.push_back(side != PlaneSide::negative);
  }
  std::vector<HalfFaceId> faces = breakable_fan(place.cells, place.star, positive);
  return {normal, std::move(faces), std::move(positive)};
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
    const Vec3 a = rest_area_vector(cells.map, f);
    area += a.norm();
    aligned += std::abs(a.dot(candidate.fan.normal));
    candidate.on_crack += borders_crack(cells, f) || borders_crack(cells, cells.map.neighbour(f));
  }
  candidate.alignment = aligned / area;
  return candidate;
}

/// Leaves the candidates with the largest value, and those tied with it. Not pairwise: ties are not
/// transitive, and the winner must not depend on the order.
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
  const bool touched = std::ranges::any_of(place.centres, [&](const CentreOffset& centre) {
    return plane_side({normal.x(), normal.y(), normal.z()}, centre) == PlaneSide::on;
  });
  for (const double sign : {1.0, -1.0}) {
    FanPlane fan = fan_of(place, sign * normal);
    if (!fan.faces.empty()) candidates.push_back(judge_fan(place.cells, std::move(fan)));
    if (!touched) return;
  }
}

/// Normals of the interior faces at a vertex, in rising order of half-face.
std::vector<Vec3> interior_face_normals(const Place& place) {
  std::vector<Vec3> normals;
  for (const CornerId c : place.star.corners) {
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId f = half_face(tetrahedron_of(c), p);
      if (p == place_of(c)) continue;
      const HalfFaceId other = place.cells.map.neighbour(f);
      if (!other.is_none() && f < other) {
        normals.push_back(rest_area_vector(place.cells.map, f).normalized());
      }
    }
  }
  return normals;
}

}  // namespace

FanPlane choose_fan(const Cells& cells, const VertexStar& v, const PrincipalTension& tension,
                    const Vec3& centre) {
  const Place place = look_around(cells, v, centre);
  std::vector<Vec3> face_normals;
  if (tension.directions.cols() > 1) face_normals = interior_face_normals(place);
  std::vector<Candidate> candidates;
  for (const Vec3& normal : candidate_normals(tension, face_normals, place.octant)) {
    add_fans(candidates, place, normal);
  }
  if (candidates.empty()) return {};
  return std::move(best_of(candidates, place.octant).fan);
}

}  // namespace sunder
