// SPDX-License-Identifier: MIT
// CGAL's Linear_cell_complex under judgement, used as its manual shows: tetrahedra one by one,
// managed sew<3> and unsew<3>, functors on the attributes of vertices and edges. The one source of
// the suite that sees CGAL.
#include <CGAL/Cell_attribute.h>
#include <CGAL/Cell_attribute_with_point.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>
#include <CGAL/Linear_cell_complex_traits.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "topology/suite/kernels/judged_kernel.hpp"

namespace sunder::suite {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

struct VertexInfo {
  std::uint32_t point = nobody;   // the file's; copies inherit it
  std::uint32_t number = nobody;  // of the attribute, when somebody asks
};
struct EdgeInfo {
  std::array<std::uint32_t, 2> points = {nobody, nobody};  // rising
};
struct TetInfo {
  std::uint32_t row = nobody;
  std::uint32_t number = nobody;  // of the component, when somebody asks
  std::size_t stamp = 0;          // of the last search that met it
  int side = 0;                   // from which side it did
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
using Complex = CGAL::Linear_cell_complex_for_combinatorial_map<3, 3, Traits, Items>;
// CGAL 5.6 renamed handles to descriptors.
#if CGAL_VERSION_NR >= 1050600000
using Dart = Complex::Dart_descriptor;
#else
using Dart = Complex::Dart_handle;
#endif

struct Body {
  Complex complex;
  std::vector<std::array<std::uint32_t, 4>> file;
  /// A dart of each tetrahedron.
  std::vector<Dart> dart;
  /// The answer gathered by the functors during the present split.
  SplitAnswer told;
  /// Attributes there should be, by the functors' calls since loading.
  std::ptrdiff_t vertices = 0, edges = 0;
  std::size_t searches = 0;
  std::vector<std::string> faults;
};

std::uint32_t point_of(const Body& body, Dart d) { return body.complex.info<0>(d).point; }

/// The point of the tetrahedron that is not on the face of `d`.
std::uint32_t opposite_point(Body& body, Dart d) {
  return point_of(body, body.complex.beta<2, 0>(d));
}

/// The darts of a tetrahedron, one for each face.
std::array<Dart, 4> face_darts(Body& body, Dart d) {
  Complex& c = body.complex;
  return {d, c.beta<2>(d), c.beta<1, 2>(d), c.beta<0, 2>(d)};
}

Dart face_at(Body& body, FaceSide side) {
  for (const Dart d : face_darts(body, body.dart[side.tetrahedron])) {
    if (opposite_point(body, d) == side.opposite) return d;
  }
  return body.dart[side.tetrahedron];
}

/// Every dart of a tetrahedron that starts at a point gets that point; edges likewise.
void add_tetrahedron(Body& body, const TetMesh& mesh, std::size_t row, bool flipped) {
  Complex& c = body.complex;
  std::array<std::uint32_t, 4> t = mesh.tetrahedra[row];
  if (flipped) std::swap(t[2], t[3]);
  std::array<Complex::Vertex_attribute_handle, 4> v;
  for (std::size_t i = 0; i < 4; ++i) {
    const Point& p = mesh.points[t[i]];
    v[i] = c.create_vertex_attribute(Complex::Point(p[0], p[1], p[2]));
    c.info_of_attribute<0>(v[i]).point = t[i];
  }
  const Dart first = c.make_tetrahedron(v[0], v[1], v[2], v[3]);
  c.set_attribute<3>(first, c.create_attribute<3>(TetInfo{.row = static_cast<std::uint32_t>(row)}));
  for (const Dart face : face_darts(body, first)) {
    Dart d = face;
    for (int j = 0; j < 3; ++j, d = c.beta<1>(d)) {
      if (c.attribute<1>(d) != nullptr) continue;
      const std::uint32_t a = point_of(body, d), b = point_of(body, c.beta<1>(d));
      c.set_attribute<1>(d, c.create_attribute<1>(EdgeInfo{{std::min(a, b), std::max(a, b)}}));
    }
  }
  body.dart.push_back(first);
}

using Half = std::array<std::uint32_t, 2>;  // tetrahedron, place

/// Pairs of half-faces with the same three points, the first two of each.
std::vector<std::array<Half, 2>> shared_faces(const TetMesh& mesh) {
  std::map<std::array<std::uint32_t, 3>, std::optional<Half>> open;
  std::vector<std::array<Half, 2>> pairs;
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    for (std::uint32_t p = 0; p < 4; ++p) {
      std::array<std::uint32_t, 3> face;
      for (std::size_t i = 0, n = 0; i < 4; ++i) {
        if (i != p) face[n++] = mesh.tetrahedra[t][i];
      }
      std::sort(face.begin(), face.end());
      const auto [it, fresh] = open.emplace(face, Half{t, p});
      if (fresh || !it->second) continue;
      pairs.push_back({*it->second, Half{t, p}});
      it->second.reset();
    }
  }
  return pairs;
}

/// Whether the two tetrahedra of a shared face, as the file has them, lie on it in the same sense:
/// an even permutation leads from one to the other with its fourth point exchanged.
bool same_sense(const TetMesh& mesh, const std::array<Half, 2>& pair) {
  const auto& a = mesh.tetrahedra[pair[0][0]];
  auto b = mesh.tetrahedra[pair[1][0]];
  b[pair[1][1]] = a[pair[0][1]];
  bool even = true;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto j = static_cast<std::size_t>(std::find(b.begin() + i, b.end(), a[i]) - b.begin());
    if (j == i || j == 4) continue;
    std::swap(b[i], b[j]);
    even = !even;
  }
  return even;
}

/// Which tetrahedra to turn round so that as many as possible lie alike: sew<3> wants that.
std::vector<char> turned(const TetMesh& mesh, const std::vector<std::array<Half, 2>>& pairs) {
  std::vector<std::vector<std::pair<std::uint32_t, bool>>> next(mesh.tetrahedra.size());
  for (const auto& pair : pairs) {
    const bool same = same_sense(mesh, pair);
    next[pair[0][0]].push_back({pair[1][0], same});
    next[pair[1][0]].push_back({pair[0][0], same});
  }
  std::vector<char> turn(mesh.tetrahedra.size(), 2);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t seed = 0; seed < turn.size(); ++seed) {
    if (turn[seed] != 2) continue;
    turn[seed] = 0;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      for (const auto& [u, same] : next[t]) {
        if (turn[u] != 2) continue;
        turn[u] = static_cast<char>(turn[t] ^ (same ? 1 : 0));
        stack.push_back(u);
      }
    }
  }
  return turn;
}

/// The dart of the face of `b` that runs against `a` between the same two points; null when the two
/// faces lie in the same sense and cannot be sewn point to point.
Dart partner(Body& body, Dart a, Dart b) {
  Complex& c = body.complex;
  const auto point = [&body](Dart d) { return point_of(body, d); };
  for (int j = 0; j < 3; ++j, b = c.beta<1>(b)) {
    if (point(a) == point(c.beta<1>(b)) && point(c.beta<1>(a)) == point(b) &&
        point(c.beta<0>(a)) == point(c.beta<0>(b))) {
      return b;
    }
  }
  return nullptr;
}

bool sew(Body& body, Dart a, Dart b) {
  const Dart d = partner(body, a, b);
  if (d == nullptr || !body.complex.is_sewable<3>(a, d)) return false;
  body.complex.sew<3>(a, d);
  return true;
}

void listen(Body& body) {
  Complex& c = body.complex;
  c.onsplit_functor<0>() = [&body](auto& old, auto&) {
    ++body.vertices;
    body.told.vertices.push_back(old.info().point);
  };
  c.onsplit_functor<1>() = [&body](auto& old, auto&) {
    ++body.edges;
    body.told.edges.push_back(old.info().points);
  };
  c.onmerge_functor<0>() = [&body](auto&, auto&) { --body.vertices; };
  c.onmerge_functor<1>() = [&body](auto&, auto&) { --body.edges; };
}

/// CGAL checks nothing; only meshes that would make this program read beyond its arrays are
/// refused.
std::vector<Finding> load(Body& body, const TetMesh& mesh) {
  body.complex.clear();
  body.file = mesh.tetrahedra;
  body.dart.clear();
  body.faults.clear();
  for (const auto& t : mesh.tetrahedra) {
    if (*std::max_element(t.begin(), t.end()) < mesh.points.size()) continue;
    Finding finding;
    finding.code = "index_out_of_range";
    finding.text = "a tetrahedron names a point that the body has not";
    finding.remedy = "mend the body";
    return {finding};
  }
  listen(body);
  const auto pairs = shared_faces(mesh);
  const std::vector<char> turn = turned(mesh, pairs);
  for (std::size_t t = 0; t < turn.size(); ++t) add_tetrahedron(body, mesh, t, turn[t] == 1);
  body.vertices = static_cast<std::ptrdiff_t>(4 * turn.size());
  body.edges = static_cast<std::ptrdiff_t>(6 * turn.size());
  for (const auto& [a, b] : pairs) {
    sew(body, face_at(body, {a[0], mesh.tetrahedra[a[0]][a[1]]}),
        face_at(body, {b[0], mesh.tetrahedra[b[0]][b[1]]}));
  }
  return {};
}

/// Whether two tetrahedra hang together: a search from both, tetrahedron by tetrahedron in turn.
bool connected(Body& body, Dart a, Dart b) {
  Complex& c = body.complex;
  const std::size_t stamp = ++body.searches;
  std::array<std::vector<Dart>, 2> queue;
  const auto meet = [&](int side, Dart d) {  // true: the other side was here before
    TetInfo& tet = c.info<3>(d);
    if (tet.stamp == stamp) return tet.side != side;
    tet.stamp = stamp;
    tet.side = side;
    queue[side].push_back(d);
    return false;
  };
  if (meet(0, a) || meet(1, b)) return true;
  std::array<std::size_t, 2> at = {0, 0};
  for (int side = 0; at[side] < queue[side].size(); side = 1 - side) {
    for (const Dart d : face_darts(body, queue[side][at[side]])) {
      if (!c.is_free<3>(d) && meet(side, c.beta<3>(d))) return true;
    }
    ++at[side];
  }
  return false;
}

SplitAnswer split(Body& body, FaceSide side) {
  body.told = {};
  const Dart d = face_at(body, side);
  // unsew<3> of a free dart is an assertion in debug builds and nothing in others.
  if (body.complex.is_free<3>(d)) return body.told;
  const Dart other = body.complex.beta<3>(d);
  body.complex.unsew<3>(d);
  body.told.did = true;
  body.told.separated = !connected(body, d, other);
  std::sort(body.told.vertices.begin(), body.told.vertices.end());
  std::sort(body.told.edges.begin(), body.told.edges.end());
  return body.told;
}

bool glue(Body& body, FaceSide a, FaceSide b) {
  const Dart d = face_at(body, a), e = face_at(body, b);
  return d != e && body.complex.is_free<3>(d) && body.complex.is_free<3>(e) && sew(body, d, e);
}

/// Closed surfaces of the boundary: from face to face through the free face at the same edge.
std::size_t count_sheets(Body& body) {
  Complex& c = body.complex;
  const auto mark = c.get_new_mark();
  std::size_t sheets = 0;
  std::vector<Dart> stack;
  const auto meet = [&](Dart d) {
    if (c.is_marked(d, mark)) return;
    for (int j = 0; j < 3; ++j, d = c.beta<1>(d)) c.mark(d, mark);
    stack.push_back(d);
  };
  for (auto it = c.darts().begin(); it != c.darts().end(); ++it) {
    if (!c.is_free<3>(it) || c.is_marked(it, mark)) continue;
    ++sheets;
    meet(it);
    while (!stack.empty()) {
      Dart d = stack.back();
      stack.pop_back();
      for (int j = 0; j < 3; ++j, d = c.beta<1>(d)) {
        Dart next = c.beta<2>(d);
        while (!c.is_free<3>(next)) next = c.beta<3, 2>(next);
        meet(next);
      }
    }
  }
  c.free_mark(mark);
  return sheets;
}

CellCounts counts(Body& body) {
  Complex& c = body.complex;
  const std::vector<unsigned int> cells = c.count_cells({0, 1, 2, 3, 4});
  CellCounts counts{cells[0], cells[1], cells[2], cells[3], cells[4], 0, 0};
  for (auto it = c.one_dart_per_cell<2>().begin(); it.cont(); ++it) {
    counts.boundary_faces += c.is_free<3>(it) ? 1 : 0;
  }
  counts.boundary_sheets = count_sheets(body);
  const auto expect = [&body](std::size_t seen, std::ptrdiff_t told, const std::string& cell) {
    if (static_cast<std::ptrdiff_t>(seen) == told) return;
    body.faults.push_back("functors lead to " + std::to_string(told) + " " + cell + ", there are " +
                          std::to_string(seen));
  };
  expect(cells[0], body.vertices, "vertices");
  expect(cells[1], body.edges, "edges");
  return counts;
}

/// Numbers of the attributes at each corner.
std::vector<std::uint32_t> vertex_of_corner(Body& body) {
  Complex& c = body.complex;
  std::uint32_t number = 0;
  for (auto it = c.attributes<0>().begin(); it != c.attributes<0>().end(); ++it) {
    it->info().number = number++;
  }
  std::vector<std::uint32_t> of(4 * body.file.size(), nobody);
  for (std::size_t t = 0; t < body.file.size(); ++t) {
    for (const Dart d : face_darts(body, body.dart[t])) {
      const VertexInfo& v = c.info<0>(c.beta<2, 0>(d));
      const auto& corners = body.file[t];
      const auto place = std::find(corners.begin(), corners.end(), v.point) - corners.begin();
      of[4 * t + static_cast<std::size_t>(place)] = v.number;
    }
  }
  return of;
}

std::vector<std::uint32_t> component_of_tetrahedron(Body& body) {
  Complex& c = body.complex;
  std::uint32_t number = 0;
  for (auto it = c.one_dart_per_cell<4>().begin(); it.cont(); ++it, ++number) {
    for (auto d = c.darts_of_cell<4>(it).begin(); d.cont(); ++d) c.info<3>(d).number = number;
  }
  std::vector<std::uint32_t> of;
  for (const Dart d : body.dart) of.push_back(c.info<3>(d).number);
  return of;
}

/// CGAL's own check prints its findings; here it prints into a string.
std::vector<std::string> own_faults(Body& body) {
  std::ostringstream printed;
  std::streambuf* const out = std::cout.rdbuf(printed.rdbuf());
  std::streambuf* const err = std::cerr.rdbuf(printed.rdbuf());
  const bool valid = body.complex.is_valid();
  std::cout.rdbuf(out);
  std::cerr.rdbuf(err);
  if (!valid) {
    const std::string text = printed.str();
    body.faults.push_back("is_valid: " + text.substr(0, text.find('\n')));
  }
  return std::exchange(body.faults, {});
}

}  // namespace

JudgedKernel cgal_kernel() {
  const auto body = std::make_shared<Body>();
  JudgedKernel kernel;
  kernel.name = "cgal";
  kernel.load = [body](const TetMesh& mesh) { return load(*body, mesh); };
  kernel.split = [body](FaceSide side) { return split(*body, side); };
  kernel.glue = [body](FaceSide a, FaceSide b) { return glue(*body, a, b); };
  kernel.counts = [body] { return counts(*body); };
  kernel.vertex_of_corner = [body] { return vertex_of_corner(*body); };
  kernel.component_of_tetrahedron = [body] { return component_of_tetrahedron(*body); };
  kernel.own_faults = [body] { return own_faults(*body); };
  return kernel;
}

}  // namespace sunder::suite
