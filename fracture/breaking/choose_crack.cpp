// SPDX-License-Identifier: MIT
// Fronts and flanks at a vertex, and the plane along which a crack goes on.
#include "fracture/breaking/choose_crack.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace sunder {
namespace {

Vec3 rest_position(const Cells& cells, VertexId v) { return Vec3(cells.map.point(v).data()); }

std::array<Point, 4> rest_corners(const Cells& cells, TetId t) {
  const Corners& rows = cells.map.corners(t);
  return {cells.map.point(rows[0]), cells.map.point(rows[1]), cells.map.point(rows[2]),
          cells.map.point(rows[3])};
}

/// Towards the positive side by the labels of a star: from the mean centre of the negative
/// tetrahedra to that of the positive; by the faces that the crack unsewed where one side is there.
Vec3 normal_by_labels(const Cells& cells, const VertexStar& v, const CrackAtVertex& crack) {
  Vec3 sums[2] = {Vec3::Zero(), Vec3::Zero()};
  int counts[2] = {0, 0};
  Vec3 faces = Vec3::Zero();
  for (const CornerId c : v.corners) {
    const TetId t = tetrahedron_of(c);
    const Side side = side_of(cells.cracks, crack.crack, t);
    if (side == Side::undecided) continue;
    const bool positive = side == Side::positive;
    for (const Point& x : rest_corners(cells, t)) sums[positive] += 0.25 * Vec3(x.data());
    ++counts[positive];
    for (int place = 0; place < 4; ++place) {
      const HalfFaceId f = half_face(t, place);
      if (place == place_of(c) || cells.cracks.of_face[f.index()] != crack.crack) continue;
      faces += (positive ? -1 : 1) * rest_area_vector(cells.map, f);
    }
  }
  const Vec3 n = crack.is_front() ? Vec3(sums[1] / counts[1] - sums[0] / counts[0]) : faces;
  return n.isZero(0) ? n : n.normalized();
}

/// A crack as the vertex sees it.
struct Seen {
  CrackAtVertex at;
  AnchorSums anchors;
  Vec3 normal;        ///< its own, there
  double cosine = 0;  ///< between that and the nearest tension
};

Vec3 tension_towards(const PrincipalTension& tension, const Vec3& normal) {
  return tension.directions * (tension.directions.transpose() * normal);
}

/// Order of directions that mirror images share: larger |x|, |y|, |z|, then x, y, z as folded.
bool comes_first(const Vec3& a, const Vec3& b, const Vec3& octant) {
  for (int i = 0; i < 3; ++i) {
    const double difference = std::abs(a[i]) - std::abs(b[i]);
    if (std::abs(difference) > equal_directions) return difference > 0;
  }
  for (int i = 0; i < 3; ++i) {
    const double difference = (a[i] - b[i]) * octant[i];
    if (std::abs(difference) > equal_directions) return difference > 0;
  }
  return false;
}

bool is_better(const Seen& a, const Seen& b, const Vec3& octant) {
  if (std::abs(a.cosine - b.cosine) > equal_directions) return a.cosine > b.cosine;
  return comes_first(a.normal, b.normal, octant);
}

CrackPlane plane_of_front(const Cells& cells, const VertexStar& v, const Seen& front,
                          const PrincipalTension& tension) {
  const Vec3 own = tension_towards(tension, front.normal).normalized();
  const Vec3 normal = own + (front.anchors.weight > 0 ? front.anchors.normal : front.normal);
  const Vec3 place = rest_position(cells, v.vertex);
  const Vec3 mean = (place + front.anchors.at) / (1 + front.anchors.weight);
  const Vec3 n = normal.normalized();
  return {n, place - n.dot(place - mean) * n};
}

}  // namespace

CrackChoice choose_crack(const Cells& cells, const VertexStar& v, const PrincipalTension& tension,
                         const CrackPlace& place) {
  std::optional<Seen> front, flank;
  const Vec3 at_rest = rest_position(cells, v.vertex);
  const Vec3 octant = octant_of(at_rest, place.centre);
  const std::vector<ComponentId>& component = cells.labels.of_vertex;
  const ComponentId own = component[v.vertex.index()];
  for (const CrackAtVertex& at : cracks_at(cells.cracks, v)) {
    Seen seen{at, anchors_near(cells.cracks, at.crack, at_rest, place.h, component, own)};
    seen.normal = seen.anchors.normal.isZero(0) ? normal_by_labels(cells, v, at)
                                                : Vec3(seen.anchors.normal.normalized());
    seen.cosine = tension_towards(tension, seen.normal).norm();
    if (seen.cosine < cos_branch_angle) continue;
    std::optional<Seen>& best = at.is_front() ? front : flank;
    if (!best || is_better(seen, *best, octant)) best = seen;
  }
  if (front) {
    return {CrackStep::grows, front->at.crack, plane_of_front(cells, v, *front, tension)};
  }
  if (flank) return {CrackStep::waits, flank->at.crack, {}};
  for (std::size_t row = place.under_way; row < cells.cracks.anchors.size(); ++row) {
    const CrackAnchor& anchor = cells.cracks.anchors[row];
    const bool waits = holds_back(anchor, place.time, (anchor.at - at_rest).norm()) &&
                       is_in(component, own, anchor) &&
                       tension_towards(tension, anchor.normal).norm() >= cos_branch_angle;
    if (waits) return {CrackStep::waits, anchor.crack, {}};
  }
  return {};
}

std::vector<CentreDistance> distances_of(const Cells& cells, const VertexStar& v,
                                         const CrackPlane& plane) {
  std::vector<CentreDistance> distances;
  const Point at = {plane.at[0], plane.at[1], plane.at[2]};
  for (const CornerId c : v.corners) {
    const CentreOffset centre = centre_offset(rest_corners(cells, tetrahedron_of(c)), at);
    distances.push_back({plane.normal.dot(Vec3(centre.away.data())), centre.tolerance});
  }
  return distances;
}

}  // namespace sunder
