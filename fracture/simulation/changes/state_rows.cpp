// SPDX-License-Identifier: MIT
#include "fracture/simulation/changes/state_rows.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "mechanics/solver/component_system.hpp"

namespace sunder {
namespace {

// Columns by the kind of their rows. Some are empty, or short, until they are needed.

auto vertex_columns(SimulationState& s) {
  VertexColumns& v = s.mechanics.vertices;
  Cells& c = s.cells;
  return std::tie(v.rest_position, v.position, v.velocity, v.mass, v.component, v.displacement,
                  v.displacement_rate, v.displacement_acceleration, v.support, c.strength,
                  c.painted, c.flaw, c.unbreakable, c.waits, c.labels.of_vertex,
                  s.mechanics.systems.local_row);
}

auto cell_columns(SimulationState& s) {
  ElementColumns& e = s.mechanics.elements;
  return std::tie(e.shape_gradient, e.rest_volume, e.mass, e.material, e.component, e.stress,
                  e.edge_nodes, e.corner_stress, s.cells.labels.of_tetrahedron,
                  s.cells.cracks.last_label);
}

auto half_face_columns(SimulationState& s) {
  return std::tie(s.cells.skin, s.cells.cracks.of_face);
}

auto component_columns(SimulationState& s) {
  MechanicsState& m = s.mechanics;
  return std::tie(m.components, m.systems.present, m.systems.retired, s.cells.labels.size,
                  s.cells.labels.parent, s.display, s.display_target, s.ladder.still,
                  s.ladder.rubble.apart, s.ladder.rubble.spent);
}

/// Calls `visit(column)` for each of them.
template <class Columns, class Visit>
void for_each_column(Columns columns, Visit visit) {
  std::apply([&](auto&... column) { (visit(column), ...); }, columns);
}

struct Counts {
  std::size_t rows, more;
};

template <class T>
void append(std::vector<T>& column, std::vector<T>& more, Counts count) {
  if (column.empty() && more.empty()) return;
  column.resize(count.rows);
  more.resize(count.more);
  column.insert(column.end(), std::make_move_iterator(more.begin()),
                std::make_move_iterator(more.end()));
}

template <class... T>
void append_columns(std::tuple<T&...> columns, std::tuple<T&...> more, Counts count) {
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (append(std::get<i>(columns), std::get<i>(more), count), ...);
  }
  (std::index_sequence_for<T...>());
}

template <class T>
void append_list(std::vector<T>& list, std::vector<T>& more) {
  list.insert(list.end(), std::make_move_iterator(more.begin()),
              std::make_move_iterator(more.end()));
}

/// Keeps every `width` rows together.
template <class T>
void drop_rows(std::vector<T>& column, const RowShift& shift, std::size_t width = 1) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (shift(static_cast<std::uint32_t>(i / width)) == RowShift::gone) continue;
    if (next != i) column[next] = std::move(column[i]);
    ++next;
  }
  column.resize(next);
}

void append(LooseMap& map, LooseMap& more) {
  append_list(map.rows.corners, more.rows.corners);
  append_list(map.rows.neighbours, more.rows.neighbours);
  append_list(map.rows.point_of_vertex, more.rows.point_of_vertex);
  if (more.rows.first_node_point != RowShift::gone) {
    map.rows.first_node_point =
        more.rows.first_node_point + static_cast<std::uint32_t>(map.rows.points.size());
  }
  append_list(map.rows.points, more.rows.points);
  append_list(map.rows.reoriented, more.rows.reoriented);
  append_list(map.incident, more.incident);
}

void drop_rows(LooseMap& map, const Renumbering& by, const RowShift& vertex) {
  drop_rows(map.rows.corners, by.tetrahedron);
  drop_rows(map.rows.neighbours, by.tetrahedron);
  drop_rows(map.rows.point_of_vertex, vertex);
  drop_rows(map.incident, vertex);
  std::erase_if(map.rows.reoriented, [&](TetId t) { return by.of(t).is_none(); });
  std::uint32_t& first = map.rows.first_node_point;
  if (first != RowShift::gone) {
    const auto nodes = by.point.to.begin() + first;
    const bool any = std::any_of(nodes, by.point.to.end(),
                                 [](std::uint32_t to) { return to != RowShift::gone; });
    first = any ? first - static_cast<std::uint32_t>(
                              std::count(by.point.to.begin(), nodes, RowShift::gone))
                : RowShift::gone;
  }
  drop_rows(map.rows.points, by.point);
}

VolumeMap made(LooseMap&& map, MapKernel kernel) {
  VolumeMap result(std::move(map.rows), std::move(map.incident));
  result.set_kernel(kernel);
  return result;
}

RowShift after(std::size_t rows) { return {.by = static_cast<std::uint32_t>(rows), .to = {}}; }

Renumbering behind(const SimulationState& s) {
  Renumbering by;
  by.vertex = after(s.cells.map.vertices());
  by.tetrahedron = after(s.cells.map.tetrahedra());
  by.point = after(s.cells.map.points().size());
  by.component = after(s.mechanics.components.size());
  by.material = after(s.mechanics.materials.size());
  by.motion = after(s.mechanics.motions.size());
  by.crack = after(s.cells.cracks.cracks);
  by.label = after(s.cells.cracks.labels.size());
  by.anchor = after(s.cells.cracks.anchors.size());
  if (s.cells.pieces) by.tied_vertex = after(s.cells.pieces->map.vertices());
  return by;
}

/// Tetrahedra of first order among others of second order have their stress at all corners.
void fill_corner_stress(ElementColumns& elements) {
  for (const Mat3& stress : elements.stress) elements.corner_stress.emplace_back().fill(stress);
}

void append_pieces(Pieces& pieces, Pieces& more, const Renumbering& by) {
  LooseMap map = loose(pieces.map), others = loose(more.map);
  renumber(others, by, by.tied_vertex);
  append(map, others);
  pieces.map = DenseMap(std::move(map.rows), std::move(map.incident));
  append_list(pieces.labels.of_tetrahedron, more.labels.of_tetrahedron);
  append_list(pieces.labels.of_vertex, more.labels.of_vertex);
  append_list(pieces.labels.size, more.labels.size);
  append_list(pieces.labels.parent, more.labels.parent);
}

/// Elements of lists that name rows which are gone.
void drop_from_lists(SimulationState& s, const Renumbering& by) {
  const auto is_gone = [&](auto id) { return !id.is_none() && by.of(id).is_none(); };
  const auto parts_gone = [&](const auto& pair) { return is_gone(pair.face); };
  std::erase_if(s.cells.empty_fans, [&](const EmptyFan& fan) { return is_gone(fan.vertex); });
  CrackLabels& cracks = s.cells.cracks;
  drop_rows(cracks.labels, by.label);
  drop_rows(cracks.anchors, by.anchor);
  std::erase_if(s.contact.last_contacts, [&](const ContactMemory::Remembered& last) {
    const ContactPoint& c = last.contact;
    return is_gone(c.vertex) || is_gone(c.tetrahedron_a) || is_gone(c.tetrahedron);
  });
  std::erase_if(s.contact.partners, parts_gone);
  std::erase_if(s.contact.ties, parts_gone);
  std::erase_if(s.ladder.rubble.memory.points, [&](const RubbleMemory::Point& point) {
    const auto has_gone = [&](std::uint64_t key) {
      return key < RowShift::gone &&
             by.tetrahedron(static_cast<std::uint32_t>(key)) == RowShift::gone;
    };
    return has_gone(point.a) || has_gone(point.b);
  });
  std::erase_if(s.cracks, [&](const OpenCrack& crack) {
    return std::ranges::any_of(crack.sides,
                               [&](const CrackSide& side) { return is_gone(side.vertex); });
  });
  std::erase_if(s.loads, [&](const CornerLoad& load) { return is_gone(load.corner); });
}

template <class Ids>
RowShift rows_of_others(const Ids& component, const std::vector<char>& dropped) {
  std::vector<char> kept;
  for (const ComponentId id : component) kept.push_back(id.is_none() || !dropped[id.index()]);
  return closing_gaps(kept);
}

template <class Rows, class IsGone>
RowShift rows_but(const Rows& rows, IsGone is_gone) {
  std::vector<char> kept;
  for (const auto& row : rows) kept.push_back(!is_gone(row));
  return closing_gaps(kept);
}

Renumbering without(const SimulationState& s, const std::vector<char>& dropped,
                    std::vector<char>&& points) {
  Renumbering by;
  const VolumeMap& map = s.cells.map;
  by.vertex = rows_of_others(s.mechanics.vertices.component, dropped);
  by.tetrahedron = rows_of_others(s.mechanics.elements.component, dropped);
  if (s.cells.pieces) by.tied_vertex = rows_of_others(s.cells.pieces->labels.of_vertex, dropped);
  points.resize(map.points().size(), 0);  // nodes of edges stay with their rows
  for (std::size_t v = 0; v < map.vertices(); ++v) {
    if (by.vertex.to[v] != RowShift::gone) points[map.point_of_vertex(VertexId{v})] = 1;
  }
  by.point = closing_gaps(points);
  by.label = rows_but(s.cells.cracks.labels,
                      [&](const CrackLabel& l) { return by.of(l.tetrahedron).is_none(); });
  by.anchor = rows_but(s.cells.cracks.anchors,
                       [&](const CrackAnchor& a) { return by.of(a.vertex).is_none(); });
  return by;
}

void clear_component(SimulationState& s, ComponentId id) {
  Component& c = s.mechanics.components[id.index()];
  c = Component{};
  c.id = id;
  s.cells.labels.size[id.index()] = 0;
  if (s.cells.pieces) s.cells.pieces->labels.size[id.index()] = 0;
  ComponentSystems& systems = s.mechanics.systems;
  for (auto* rows : {&systems.present, &systems.retired}) {
    if (id.index() < rows->size()) (*rows)[id.index()].reset();
  }
  const auto put = [&](auto& rows, auto value) {
    if (id.index() < rows.size()) rows[id.index()] = value;
  };
  put(s.impact.quiet, ImpactWindow::closed);
  put(s.ladder.still, 0.0);
  put(s.ladder.rubble.apart, char{0});
  put(s.ladder.rubble.spent, 0.0);
  put(s.display, Pose{});
  put(s.display_target, Pose{});
}

}  // namespace

void append_state(SimulationState& s, SimulationState more) {
  const Renumbering by = behind(s);
  const Counts vertices{s.cells.map.vertices(), more.cells.map.vertices()};
  const Counts cells{s.cells.map.tetrahedra(), more.cells.map.tetrahedra()};
  const Counts components{s.mechanics.components.size(), more.mechanics.components.size()};
  ElementColumns &elements = s.mechanics.elements, &others = more.mechanics.elements;
  if (elements.corner_stress.empty() && !others.corner_stress.empty()) fill_corner_stress(elements);

  LooseMap map = loose(s.cells.map.dense()), added = loose(more.cells.map.dense());
  renumber(added, by, by.vertex);
  renumber(more, by);
  append(map, added);
  s.cells.map = made(std::move(map), s.cells.map.kernel());
  if (s.cells.pieces) append_pieces(*s.cells.pieces, *more.cells.pieces, by);
  append_columns(vertex_columns(s), vertex_columns(more), vertices);
  append_columns(cell_columns(s), cell_columns(more), cells);
  append_columns(half_face_columns(s), half_face_columns(more), {4 * cells.rows, 4 * cells.more});
  append_columns(component_columns(s), component_columns(more), components);
  append_list(s.mechanics.materials, more.mechanics.materials);
  append_list(s.mechanics.motions, more.mechanics.motions);
  append_list(s.cells.cracks.labels, more.cells.cracks.labels);
  append_list(s.cells.cracks.anchors, more.cells.cracks.anchors);
  append_list(s.cells.cracks.last_anchor, more.cells.cracks.last_anchor);
  s.cells.cracks.cracks += more.cells.cracks.cracks;
  append_list(s.contact.partners, more.contact.partners);
  append_list(s.loads, more.loads);
}

Renumbering drop_components(SimulationState& s, const std::vector<char>& dropped,
                            std::vector<char> points) {
  const Renumbering by = without(s, dropped, std::move(points));
  for (std::size_t id = 0; id < dropped.size(); ++id) {
    if (dropped[id]) clear_component(s, ComponentId{id});
  }
  LooseMap map = loose(s.cells.map.dense());
  drop_rows(map, by, by.vertex);
  renumber(map, by, by.vertex);
  s.cells.map = made(std::move(map), s.cells.map.kernel());
  if (Pieces* pieces = s.cells.pieces ? &*s.cells.pieces : nullptr) {
    LooseMap tied = loose(pieces->map);
    drop_rows(tied, by, by.tied_vertex);
    renumber(tied, by, by.tied_vertex);
    pieces->map = DenseMap(std::move(tied.rows), std::move(tied.incident));
    drop_rows(pieces->labels.of_vertex, by.tied_vertex);
    drop_rows(pieces->labels.of_tetrahedron, by.tetrahedron);
  }
  drop_from_lists(s, by);
  const auto drop = [](const RowShift& shift, std::size_t width) {
    return [&shift, width](auto& column) { drop_rows(column, shift, width); };
  };
  for_each_column(vertex_columns(s), drop(by.vertex, 1));
  for_each_column(cell_columns(s), drop(by.tetrahedron, 1));
  for_each_column(half_face_columns(s), drop(by.tetrahedron, 4));
  if (s.cells.map.dense().rows().first_node_point == RowShift::gone) {
    s.mechanics.elements.edge_nodes.clear();
    s.mechanics.elements.corner_stress.clear();
  }
  renumber(s, by);
  return by;
}

}  // namespace sunder
