// SPDX-License-Identifier: MIT
// CGoGN_2's CMap3 as a kernel under judgement: volumes sewn and unsewn by its sew_volumes and
// unsew_volumes. The separated cells follow from the embeddings of vertices and edges that these
// operations keep, and the numbers of cells are those of the embeddings.
#include <cgogn/core/cmap/cmap3.h>
#include <cgogn/core/cmap/cmap3_builder.h>

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
    Map::Builder builder(*map_);
    for (const Tetrahedron& corners : alike(body, common)) add(builder, corners);
    for (const auto& [a, b] : common) {
      const Dart d = face(a), e = partner(d, face(b));
      if (!e.is_nil()) builder.sew_volumes_fp(d, e);
    }
    builder.close_map();
    map_->add_attribute<cgogn::uint32, Map::Vertex>("vertex");
    map_->add_attribute<cgogn::uint32, Map::Edge>("edge");
    return "";
  }

  std::optional<Parted> split(Side side) {
    const Dart d = face(side);
    if (map_->is_incident_to_boundary(Map::Face(d))) return std::nullopt;
    const Dart e = map_->phi3(d);
    const std::uint32_t u = row(e);
    map_->unsew_volumes(Map::Face(d));
    Parted parted;
    Dart a = d, b = map_->phi1(e);  // both start at the same point
    for (int i = 0; i < 3; ++i, a = map_->phi1(a), b = map_->phi_1(b)) {
      if (map_->embedding(Map::Vertex(a)) != map_->embedding(Map::Vertex(b))) {
        parted.vertices.push_back(point(a));
      }
      if (map_->embedding(Map::Edge(a)) != map_->embedding(Map::Edge(map_->phi_1(b)))) {
        parted.edges.push_back({point(a), point(map_->phi1(a))});
      }
    }
    parted.separated = !search_.connected(side.tetrahedron, u, base_.size(),
                                          [this](std::uint32_t t, const auto& visit) {
                                            for (const Dart f : faces(base_[t])) {
                                              const Dart across = map_->phi3(f);
                                              if (!map_->is_boundary(across)) visit(row(across));
                                            }
                                          });
    return parted;
  }

  bool glue(Side a, Side b) {
    const Dart d = face(a), f = face(b);
    if (d == f || !map_->is_incident_to_boundary(Map::Face(d)) ||
        !map_->is_incident_to_boundary(Map::Face(f))) {
      return false;
    }
    const Dart e = partner(d, f);
    if (e.is_nil()) return false;
    map_->sew_volumes(Map::Face(d), Map::Face(e));
    return true;
  }

  Counts counts() {
    std::size_t boundary = 0;
    map_->foreach_cell([&](Map::Face f) { boundary += map_->is_incident_to_boundary(f) ? 1 : 0; });
    return {
        map_->nb_cells<Map::Vertex>(), map_->nb_cells<Map::Edge>(),     map_->nb_cells<Map::Face>(),
        map_->nb_cells<Map::Volume>(), map_->nb_connected_components(), boundary,
        map_->nb_boundaries()};
  }

  std::vector<std::uint32_t> vertices() {
    std::vector<std::uint32_t> of(4 * base_.size());
    for (std::size_t t = 0; t < base_.size(); ++t) {
      for (const Dart f : faces(base_[t])) {
        const Dart top = apex(f);
        of[4 * t + place_of(body_.tetrahedra[t], point(top))] = map_->embedding(Map::Vertex(top));
      }
    }
    return of;
  }

  std::vector<std::uint32_t> components() {
    std::vector<std::uint32_t> of(base_.size());
    std::uint32_t number = 0;
    map_->foreach_cell([&](Map::ConnectedComponent c) {
      map_->foreach_dart_of_orbit(c, [&](Dart d) {
        if (!map_->is_boundary(d)) of[row(d)] = number;
      });
      ++number;
    });
    return of;
  }

 private:
  void set(Dart d, std::uint32_t point, std::uint32_t row) {
    if (point_.size() <= d.index) point_.resize(d.index + 1);
    point_[d.index] = {point, row};
  }
  std::uint32_t point(Dart d) const { return point_[d.index][0]; }
  std::uint32_t row(Dart d) const { return point_[d.index][1]; }

  void add(Map::Builder& builder, const Tetrahedron& corners) {
    const auto t = static_cast<std::uint32_t>(base_.size());
    Dart d = builder.add_pyramid_topo_fp(3);
    base_.push_back(d);
    for (std::size_t i = 0; i < 3; ++i, d = map_->phi1(d)) {
      const Dart s = map_->phi2(d);
      set(d, corners[i], t);
      set(s, corners[(i + 1) % 3], t);
      set(map_->phi1(s), corners[i], t);
      set(map_->phi_1(s), corners[3], t);
    }
  }

  /// A dart of each face of a tetrahedron, the first that of d.
  std::array<Dart, 4> faces(Dart d) const {
    return {d, map_->phi2(d), map_->phi2(map_->phi1(d)), map_->phi2(map_->phi_1(d))};
  }
  /// A dart of the corner that is not on the face of d.
  Dart apex(Dart d) const { return map_->phi_1(map_->phi2(d)); }
  Dart face(Side side) const {
    for (const Dart f : faces(base_[side.tetrahedron])) {
      if (point(apex(f)) == side.opposite) return f;
    }
    return base_[side.tetrahedron];
  }
  /// The dart of the face of f that runs against d between the same points; nil when the two faces
  /// run alike.
  Dart partner(Dart d, Dart f) const {
    for (int i = 0; i < 3; ++i, f = map_->phi1(f)) {
      if (point(f) == point(map_->phi1(d)) && point(map_->phi1(f)) == point(d) &&
          point(map_->phi_1(f)) == point(map_->phi_1(d))) {
        return f;
      }
    }
    return Dart();
  }

  Body body_;
  std::unique_ptr<Map> map_;
  std::vector<Dart> base_;                           // one of each tetrahedron
  std::vector<std::array<std::uint32_t, 2>> point_;  // and row, of each dart inside
  Search search_;
};

}  // namespace

int main() { return serve(Kernel(), "cgogn2"); }
