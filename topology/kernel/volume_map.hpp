// SPDX-License-Identifier: MIT
// The 3-map of a body: dense rows and, on request, CGAL's darts kept equal to them.
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

/// Memory of the parts of a map in bytes, counted from their capacities.
struct MapBytes {
  /// CGAL's darts.
  std::size_t darts = 0;
  /// CGAL's 0- and 3-attributes.
  std::size_t attributes = 0;
  /// Vertex rows and neighbours of each tetrahedron, and the list of reoriented ones.
  std::size_t adjacency = 0;
  /// Links from rows to darts: a dart per tetrahedron, a corner per vertex.
  std::size_t handles = 0;
  /// Point and incident tetrahedron of each vertex; the file's points.
  std::size_t vertex_columns = 0;
};

constexpr std::size_t total(const MapBytes& b) {
  return b.darts + b.attributes + b.adjacency + b.handles + b.vertex_columns;
}

/// The data structure that holds a body's topology. Both give the same answers in the same order.
enum class MapKernel : std::uint8_t {
  /// Rows of corners and neighbours, 39 bytes per tetrahedron, 69 after a total shatter.
  dense,
  /// CGAL's Linear_cell_complex: the algorithms (split, glue, star, fan, components, counts) walk
  /// and change its darts; rows are its attributes, in columns that mechanics streams.
  ///
  /// 850 bytes per tetrahedron, 1 080 after a total shatter.
  lcc,
};

/// A 3-map of tetrahedra and a model of `Kernel`. Dense rows answer its own queries.
///
/// After every call the dense rows equal the darts, if there are any. Rows of vertices are exactly
/// the vertex orbits between calls of split_face and glue_face. Use these functions instead of the
/// primitives `unsew`, `sew`, `split_vertex` and `merge_vertices`. Not thread-safe for writers.
/// Const calls may run in parallel.
class VolumeMap {
 public:
  using Dart = DartId;

  /// Marks a map that passes queries on to two other maps (map_answers.hpp).
  using TwoAnswers = void;

  /// Makes a map without darts. Requires: rows that agree with each other, as `build_map` makes
  /// them. O(|T|).
  explicit VolumeMap(MapRows rows);
  /// The same, with the incident tetrahedron of each vertex after splits: walks start there.
  VolumeMap(MapRows rows, std::vector<TetId> incident);
  VolumeMap(const VolumeMap& other);
  VolumeMap& operator=(const VolumeMap& other);
  VolumeMap(VolumeMap&&) noexcept;
  VolumeMap& operator=(VolumeMap&&) noexcept;
  ~VolumeMap();

  MapKernel kernel() const { return darts_ ? MapKernel::lcc : MapKernel::dense; }
  /// Makes darts from the rows, about 1 µs per tetrahedron, or deletes them. A build without CGAL
  /// stays dense.
  void set_kernel(MapKernel kernel);

  std::size_t tetrahedra() const { return dense_.tetrahedra(); }
  /// Number of vertex rows, including retired rows.
  std::size_t vertices() const { return dense_.vertices(); }
  const std::array<VertexId, 4>& corners(TetId t) const { return dense_.corners(t); }
  HalfFaceId neighbour(HalfFaceId f) const { return dense_.neighbour(f); }
  TetId incident_tetrahedron(VertexId v) const { return dense_.incident_tetrahedron(v); }
  const Point& point(VertexId v) const { return dense_.point(v); }
  std::uint32_t point_of_vertex(VertexId v) const { return dense_.point_of_vertex(v); }

  /// The whole columns, for loops that stream them; valid until the next change of the map.
  std::span<const std::array<VertexId, 4>> corners() const { return dense_.rows().corners; }
  std::span<const std::array<HalfFaceId, 4>> neighbours() const { return dense_.rows().neighbours; }
  std::span<const std::uint32_t> point_of_vertex() const { return dense_.rows().point_of_vertex; }
  /// Positions of the file's points, m; indexed by points and not by vertices.
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

  /// Rows of nodes other than vertices: see `DenseMap::append_node`. Darts have no nodes.
  VertexId append_node(const Point& at);
  VertexId append_node(VertexId copied);
  void retire_node(VertexId node);
  bool is_node(VertexId row) const { return dense_.is_node(row); }

  /// CGAL's darts behind the rows, for sources that include dart_map.hpp (hosts:
  /// <sunder/cgal_map.hpp>). Requires: the kernel `lcc`.
  const DartMap& darts() const { return *darts_; }
  /// The rows alone, as a map of their own.
  const DenseMap& dense() const { return dense_; }
  MapBytes bytes() const;

 private:
  void fit_darts();

  DenseMap dense_;
  std::unique_ptr<DartMap> darts_;
};

static_assert(CellKernel<VolumeMap>);

/// Checks a map and returns all faults; empty for every map that the library's calls leave. The
/// check covers the beta rules and one attribute per vertex orbit (CGAL's own check), dense rows
/// equal to darts, rows equal to vertex orbits, different points at the corners of each
/// tetrahedron, and retired rows. A dense map is compared with darts made from its rows. O(|T|),
/// about 5 µs per tetrahedron.
std::vector<Finding> check(const VolumeMap& map);

}  // namespace sunder
