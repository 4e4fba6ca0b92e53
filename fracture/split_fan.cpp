// SPDX-License-Identifier: MIT
// The fan of a vertex: which plane, which faces, unsewing them, and the rows that come of it.
#include "fracture/split_fan.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "fracture/piece_limits.hpp"
#include "topology/assert.hpp"
#include "topology/fan.hpp"

namespace sunder {
namespace {

Point to_point(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

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

/// The faces that a plane parts, but for those that nothing may split.
std::vector<HalfFaceId> breakable_faces(const Cells& cells, VertexId vertex, const Vec3& normal) {
  auto faces = fan_faces(cells.map, vertex, to_point(normal));
  SUNDER_ASSERT(faces, "a normal and a living vertex always have a fan");
  std::erase_if(*faces, [&](HalfFaceId f) { return touches_unbreakable(cells, f); });
  return std::move(*faces);
}

struct FanQuality {
  double alignment = 0;
  int on_crack = 0;
};

FanQuality judge_fan(const Cells& cells, const FanPlane& fan) {
  FanQuality quality;
  double area = 0, aligned = 0;
  for (const HalfFaceId f : fan.faces) {
    const Vec3 a = rest_area_vector(cells, f);
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
      if (!other.is_none() && f < other) normals.push_back(rest_area_vector(cells, f).normalized());
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
/// Gives the tetrahedra met.
std::size_t refresh_strength(Cells& cells, const MechanicsState& mechanics, const FanEvent& event) {
  std::vector<VertexId> rows;
  for (const FaceSplit& split : event.faces) {
    rows.insert(rows.end(), split.vertices.begin(), split.vertices.end());
    for (int i = 0; i < split.vertex_count; ++i) rows.push_back(split.split_vertices[i].new_row);
  }
  // Faces of a fan share vertices, the one that broke above all.
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  std::size_t met = 0;
  for (const VertexId v : rows) {
    const std::vector<TetId> around = star(cells.map, v);
    cells.strength[v.index()] = vertex_strength(cells, mechanics, v, around);
    met += around.size();
  }
  return met;
}

double wall_us() {
  return std::chrono::duration<double, std::micro>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// Splits the faces of `event`'s fan one by one, and finds what comes of it.
void split_faces(Cells& cells, MechanicsState& mechanics, FanEvent& event,
                 std::vector<HalfFaceId> faces, const FractureSettings& settings,
                 ComponentScratch& scratch) {
  const double start = wall_us();
  order_faces(cells.map, settings.face_order, faces);
  // What split is known after each face, for the oracle.
  event.faces.reserve(faces.size());
  for (const HalfFaceId face : faces) {
    event.faces.push_back(split_face(cells.map, face));
    append_columns(cells, mechanics, event.faces.back());
    event.visited += event.faces.back().visited;
  }
  // If the oracle predicts new connected components, identify them.
  event.components =
      update_components(cells.map, event.faces, settings.detection, cells.labels, scratch);
  event.visited += event.components.visited;
  event.visited += refresh_strength(cells, mechanics, event);
  event.split_us = wall_us() - start;
}

}  // namespace

FanPlane choose_fan(const Cells& cells, VertexId vertex, const PrincipalTension& tension) {
  std::vector<Vec3> face_normals;
  if (tension.directions.cols() > 1) face_normals = interior_face_normals(cells, vertex);
  FanPlane best;
  FanQuality best_quality;
  for (const Vec3& normal : candidate_normals(tension, face_normals)) {
    FanPlane fan{normal, breakable_faces(cells, vertex, normal)};
    if (fan.faces.empty()) continue;
    const FanQuality quality = judge_fan(cells, fan);
    if (best.faces.empty() || is_better(quality, best_quality)) {
      best = std::move(fan);
      best_quality = quality;
    }
  }
  return best;
}

PlannedFan plan_fan(const Cells& cells, VertexId vertex, const PrincipalTension& tension) {
  // Signs of the tetrahedra around v relatively to the plane, and the faces between them.
  const double start = wall_us();
  PlannedFan fan{vertex, choose_fan(cells, vertex, tension), tension.value,
                 cells.strength[vertex.index()]};
  fan.choose_us = wall_us() - start;
  return fan;
}

PlannedFan plan_known_fan(const Cells& cells, VertexId vertex, const Vec3& normal, double stress) {
  const double start = wall_us();
  PlannedFan fan{vertex,
                 {normal, breakable_faces(cells, vertex, normal)},
                 stress,
                 cells.strength[vertex.index()]};
  fan.choose_us = wall_us() - start;
  return fan;
}

FanEvent split_fan(Cells& cells, MechanicsState& mechanics, PlannedFan fan,
                   const FractureSettings& settings, FanScratch& scratch) {
  FanEvent event{.vertex = fan.vertex,
                 .point = cells.map.point_of_vertex(fan.vertex),
                 .rest_position = mechanics.vertices.rest_position[fan.vertex.index()],
                 .normal = fan.plane.normal,
                 .stress = fan.stress,
                 .strength = fan.strength,
                 .choose_us = fan.choose_us};
  std::vector<HalfFaceId>& faces = fan.plane.faces;
  std::erase_if(faces, [&](HalfFaceId f) { return cells.map.neighbour(f).is_none(); });
  event.refused = exceeds_limits(cells, mechanics, faces, settings, scratch.components);
  if (event.refused || faces.empty()) return event;
  split_faces(cells, mechanics, event, std::move(faces), settings, scratch.components);
  return event;
}

}  // namespace sunder
