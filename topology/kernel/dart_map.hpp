// SPDX-License-Identifier: MIT
// The darts behind a VolumeMap: CGAL's 3-map, and a kernel that walks nothing else.
// An include costs 12 s per source; without a need for darts, use VolumeMap alone.
#pragma once

#include <CGAL/Cell_attribute.h>
#include <CGAL/Cell_attribute_with_point.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>
#include <CGAL/Linear_cell_complex_traits.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "topology/base/ids.hpp"
#include "topology/kernel/kernel.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// Content of a vertex attribute besides its rest position; it fills the space that alignment
/// leaves.
struct VertexInfo {
  VertexId row;
  /// Row of the file's point.
  std::uint32_t point = 0;
  friend bool operator==(const VertexInfo&, const VertexInfo&) = default;
};

/// A dart carries its own row. Attributes: vertices (rest position, rows) and tetrahedra (row).
/// Edges and faces carry none, because 1- and 2-attributes would cost 40 % of time and memory
/// without a use.
struct DartItems {
  template <class Refs>
  struct Dart_wrapper {
    using Dart_info = DartId;
    using Vertex_attribute = CGAL::Cell_attribute_with_point<Refs, VertexInfo>;
    using Volume_attribute = CGAL::Cell_attribute<Refs, TetId>;
    using Attributes = std::tuple<Vertex_attribute, void, void, Volume_attribute>;
  };
};

using DartTraits = CGAL::Linear_cell_complex_traits<3, CGAL::Simple_cartesian<double>>;
using DartComplex = CGAL::Linear_cell_complex_for_combinatorial_map<3, 3, DartTraits, DartItems>;

// CGAL 5.6 renamed handles to descriptors.
#if CGAL_VERSION_NR >= 1050600000
using DartDescriptor = DartComplex::Dart_descriptor;
using ConstDartDescriptor = DartComplex::Dart_const_descriptor;
using VertexAttributeDescriptor = DartComplex::Attribute_descriptor<0>::type;
#else
using DartDescriptor = DartComplex::Dart_handle;
using ConstDartDescriptor = DartComplex::Dart_const_handle;
using VertexAttributeDescriptor = DartComplex::Attribute_handle<0>::type;
#endif

/// CGAL's map, always unmanaged, with a handle for every row. It is a model of `Kernel` that
/// answers by walks on darts: three to five times slower than rows, and 22 times larger.
class DartMap {
 public:
  using Dart = DartDescriptor;
  using ConstDart = ConstDartDescriptor;

  /// Requires: rows that agree with each other, and one orbit for the corners of each vertex row.
  explicit DartMap(const MapRows& rows);
  DartMap(const DartMap&) = delete;  // handles point into the complex: build again from rows
  DartMap& operator=(const DartMap&) = delete;

  std::size_t tetrahedra() const { return first_dart_.size(); }
  std::size_t vertices() const { return corner_.size(); }
  std::array<VertexId, 4> corners(TetId t) const;
  HalfFaceId neighbour(HalfFaceId f) const;
  TetId incident_tetrahedron(VertexId v) const;
  Point point(VertexId v) const;
  std::uint32_t point_of_vertex(VertexId v) const;

  Dart dart(HalfFaceId f, CornerId from) const;
  /// A dart that starts at the vertex. Requires: a vertex that is not retired.
  Dart dart(VertexId v) const;
  /// The same dart for the functions here, from a const dart of an iteration over `complex()`, such
  /// as `one_dart_per_incident_cell<2, 0>(d)`.
  Dart dart(ConstDart d) const;
  /// The half-face along which a dart runs, and the corner at which it starts.
  HalfFaceId half_face_of(Dart d) const { return HalfFaceId{id(d).index() / 3}; }
  CornerId corner_of(Dart d) const;
  DartId id(Dart d) const { return complex_.info(d); }
  VertexId vertex(Dart d) const { return complex_.info<0>(d).row; }
  TetId tetrahedron(Dart d) const { return complex_.info<3>(d); }
  // CGAL gives back const handles from a const complex; the same darts, hence the casts.
  Dart beta0(Dart d) const { return beta<0>(d); }
  Dart beta1(Dart d) const { return beta<1>(d); }
  Dart beta2(Dart d) const { return beta<2>(d); }
  Dart beta3(Dart d) const { return beta<3>(d); }
  bool is_free(Dart d) const { return complex_.is_free<3>(d); }

  void unsew(HalfFaceId face);
  void sew(Dart a, Dart b);
  VertexId split_vertex(const VertexSplit& split);
  void merge_vertices(VertexId kept, VertexId retired, std::span<const CornerId> corners);
  /// Applies a change. `rows`: the rows after the change. O(cells of the change log).
  void apply(const CellChange& change, const MapRows& rows);
  /// Sets the number of vertex rows, including rows without a corner.
  void fit_rows(std::size_t rows) { corner_.resize(rows); }

  const DartComplex& complex() const { return complex_; }
  /// For measurements and tests in which CGAL manages attributes. Rows are then not updated.
  DartComplex& complex() { return complex_; }
  /// Dart k (0 to 11, canonical order) of a tetrahedron.
  Dart dart_at(TetId t, int k) const;
  /// Prefetches the darts of a tetrahedron. A walk to one of them takes up to four dependent reads.
  /// The only effect is on time.
  void prefetch(TetId t) const;
  /// Bytes of darts, attributes and handles.
  MapBytes bytes() const;

 private:
  template <unsigned int i>
  Dart beta(Dart d) const {
    return const_cast<DartComplex&>(complex_).template beta<i>(d);
  }
  void remove_tetrahedron(TetId t);
  void add_tetrahedron(TetId t, const std::array<VertexAttributeDescriptor, 4>& corners);
  void rename(CornerId c, VertexAttributeDescriptor to);
  /// Requires: v is not retired.
  VertexAttributeDescriptor attribute_of(VertexId v) const;

  DartComplex complex_;
  std::vector<Dart> first_dart_;  // dart 0 of each tetrahedron
  // A corner of each vertex row, none() when it is retired: half of a handle to its attribute.
  std::vector<CornerId> corner_;
};

static_assert(Kernel<DartMap>);

}  // namespace sunder
