// SPDX-License-Identifier: MIT
// OpenVolumeMesh as a kernel under judgement. It has no sewing: two cells are neighbours because
// they hold the two halves of one face, and vertices, edges and faces are entities of their own.
// Splitting and gluing are made here of its set_cell, set_face and set_edge; whether two cells
// still meet round a vertex or an edge is asked of its incidences, and the numbers of cells are its
// own.
#include <OpenVolumeMesh/Mesh/TetrahedralMeshTopologyKernel.hh>

#include <set>

#include "serve.hpp"

namespace {

using namespace adapter;
namespace ovm = OpenVolumeMesh;
using Mesh = ovm::TetrahedralMeshTopologyKernel;
using ovm::CellHandle, ovm::EdgeHandle, ovm::FaceHandle, ovm::HalfEdgeHandle, ovm::HalfFaceHandle,
    ovm::VertexHandle;

class Kernel {
 public:
  std::string load(const Body& body) {
    body_ = body;
    mesh_ = Mesh();
    mesh_.enable_deferred_deletion(true);  // so that handles stay as they are
    point_.clear();
    const auto common = common_faces(body);
    for (const Tetrahedron& corners : alike(body, common)) {
      std::vector<VertexHandle> v;
      for (const std::uint32_t p : corners) v.push_back(add_vertex(p));
      mesh_.add_cell(v);
    }
    for (const auto& [a, b] : common) glue(a, b);
    return "";
  }

  std::optional<Parted> split(Side side) {
    const CellHandle a(static_cast<int>(side.tetrahedron));
    const HalfFaceHandle here = half_face(side), there = mesh_.opposite_halfface_handle(here);
    const CellHandle b = mesh_.incident_cell(there);
    if (!b.is_valid()) return std::nullopt;
    const std::vector<HalfEdgeHandle> rim = mesh_.halfface(there).halfedges();
    replace(b, there, mesh_.halfface_handle(mesh_.add_face(rim), 0));
    Parted parted;
    for (const HalfEdgeHandle h : rim) {
      const EdgeHandle e = mesh_.edge_handle(h);
      if (const auto part = parted_at(a, b, [&](HalfFaceHandle f) { return has(f, e); })) {
        parted.edges.push_back(
            {point_of(mesh_.from_vertex_handle(h)), point_of(mesh_.to_vertex_handle(h))});
        move_to_new_edge(e, *part);
      }
    }
    for (const HalfEdgeHandle h : rim) {
      // An edge of the rim may have been replaced: its vertices are still the old ones.
      const VertexHandle v = mesh_.from_vertex_handle(h);
      if (const auto part = parted_at(a, b, [&](HalfFaceHandle f) { return has(f, v); })) {
        parted.vertices.push_back(point_of(v));
        move_to_new_vertex(v, *part);
      }
    }
    parted.separated = !search_.connected(
        side.tetrahedron, static_cast<std::uint32_t>(b.idx()), body_.tetrahedra.size(),
        [this](std::uint32_t t, const auto& visit) {
          for (const HalfFaceHandle f : mesh_.cell(CellHandle(static_cast<int>(t))).halffaces()) {
            const CellHandle c = across(f);
            if (c.is_valid()) visit(static_cast<std::uint32_t>(c.idx()));
          }
        });
    return parted;
  }

  bool glue(Side a, Side b) {
    const HalfFaceHandle f = half_face(a), g = half_face(b);
    if (f == g || across(f).is_valid() || across(g).is_valid()) return false;
    if (!join_edges(f, g)) return false;
    replace(CellHandle(static_cast<int>(b.tetrahedron)), g, mesh_.opposite_halfface_handle(f));
    mesh_.delete_face(mesh_.face_handle(g));
    return true;
  }

  Counts counts() {
    std::size_t boundary = 0;
    for (const FaceHandle f : mesh_.faces()) boundary += mesh_.is_boundary(f) ? 1 : 0;
    const auto of = components();
    const std::size_t components = std::set<std::uint32_t>(of.begin(), of.end()).size();
    return {mesh_.n_logical_vertices(),
            mesh_.n_logical_edges(),
            mesh_.n_logical_faces(),
            mesh_.n_logical_cells(),
            components,
            boundary,
            sheets()};
  }

  std::vector<std::uint32_t> vertices() {
    std::vector<std::uint32_t> of;
    for (std::size_t t = 0; t < body_.tetrahedra.size(); ++t) {
      const std::vector<VertexHandle> cell =
          mesh_.get_cell_vertices(CellHandle(static_cast<int>(t)));
      for (const std::uint32_t p : body_.tetrahedra[t]) {
        const auto at = std::find_if(cell.begin(), cell.end(),
                                     [&](VertexHandle v) { return point_of(v) == p; });
        of.push_back(at == cell.end() ? 0xffffffffU : static_cast<std::uint32_t>(at->idx()));
      }
    }
    return of;
  }

  std::vector<std::uint32_t> components() {
    constexpr std::uint32_t none = 0xffffffffU;
    std::vector<std::uint32_t> of(body_.tetrahedra.size(), none);
    std::vector<CellHandle> stack;
    for (const CellHandle seed : mesh_.cells()) {
      if (of[seed.idx()] != none) continue;
      of[seed.idx()] = static_cast<std::uint32_t>(seed.idx());
      stack.assign(1, seed);
      while (!stack.empty()) {
        const CellHandle c = stack.back();
        stack.pop_back();
        for (auto next = mesh_.cc_iter(c); next.valid(); ++next) {
          if (of[next->idx()] != none) continue;
          of[next->idx()] = static_cast<std::uint32_t>(seed.idx());
          stack.push_back(*next);
        }
      }
    }
    return of;
  }

 private:
  VertexHandle add_vertex(std::uint32_t point) {
    point_.push_back(point);
    return mesh_.add_vertex();
  }
  std::uint32_t point_of(VertexHandle v) const { return point_[static_cast<std::size_t>(v.idx())]; }

  CellHandle across(HalfFaceHandle f) const {
    return mesh_.incident_cell(mesh_.opposite_halfface_handle(f));
  }
  bool has(HalfFaceHandle f, EdgeHandle e) const {
    const auto& rim = mesh_.face(mesh_.face_handle(f)).halfedges();
    return std::any_of(rim.begin(), rim.end(),
                       [&](HalfEdgeHandle h) { return mesh_.edge_handle(h) == e; });
  }
  bool has(HalfFaceHandle f, VertexHandle v) const {
    const auto& rim = mesh_.face(mesh_.face_handle(f)).halfedges();
    return std::any_of(rim.begin(), rim.end(), [&](HalfEdgeHandle h) {
      return mesh_.from_vertex_handle(h) == v || mesh_.to_vertex_handle(h) == v;
    });
  }
  bool has_point(HalfFaceHandle f, std::uint32_t p) const {
    for (const HalfEdgeHandle h : mesh_.halfface(f).halfedges()) {
      if (point_of(mesh_.from_vertex_handle(h)) == p) return true;
    }
    return false;
  }
  /// The half-face of the tetrahedron without a vertex of that point.
  HalfFaceHandle half_face(Side side) const {
    const auto& faces = mesh_.cell(CellHandle(static_cast<int>(side.tetrahedron))).halffaces();
    for (const HalfFaceHandle f : faces) {
      if (!has_point(f, side.opposite)) return f;
    }
    return faces.front();
  }

  void replace(CellHandle c, HalfFaceHandle old, HalfFaceHandle fresh) {
    std::vector<HalfFaceHandle> faces = mesh_.cell(c).halffaces();
    std::replace(faces.begin(), faces.end(), old, fresh);
    mesh_.set_cell(c, faces);
  }

  /// A search from a and from b in turn through faces that `through` lets pass: nothing when they
  /// meet, else the cells of the side that came to its end first.
  template <class Through>
  std::optional<std::vector<CellHandle>> parted_at(CellHandle a, CellHandle b,
                                                   const Through& through) const {
    std::array<std::vector<CellHandle>, 2> found = {{{a}, {b}}};
    std::array<std::size_t, 2> at = {0, 0};
    const auto is_in = [](const std::vector<CellHandle>& list, CellHandle c) {
      return std::find(list.begin(), list.end(), c) != list.end();
    };
    for (int side = 0; at[side] < found[side].size(); side = 1 - side) {
      for (const HalfFaceHandle f : mesh_.cell(found[side][at[side]++]).halffaces()) {
        const CellHandle c = across(f);
        if (!c.is_valid() || !through(f) || is_in(found[side], c)) continue;
        if (is_in(found[1 - side], c)) return std::nullopt;
        found[side].push_back(c);
      }
    }
    return found[at[0] == found[0].size() ? 0 : 1];
  }

  std::set<FaceHandle> faces_of(const std::vector<CellHandle>& cells) const {
    std::set<FaceHandle> faces;
    for (const CellHandle c : cells) {
      for (const HalfFaceHandle f : mesh_.cell(c).halffaces()) faces.insert(mesh_.face_handle(f));
    }
    return faces;
  }

  /// In the rim of a face, one edge for another that runs the same way.
  void replace(FaceHandle f, EdgeHandle old, EdgeHandle fresh, bool turned = false) {
    std::vector<HalfEdgeHandle> rim = mesh_.face(f).halfedges();
    for (HalfEdgeHandle& h : rim) {
      if (mesh_.edge_handle(h) != old) continue;
      const bool second = h == mesh_.halfedge_handle(old, 1);
      h = mesh_.halfedge_handle(fresh, second != turned ? 1 : 0);
    }
    mesh_.set_face(f, rim);
  }

  void move_to_new_edge(EdgeHandle e, const std::vector<CellHandle>& part) {
    const EdgeHandle fresh =
        mesh_.add_edge(mesh_.edge(e).from_vertex(), mesh_.edge(e).to_vertex(), true);
    for (const FaceHandle f : faces_of(part)) {
      if (has(mesh_.halfface_handle(f, 0), e)) replace(f, e, fresh);
    }
  }

  void move_to_new_vertex(VertexHandle v, const std::vector<CellHandle>& part) {
    const VertexHandle fresh = add_vertex(point_of(v));
    std::set<EdgeHandle> edges;
    for (const FaceHandle f : faces_of(part)) {
      for (const HalfEdgeHandle h : mesh_.face(f).halfedges()) edges.insert(mesh_.edge_handle(h));
    }
    for (const EdgeHandle e : edges) replace(e, v, fresh);
  }

  void replace(EdgeHandle e, VertexHandle old, VertexHandle fresh) {
    const VertexHandle from = mesh_.edge(e).from_vertex(), to = mesh_.edge(e).to_vertex();
    if (from != old && to != old) return;
    mesh_.set_edge(e, from == old ? fresh : from, to == old ? fresh : to);
  }

  /// Makes the edges and vertices of g those of f, which has the same points the other way round;
  /// false when it has not.
  bool join_edges(HalfFaceHandle f, HalfFaceHandle g) {
    const std::vector<HalfEdgeHandle> to = mesh_.halfface(f).halfedges();
    std::vector<HalfEdgeHandle> from;
    const std::vector<HalfEdgeHandle> rim = mesh_.halfface(g).halfedges();
    for (const HalfEdgeHandle h : to) {
      for (const HalfEdgeHandle k : rim) {
        if (point_of(mesh_.from_vertex_handle(h)) == point_of(mesh_.to_vertex_handle(k)) &&
            point_of(mesh_.to_vertex_handle(h)) == point_of(mesh_.from_vertex_handle(k))) {
          from.push_back(k);
        }
      }
    }
    if (from.size() != 3) return false;
    std::array<std::array<VertexHandle, 2>, 3> vertices;  // that of f and that of g
    for (std::size_t i = 0; i < 3; ++i) {
      vertices[i] = {mesh_.from_vertex_handle(to[i]), mesh_.to_vertex_handle(from[i])};
    }
    for (std::size_t i = 0; i < 3; ++i) join_edge(to[i], mesh_.opposite_halfedge_handle(from[i]));
    for (const auto& [v, w] : vertices) join_vertex(v, w);
    return true;
  }

  /// Puts half-edge h in the place of k everywhere.
  void join_edge(HalfEdgeHandle h, HalfEdgeHandle k) {
    const EdgeHandle e = mesh_.edge_handle(h), gone = mesh_.edge_handle(k);
    if (e == gone) return;
    const bool turned = (h.idx() & 1) != (k.idx() & 1);
    std::set<FaceHandle> faces;
    for (auto f = mesh_.ef_iter(gone); f.valid(); ++f) faces.insert(*f);
    for (const FaceHandle f : faces) replace(f, gone, e, turned);
    mesh_.delete_edge(gone);
  }

  void join_vertex(VertexHandle v, VertexHandle gone) {
    if (v == gone) return;
    std::set<EdgeHandle> edges;
    for (auto e = mesh_.ve_iter(gone); e.valid(); ++e) edges.insert(*e);
    for (const EdgeHandle e : edges) replace(e, gone, v);
    mesh_.delete_vertex(gone);
  }

  /// Boundary faces joined across edges.
  std::size_t sheets() {
    std::set<FaceHandle> left;
    for (const FaceHandle f : mesh_.faces()) {
      if (mesh_.is_boundary(f)) left.insert(f);
    }
    std::size_t found = 0;
    std::vector<FaceHandle> stack;
    while (!left.empty()) {
      ++found;
      stack.assign(1, *left.begin());
      left.erase(left.begin());
      while (!stack.empty()) {
        const FaceHandle f = stack.back();
        stack.pop_back();
        for (const HalfEdgeHandle h : mesh_.face(f).halfedges()) {
          for (auto next = mesh_.ef_iter(mesh_.edge_handle(h)); next.valid(); ++next) {
            if (left.erase(*next) > 0) stack.push_back(*next);
          }
        }
      }
    }
    return found;
  }

  Body body_;
  Mesh mesh_;
  std::vector<std::uint32_t> point_;  // of each vertex; copies inherit it
  Search search_;
};

}  // namespace

int main() { return serve(Kernel(), "openvolumemesh"); }
