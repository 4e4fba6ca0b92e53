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

/// The dense rows of a map.
struct MapRows {
  /// Vertex rows of each tetrahedron, positively oriented if its volume is meaningful.
  std::vector<std::array<VertexId, 4>> corners;
  /// The half-face on the other side of each face (place p: opposite to corner p), or none().
  std::vector<std::array<HalfFaceId, 4>> neighbours;
  /// Row of the file's point of each vertex; several rows may share one (pinches, splits).
  std::vector<std::uint32_t> point_of_vertex;
  /// The file's points: rest positions, m. A vertex has the position of its point. Points of nodes
  /// follow (`DenseMap::append_node`).
  std::vector<Point> points;
  /// Tetrahedra with their last two corners exchanged on reading, in rising order.
  std::vector<TetId> reoriented;
  /// Row of the first point of a node.
  std::uint32_t first_node_point = 0xffffffffU;
};

/// A model of `Kernel` with 32 bytes per tetrahedron, 8 bytes per vertex, and the file's points.
/// `VolumeMap` answers from a `DenseMap`. A second one can hold a coarser sewing of the same
/// tetrahedra.
///
/// Rows of vertices are exactly the vertex orbits between calls of split_face and glue_face (the
/// primitives `unsew`, `sew`, `split_vertex`, `merge_vertices` belong to these). Not thread-safe
/// for writers. Const calls may run in parallel.
class DenseMap {
 public:
  using Dart = DartId;

  DenseMap() = default;
  /// Requires: rows that agree with each other, as `build_map` makes them. O(|T|).
  explicit DenseMap(MapRows rows);
  /// The same, with the incident tetrahedron of each vertex after splits.
  DenseMap(MapRows rows, std::vector<TetId> incident)
      : rows_(std::move(rows)), incident_(std::move(incident)) {}

  std::size_t tetrahedra() const { return rows_.corners.size(); }
  /// Number of vertex rows, including retired rows.
  std::size_t vertices() const { return rows_.point_of_vertex.size(); }
  const std::array<VertexId, 4>& corners(TetId t) const { return rows_.corners[t.index()]; }
  HalfFaceId neighbour(HalfFaceId f) const {
    return rows_.neighbours[f.index() / 4][f.index() % 4];
  }
  TetId incident_tetrahedron(VertexId v) const { return incident_[v.index()]; }
  const Point& point(VertexId v) const { return rows_.points[point_of_vertex(v)]; }
  std::uint32_t point_of_vertex(VertexId v) const { return rows_.point_of_vertex[v.index()]; }

  /// Positions of the file's points, m; indexed by points and not by vertices.
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

  /// Appends a row for a node other than a vertex, such as the middle of an edge (edge_nodes.hpp),
  /// at a new point, m. No corner has such a row, and no tetrahedron is incident to it. Nodes are
  /// numbered with the vertices, so that one column holds both.
  VertexId append_node(const Point& at);
  /// Appends a node at the same point.
  VertexId append_node(VertexId copied);
  /// Retires a node. The last rows are dropped, as with vertices.
  void retire_node(VertexId node);
  bool is_node(VertexId row) const { return point_of_vertex(row) >= rows_.first_node_point; }

 private:
  void drop_retired_rows();

  MapRows rows_;
  std::vector<TetId> incident_;  // of each vertex row; none() when it is retired, and for nodes
};

static_assert(CellKernel<DenseMap>);

}  // namespace sunder
