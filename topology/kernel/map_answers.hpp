// SPDX-License-Identifier: MIT
// The kernel behind a VolumeMap: its rows, or its darts. For sources that instantiate algorithms.
#pragma once

#include "topology/kernel/kernel.hpp"
#include "topology/kernel/volume_map.hpp"
#if !defined(SUNDER_ROWS_ALONE)
#include "topology/kernel/dart_map.hpp"
#endif

namespace sunder {

/// A VolumeMap by its rows; changes go to all that it keeps.
class RowAnswers {
 public:
  using Dart = DartId;
  explicit RowAnswers(VolumeMap& map) : map_(&map) {}

  std::size_t tetrahedra() const { return map_->tetrahedra(); }
  std::size_t vertices() const { return map_->vertices(); }
  const std::array<VertexId, 4>& corners(TetId t) const { return map_->corners(t); }
  HalfFaceId neighbour(HalfFaceId f) const { return map_->neighbour(f); }
  TetId incident_tetrahedron(VertexId v) const { return map_->incident_tetrahedron(v); }
  const Point& point(VertexId v) const { return map_->point(v); }
  std::uint32_t point_of_vertex(VertexId v) const { return map_->point_of_vertex(v); }
  DartId dart(HalfFaceId f, CornerId from) const { return map_->dart(f, from); }
  DartId id(DartId d) const { return d; }
  VertexId vertex(DartId d) const { return map_->vertex(d); }
  TetId tetrahedron(DartId d) const { return map_->tetrahedron(d); }
  DartId beta0(DartId d) const { return map_->beta0(d); }
  DartId beta1(DartId d) const { return map_->beta1(d); }
  DartId beta2(DartId d) const { return map_->beta2(d); }
  DartId beta3(DartId d) const { return map_->beta3(d); }
  bool is_free(DartId d) const { return map_->is_free(d); }
  void unsew(HalfFaceId f) { map_->unsew(f); }
  void sew(DartId a, DartId b) { map_->sew(a, b); }
  VertexId split_vertex(const VertexSplit& split) { return map_->split_vertex(split); }
  void merge_vertices(VertexId kept, VertexId retired, std::span<const CornerId> corners) {
    map_->merge_vertices(kept, retired, corners);
  }
  std::span<const Point> points() const { return map_->points(); }
  CellChange apply(const CellChange& change) { return map_->apply(change); }

 private:
  VolumeMap* map_;
};
static_assert(CellKernel<RowAnswers>);

#if !defined(SUNDER_ROWS_ALONE)
/// A VolumeMap by its darts: all but where walks round a vertex begin, which is a row, so that
/// answers come in the same order. Changes go to darts and rows.
class DartAnswers {
 public:
  using Dart = DartDescriptor;
  explicit DartAnswers(VolumeMap& map) : map_(&map), darts_(&map.darts()) {}

  std::size_t tetrahedra() const { return darts_->tetrahedra(); }
  std::size_t vertices() const { return darts_->vertices(); }
  std::array<VertexId, 4> corners(TetId t) const { return darts_->corners(t); }
  HalfFaceId neighbour(HalfFaceId f) const { return darts_->neighbour(f); }
  TetId incident_tetrahedron(VertexId v) const { return map_->incident_tetrahedron(v); }
  Point point(VertexId v) const { return darts_->point(v); }
  std::uint32_t point_of_vertex(VertexId v) const { return darts_->point_of_vertex(v); }
  Dart dart(HalfFaceId f, CornerId from) const { return darts_->dart(f, from); }
  DartId id(Dart d) const { return darts_->id(d); }
  VertexId vertex(Dart d) const { return darts_->vertex(d); }
  TetId tetrahedron(Dart d) const { return darts_->tetrahedron(d); }
  Dart beta0(Dart d) const { return darts_->beta0(d); }
  Dart beta1(Dart d) const { return darts_->beta1(d); }
  Dart beta2(Dart d) const { return darts_->beta2(d); }
  Dart beta3(Dart d) const { return darts_->beta3(d); }
  bool is_free(Dart d) const { return darts_->is_free(d); }
  void unsew(HalfFaceId f) { map_->unsew(f); }
  void sew(Dart a, Dart b) { map_->sew(darts_->id(a), darts_->id(b)); }
  VertexId split_vertex(const VertexSplit& split) { return map_->split_vertex(split); }
  void merge_vertices(VertexId kept, VertexId retired, std::span<const CornerId> corners) {
    map_->merge_vertices(kept, retired, corners);
  }
  std::span<const Point> points() const { return map_->points(); }
  CellChange apply(const CellChange& change) { return map_->apply(change); }

 private:
  VolumeMap* map_;
  const DartMap* darts_;
};
static_assert(CellKernel<DartAnswers>);
#endif

/// Gives `ask(kernel)`, where `kernel` is the one that the map uses.
template <class Ask>
auto answer(VolumeMap& map, Ask ask) {
#if defined(SUNDER_ROWS_ALONE)
  return ask(const_cast<DenseMap&>(map.dense()));  // nothing else is kept
#else
  if (map.kernel() == MapKernel::lcc) {
    DartAnswers darts(map);
    return ask(darts);
  }
  RowAnswers rows(map);
  return ask(rows);
#endif
}

/// The same for questions that change nothing: `ask` gets a const kernel.
template <class Ask>
auto answer(const VolumeMap& map, Ask ask) {
  return answer(const_cast<VolumeMap&>(map), [&](const auto& kernel) { return ask(kernel); });
}

}  // namespace sunder
