// SPDX-License-Identifier: MIT
// A 3-map of tetrahedra held in dense rows alone: no dart is stored, every one follows from a row.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "topology/base/ids.hpp"
#include "topology/base/tet_mesh.hpp"
#include "topology/kernel/kernel.hpp"

namespace sunder {

/// Dense rows from which a map is made, and which it keeps.
struct MapRows {
  /// Vertex rows of each tetrahedron, positively oriented wherever its volume is meaningful.
  std::vector<std::array<VertexId, 4>> corners;
  /// The half-face on the other side of each face (place p: opposite to corner p), or none().
  std::vector<std::array<HalfFaceId, 4>> neighbours;
  /// Row of the file's point of each vertex; several rows may share one (pinches, splits).
  std::vector<std::uint32_t> point_of_vertex;
  /// The file's points: rest positions, m. A vertex has that of its point. Behind them those of nodes
  /// (`DenseMap::append_node`).
  std::vector<Point> points;
  /// Tetrahedra whose last two corners were exchanged on reading, in rising order.
  std::vector<TetId> reoriented;
  /// Row of the first point that is a node's.
  std::uint32_t first_node_point = 0xffffffffU;
};

/// A model of `Kernel` in 32 bytes a tetrahedron, 8 a vertex and the file's points. `VolumeMap`
/// answers from one; beside another map, one holds a coarser sewing of the same tetrahedra.
///
/// Rows of vertices are exactly the vertex orbits between calls of split_face and glue_face (the
/// primitives `unsew`, `sew`, `split_vertex`, `merge_vertices` are theirs).
/// Not thread-safe for writers; const calls may run side by side.
class DenseMap {
 public:
  using Dart = DartId;

  DenseMap() = default;
  /// Needs: rows that agree with each other, as `build_map` makes them. O(|T|).
  explicit DenseMap(MapRows rows);
  /// The same with the incident tetrahedron of each vertex as splits have left it.
  DenseMap(MapRows rows, std::vector<TetId> incident)
      : rows_(std::move(rows)), incident_(std::move(incident)) {}

  std::size_t tetrahedra() const { return rows_.corners.size(); }
  /// Vertex rows, retired ones among them.
  std::size_t vertices() const { return rows_.point_of_vertex.size(); }
  const std::array<VertexId, 4>& corners(TetId t) const { return rows_.corners[t.index()]; }
  HalfFaceId neighbour(HalfFaceId f) const {
    return rows_.neighbours[f.index() / 4][f.index() % 4];
  }
  TetId incident_tetrahedron(VertexId v) const { return incident_[v.index()]; }
  const Point& point(VertexId v) const { return rows_.points[point_of_vertex(v)]; }
  std::uint32_t point_of_vertex(VertexId v) const { return rows_.point_of_vertex[v.index()]; }

  /// By the file's points, not by vertices.
  std::span<const Point> points() const { return rows_.points; }
  const MapRows& rows() const { return rows_; }
  std::span<const TetId> incident_tetrahedra() const { return incident_; }

  DartId dart(HalfFaceId f, CornerId from) const;
  DartId id(DartId d) const { return d; }
  VertexId vertex(DartId d) const;
  TetId tetrahedron(DartId d) const { return TetId{d.index() / 12}; }
  DartId beta0(DartId d) const;
  DartId beta1(DartId d) const;
  DartId beta2(DartId d) const;
  DartId beta3(DartId d) const;
  bool is_free(DartId d) const;

  void unsew(HalfFaceId face);
  void sew(DartId a, DartId b);
  VertexId split_vertex(const VertexSplit& split);
  void merge_vertices(VertexId kept, VertexId retired, std::span<const CornerId> corners);
  CellChange apply(const CellChange& change);

  /// Rows for nodes that are no vertices, such as the middles of edges (edge_nodes.hpp): no corner has
  /// them, no tetrahedron is incident to them, and they are numbered with the vertices, so that one
  /// column has a place for both. Appends one at a point of its own, m.
  VertexId append_node(const Point& at);
  /// Appends one at the same point.
  VertexId append_node(VertexId copied);
  /// Retires one; at the end its row is dropped, as those of vertices are.
  void retire_node(VertexId node);
  bool is_node(VertexId row) const { return point_of_vertex(row) >= rows_.first_node_point; }

 private:
  void drop_retired_rows();

  MapRows rows_;
  std::vector<TetId> incident_;  // of each vertex row; none() when it is retired, and for nodes
};

static_assert(CellKernel<DenseMap>);

}  // namespace sunder
