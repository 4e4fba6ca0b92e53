// SPDX-License-Identifier: MIT
// Darts of a map: making them, walking them, and giving their vertices new rows.
#include "topology/kernel/dart_map.hpp"

#include <algorithm>

#include "topology/base/append_row.hpp"
#include "topology/base/assert.hpp"
#include "topology/base/sort_unique.hpp"

namespace sunder {
namespace {

// The number of reserved darts in one go matters: CGAL's containers otherwise grow block by block.
void reserve(DartComplex& complex, std::size_t tetrahedra, std::size_t vertices) {
  complex.darts().reserve(12 * tetrahedra);
  complex.attributes<0>().reserve(vertices);
  complex.attributes<3>().reserve(tetrahedra);
}

constexpr std::array<int, 4> some_dart_from = {3, 0, 1, 2};

DartComplex::Point to_cgal(const Point& p) { return {p[0], p[1], p[2]}; }

}  // namespace

DartMap::DartMap(const MapRows& rows) : corner_(rows.point_of_vertex.size()) {
  complex_.set_automatic_attributes_management(false);
  for (std::size_t t = rows.corners.size(); t-- > 0;) {
    for (int i = 0; i < 4; ++i) corner_[rows.corners[t][i].index()] = corner(TetId{t}, i);
  }
  // A copy of a map may bring retired rows: they have no corner and get no attribute.
  const auto used = static_cast<std::size_t>(
      std::count_if(corner_.begin(), corner_.end(), [](CornerId c) { return !c.is_none(); }));
  reserve(complex_, rows.corners.size(), used);
  std::vector<VertexAttributeDescriptor> attributes(corner_.size());
  for (std::size_t v = 0; v < corner_.size(); ++v) {
    if (corner_[v].is_none()) continue;
    const std::uint32_t point = rows.point_of_vertex[v];
    attributes[v] =
        complex_.create_attribute<0>(to_cgal(rows.points[point]), VertexInfo{VertexId{v}, point});
  }
  first_dart_.reserve(rows.corners.size());
  for (std::size_t t = 0; t < rows.corners.size(); ++t) {
    std::array<VertexAttributeDescriptor, 4> at;
    for (int i = 0; i < 4; ++i) at[i] = attributes[rows.corners[t][i].index()];
    add_tetrahedron(TetId{t}, at);
  }
  for (std::size_t t = 0; t < rows.corners.size(); ++t) {
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId g = rows.neighbours[t][p];
      const HalfFaceId f = half_face(TetId{t}, p);
      if (g.is_none() || g < f) continue;
      const int k = 3 * p;
      const VertexId target = rows.corners[t][dart_order::target(k)];
      const TetId u = tetrahedron_of(g);
      const int from = place_of_vertex(rows.corners[u.index()], target);
      sew(dart_at(TetId{t}, k), dart_at(u, dart_order::dart_from(place_of(g), from)));
    }
  }
}

void DartMap::add_tetrahedron(TetId t, const std::array<VertexAttributeDescriptor, 4>& corners) {
  const auto volume = complex_.create_attribute<3>(t);
  std::array<Dart, 12> d;
  for (int k = 0; k < 12; ++k) {
    d[k] = complex_.create_dart(DartId{12 * t.index() + static_cast<std::size_t>(k)});
    complex_.set_dart_attribute<0>(d[k], corners[dart_order::origin(k)]);
    complex_.set_dart_attribute<3>(d[k], volume);
  }
  for (int k = 0; k < 12; ++k) {
    complex_.basic_link_beta_1(d[k], d[dart_order::beta1(k)]);
    const int across = dart_order::beta2(k);
    if (k < across) complex_.basic_link_beta_for_involution<2>(d[k], d[across]);
  }
  first_dart_.push_back(d[0]);
}

// Dart 0 runs from corner 1 to corner 2 of face 0. Beta2 of darts 1, 2, 0 are the middle darts
// (j = 1) of faces 1, 2, 3, so every dart is at most three steps away.
DartMap::Dart DartMap::dart_at(TetId t, int k) const {
  const Dart d0 = first_dart_[t.index()];
  const int p = k / 3, j = k % 3;
  if (p == 0) return j == 0 ? d0 : j == 1 ? beta1(d0) : beta0(d0);
  const Dart middle = beta2(p == 1 ? beta1(d0) : p == 2 ? beta0(d0) : d0);
  return j == 1 ? middle : j == 0 ? beta0(middle) : beta1(middle);
}

std::array<VertexId, 4> DartMap::corners(TetId t) const {
  return {vertex(dart_at(t, 3)), vertex(dart_at(t, 0)), vertex(dart_at(t, 1)),
          vertex(dart_at(t, 2))};
}

HalfFaceId DartMap::neighbour(HalfFaceId f) const {
  const Dart d = dart_at(tetrahedron_of(f), 3 * place_of(f));
  if (is_free(d)) return HalfFaceId::none();
  return HalfFaceId{id(beta3(d)).index() / 3};
}

TetId DartMap::incident_tetrahedron(VertexId v) const {
  const CornerId c = corner_[v.index()];
  return c.is_none() ? TetId::none() : tetrahedron_of(c);
}

Point DartMap::point(VertexId v) const {
  if (corner_[v.index()].is_none()) return {};
  const VertexAttributeDescriptor a = attribute_of(v);
  return {a->point().x(), a->point().y(), a->point().z()};
}

std::uint32_t DartMap::point_of_vertex(VertexId v) const {
  return complex_.info_of_attribute<0>(attribute_of(v)).point;
}

void DartMap::prefetch(TetId t) const {
  // They lie one after the other, but for the few that begin a new block of CGAL's container.
  const auto* const at = reinterpret_cast<const char*>(&*first_dart_[t.index()]);
  for (std::size_t i = 0; i < 12; ++i) __builtin_prefetch(at + i * sizeof(DartComplex::Dart), 1);
}

DartMap::Dart DartMap::dart(HalfFaceId f, CornerId from) const {
  return dart_at(tetrahedron_of(f), dart_order::dart_from(place_of(f), place_of(from)));
}

DartMap::Dart DartMap::dart(VertexId v) const {
  const CornerId c = corner_[v.index()];
  return dart_at(tetrahedron_of(c), some_dart_from[place_of(c)]);
}

DartMap::Dart DartMap::dart(ConstDart d) const {
  // CGAL gives back const handles from a const complex; the same darts, hence the casts.
  return const_cast<DartComplex&>(complex_).darts().iterator_to(const_cast<DartComplex::Dart&>(*d));
}

CornerId DartMap::corner_of(Dart d) const {
  const DartId row = id(d);
  return corner(TetId{row.index() / 12}, dart_order::origin(static_cast<int>(row.index() % 12)));
}

void DartMap::unsew(HalfFaceId face) {
  Dart d = dart_at(tetrahedron_of(face), 3 * place_of(face));
  // By hand: CGAL's topo_unsew<3> asserts nothing in release, and its iterator over the involution
  // costs more than the three links.
  for (int j = 0; j < 3; ++j, d = beta1(d)) complex_.unlink_beta<3>(d);
}

void DartMap::sew(Dart a, Dart b) {
  for (int j = 0; j < 3; ++j, a = beta1(a), b = beta0(b)) {
    complex_.basic_link_beta_for_involution<3>(a, b);
  }
}

VertexAttributeDescriptor DartMap::attribute_of(VertexId v) const {
  return const_cast<DartComplex&>(complex_).attribute<0>(dart(v));
}

void DartMap::rename(CornerId c, VertexAttributeDescriptor to) {
  Dart d = dart_at(tetrahedron_of(c), some_dart_from[place_of(c)]);
  for (int j = 0; j < 3; ++j, d = beta2(beta0(d))) complex_.set_dart_attribute<0>(d, to);
}

VertexId DartMap::split_vertex(const VertexSplit& split) {
  const VertexId added{corner_.size()};
  const VertexAttributeDescriptor old = attribute_of(split.vertex);
  const std::uint32_t point = complex_.info_of_attribute<0>(old).point;
  const VertexAttributeDescriptor fresh =
      complex_.create_attribute<0>(old->point(), VertexInfo{added, point});
  // The attribute that the many darts hold stays with them, whichever row they are to have.
  const bool rename_staying = split.staying.size() < split.leaving.size();
  const auto few = rename_staying ? split.staying : split.leaving;
  const auto many = rename_staying ? split.leaving : split.staying;
  for (const CornerId c : few) rename(c, fresh);
  const int k = dart_order::dart_from((place_of(many[0]) + 1) % 4, place_of(many[0]));
  complex_.set_dart_of_attribute<0>(old, dart_at(tetrahedron_of(many[0]), k));
  if (rename_staying) {
    complex_.info_of_attribute<0>(fresh).row = split.vertex;
    complex_.info_of_attribute<0>(old).row = added;
  }
  corner_[split.vertex.index()] = split.staying[0];
  append_row(corner_, split.leaving[0]);
  return added;
}

void DartMap::merge_vertices(VertexId kept, VertexId retired, std::span<const CornerId> corners) {
  const VertexAttributeDescriptor to = attribute_of(kept), gone = attribute_of(retired);
  for (const CornerId c : corners) rename(c, to);
  complex_.erase_attribute<0>(gone);
  corner_[retired.index()] = CornerId::none();
  while (!corner_.empty() && corner_.back().is_none()) corner_.pop_back();
}

void DartMap::remove_tetrahedron(TetId t) {
  const auto volume = complex_.attribute<3>(first_dart_[t.index()]);
  std::array<Dart, 12> darts;
  for (int k = 0; k < 12; ++k) darts[k] = dart_at(t, k);
  for (const Dart d : darts) complex_.erase_dart(d);
  complex_.erase_attribute<3>(volume);
}

void DartMap::apply(const CellChange& change, const MapRows& rows) {
  // Attributes by rows, before the corners change that lead to them.
  std::vector<VertexId> used;
  for (const CellChange::Cell& cell : change.cells) {
    used.insert(used.end(), cell.corners.begin(), cell.corners.end());
  }
  for (std::size_t v = change.kept_vertices; v < corner_.size(); ++v) used.emplace_back(v);
  sort_unique(used);
  std::vector<VertexAttributeDescriptor> attributes(used.size());
  std::vector<VertexAttributeDescriptor> dropped;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const std::size_t v = used[i].index();
    const bool is_there = v < corner_.size() && !corner_[v].is_none();
    if (is_there && v < change.kept_vertices) {
      attributes[i] = attribute_of(used[i]);
      continue;
    }
    if (is_there) dropped.push_back(attribute_of(used[i]));
    if (v >= rows.point_of_vertex.size()) continue;  // it goes and nothing comes in its place
    const std::uint32_t point = rows.point_of_vertex[v];
    attributes[i] =
        complex_.create_attribute<0>(to_cgal(rows.points[point]), VertexInfo{used[i], point});
  }
  for (const CellChange::Begin& begin : change.begins) {
    const VertexId v = begin.vertex;
    if (!begin.tetrahedron.is_none() || v.index() >= change.kept_vertices) continue;
    dropped.push_back(attribute_of(v));
    corner_[v.index()] = CornerId::none();
  }
  const auto attribute = [&](VertexId v) {
    return attributes[static_cast<std::size_t>(std::ranges::lower_bound(used, v) - used.begin())];
  };

  const auto open = [&](TetId t) {
    for (int p = 0; p < 4; ++p) {
      if (!is_free(dart_at(t, 3 * p))) unsew(half_face(t, p));
    }
  };
  for (const CellChange::Cell& cell : change.cells) {
    if (cell.row.index() < change.kept_tetrahedra) open(cell.row);
  }
  for (std::size_t t = change.kept_tetrahedra; t < first_dart_.size(); ++t) {
    remove_tetrahedron(TetId{t});
  }
  first_dart_.resize(change.kept_tetrahedra);
  corner_.resize(rows.point_of_vertex.size());
  for (const auto& [row, corners, neighbours] : change.cells) {
    if (row.index() == first_dart_.size()) {
      add_tetrahedron(row, {attribute(corners[0]), attribute(corners[1]), attribute(corners[2]),
                            attribute(corners[3])});
    }
    for (int i = 0; i < 4; ++i) {
      const CornerId c = corner(row, i);
      const VertexAttributeDescriptor at = attribute(corners[i]);
      rename(c, at);
      complex_.set_dart_of_attribute<0>(at, dart_at(row, some_dart_from[i]));
      corner_[corners[i].index()] = c;
    }
  }
  for (const VertexAttributeDescriptor gone : dropped) complex_.erase_attribute<0>(gone);
  for (const auto& [row, corners, neighbours] : change.cells) {
    for (int p = 0; p < 4; ++p) {
      const Dart d = dart_at(row, 3 * p);
      if (neighbours[p].is_none() || !is_free(d)) continue;
      const TetId u = tetrahedron_of(neighbours[p]);
      const int from = place_of_vertex(rows.corners[u.index()], vertex(beta1(d)));
      sew(d, dart_at(u, dart_order::dart_from(place_of(neighbours[p]), from)));
    }
  }
}

MapBytes DartMap::bytes() const {
  const auto held = [](const auto& container) {
    return container.capacity() * sizeof(typename std::decay_t<decltype(container)>::value_type);
  };
  MapBytes bytes;
  bytes.darts = held(complex_.darts());
  bytes.attributes = held(complex_.attributes<0>()) + held(complex_.attributes<3>());
  bytes.handles = held(first_dart_) + held(corner_);
  return bytes;
}

}  // namespace sunder
