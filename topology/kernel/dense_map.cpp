// SPDX-License-Identifier: MIT
// Darts that follow from rows, and changes of the rows.
#include "topology/kernel/dense_map.hpp"

#include <algorithm>

#include "topology/base/append_row.hpp"
#include "topology/base/assert.hpp"

namespace sunder {
namespace {

DartId dart_in(TetId t, int k) { return DartId{12 * t.index() + static_cast<std::size_t>(k)}; }
int place_of(DartId d) { return static_cast<int>(d.index() % 12); }
HalfFaceId half_face_of(DartId d) { return HalfFaceId{d.index() / 3}; }

std::vector<TetId> incident_of(const MapRows& rows) {
  std::vector<TetId> incident(rows.point_of_vertex.size());
  for (std::size_t t = rows.corners.size(); t-- > 0;) {
    for (const VertexId v : rows.corners[t]) incident[v.index()] = TetId{t};
  }
  return incident;
}

}  // namespace

DenseMap::DenseMap(MapRows rows) : rows_(std::move(rows)), incident_(incident_of(rows_)) {}

DartId DenseMap::dart(HalfFaceId f, CornerId from) const {
  return dart_in(tetrahedron_of(f),
                 dart_order::dart_from(sunder::place_of(f), sunder::place_of(from)));
}

VertexId DenseMap::vertex(DartId d) const {
  return corners(tetrahedron(d))[dart_order::origin(place_of(d))];
}

DartId DenseMap::beta0(DartId d) const {
  return dart_in(tetrahedron(d), dart_order::beta0(place_of(d)));
}
DartId DenseMap::beta1(DartId d) const {
  return dart_in(tetrahedron(d), dart_order::beta1(place_of(d)));
}
DartId DenseMap::beta2(DartId d) const {
  return dart_in(tetrahedron(d), dart_order::beta2(place_of(d)));
}
bool DenseMap::is_free(DartId d) const { return neighbour(half_face_of(d)).is_none(); }

DartId DenseMap::beta3(DartId d) const {
  const HalfFaceId g = neighbour(half_face_of(d));
  SUNDER_ASSERT(!g.is_none(), "beta3 of a dart on the boundary");
  const int from = place_of_vertex(corners(tetrahedron_of(g)), vertex(beta1(d)));
  return dart_in(tetrahedron_of(g), dart_order::dart_from(sunder::place_of(g), from));
}

void DenseMap::unsew(HalfFaceId face) {
  const HalfFaceId across = neighbour(face);
  SUNDER_ASSERT(!across.is_none(), "unsewing a boundary face");
  rows_.neighbours[face.index() / 4][face.index() % 4] = HalfFaceId::none();
  rows_.neighbours[across.index() / 4][across.index() % 4] = HalfFaceId::none();
}

void DenseMap::sew(DartId a, DartId b) {
  SUNDER_ASSERT(is_free(a) && is_free(b), "sewing a face that has two sides already");
  const HalfFaceId f = half_face_of(a), g = half_face_of(b);
  rows_.neighbours[f.index() / 4][f.index() % 4] = g;
  rows_.neighbours[g.index() / 4][g.index() % 4] = f;
}

VertexId DenseMap::split_vertex(const VertexSplit& split) {
  const VertexId added{vertices()};
  for (const CornerId c : split.leaving) rows_.corners[c.index() / 4][c.index() % 4] = added;
  append_row(rows_.point_of_vertex, point_of_vertex(split.vertex));
  incident_[split.vertex.index()] = tetrahedron_of(split.staying[0]);
  append_row(incident_, tetrahedron_of(split.leaving[0]));
  return added;
}

void DenseMap::merge_vertices(VertexId kept, VertexId retired, std::span<const CornerId> corners) {
  for (const CornerId c : corners) rows_.corners[c.index() / 4][c.index() % 4] = kept;
  incident_[retired.index()] = TetId::none();
  drop_retired_rows();
}

void DenseMap::drop_retired_rows() {
  while (!incident_.empty() && incident_.back().is_none() && !is_node(VertexId{vertices() - 1})) {
    incident_.pop_back();
    rows_.point_of_vertex.pop_back();
  }
}

VertexId DenseMap::append_node(const Point& at) {
  const auto point = static_cast<std::uint32_t>(rows_.points.size());
  rows_.first_node_point = std::min(rows_.first_node_point, point);
  rows_.points.push_back(at);
  append_row(rows_.point_of_vertex, point);
  append_row(incident_, TetId::none());
  return VertexId{vertices() - 1};
}

VertexId DenseMap::append_node(VertexId copied) {
  SUNDER_ASSERT(is_node(copied), "append_node: the copy of a vertex");
  append_row(rows_.point_of_vertex, point_of_vertex(copied));
  append_row(incident_, TetId::none());
  return VertexId{vertices() - 1};
}

void DenseMap::retire_node(VertexId node) {
  SUNDER_ASSERT(is_node(node), "retire_node: a vertex");
  rows_.point_of_vertex[node.index()] = 0;  // that of any vertex: a retired row, no node's
  drop_retired_rows();
}

CellChange DenseMap::apply(const CellChange& change) {
  const std::size_t cells = tetrahedra();
  SUNDER_ASSERT(rows_.first_node_point >= rows_.points.size(), "cells change before nodes come in");
  SUNDER_ASSERT(change.kept_points <= rows_.points.size() && change.kept_vertices <= vertices() &&
                    change.kept_tetrahedra <= cells,
                "rows are kept that are there");
  const auto from = [](const auto& column, std::size_t first) {
    return std::vector(column.begin() + static_cast<std::ptrdiff_t>(first), column.end());
  };
  CellChange back{change.kept_points, change.kept_vertices, change.kept_tetrahedra};
  back.points = from(rows_.points, change.kept_points);
  back.vertices = from(rows_.point_of_vertex, change.kept_vertices);
  const auto keep = [&](std::size_t t) {
    back.cells.push_back({TetId{t}, rows_.corners[t], rows_.neighbours[t]});
  };
  for (const CellChange::Cell& cell : change.cells) {
    if (cell.row.index() < change.kept_tetrahedra) keep(cell.row.index());
  }
  for (std::size_t t = change.kept_tetrahedra; t < cells; ++t) keep(t);
  for (const auto& [vertex, tetrahedron] : change.begins) {
    if (vertex.index() < change.kept_vertices) {
      back.begins.push_back({vertex, incident_[vertex.index()]});
    }
  }
  for (std::size_t v = change.kept_vertices; v < vertices(); ++v) {
    back.begins.push_back({VertexId{v}, incident_[v]});
  }

  rows_.points.resize(change.kept_points);
  for (const Point& x : change.points) append_row(rows_.points, x);
  rows_.point_of_vertex.resize(change.kept_vertices);
  for (const std::uint32_t p : change.vertices) append_row(rows_.point_of_vertex, p);
  incident_.resize(rows_.point_of_vertex.size());
  rows_.corners.resize(change.kept_tetrahedra);
  rows_.neighbours.resize(change.kept_tetrahedra);
  for (const auto& [row, corners, neighbours] : change.cells) {
    if (row.index() < rows_.corners.size()) {
      rows_.corners[row.index()] = corners;
      rows_.neighbours[row.index()] = neighbours;
    } else {
      SUNDER_ASSERT(row.index() == rows_.corners.size(), "rows are appended in rising order");
      append_row(rows_.corners, corners);
      append_row(rows_.neighbours, neighbours);
    }
  }
  for (const auto& [vertex, tetrahedron] : change.begins) incident_[vertex.index()] = tetrahedron;
  return back;
}

}  // namespace sunder
