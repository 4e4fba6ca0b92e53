// SPDX-License-Identifier: MIT
// Every member of a state that names rows, once.
#include "fracture/simulation/changes/renumber.hpp"

#include <algorithm>

#include "mechanics/solver/component_system.hpp"

namespace sunder {
namespace {

template <class T>
void renumber_all(T& values, const Renumbering& by) {
  for (auto& value : values) value = by.of(value);
}

template <class T>
void renumber_each(std::vector<T>& rows, const Renumbering& by) {
  for (T& row : rows) renumber_all(row, by);
}

/// Rows counted from 1, where 0 stands for none.
std::uint32_t from_one(const RowShift& shift, std::uint32_t row) {
  const std::uint32_t moved = row == 0 ? RowShift::gone : shift(row - 1);
  return moved == RowShift::gone ? 0 : moved + 1;
}

void renumber(Components& labels, const Renumbering& by) {
  renumber_all(labels.of_tetrahedron, by);
  renumber_all(labels.of_vertex, by);
  renumber_all(labels.parent, by);
}

void renumber(CrackLabels& cracks, const Renumbering& by) {
  for (CrackLabel& label : cracks.labels) {
    label.crack = by.of(label.crack);
    label.tetrahedron = by.of(label.tetrahedron);
    label.before = from_one(by.label, label.before);
  }
  for (CrackAnchor& anchor : cracks.anchors) {
    anchor.crack = by.of(anchor.crack);
    anchor.vertex = by.of(anchor.vertex);
    anchor.copy = by.of(anchor.copy);
    anchor.before = from_one(by.anchor, anchor.before);
  }
  for (std::uint32_t& row : cracks.last_label) row = from_one(by.label, row);
  for (std::uint32_t& row : cracks.last_anchor) row = from_one(by.anchor, row);
  renumber_all(cracks.of_face, by);
}

void renumber(std::unique_ptr<ComponentSystem>& system, const Renumbering& by) {
  if (!system) return;
  renumber_all(system->order, by);
  renumber_all(system->tetrahedra, by);
  renumber_each(system->corners, by);
  renumber_each(system->edge_nodes, by);
  renumber_all(system->row_vertex, by);
}

void renumber(MechanicsState& m, const Renumbering& by) {
  renumber_all(m.vertices.component, by);
  renumber_all(m.vertices.support, by);
  renumber_all(m.elements.material, by);
  renumber_all(m.elements.component, by);
  renumber_each(m.elements.edge_nodes, by);
  for (Component& c : m.components) {
    c.id = by.of(c.id);
    renumber_all(c.vertices, by);
    renumber_all(c.tetrahedra, by);
  }
  for (auto& system : m.systems.present) renumber(system, by);
  for (auto& system : m.systems.retired) renumber(system, by);
}

template <class Pair>
void renumber_faces(std::vector<Pair>& pairs, const Renumbering& by) {
  for (Pair& pair : pairs) {
    pair.face = by.of(pair.face);
    pair.opposite = by.of(pair.opposite);
  }
}

void renumber(ContactMemory& memory, const Renumbering& by) {
  for (ContactMemory::Remembered& last : memory.last_contacts) {
    ContactPoint& c = last.contact;
    c.vertex = by.of(c.vertex);
    c.tetrahedron_a = by.of(c.tetrahedron_a);
    c.tetrahedron = by.of(c.tetrahedron);
    c.face = by.of(c.face);
  }
  renumber_faces(memory.partners, by);
  renumber_faces(memory.ties, by);
  for (Tie& tie : memory.ties) tie.crack = by.of(tie.crack);
}

}  // namespace

RowShift closing_gaps(const std::vector<char>& kept) {
  RowShift shift;
  std::uint32_t next = 0;
  for (const char keep : kept) shift.to.push_back(keep ? next++ : RowShift::gone);
  return shift;
}

std::size_t rows_left(const RowShift& shift, std::size_t before) {
  if (shift.to.empty()) return before;
  return before - static_cast<std::size_t>(std::ranges::count(shift.to, RowShift::gone));
}

LooseMap loose(const DenseMap& map) {
  return {map.rows(), {map.incident_tetrahedra().begin(), map.incident_tetrahedra().end()}};
}

void renumber(LooseMap& map, const Renumbering& by, const RowShift& vertex) {
  for (auto& corners : map.rows.corners) {
    for (VertexId& v : corners) v.value = vertex(v.value);
  }
  renumber_each(map.rows.neighbours, by);
  for (std::uint32_t& point : map.rows.point_of_vertex) point = by.point(point);
  renumber_all(map.rows.reoriented, by);
  renumber_all(map.incident, by);
}

void renumber(SimulationState& s, const Renumbering& by) {
  renumber(s.cells.labels, by);
  if (s.cells.pieces) renumber(s.cells.pieces->labels, by);
  for (EmptyFan& fan : s.cells.empty_fans) fan.vertex = by.of(fan.vertex);
  renumber(s.cells.cracks, by);
  renumber(s.mechanics, by);
  renumber(s.contact, by);
  for (RubbleMemory::Point& point : s.ladder.rubble.memory.points) {
    for (std::uint64_t* key : {&point.a, &point.b}) {
      // Keys of obstacles are above all rows.
      if (*key < RowShift::gone) *key = by.tetrahedron(static_cast<std::uint32_t>(*key));
    }
  }
  for (OpenCrack& crack : s.cracks) {
    for (CrackSide& side : crack.sides) side.vertex = by.of(side.vertex);
  }
  for (CornerLoad& load : s.loads) load.corner = by.of(load.corner);
}

}  // namespace sunder
