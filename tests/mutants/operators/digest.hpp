// SPDX-License-Identifier: MIT
// One number for all that topology/{kernel,cells,mesh} can answer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "topology/cells/subdivide.hpp"
#include "topology/kernel/components.hpp"
#include "topology/kernel/counts.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/kernel/volume_map.hpp"
#include "topology/mesh/check.hpp"
#include "topology/mesh/crack.hpp"
#include "topology/mesh/file_mesh.hpp"
#include "topology/mesh/kinds/split_cells.hpp"
#include "topology/mesh/surface/surface_check.hpp"

namespace sunder::test {

/// FNV-1a over all that it is given.
struct Digest {
  std::uint64_t value = 0xcbf29ce484222325U;

  void bytes(const void* data, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      value = (value ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3U;
    }
  }
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(T number) { bytes(&number, sizeof number); }
  template <class Tag>
  void add(Id<Tag> id) {
    add(id.value);
  }
  void add(const std::string& text) {
    add(text.size());
    bytes(text.data(), text.size());
  }
  template <class A, class B>
  void add(const std::pair<A, B>& both) {
    add(both.first), add(both.second);
  }
  template <class... V>
  void add(const std::variant<V...>& any) {
    std::visit([this](const auto& held) { add(held); }, any);
  }
  template <class T>
  void add(const std::optional<T>& held) {
    add(held.has_value());
    if (held) add(*held);
  }
  template <class Range>
  requires requires(const Range& r) { r.begin(), r.size(); }
  void add(const Range& range) {
    add(range.size());
    for (const auto& one : range) add(one);
  }
  void add(const Finding& f) { all(f.code, f.severity, f.count, f.ids, f.text, f.remedy, f.line); }
  void add(const VertexCopy& c) { all(c.old_row, c.new_row); }
  void add(const FaceSplit& s) {
    all(s.did, s.face, s.opposite, s.vertex_count, s.split_edges, s.visited);
    if (s.did) add(s.vertices);
    for (int i = 0; i < s.vertex_count; ++i) add(s.split_vertices[static_cast<std::size_t>(i)]);
  }
  void add(const FaceGlue& g) {
    all(g.refusal, g.vertex_count);
    for (int i = 0; i < g.vertex_count; ++i) add(g.merged[static_cast<std::size_t>(i)]);
  }
  void add(const Components& c) { all(c.of_tetrahedron, c.of_vertex, c.size, c.parent); }
  void add(const Counts& c) {
    all(c.vertices, c.edges, c.faces, c.tetrahedra, c.components, c.boundary_faces,
        c.boundary_sheets, c.euler_characteristic, c.betti, c.volume);
  }
  void add(const TetMesh& m) {
    all(m.points, m.tetrahedra, m.region, m.region_name, m.source_point_id,
        m.source_tetrahedron_id);
  }
  void add(const DataColumn& c) { all(c.name, c.components, c.type, c.values); }
  template <std::size_t N>
  void add(const CellList<N>& c) {
    all(c.corners, c.region, c.entity, c.source_id, c.data);
  }
  void add(const OtherCells& c) { all(c.points, c.ends, c.region, c.entity, c.source_id, c.data); }
  void add(const FileMesh& m) {
    all(m.points, m.source_point_id, m.point_region, m.point_data, m.vertices, m.edges, m.triangles,
        m.tetrahedra, m.region_name);
    for (const OtherCells& cells : m.others) {
      if (!cells.points.empty()) add(cells);
    }
  }
  void add(const CellColumns& c) { all(c.region, c.entity, c.source_id, c.data); }
  void add(const BoundingBox& b) { all(b.low, b.high); }
  void add(const Extent& e) { all(e.box, e.centre); }
  void add(const SurfaceCheck& c) {
    all(c.findings, c.triangles, c.quadrilaterals, c.polygons, c.vertices, c.edges,
        c.boundary_edges, c.components, c.euler_characteristic, c.is_closed, c.is_manifold,
        c.is_oriented, c.crosses_itself, c.area, c.volume, c.extent);
  }
  void add(const SplitCells& s) {
    all(s.cut, s.triangles, s.tetrahedra, s.empty_parts, s.concave_volumes, s.concave_faces,
        s.bent_polygons, s.numbers_added);
  }
  void add(const FindingPlaces& p) { all(p.code, p.kind, p.rows); }
  void add(const Quality::Extreme& e) { all(e.value, e.tetrahedron); }
  void add(const Quality& q) {
    all(q.smallest_dihedral, q.largest_dihedral, q.smallest_radius_ratio, q.mean_radius_ratio,
        q.smallest_volume, q.largest_volume, q.shortest_edge, q.longest_edge);
  }
  void add(const MeshCheck& c) { all(c.findings, c.places, c.counts, c.quality); }
  void add(const CrackFace& f) { all(f.tetrahedra, f.points); }
  void add(const Crack& c) { all(c.copies, c.faces, c.closed_faces, c.triangles_on_it); }
  void add(const MiddleVertex& m) { all(m.vertex, m.ends, m.weight); }
  void add(const ChildCell& c) { all(c.tetrahedron, c.parent, c.share, c.face); }
  void add(const CellChange::Cell& c) { all(c.row, c.corners, c.neighbours); }
  void add(const CellChange::Begin& b) { all(b.vertex, b.tetrahedron); }
  void add(const CellChange& c) {
    all(c.kept_points, c.kept_vertices, c.kept_tetrahedra, c.points, c.vertices, c.cells, c.begins);
  }
  void add(const CellEdit& e) { all(e.vertices, e.cells, e.undo); }
  void add(const VolumeMap& m) {
    all(m.corners(), m.neighbours(), m.point_of_vertex(), m.points(), m.reoriented(),
        m.dense().incident_tetrahedra());
  }
  template <class T>
  void add(const Result<T>& r) {
    all(r.value, r.findings);
  }
  template <class... T>
  void all(const T&... parts) {
    (add(parts), ...);
  }
};

}  // namespace sunder::test
