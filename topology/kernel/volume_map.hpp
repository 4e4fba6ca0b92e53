// SPDX-License-Identifier: MIT
// The 3-map of a body: dense rows and, where they are asked for, CGAL's darts kept equal to them.
// CGAL stays behind a pointer.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/kernel/dense_map.hpp"

namespace sunder {

class DartMap;

/// Memory of the parts of a map, bytes, counted from their capacities.
struct MapBytes {
  /// CGAL's darts.
  std::size_t darts = 0;
  /// CGAL's 0- and 3-attributes.
  std::size_t attributes = 0;
  /// Vertex rows and neighbours of each tetrahedron, and the list of reoriented ones.
  std::size_t adjacency = 0;
  /// From rows to darts: a dart of each tetrahedron, a corner of each vertex.
  std::size_t handles = 0;
  /// Point and incident tetrahedron of each vertex; the file's points.
  std::size_t vertex_columns = 0;
};

constexpr std::size_t total(const MapBytes& b) {
  return b.darts + b.attributes + b.adjacency + b.handles + b.vertex_columns;
}

/// What holds a body's topology and answers for it. Both give the same answers in the same order.
enum class MapKernel : std::uint8_t {
  /// Rows of corners and neighbours, 39 bytes a tetrahedron, 69 after a total shatter.
  dense,
  /// CGAL's Linear_cell_complex: the algorithms (split, glue, star, fan, components, counts) walk
  /// and change its darts; rows are its attributes, in columns that mechanics streams.
  ///
  /// 850 bytes a tetrahedron, 1 080 after a total shatter.
  lcc,
};

/// A 3-map of tetrahedra; a model of `Kernel` whose own queries come from its dense rows.
///
/// Guarded: the dense rows equal the darts, if there are any, after every call; rows of vertices
/// are exactly the vertex orbits between calls of split_face and glue_face (the primitives `unsew`,
/// `sew`, `split_vertex`, `merge_vertices` are theirs; use those functions instead). Not
/// thread-safe for writers; const calls may run side by side.
class VolumeMap {
 public:
  using Dart = DartId;

  /// Tells the algorithms that two maps answer for this one (map_answers.hpp).
  using TwoAnswers = void;

  /// Needs: rows that agree with each other, as `build_map` makes them. No darts. O(|T|).
  explicit VolumeMap(MapRows rows);
  /// The same with the incident tetrahedron of each vertex as splits have left it: walks begin
  /// there.
  VolumeMap(MapRows rows, std::vector<TetId> incident);
  VolumeMap(const VolumeMap& other);
  VolumeMap& operator=(const VolumeMap& other);
  VolumeMap(VolumeMap&&) noexcept;
  VolumeMap& operator=(VolumeMap&&) noexcept;
  ~VolumeMap();

  MapKernel kernel() const { return darts_ ? MapKernel::lcc : MapKernel::dense; }
  /// Makes darts of the rows, about 1 us a tetrahedron, or lets them go. A build without CGAL has
  /// none to make and stays dense.
  void set_kernel(MapKernel kernel);

  std::size_t tetrahedra() const { return dense_.tetrahedra(); }
  /// Vertex rows, retired ones among them.
  std::size_t vertices() const { return dense_.vertices(); }
  const std::array<VertexId, 4>& corners(TetId t) const { return dense_.corners(t); }
  HalfFaceId neighbour(HalfFaceId f) const { return dense_.neighbour(f); }
  TetId incident_tetrahedron(VertexId v) const { return dense_.incident_tetrahedron(v); }
  const Point& point(VertexId v) const { return dense_.point(v); }
  std::uint32_t point_of_vertex(VertexId v) const { return dense_.point_of_vertex(v); }

  /// The columns whole, for loops that stream them; valid until the next change of the map.
  std::span<const std::array<VertexId, 4>> corners() const { return dense_.rows().corners; }
  std::span<const std::array<HalfFaceId, 4>> neighbours() const { return dense_.rows().neighbours; }
  std::span<const std::uint32_t> point_of_vertex() const { return dense_.rows().point_of_vertex; }
  /// By the file's points, not by vertices.
  std::span<const Point> points() const { return dense_.points(); }
  std::span<const TetId> reoriented() const { return dense_.rows().reoriented; }

  DartId dart(HalfFaceId f, CornerId from) const { return dense_.dart(f, from); }
  DartId id(DartId d) const { return d; }
  VertexId vertex(DartId d) const { return dense_.vertex(d); }
  TetId tetrahedron(DartId d) const { return dense_.tetrahedron(d); }
  DartId beta0(DartId d) const { return dense_.beta0(d); }
  DartId beta1(DartId d) const { return dense_.beta1(d); }
  DartId beta2(DartId d) const { return dense_.beta2(d); }
  DartId beta3(DartId d) const { return dense_.beta3(d); }
  bool is_free(DartId d) const { return dense_.is_free(d); }

  void unsew(HalfFaceId face);
  void sew(DartId a, DartId b);
  VertexId split_vertex(const VertexSplit& split);
  void merge_vertices(VertexId kept, VertexId retired, std::span<const CornerId> corners);
  CellChange apply(const CellChange& change);

  /// Rows of nodes that are no vertices; see `DenseMap::append_node`. Darts do not know them.
  VertexId append_node(const Point& at);
  VertexId append_node(VertexId copied);
  void retire_node(VertexId node);
  bool is_node(VertexId row) const { return dense_.is_node(row); }

  /// CGAL's darts behind the rows, for the few sources that include dart_map.hpp (of hosts:
  /// <sunder/cgal_map.hpp>). Needs: the kernel `lcc`.
  const DartMap& darts() const { return *darts_; }
  /// The rows by themselves, a map of their own.
  const DenseMap& dense() const { return dense_; }
  MapBytes bytes() const;

 private:
  void fit_darts();

  DenseMap dense_;
  std::unique_ptr<DartMap> darts_;
};

static_assert(CellKernel<VolumeMap>);

/// Everything that is wrong with a map; empty for every map that the library's calls leave behind.
/// beta rules and one attribute a vertex orbit (CGAL's own check), dense rows equal to the darts,
/// rows equal to vertex orbits, different points at the corners of each tetrahedron, retired rows.
/// A dense map is held against darts made of its rows. O(|T|), about 5 us a tetrahedron.
std::vector<Finding> check(const VolumeMap& map);

}  // namespace sunder
