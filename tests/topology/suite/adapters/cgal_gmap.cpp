// SPDX-License-Identifier: MIT
// CGAL's Linear_cell_complex on a generalized map as a kernel under judgement: cells sewn and
// unsewn by its managed sew<3> and unsew<3>, splits seen by its functors on 0- and 1-attributes. A
// generalized map has no orientation: tetrahedra are sewn as the file has them.
#include <CGAL/Cell_attribute.h>
#include <CGAL/Cell_attribute_with_point.h>
#include <CGAL/Linear_cell_complex_for_generalized_map.h>
#include <CGAL/Linear_cell_complex_traits.h>
#include <CGAL/Simple_cartesian.h>

#include "serve.hpp"

namespace {

using namespace adapter;

struct VertexInfo {
  std::uint32_t point = 0, number = 0;
};
struct EdgeInfo {
  std::array<std::uint32_t, 2> points = {0, 0};
};
struct TetInfo {
  std::uint32_t row = 0, component = 0;
};

struct Items {
  template <class Refs>
  struct Dart_wrapper {
    using Vertex_attribute = CGAL::Cell_attribute_with_point<Refs, VertexInfo>;
    using Edge_attribute = CGAL::Cell_attribute<Refs, EdgeInfo>;
    using Volume_attribute = CGAL::Cell_attribute<Refs, TetInfo>;
    using Attributes = std::tuple<Vertex_attribute, Edge_attribute, void, Volume_attribute>;
  };
};
using Traits = CGAL::Linear_cell_complex_traits<3, CGAL::Simple_cartesian<double>>;
using Complex = CGAL::Linear_cell_complex_for_generalized_map<3, 3, Traits, Items>;
using Dart = Complex::Dart_handle;

class Kernel {
 public:
  std::string load(const Body& body) {
    body_ = body;
    complex_.clear();
    dart_.clear();
    listen();
    for (std::uint32_t t = 0; t < body.tetrahedra.size(); ++t) add(t);
    for (const auto& [a, b] : common_faces(body)) sew(a, b);
    return "";
  }

  std::optional<Parted> split(Side side) {
    const Dart d = face(side);
    if (complex_.is_free<3>(d)) return std::nullopt;
    const std::uint32_t u = row(complex_.alpha<3>(d));
    told_ = {};
    complex_.unsew<3>(d);
    told_.separated = !search_.connected(side.tetrahedron, u, dart_.size(),
                                         [this](std::uint32_t t, const auto& visit) {
                                           for (const Dart f : faces(dart_[t])) {
                                             if (!complex_.is_free<3>(f))
                                               visit(row(complex_.alpha<3>(f)));
                                           }
                                         });
    return told_;
  }

  bool glue(Side a, Side b) { return sew(a, b); }

  Counts counts() {
    const std::vector<unsigned> cells = complex_.count_cells({0, 1, 2, 3, 4});
    std::size_t boundary = 0;
    for (auto it = complex_.one_dart_per_cell<2>().begin(); it.cont(); ++it) {
      boundary += complex_.is_free<3>(it) ? 1 : 0;
    }
    return {cells[0], cells[1], cells[2], cells[3], cells[4], boundary, sheets()};
  }

  std::vector<std::uint32_t> vertices() {
    std::uint32_t number = 0;
    for (auto it = complex_.attributes<0>().begin(); it != complex_.attributes<0>().end(); ++it) {
      it->info().number = number++;
    }
    std::vector<std::uint32_t> of(4 * dart_.size());
    for (std::size_t t = 0; t < dart_.size(); ++t) {
      for (const Dart f : faces(dart_[t])) {
        const VertexInfo& v = complex_.info<0>(apex(f));
        of[4 * t + place_of(body_.tetrahedra[t], v.point)] = v.number;
      }
    }
    return of;
  }

  std::vector<std::uint32_t> components() {
    std::uint32_t number = 0;
    for (auto it = complex_.one_dart_per_cell<4>().begin(); it.cont(); ++it, ++number) {
      for (auto d = complex_.darts_of_cell<4>(it).begin(); d.cont(); ++d) {
        complex_.info<3>(d).component = number;
      }
    }
    std::vector<std::uint32_t> of;
    for (const Dart d : dart_) of.push_back(complex_.info<3>(d).component);
    return of;
  }

 private:
  void listen() {
    complex_.onsplit_functor<0>() = [this](auto& old, auto&) {
      told_.vertices.push_back(old.info().point);
    };
    complex_.onsplit_functor<1>() = [this](auto& old, auto&) {
      told_.edges.push_back(old.info().points);
    };
  }

  void add(std::uint32_t t) {
    std::array<Complex::Vertex_attribute_handle, 4> v;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& p = body_.points[body_.tetrahedra[t][i]];
      v[i] = complex_.create_vertex_attribute(Complex::Point(p[0], p[1], p[2]));
      complex_.info_of_attribute<0>(v[i]).point = body_.tetrahedra[t][i];
    }
    const Dart first = complex_.make_tetrahedron(v[0], v[1], v[2], v[3]);
    complex_.set_attribute<3>(first, complex_.create_attribute<3>(TetInfo{t, 0}));
    for (const Dart f : faces(first)) {
      for (const Dart d : edges(f)) {
        if (complex_.attribute<1>(d) != nullptr) continue;
        const std::uint32_t a = point(d), b = point(complex_.alpha<0>(d));
        complex_.set_attribute<1>(
            d, complex_.create_attribute<1>(EdgeInfo{{std::min(a, b), std::max(a, b)}}));
      }
    }
    dart_.push_back(first);
  }

  std::uint32_t point(Dart d) { return complex_.info<0>(d).point; }
  std::uint32_t row(Dart d) { return complex_.info<3>(d).row; }
  /// A dart of the corner that is not on the face of d.
  Dart apex(Dart d) { return complex_.alpha<2, 1, 0>(d); }
  /// A dart of each face of the tetrahedron of d; of each edge of its face.
  std::array<Dart, 4> faces(Dart d) {
    return {d, complex_.alpha<2>(d), complex_.alpha<1, 2>(d), complex_.alpha<0, 1, 2>(d)};
  }
  std::array<Dart, 3> edges(Dart d) { return {d, complex_.alpha<1>(d), complex_.alpha<0, 1>(d)}; }
  Dart face(Side side) {
    for (const Dart f : faces(dart_[side.tetrahedron])) {
      if (point(apex(f)) == side.opposite) return f;
    }
    return dart_[side.tetrahedron];
  }

  /// Sews two free faces, points with the same number together.
  bool sew(Side a, Side b) {
    const Dart d = face(a);
    if (a.tetrahedron == b.tetrahedron && a.opposite == b.opposite) return false;
    for (const Dart e : edges(face(b))) {
      for (const Dart f : {e, complex_.alpha<0>(e)}) {
        if (point(f) != point(d) || point(complex_.alpha<0>(f)) != point(complex_.alpha<0>(d)) ||
            point(complex_.alpha<1, 0>(f)) != point(complex_.alpha<1, 0>(d))) {
          continue;
        }
        if (!complex_.is_free<3>(d) || !complex_.is_free<3>(f) || !complex_.is_sewable<3>(d, f)) {
          return false;
        }
        complex_.sew<3>(d, f);
        return true;
      }
    }
    return false;
  }

  /// Closed surfaces of the boundary: from face to face through the free face at the same edge.
  std::size_t sheets() {
    const auto mark = complex_.get_new_mark();
    std::size_t found = 0;
    std::vector<Dart> stack;
    const auto meet = [&](Dart d) {
      if (complex_.is_marked(d, mark)) return;
      for (const Dart e : edges(d)) {
        complex_.mark(e, mark);
        complex_.mark(complex_.alpha<0>(e), mark);
      }
      stack.push_back(d);
    };
    for (auto it = complex_.darts().begin(); it != complex_.darts().end(); ++it) {
      if (!complex_.is_free<3>(it) || complex_.is_marked(it, mark)) continue;
      ++found;
      meet(it);
      while (!stack.empty()) {
        const Dart d = stack.back();
        stack.pop_back();
        for (const Dart e : edges(d)) {
          Dart next = complex_.alpha<2>(e);
          while (!complex_.is_free<3>(next)) next = complex_.alpha<3, 2>(next);
          meet(next);
        }
      }
    }
    complex_.free_mark(mark);
    return found;
  }

  Body body_;
  Complex complex_;
  std::vector<Dart> dart_;  // one of each tetrahedron
  Parted told_;
  Search search_;
};

}  // namespace

int main() { return serve(Kernel(), "cgal-gmap"); }
