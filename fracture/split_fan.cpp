// SPDX-License-Identifier: MIT
// The fan of a vertex: which plane, which faces, unsewing them, and the rows that come of it.
#include "fracture/split_fan.hpp"

#include <algorithm>
#include <cmath>

#include "topology/assert.hpp"
#include "topology/fan.hpp"

namespace sunder {
namespace {

Point to_point(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 to_vec3(const Point& p) { return {p[0], p[1], p[2]}; }

/// Area vector of a face at rest, m^2.
Vec3 area_vector(const Cells& cells, HalfFaceId face) {
  const auto& corners = cells.map.corners(tetrahedron_of(face));
  const auto& order = dart_order::face_corners[place_of(face)];
  const Vec3 a = to_vec3(cells.map.point(corners[order[0]]));
  const Vec3 b = to_vec3(cells.map.point(corners[order[1]]));
  const Vec3 c = to_vec3(cells.map.point(corners[order[2]]));
  return 0.5 * (b - a).cross(c - a);
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
  return std::ranges::any_of(
      dart_order::face_corners[place_of(face)],
      [&](int place) { return cells.unbreakable[corners[place].index()] != 0; });
}

struct FanQuality {
  double alignment = 0;
  int on_crack = 0;
};

FanQuality judge_fan(const Cells& cells, const FanPlane& fan) {
  FanQuality quality;
  double area = 0, aligned = 0;
  for (const HalfFaceId f : fan.faces) {
    const Vec3 a = area_vector(cells, f);
    area += a.norm();
    aligned += std::abs(a.dot(fan.normal));
    quality.on_crack += borders_crack(cells, f) || borders_crack(cells, cells.map.neighbour(f));
  }
  quality.alignment = aligned / area;
  return quality;
}

bool is_better(const FanQuality& a, const FanQuality& b) {
  // Mirror-symmetric fans agree to rounding only; 1e-9 keeps them tied.
  if (std::abs(a.alignment - b.alignment) > 1e-9) return a.alignment > b.alignment;
  return a.on_crack > b.on_crack;
}

/// Normals of the interior faces at a vertex, in rising order of half-face.
std::vector<Vec3> interior_face_normals(const Cells& cells, VertexId vertex) {
  std::vector<Vec3> normals;
  for (const TetId t : star(cells.map, vertex)) {
    for (int place = 0; place < 4; ++place) {
      const HalfFaceId f = half_face(t, place);
      if (cells.map.corners(t)[place] == vertex) continue;
      const HalfFaceId other = cells.map.neighbour(f);
      if (!other.is_none() && f < other) normals.push_back(area_vector(cells, f).normalized());
    }
  }
  return normals;
}

/// Rows of the copies: everything of the vertex they came from.
void append_columns(Cells& cells, MechanicsState& mechanics, const FaceSplit& split) {
  for (int i = 0; i < split.vertex_count; ++i) {
    const VertexCopy& copy = split.split_vertices[i];
    const VertexId row = append_copy(mechanics.vertices, copy.old_row);
    SUNDER_ASSERT(row == copy.new_row, "vertex columns out of step with the map");
    append_copy(cells, copy.old_row);
  }
}

/// The vertices of the fan's faces have a crack beside them now: their threshold may be another.
void refresh_strength(Cells& cells, const MechanicsState& mechanics, const FanEvent& event) {
  const auto refresh = [&](VertexId v) {
    cells.strength[v.index()] = vertex_strength(cells, mechanics, v, star(cells.map, v));
  };
  for (const FaceSplit& split : event.faces) {
    for (const VertexId v : split.vertices) refresh(v);
    for (int i = 0; i < split.vertex_count; ++i) refresh(split.split_vertices[i].new_row);
  }
}

}  // namespace

FanPlane choose_fan(const Cells& cells, VertexId vertex, const PrincipalTension& tension) {
  std::vector<Vec3> face_normals;
  if (tension.directions.cols() > 1) face_normals = interior_face_normals(cells, vertex);
  FanPlane best;
  FanQuality best_quality;
  for (const Vec3& normal : candidate_normals(tension, face_normals)) {
    auto faces = fan_faces(cells.map, vertex, to_point(normal));
    SUNDER_ASSERT(faces, "a unit normal and a living vertex always have a fan");
    FanPlane fan{normal, std::move(*faces)};
    std::erase_if(fan.faces, [&](HalfFaceId f) { return touches_unbreakable(cells, f); });
    if (fan.faces.empty()) continue;
    const FanQuality quality = judge_fan(cells, fan);
    if (best.faces.empty() || is_better(quality, best_quality)) {
      best = std::move(fan);
      best_quality = quality;
    }
  }
  return best;
}

FanEvent split_fan(Cells& cells, MechanicsState& mechanics, VertexId vertex,
                   const PrincipalTension& tension, const FractureSettings& settings,
                   FanScratch& scratch) {
  FanEvent event{.vertex = vertex,
                 .point = cells.map.point_of_vertex(vertex),
                 .rest_position = mechanics.vertices.rest_position[vertex.index()],
                 .stress = tension.value,
                 .strength = cells.strength[vertex.index()]};
  // Signs of the tetrahedra around v relatively to the plane, and the faces between them.
  FanPlane fan = choose_fan(cells, vertex, tension);
  event.normal = fan.normal;
  order_faces(cells.map, settings.face_order, fan.faces);
  // Split them one by one; what split is known after each, for the oracle.
  for (const HalfFaceId face : fan.faces) {
    event.faces.push_back(split_face(cells.map, face));
    append_columns(cells, mechanics, event.faces.back());
  }
  if (event.faces.empty()) return event;
  // If the oracle predicts new connected components, identify them.
  event.components = update_components(cells.map, event.faces, settings.detection, cells.labels,
                                       scratch.components);
  refresh_strength(cells, mechanics, event);
  return event;
}

}  // namespace sunder
