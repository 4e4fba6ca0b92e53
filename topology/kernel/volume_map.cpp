// SPDX-License-Identifier: MIT
// The map of a body: every change goes to the dense rows and to the darts, if there are any.
#include "topology/kernel/volume_map.hpp"

#include "topology/base/assert.hpp"
#if !defined(SUNDER_ROWS_ALONE)
#include "topology/kernel/dart_map.hpp"
#endif

namespace sunder {

#if defined(SUNDER_ROWS_ALONE)
/// Stands for the darts in a build without CGAL, as for WebAssembly, which never makes any. Such a
/// build has no `check(const VolumeMap&)`, which compares the two.
class DartMap {
 public:
  void prefetch(TetId) const {}
  void unsew(HalfFaceId) {}
  int dart_at(TetId, int) const { return 0; }
  void sew(int, int) {}
  VertexId split_vertex(const VertexSplit&) { return VertexId::none(); }
  void merge_vertices(VertexId, VertexId, std::span<const CornerId>) {}
  void apply(const CellChange&, const MapRows&) {}
  void fit_rows(std::size_t) const {}
  MapBytes bytes() const { return {}; }
};
#endif

namespace {

// Debug builds compare each changed place with the darts at once; `check` compares everything.
#if !defined(SUNDER_ROWS_ALONE)
[[maybe_unused]] bool agree(const VolumeMap& map, TetId t) {
  if (map.kernel() == MapKernel::dense) return true;
  if (map.darts().corners(t) != map.corners(t)) return false;
  for (int p = 0; p < 4; ++p) {
    if (map.darts().neighbour(half_face(t, p)) != map.neighbour(half_face(t, p))) return false;
  }
  return true;
}
#else
bool agree(const VolumeMap&, TetId) { return true; }  // there are no darts to differ
#endif

}  // namespace

VolumeMap::VolumeMap(MapRows rows) : dense_(std::move(rows)) {}

VolumeMap::VolumeMap(MapRows rows, std::vector<TetId> incident)
    : dense_(std::move(rows), std::move(incident)) {}

VolumeMap::VolumeMap(const VolumeMap& other) : dense_(other.dense_) { set_kernel(other.kernel()); }

VolumeMap& VolumeMap::operator=(const VolumeMap& other) { return *this = VolumeMap(other); }
VolumeMap::VolumeMap(VolumeMap&&) noexcept = default;
VolumeMap& VolumeMap::operator=(VolumeMap&&) noexcept = default;
VolumeMap::~VolumeMap() = default;

void VolumeMap::set_kernel([[maybe_unused]] MapKernel kernel) {
#if !defined(SUNDER_ROWS_ALONE)
  if (kernel == MapKernel::dense) {
    darts_.reset();
  } else if (!darts_) {
    darts_ = std::make_unique<DartMap>(dense_.rows());
  }
#endif
}

void VolumeMap::unsew(HalfFaceId face) {
  const HalfFaceId across = neighbour(face);
  SUNDER_ASSERT(!across.is_none(), "unsewing a boundary face");
  if (darts_) {
    // A third of the time of a fan in a body of 384 000 tetrahedra (docs/lab/kernel.md).
    darts_->prefetch(tetrahedron_of(face));
    darts_->prefetch(tetrahedron_of(across));
    darts_->unsew(face);
  }
  dense_.unsew(face);
  SUNDER_ASSERT(agree(*this, tetrahedron_of(face)), "the darts are unsewn as the rows are");
  SUNDER_ASSERT(agree(*this, tetrahedron_of(across)), "the darts are unsewn as the rows are");
}

void VolumeMap::sew(DartId a, DartId b) {
  const auto place = [](DartId d) { return static_cast<int>(d.index() % 12); };
  if (darts_) {
    darts_->sew(darts_->dart_at(tetrahedron(a), place(a)),
                darts_->dart_at(tetrahedron(b), place(b)));
  }
  dense_.sew(a, b);
  SUNDER_ASSERT(agree(*this, tetrahedron(a)), "the darts are sewn as the rows are");
  SUNDER_ASSERT(agree(*this, tetrahedron(b)), "the darts are sewn as the rows are");
}

VertexId VolumeMap::split_vertex(const VertexSplit& split) {
  const VertexId added = darts_ ? darts_->split_vertex(split) : VertexId::none();
  const VertexId row = dense_.split_vertex(split);
  SUNDER_ASSERT(!darts_ || row == added, "the darts and the rows append the same vertex");
  static_cast<void>(added);
  for ([[maybe_unused]] const CornerId c : split.leaving) {
    SUNDER_ASSERT(agree(*this, tetrahedron_of(c)), "the darts have the new row");
  }
  for ([[maybe_unused]] const CornerId c : split.staying) {
    SUNDER_ASSERT(agree(*this, tetrahedron_of(c)), "the darts have the old row");
  }
  return row;
}

void VolumeMap::merge_vertices(VertexId kept, VertexId retired, std::span<const CornerId> corners) {
  if (darts_) darts_->merge_vertices(kept, retired, corners);
  dense_.merge_vertices(kept, retired, corners);
  fit_darts();  // at the end nodes may hold rows that the darts alone would drop
  for ([[maybe_unused]] const CornerId c : corners) {
    SUNDER_ASSERT(agree(*this, tetrahedron_of(c)), "the darts have the kept row");
  }
}

CellChange VolumeMap::apply(const CellChange& change) {
  CellChange back = dense_.apply(change);
  if (darts_) darts_->apply(change, dense_.rows());
  for ([[maybe_unused]] const CellChange::Cell& cell : change.cells) {
    SUNDER_ASSERT(agree(*this, cell.row), "the darts are changed as the rows are");
  }
  return back;
}

void VolumeMap::fit_darts() {
  if (darts_) darts_->fit_rows(dense_.vertices());
}

VertexId VolumeMap::append_node(const Point& at) {
  const VertexId row = dense_.append_node(at);
  fit_darts();
  return row;
}

VertexId VolumeMap::append_node(VertexId copied) {
  const VertexId row = dense_.append_node(copied);
  fit_darts();
  return row;
}

void VolumeMap::retire_node(VertexId node) {
  dense_.retire_node(node);
  fit_darts();
}

MapBytes VolumeMap::bytes() const {
  const auto held = [](const auto& v) {
    return v.capacity() * sizeof(typename std::decay_t<decltype(v)>::value_type);
  };
  const MapRows& rows = dense_.rows();
  MapBytes bytes = darts_ ? darts_->bytes() : MapBytes{};
  bytes.adjacency = held(rows.corners) + held(rows.neighbours) + held(rows.reoriented);
  bytes.vertex_columns =
      held(rows.points) + held(rows.point_of_vertex) + dense_.vertices() * sizeof(TetId);
  return bytes;
}

}  // namespace sunder
