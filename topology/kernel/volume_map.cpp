// SPDX-License-Identifier: MIT
// The map of a body: every change goes to the darts and to the dense rows in one call.
#include "topology/kernel/volume_map.hpp"

#include "topology/base/append_row.hpp"
#include "topology/base/assert.hpp"
#include "topology/kernel/dart_map.hpp"

namespace sunder {
namespace {

DartId dart_in(TetId t, int k) { return DartId{12 * t.index() + static_cast<std::size_t>(k)}; }
int place_of(DartId d) { return static_cast<int>(d.index() % 12); }
HalfFaceId half_face_of(DartId d) { return HalfFaceId{d.index() / 3}; }

std::vector<TetId> incident_tetrahedra(const MapRows& rows) {
  std::vector<TetId> incident(rows.point_of_vertex.size());
  for (std::size_t t = rows.corners.size(); t-- > 0;) {
    for (const VertexId v : rows.corners[t]) incident[v.index()] = TetId{t};
  }
  return incident;
}

// Debug builds hold what a change touched against the darts at once; `check` holds everything.
[[maybe_unused]] bool agree(const VolumeMap& map, TetId t) {
  if (map.darts().corners(t) != map.corners(t)) return false;
  for (int p = 0; p < 4; ++p) {
    if (map.darts().neighbour(half_face(t, p)) != map.neighbour(half_face(t, p))) return false;
  }
  return true;
}

}  // namespace

VolumeMap::VolumeMap(MapRows rows)
    : rows_(std::move(rows)),
      incident_(incident_tetrahedra(rows_)),
      darts_(std::make_unique<DartMap>(rows_)) {}

VolumeMap::VolumeMap(MapRows rows, std::vector<TetId> incident)
    : rows_(std::move(rows)),
      incident_(std::move(incident)),
      darts_(std::make_unique<DartMap>(rows_)) {}

VolumeMap::VolumeMap(const VolumeMap& other)
    : rows_(other.rows_), incident_(other.incident_), darts_(std::make_unique<DartMap>(rows_)) {}

VolumeMap& VolumeMap::operator=(const VolumeMap& other) { return *this = VolumeMap(other); }
VolumeMap::VolumeMap(VolumeMap&&) noexcept = default;
VolumeMap& VolumeMap::operator=(VolumeMap&&) noexcept = default;
VolumeMap::~VolumeMap() = default;

DartId VolumeMap::dart(HalfFaceId f, CornerId from) const {
  return dart_in(tetrahedron_of(f),
                 dart_order::dart_from(sunder::place_of(f), sunder::place_of(from)));
}

VertexId VolumeMap::vertex(DartId d) const {
  return corners(tetrahedron(d))[dart_order::origin(place_of(d))];
}

DartId VolumeMap::beta0(DartId d) const {
  return dart_in(tetrahedron(d), dart_order::beta0(place_of(d)));
}
DartId VolumeMap::beta1(DartId d) const {
  return dart_in(tetrahedron(d), dart_order::beta1(place_of(d)));
}
DartId VolumeMap::beta2(DartId d) const {
  return dart_in(tetrahedron(d), dart_order::beta2(place_of(d)));
}
bool VolumeMap::is_free(DartId d) const { return neighbour(half_face_of(d)).is_none(); }

DartId VolumeMap::beta3(DartId d) const {
  const HalfFaceId g = neighbour(half_face_of(d));
  SUNDER_ASSERT(!g.is_none(), "beta3 of a dart on the boundary");
  const int from = place_of_vertex(corners(tetrahedron_of(g)), vertex(beta1(d)));
  return dart_in(tetrahedron_of(g), dart_order::dart_from(sunder::place_of(g), from));
}

void VolumeMap::unsew(HalfFaceId face) {
  const HalfFaceId across = neighbour(face);
  SUNDER_ASSERT(!across.is_none(), "unsewing a boundary face");
  // A third of the time of a fan in a body of 384 000 tetrahedra (docs/kernel.md).
  darts_->prefetch(tetrahedron_of(face));
  darts_->prefetch(tetrahedron_of(across));
  darts_->unsew(face);
  rows_.neighbours[face.index() / 4][face.index() % 4] = HalfFaceId::none();
  rows_.neighbours[across.index() / 4][across.index() % 4] = HalfFaceId::none();
  SUNDER_ASSERT(agree(*this, tetrahedron_of(face)), "the darts are unsewn as the rows are");
  SUNDER_ASSERT(agree(*this, tetrahedron_of(across)), "the darts are unsewn as the rows are");
}

void VolumeMap::sew(DartId a, DartId b) {
  SUNDER_ASSERT(is_free(a) && is_free(b), "sewing a face that has two sides already");
  darts_->sew(darts_->dart_at(tetrahedron(a), place_of(a)),
              darts_->dart_at(tetrahedron(b), place_of(b)));
  const HalfFaceId f = half_face_of(a), g = half_face_of(b);
  rows_.neighbours[f.index() / 4][f.index() % 4] = g;
  rows_.neighbours[g.index() / 4][g.index() % 4] = f;
  SUNDER_ASSERT(agree(*this, tetrahedron(a)), "the darts are sewn as the rows are");
  SUNDER_ASSERT(agree(*this, tetrahedron(b)), "the darts are sewn as the rows are");
}

VertexId VolumeMap::split_vertex(const VertexSplit& split) {
  const VertexId added = darts_->split_vertex(split);
  for (const CornerId c : split.leaving) rows_.corners[c.index() / 4][c.index() % 4] = added;
  append_row(rows_.point_of_vertex, point_of_vertex(split.vertex));
  incident_[split.vertex.index()] = tetrahedron_of(split.staying[0]);
  append_row(incident_, tetrahedron_of(split.leaving[0]));
  for ([[maybe_unused]] const CornerId c : split.leaving) {
    SUNDER_ASSERT(agree(*this, tetrahedron_of(c)), "the darts have the new row");
  }
  for ([[maybe_unused]] const CornerId c : split.staying) {
    SUNDER_ASSERT(agree(*this, tetrahedron_of(c)), "the darts have the old row");
  }
  return added;
}

void VolumeMap::merge_vertices(VertexId kept, VertexId retired, std::span<const CornerId> corners) {
  darts_->merge_vertices(kept, retired, corners);
  for (const CornerId c : corners) rows_.corners[c.index() / 4][c.index() % 4] = kept;
  for ([[maybe_unused]] const CornerId c : corners) {
    SUNDER_ASSERT(agree(*this, tetrahedron_of(c)), "the darts have the kept row");
  }
  incident_[retired.index()] = TetId::none();
  while (!incident_.empty() && incident_.back().is_none()) {
    incident_.pop_back();
    rows_.point_of_vertex.pop_back();
  }
}

MapBytes VolumeMap::bytes() const {
  const auto held = [](const auto& v) {
    return v.capacity() * sizeof(typename std::decay_t<decltype(v)>::value_type);
  };
  MapBytes bytes = darts_->bytes();
  bytes.adjacency = held(rows_.corners) + held(rows_.neighbours) + held(rows_.reoriented);
  bytes.vertex_columns = held(rows_.points) + held(rows_.point_of_vertex) + held(incident_);
  return bytes;
}

}  // namespace sunder
