// SPDX-License-Identifier: MIT
// CGAL's insertions round an edge.
#include "tests/experiments/cells/cgal_bisection.hpp"

#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

#include "apps/bench/clock.hpp"
#include "topology/kernel/dart_map.hpp"

namespace sunder::test {
namespace {

/// Points alone.
using Plain = CGAL::Linear_cell_complex_for_combinatorial_map<3, 3, DartTraits>;

template <class Complex>
using Dart = typename Complex::Dart_handle;

template <class Complex>
Point place(Complex& complex, Dart<Complex> d) {
  const auto& x = complex.point(d);
  return {x.x(), x.y(), x.z()};
}

template <class Complex>
typename Complex::Point to_point(const Point& x) {
  return {x[0], x[1], x[2]};
}

template <class Complex>
void build(Complex& complex, const TetMesh& mesh) {
  complex.set_automatic_attributes_management(true);
  std::vector<typename Complex::Vertex_attribute_handle> vertices;
  for (const Point& x : mesh.points) {
    vertices.push_back(complex.create_vertex_attribute(to_point<Complex>(x)));
  }
  for (const auto& t : mesh.tetrahedra) {
    const Dart<Complex> first =
        complex.make_tetrahedron(vertices[t[0]], vertices[t[1]], vertices[t[2]], vertices[t[3]]);
    if constexpr (std::is_same_v<Complex, DartComplex>) {
      complex.template set_attribute<3>(first, complex.template create_attribute<3>());
    }
  }
  complex.sew3_same_facets();
}

template <class Complex>
using Edges = std::map<std::pair<Point, Point>, Dart<Complex>>;

/// A dart of every edge, by the places of its ends, the lower one first.
template <class Complex>
Edges<Complex> edges_of(Complex& complex) {
  Edges<Complex> edges;
  for (auto d = complex.darts().begin(); d != complex.darts().end(); ++d) {
    const Point a = place(complex, d), b = place(complex, complex.template beta<1>(d));
    if (a < b) edges.try_emplace({a, b}, d);
  }
  return edges;
}

/// Darts of the edge from `d`'s origin to its end, one of each tetrahedron round it; and a dart of
/// each face round it.
template <class Complex>
void gather(Complex& complex, Dart<Complex> d, std::vector<Dart<Complex>>& ring,
            std::vector<Dart<Complex>>& faces) {
  ring.assign(1, d);
  faces.assign(1, d);
  Dart<Complex> at = d;
  while (true) {
    const Dart<Complex> other = complex.template beta<2>(at);
    if (complex.template is_free<3>(other)) {
      faces.push_back(other);
      break;
    }
    at = complex.template beta<3>(other);
    if (at == d) return;
    ring.push_back(at);
    faces.push_back(at);
  }
  for (at = d; !complex.template is_free<3>(at);) {
    at = complex.template beta<2>(complex.template beta<3>(at));
    ring.push_back(at);
    faces.push_back(at);
  }
}

template <class Complex>
void divide_edge(Complex& complex, Dart<Complex> d, const Point& middle,
                 std::vector<Dart<Complex>>& ring, std::vector<Dart<Complex>>& faces) {
  gather(complex, d, ring, faces);
  complex.template insert_point_in_cell<1>(d, to_point<Complex>(middle));
  for (const Dart<Complex> f : faces) {  // from the middle to the corner that is not on the edge
    complex.insert_cell_1_in_cell_2(complex.template beta<1>(f), complex.template beta<0>(f));
  }
  for (const Dart<Complex> t : ring) {
    // t runs from a to the middle m; in its tetrahedron, on the side of a: m to c, c to d, d to m.
    const std::array<Dart<Complex>, 3> path = {complex.template beta<1>(t),
                                               complex.template beta<0, 2, 1>(t),
                                               complex.template beta<2, 0>(t)};
    complex.insert_cell_2_in_cell_3(path.begin(), path.end());
  }
}

template <class Complex>
CgalBody body_of(Complex& complex) {
  CgalBody body;
  body.is_valid = complex.is_valid();
  body.cells = complex.count_all_cells();
  body.bytes = complex.bytes();
  for (auto d = complex.template one_dart_per_cell<3>().begin(),
            end = complex.template one_dart_per_cell<3>().end();
       d != end; ++d) {
    std::array<Point, 4> corners = {place(complex, d), place(complex, complex.template beta<1>(d)),
                                    place(complex, complex.template beta<0>(d)),
                                    place(complex, complex.template beta<2, 0>(d))};
    std::ranges::sort(corners);
    body.tetrahedra.push_back(corners);
  }
  std::ranges::sort(body.tetrahedra);
  return body;
}

template <class Complex>
double divide_all(Complex& complex, const std::vector<DividedEdge>& edges) {
  const Edges<Complex> known = edges_of(complex);
  std::vector<Dart<Complex>> darts, ring, faces;
  for (const DividedEdge& edge : edges) {
    const auto at = known.find(std::minmax(edge.ends[0], edge.ends[1]));
    if (at == known.end()) throw std::logic_error("CGAL's map has no such edge");
    darts.push_back(at->second);
  }
  const double start = thread_us();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    divide_edge(complex, darts[i], edges[i].middle, ring, faces);
  }
  return thread_us() - start;
}

}  // namespace

struct CgalBisection::Complex {
  std::optional<Plain> plain;
  std::optional<DartComplex> rows;
};

CgalBisection::CgalBisection(const TetMesh& mesh, bool with_rows)
    : complex_(std::make_unique<Complex>()) {
  if (with_rows) {
    build(complex_->rows.emplace(), mesh);
  } else {
    build(complex_->plain.emplace(), mesh);
  }
}
CgalBisection::CgalBisection(CgalBisection&&) noexcept = default;
CgalBisection::~CgalBisection() = default;

double CgalBisection::divide(const std::vector<DividedEdge>& edges) {
  return complex_->plain ? divide_all(*complex_->plain, edges) : divide_all(*complex_->rows, edges);
}

CgalBody CgalBisection::body() {
  return complex_->plain ? body_of(*complex_->plain) : body_of(*complex_->rows);
}

}  // namespace sunder::test
