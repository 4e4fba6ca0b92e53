// SPDX-License-Identifier: MIT
// Making the cells, and the threshold of a vertex from the materials and cracks around it.
#include "fracture/algorithms/cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/element/second_order.hpp"
#include "topology/kernel/edge_nodes.hpp"

namespace sunder {
namespace {

bool is_crack_tip(const Cells& cells, VertexId vertex, std::span<const TetId> star) {
  for (const TetId t : star) {
    for (int place = 0; place < 4; ++place) {
      if (cells.map.corners(t)[place] == vertex) continue;  // the face opposite to the vertex
      if (is_crack_face(cells, half_face(t, place))) return true;
    }
  }
  return false;
}

/// Whether a face has a vertex that never splits.
bool touches_unbreakable(const Cells& cells, HalfFaceId face) {
  return std::ranges::any_of(corners_of_face(cells.map.corners(tetrahedron_of(face)), face),
                             [&](VertexId v) { return cells.unbreakable[v.index()] != 0; });
}

}  // namespace

std::vector<char> boundary_of(const VolumeMap& map) {
  std::vector<char> boundary;
  for (const auto& neighbours : map.neighbours()) {
    for (const HalfFaceId n : neighbours) boundary.push_back(n.is_none());
  }
  return boundary;
}

Cells make_cells(VolumeMap map, const MechanicsState& mechanics, std::vector<char> skin) {
  Cells cells{.map = std::move(map), .skin = std::move(skin)};
  cells.labels = label_components(cells.map);
  if (cells.skin.empty()) cells.skin = boundary_of(cells.map);
  // Before anything is cracked the smallest strength around a vertex needs no star.
  cells.strength.assign(cells.map.vertices(), std::numeric_limits<double>::infinity());
  for (std::size_t t = 0; t < cells.map.tetrahedra(); ++t) {
    const double xi = material_of(mechanics, TetId{t}).tensile_strength;
    for (const VertexId v : cells.map.corners(TetId{t})) {
      cells.strength[v.index()] = std::min(cells.strength[v.index()], xi);
    }
  }
  cells.painted.assign(cells.map.vertices(), 0);
  cells.flaw.assign(cells.map.vertices(), 1);
  cells.unbreakable.assign(cells.map.vertices(), 0);
  cells.waits.assign(cells.map.vertices(), 0);
  return cells;
}

void append_copy(Cells& cells, VertexId from) {
  const auto append = [from](auto& column) { column.push_back(column[from.index()]); };
  append(cells.strength);
  append(cells.painted);
  append(cells.flaw);
  append(cells.unbreakable);
  append(cells.waits);
  append(cells.labels.of_vertex);
}

void append_node(Cells& cells, ComponentId component) {
  cells.strength.push_back(std::numeric_limits<double>::infinity());
  cells.painted.push_back(0);
  cells.flaw.push_back(1);
  cells.unbreakable.push_back(0);
  cells.waits.push_back(0);
  cells.labels.of_vertex.push_back(component);
}

void raise_order(BreakableBody body, TetId first, TetId end) {
  auto& [cells, m] = body;
  append_edge_nodes(m.elements.edge_nodes, cells.map, first, end);
  for (std::size_t t = first.index(); t < end.index(); ++t) {
    for (std::size_t e = 0; e < 6; ++e) {
      // Rows come in the order in which they are met.
      if (m.elements.edge_nodes[t][e].index() != m.vertices.size()) continue;
      const Corners& c = cells.map.corners(TetId{t});
      append_middle(m.vertices, c[static_cast<std::size_t>(edge_ends[e][0])],
                    c[static_cast<std::size_t>(edge_ends[e][1])]);
      append_node(cells, m.elements.component[t]);
    }
  }
}

double mean_edge_length(const VertexColumns& vertices, std::span<const Corners> corners,
                        std::span<const TetId> star) {
  double sum = 0;
  for (const TetId t : star) {
    const Corners& c = corners[t.index()];
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) {
        sum += (vertices.rest_position[c[i].index()] - vertices.rest_position[c[j].index()]).norm();
      }
    }
  }
  return sum / (6.0 * static_cast<double>(star.size()));
}

double mean_edge_length(const VertexColumns& vertices, std::span<const Corners> corners,
                        const VertexStar& star) {
  std::vector<TetId> around;
  for (const CornerId c : star.corners) around.push_back(tetrahedron_of(c));
  return mean_edge_length(vertices, corners, around);
}

double vertex_strength(const Cells& cells, const MechanicsState& mechanics, VertexId vertex,
                       std::span<const TetId> star) {
  if (cells.unbreakable[vertex.index()]) return std::numeric_limits<double>::infinity();
  double strength = std::numeric_limits<double>::infinity();
  double toughness = strength;
  for (const TetId t : star) {
    const Material& m = mechanics.materials[mechanics.elements.material[t.index()].index()];
    strength = std::min(strength, m.tensile_strength);
    toughness = std::min(toughness, toughness_of(m));
  }
  if (cells.painted[vertex.index()] > 0) strength = cells.painted[vertex.index()];
  strength *= cells.flaw[vertex.index()];
  if (std::isinf(toughness) || !is_crack_tip(cells, vertex, star)) return strength;
  const double h = mean_edge_length(mechanics.vertices, cells.map.corners(), star);
  const int order = is_second_order(mechanics.elements, star.front()) ? 2 : 1;
  const double at_tip = crack_tip_factor(order) * toughness / std::sqrt(h);
  // Ties take the energy: at a tip they must not have less than the strength of the material.
  return cells.pieces ? std::min(strength, at_tip) : at_tip;
}

Vec3 rest_area_vector(const VolumeMap& map, HalfFaceId face) {
  const auto corners = corners_of_face(map.corners(tetrahedron_of(face)), face);
  const auto x = [&](int k) { return Vec3(map.point(corners[k]).data()); };
  const Vec3 a = x(0);
  return 0.5 * (x(1) - a).cross(x(2) - a);
}

std::vector<HalfFaceId> breakable_fan(const Cells& cells, const VertexStar& v,
                                      std::span<const char> positive) {
  std::vector<HalfFaceId> faces = fan_faces(cells.map, v, positive);
  std::erase_if(faces, [&](HalfFaceId f) { return touches_unbreakable(cells, f); });
  return faces;
}

}  // namespace sunder
