// SPDX-License-Identifier: MIT
// Algorithm 4, and the rows that come of a split.
#include "fracture/algorithms/split_fan.hpp"

#include "topology/base/assert.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/kernel/edge_nodes.hpp"

namespace sunder {
namespace {

/// Updates the thresholds of the vertices of the fan's faces, which now lie at a crack. Gives the
/// number of tetrahedra visited.
std::size_t refresh_strength(BreakableBody body, const FanEvent& event) {
  Cells& cells = body.cells;
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
    cells.strength[v.index()] = vertex_strength(cells, body.mechanics, v, around);
    met += around.size();
  }
  return met;
}

}  // namespace

FaceSplit part_face(BreakableBody body, HalfFaceId face, std::vector<VertexCopy>& nodes) {
  const auto append = [&](const VertexCopy& copy) {
    const VertexId row = append_copy(body.mechanics.vertices, copy.old_row);
    SUNDER_ASSERT(row == copy.new_row, "vertex columns out of step with the map");
    append_copy(body.cells, copy.old_row);
  };
  const FaceSplit split = split_face(body.cells.map, face);
  for (std::size_t i = 0; i < std::size_t(split.vertex_count); ++i) append(split.split_vertices[i]);
  std::vector<EdgeNodes>& edges = body.mechanics.elements.edge_nodes;
  if (!split.did || edges.empty()) return split;
  const EdgeSplits parted = split_edge_nodes(edges, body.cells.map, split);
  for (std::size_t i = 0; i < std::size_t(parted.count); ++i) {
    append(parted.copies[i]);
    nodes.push_back(parted.copies[i]);
  }
  return split;
}

// Algorithm 4: split(v, u).
FanEvent split_fan(BreakableBody body, const VertexStar& v, const Vec3& u,
                   const FractureSettings& settings, ComponentScratch& scratch) {
  // Get the signs of tetrahedra around v relatively to the fracture plane.
  const std::vector<char> positive = plane_signs(body.cells.map, v, {u.x(), u.y(), u.z()});
  return split_fan(body, v, u, positive, settings, scratch);
}

FanEvent split_fan(BreakableBody body, const VertexStar& v, const Vec3& u,
                   std::span<const char> positive, const FractureSettings& settings,
                   ComponentScratch& scratch) {
  VolumeMap& map = body.cells.map;
  FanEvent event{.vertex = v.vertex,
                 .point = map.point_of_vertex(v.vertex),
                 .rest_position = body.mechanics.vertices.rest_position[v.vertex.index()],
                 .normal = u};
  // Search for faces adjacent to positive and negative tetrahedra; those with an edge at the
  // surface first, or they would fool the oracle (figure 5).
  std::vector<HalfFaceId> fan = breakable_fan(body.cells, v, positive);
  order_faces(map, settings.face_order, fan);
  bool new_component = false;
  for (const HalfFaceId face : fan) {
    const FaceSplit split = part_face(body, face, event.nodes);
    // Check for oracle: have all vertices of the face split?
    if (oracle_says_new(split)) new_component = true;
    event.visited += split.visited;
    event.faces.push_back(split);
  }
  // If the oracle predicts new connected components, identify them, from the faces it points at.
  // Tied parts have not come off yet; that is found as ties are released.
  const bool is_tied = body.cells.pieces.has_value();
  if (!is_tied && (new_component || !asks_oracle(settings.detection))) {
    event.components =
        update_components(map, event.faces, settings.detection, body.cells.labels, scratch);
  }
  event.visited += event.components.visited + refresh_strength(body, event);
  return event;
}

}  // namespace sunder
