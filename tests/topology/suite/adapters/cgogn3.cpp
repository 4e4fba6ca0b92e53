// SPDX-License-Identifier: MIT
// CGoGN_3's CMap3 as a kernel under judgement. It has no unsewing of volumes: the boundary is
// mended here, by the six links that differ, and everything else is CGoGN's. Its orbits give the
// separated cells, and its traversals over the indices it keeps count the cells.
// CGoGN's headers need this order.
// clang-format off
#include <cgogn/core/types/maps/cmap/cmap3.h>
#include <cgogn/core/types/cell_marker.h>
#include <cgogn/core/functions/attributes.h>
#include <cgogn/core/functions/mesh_info.h>
// clang-format on

#include <memory>

#include "serve.hpp"

namespace {

using namespace adapter;
using Map = cgogn::CMap3;
using cgogn::Dart;

class Kernel {
 public:
  std::string load(const Body& body) {
    body_ = body;
    map_ = std::make_unique<Map>();
    base_.clear();
    point_.clear();
    const auto common = common_faces(body);
    for (const Tetrahedron& corners : alike(body, common)) add(corners);
    for (const auto& [a, b] : common) {
      const Dart d = face(a), e = partner(d, face(b));
      if (!e.is_nil()) sew(d, e);
    }
    close(*map_, false);
    cgogn::index_cells<Map::Vertex>(*map_);
    cgogn::index_cells<Map::Edge>(*map_);
    return "";
  }

  std::optional<Parted> split(Side side) {
    Map& m = *map_;
    const Dart d = face(side);
    if (is_incident_to_boundary(m, Map::Face(d))) return std::nullopt;
    const Dart e = phi3(m, d);
    const std::uint32_t u = row(e);
    unsew(d);
    Parted parted;
    Dart a = d, b = phi1(m, e);  // both start at the same point
    for (int i = 0; i < 3; ++i, a = phi1(m, a), b = phi_1(m, b)) {
      if (part(Map::Vertex(a), Map::Vertex(b))) parted.vertices.push_back(point(a));
      if (part(Map::Edge(a), Map::Edge(phi_1(m, b)))) {
        parted.edges.push_back({point(a), point(phi1(m, a))});
      }
    }
    parted.separated = !search_.connected(side.tetrahedron, u, base_.size(),
                                          [&](std::uint32_t t, const auto& visit) {
                                            for (const Dart f : faces(base_[t])) {
                                              const Dart across = phi3(m, f);
                                              if (!is_boundary(m, across)) visit(row(across));
                                            }
                                          });
    return parted;
  }

  bool glue(Side a, Side b) {
    Map& m = *map_;
    const Dart d = face(a), f = face(b);
    if (d == f || !is_incident_to_boundary(m, Map::Face(d)) ||
        !is_incident_to_boundary(m, Map::Face(f))) {
      return false;
    }
    const Dart e = partner(d, f);
    if (e.is_nil()) return false;
    open(d, e);
    sew(d, e);
    Dart x = d;
    for (int i = 0; i < 3; ++i, x = phi1(m, x)) {
      cgogn::set_index(m, Map::Vertex(x), cgogn::index_of(m, Map::Vertex(x)));
      cgogn::set_index(m, Map::Edge(x), cgogn::index_of(m, Map::Edge(x)));
    }
    return true;
  }

  Counts counts() {
    const Map& m = *map_;
    std::size_t boundary = 0;
    foreach_cell(m, [&](Map::Face f) -> bool {
      boundary += is_incident_to_boundary(m, f) ? 1 : 0;
      return true;
    });
    return {cgogn::nb_cells<Map::Vertex>(m),
            cgogn::nb_cells<Map::Edge>(m),
            cgogn::nb_cells<Map::Face>(m),
            cgogn::nb_cells<Map::Volume>(m),
            number_components().second,
            boundary,
            sheets()};
  }

  std::vector<std::uint32_t> vertices() {
    std::vector<std::uint32_t> of(4 * base_.size());
    for (std::size_t t = 0; t < base_.size(); ++t) {
      for (const Dart f : faces(base_[t])) {
        const Dart top = apex(f);
        of[4 * t + place_of(body_.tetrahedra[t], point(top))] =
            cgogn::index_of(*map_, Map::Vertex(top));
      }
    }
    return of;
  }

  std::vector<std::uint32_t> components() { return number_components().first; }

 private:
  void set(Dart d, std::uint32_t point, std::uint32_t row) {
    if (point_.size() <= d.index_) point_.resize(d.index_ + 1);
    point_[d.index_] = {point, row};
  }
  std::uint32_t point(Dart d) const { return point_[d.index_][0]; }
  std::uint32_t row(Dart d) const { return point_[d.index_][1]; }

  void add(const Tetrahedron& corners) {
    Map& m = *map_;
    const auto t = static_cast<std::uint32_t>(base_.size());
    Dart d = cgogn::add_pyramid(static_cast<cgogn::CMap2&>(m), 3, false).dart_;
    base_.push_back(d);
    for (std::size_t i = 0; i < 3; ++i, d = phi1(m, d)) {
      const Dart s = phi2(m, d);
      set(d, corners[i], t);
      set(s, corners[(i + 1) % 3], t);
      set(phi1(m, s), corners[i], t);
      set(phi_1(m, s), corners[3], t);
    }
  }

  /// A dart of each face of a tetrahedron, the first that of d.
  std::array<Dart, 4> faces(Dart d) const {
    const Map& m = *map_;
    return {d, phi2(m, d), phi2(m, phi1(m, d)), phi2(m, phi_1(m, d))};
  }
  /// A dart of the corner that is not on the face of d.
  Dart apex(Dart d) const { return phi_1(*map_, phi2(*map_, d)); }
  Dart face(Side side) const {
    for (const Dart f : faces(base_[side.tetrahedron])) {
      if (point(apex(f)) == side.opposite) return f;
    }
    return base_[side.tetrahedron];
  }
  /// The dart of the face of f that runs against d between the same points; nil when the two faces
  /// run alike.
  Dart partner(Dart d, Dart f) const {
    const Map& m = *map_;
    for (int i = 0; i < 3; ++i, f = phi1(m, f)) {
      if (point(f) == point(phi1(m, d)) && point(phi1(m, f)) == point(d) &&
          point(phi_1(m, f)) == point(phi_1(m, d))) {
        return f;
      }
    }
    return Dart();
  }

  void sew(Dart d, Dart e) {
    for (int i = 0; i < 3; ++i, d = phi1(*map_, d), e = phi_1(*map_, e)) phi3_sew(*map_, d, e);
  }

  /// Takes the face of d apart and closes both sides by a boundary face each. At an edge that was
  /// on the boundary already the new faces go between the two there; else they meet each other.
  void unsew(Dart d) {
    Map& m = *map_;
    struct Edge {
      Dart inside, across, before, behind;  // nil: not on the boundary
    };
    std::array<Edge, 3> edges;
    for (Edge& edge : edges) {
      edge.inside = d;
      edge.across = phi3(m, d);
      Dart x = phi3(m, phi2(m, d));
      while (x != d && !is_boundary(m, x)) x = phi3(m, phi2(m, x));
      if (x != d) edge.before = x, edge.behind = phi2(m, x);
      d = phi1(m, d);
    }
    const auto boundary_face = [&m] {
      const Dart f = cgogn::add_face(static_cast<cgogn::CMap1&>(m), 3, false).dart_;
      for (const Dart x : {f, phi1(m, f), phi_1(m, f)}) set_boundary(m, x, true);
      return f;
    };
    Dart a = boundary_face(), b = boundary_face();
    for (const Edge& edge : edges) {
      phi3_unsew(m, edge.inside);
      phi3_sew(m, edge.inside, a);
      phi3_sew(m, edge.across, b);
      if (edge.before.is_nil()) {
        phi2_sew(m, a, b);
      } else {
        phi2_unsew(m, edge.before);
        phi2_sew(m, a, edge.before);
        phi2_sew(m, b, edge.behind);
      }
      a = phi_1(m, a);
      b = phi1(m, b);
    }
    // New darts get the indices of the cells that they belong to.
    for (const Edge& edge : edges) {
      for (const Dart x : {edge.inside, edge.across}) {
        cgogn::copy_index<Map::Edge>(m, phi3(m, x), x);
        cgogn::copy_index<Map::Vertex>(m, phi3(m, x), phi1(m, x));
      }
    }
  }

  /// Takes the boundary faces of two faces away that are to be sewn.
  void open(Dart d, Dart e) {
    Map& m = *map_;
    std::vector<Dart> gone;
    for (int i = 0; i < 3; ++i, d = phi1(m, d), e = phi_1(m, e)) {
      const Dart a = phi3(m, d), b = phi3(m, e);
      const Dart a2 = phi2(m, a), b2 = phi2(m, b);
      phi2_unsew(m, a);
      if (a2 != b) {
        phi2_unsew(m, b);
        phi2_sew(m, a2, b2);
      }
      phi3_unsew(m, d);
      phi3_unsew(m, e);
      gone.push_back(a);
      gone.push_back(b);
    }
    for (const Dart x : gone) remove_dart(m, x);
  }

  /// Whether two cells that were one are two now; then the second gets an index of its own.
  template <class Cell>
  bool part(Cell a, Cell b) {
    bool same = false;
    foreach_dart_of_orbit(*map_, a, [&](Dart d) -> bool {
      same = d == b.dart_;
      return !same;
    });
    if (!same) cgogn::set_index(*map_, b, cgogn::new_index<Cell>(*map_));
    return !same;
  }

  std::pair<std::vector<std::uint32_t>, std::size_t> number_components() {
    std::vector<std::uint32_t> of(base_.size());
    std::uint32_t number = 0;
    cgogn::DartMarker marker(*map_);
    for (const Dart start : base_) {
      if (marker.is_marked(start)) continue;
      foreach_dart_of_orbit(*map_, Map::CC(start), [&](Dart d) -> bool {
        marker.mark(d);
        if (!is_boundary(*map_, d)) of[row(d)] = number;
        return true;
      });
      ++number;
    }
    return {of, number};
  }

  /// Volumes of the boundary.
  std::size_t sheets() {
    const Map& m = *map_;
    std::size_t found = 0;
    cgogn::DartMarker marker(m);
    for (Dart d = m.begin(); d != m.end(); d = m.next(d)) {
      if (!is_boundary(m, d) || marker.is_marked(d)) continue;
      ++found;
      foreach_dart_of_orbit(m, Map::Volume(d), [&](Dart x) -> bool {
        marker.mark(x);
        return true;
      });
    }
    return found;
  }

  Body body_;
  std::unique_ptr<Map> map_;
  std::vector<Dart> base_;                           // one of each tetrahedron
  std::vector<std::array<std::uint32_t, 2>> point_;  // and row, of each dart inside
  Search search_;
};

}  // namespace

int main() { return serve(Kernel(), "cgogn3"); }
