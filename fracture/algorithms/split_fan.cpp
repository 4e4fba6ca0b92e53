// SPDX-License-Identifier: MIT
// The fan of a vertex: unsewing its faces, and the rows and pieces that come of it.
#include "fracture/algorithms/split_fan.hpp"

#include <algorithm>
#include <chrono>

#include "fracture/algorithms/piece_limits.hpp"
#include "topology/kernel/assert.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/kernel/sort_unique.hpp"

namespace sunder {
namespace {

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
  sort_unique(rows);
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
