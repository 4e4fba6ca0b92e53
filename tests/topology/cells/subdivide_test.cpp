// SPDX-License-Identifier: MIT
// Edges divided: results for known bodies, and the guarantees of the operation.
#include "topology/cells/subdivide.hpp"

#include <algorithm>
#include <map>

#include "tests/support/built.hpp"
#include "topology/cells/cell_templates.hpp"
#include "topology/cells/refine.hpp"
#include "topology/mesh/radius_ratio.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// An edge of the map between two of the file's points.
CellEdge edge_on(const VolumeMap& map, std::uint32_t a, std::uint32_t b) {
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
    for (int e = 0; e < 6; ++e) {
      const auto corners = map.corners(TetId{t});
      const auto& [i, j] = edge_ends[static_cast<std::size_t>(e)];
      const std::uint32_t p = map.point_of_vertex(corners[i]), q = map.point_of_vertex(corners[j]);
      if (std::minmax(p, q) == std::minmax(a, b)) return {TetId{t}, e};
    }
  }
  FAIL("no such edge");
  return {};
}

bool has(const VolumeMap& map, TetId t, VertexId v) {
  return place_of_vertex(map.corners(t), v) < 4;
}

/// One tetrahedron divided at all of its edges, and its corners by their places of before.
struct Eight {
  VolumeMap map;
  CellEdit edit;
  VertexId middle(int a, int b) const {
    return edit.vertices[static_cast<std::size_t>(edge_between(a, b))].vertex;
  }
};

Eight eight_of(const std::array<Point, 4>& corners, const std::array<double, 6>& weights) {
  TetMesh mesh = one_tetrahedron();
  mesh.points.assign(corners.begin(), corners.end());
  Eight eight{built(mesh), {}};
  std::vector<EdgeMark> marks;
  for (int e = 0; e < 6; ++e)
    marks.push_back({{TetId{0}, e}, weights[static_cast<std::size_t>(e)]});
  eight.edit = divide_edges(eight.map, marks);
  return eight;
}

/// Pairs of opposite edges in the order in which they are asked.
constexpr std::array<std::array<int, 4>, 3> turns = {{{0, 2, 1, 3}, {0, 3, 1, 2}, {0, 1, 2, 3}}};

/// The pair with middles that are joined inside.
std::size_t turn_of(const Eight& eight) {
  for (std::size_t turn = 0; turn < 3; ++turn) {
    const auto& [a, b, c, d] = turns[turn];
    std::size_t round = 0;
    for (std::size_t t = 0; t < eight.map.tetrahedra(); ++t) {
      round += has(eight.map, TetId{t}, eight.middle(a, b)) &&
               has(eight.map, TetId{t}, eight.middle(c, d));
    }
    if (round == 4) return turn;
  }
  return 3;
}

}  // namespace

TEST_CASE("a vertex in an edge: known counts", "[topology][cells]") {
  // Body, edge, cells after: V E F T CC, worked out by hand.
  struct Case {
    TetMesh mesh;
    std::array<std::uint32_t, 2> edge;
    Cells5 after;
  };
  const std::vector<Case> cases = {
      {one_tetrahedron(), {0, 1}, {5, 9, 7, 2, 1}},
      {two_tetrahedra(), {0, 1}, {6, 13, 12, 4, 1}},   // in the common face
      {two_tetrahedra(), {0, 3}, {6, 12, 10, 3, 1}},   // of one of them
      {closed_fan(5), {0, 1}, {8, 22, 25, 10, 1}},     // the axis
      {octahedron_star(), {0, 1}, {8, 23, 28, 12, 1}}  // four round a spoke
  };
  for (const Case& c : cases) {
    for (const MapKernel kernel : {MapKernel::dense, MapKernel::lcc}) {
      VolumeMap map = built(c.mesh);
      map.set_kernel(kernel);
      const CellEdit edit = insert_vertex(map, edge_on(map, c.edge[0], c.edge[1]), 0.25);
      CHECK(cells(map) == c.after);
      CHECK(check(map).empty());
      REQUIRE(edit.vertices.size() == 1);
      const Point a = map.point(edit.vertices[0].ends[0]), b = map.point(edit.vertices[0].ends[1]);
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK(map.point(edit.vertices[0].vertex)[i] == 0.75 * a[i] + 0.25 * b[i]);
      }
    }
  }
}

TEST_CASE("a ring of tetrahedra, closed and open", "[topology][cells]") {
  const VolumeMap fan = built(closed_fan(6));
  CHECK(edge_ring(fan, edge_on(fan, 0, 1)).size() == 6);
  VolumeMap open = built(open_fan(6));
  for (std::size_t t = 0; t < 6; ++t) {  // from every one of its tetrahedra all are found
    int place = 0;
    const auto corners = open.corners(TetId{t});
    for (int e = 0; e < 6; ++e) {
      const auto& [i, j] = edge_ends[static_cast<std::size_t>(e)];
      if (open.point_of_vertex(corners[i]) + open.point_of_vertex(corners[j]) == 1) place = e;
    }
    CHECK(edge_ring(open, {TetId{t}, place}).size() == 6);
  }
  const EdgeRows rows = edge_rows(fan);
  CHECK(rows.first.size() == count_cells(fan).edges);
}

TEST_CASE("which sets of edges a tetrahedron can be divided at", "[topology][cells]") {
  int divisible = 0;
  for (unsigned edges = 0; edges < 64; ++edges) {
    if (!is_divisible(edges)) continue;
    ++divisible;
    const auto parts = parts_of_cell(edges, {0, 1, 2, 3, 4, 5});
    // Parts are oriented as the whole and fill it: determinants of their corners' weights.
    double volume = 0;
    for (const CellPart& part : parts) {
      std::array<std::array<double, 3>, 4> x{};
      for (std::size_t i = 0; i < 4; ++i) {
        const auto add = [&](int corner, double w) {
          if (corner > 0) x[i][static_cast<std::size_t>(corner - 1)] += w;
        };
        if (part[i] < 4) {
          add(part[i], 1);
        } else {
          add(edge_ends[static_cast<std::size_t>(part[i] - 4)][0], 0.5);
          add(edge_ends[static_cast<std::size_t>(part[i] - 4)][1], 0.5);
        }
      }
      std::array<std::array<double, 3>, 3> d{};
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) d[i][k] = x[i + 1][k] - x[0][k];
      }
      const double det = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
                         d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
                         d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
      CHECK(det > 0);
      volume += det;
    }
    CHECK(volume == 1);  // sums of powers of two
  }
  // Without a full face: 1 of none, 6 of one, 15 of two, 16 of three, 3 of four; 4 faces; all.
  CHECK(divisible == 1 + 6 + 15 + 16 + 3 + 4 + 1);
}

TEST_CASE("both sides of a crack get one point, and can be glued after", "[topology][cells]") {
  VolumeMap map = built(two_tetrahedra());
  const HalfFaceId face = face_on(map, {0, 1, 2});
  const HalfFaceId other = map.neighbour(face);
  REQUIRE(split_face(map, face).vertex_count == 3);
  const std::vector<EdgeMark> marks = {{edge_on(map, 0, 1), 0.3},
                                       {{TetId{1}, 0}, 0.3}};  // 1 0 2 4: the same edge
  const CellEdit edit = divide_edges(map, marks);
  REQUIRE(edit.vertices.size() == 2);
  CHECK(map.points().size() == 6);
  CHECK(map.point_of_vertex(edit.vertices[0].vertex) ==
        map.point_of_vertex(edit.vertices[1].vertex));
  CHECK(count_cells(map).components == 2);
  static_cast<void>(other);
  std::size_t glued = 0;
  for (std::size_t a = 0; a < 4 * map.tetrahedra(); ++a) {
    for (std::size_t b = a + 1; b < 4 * map.tetrahedra(); ++b) {
      glued += glue_face(map, HalfFaceId{a}, HalfFaceId{b}).refusal == GlueRefusal::none;
    }
  }
  CHECK(glued == 2);
  CHECK(cells(map) == Cells5{6, 13, 12, 4, 1});
}

TEST_CASE("a tetrahedron divided at all its edges is that of the first turn", "[topology][cells]") {
  const auto& eight = parts_by_eight(0);
  const std::vector<CellPart> parts = parts_of_cell(63, {0, 1, 2, 3, 4, 5});
  CHECK(std::ranges::equal(parts, eight));
}

TEST_CASE("of three edges inside the best one, wherever edges are divided", "[topology][cells]") {
  std::mt19937_64 random(29);
  for (int trial = 0; trial < 200; ++trial) {
    std::array<Point, 4> corners;
    for (Point& x : corners) x = {unit(random), unit(random), unit(random)};
    std::array<double, 6> weights = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
    if (trial % 4 > 0) {
      for (double& w : weights) w = 0.05 + 0.9 * unit(random);
    }
    const Eight eight = eight_of(corners, weights);
    std::size_t best = 0;
    double most = 0;
    for (std::size_t turn = 0; turn < 3; ++turn) {
      const auto& [a, b, c, d] = turns[turn];
      const auto m = [&](int i, int j) { return eight.map.point(eight.middle(i, j)); };
      const std::array<Point, 4> ring = {m(a, c), m(a, d), m(b, d), m(b, c)};
      double least = 1;
      for (std::size_t i = 0; i < 4; ++i) {
        least = std::min(least, radius_ratio({m(a, b), m(c, d), ring[i], ring[(i + 1) % 4]}));
      }
      if (least > most * (1 + 1e-9)) best = turn, most = least;
    }
    CHECK(turn_of(eight) == best);
  }
}

TEST_CASE("the edge inside that its corners tell, where none is better", "[topology][cells]") {
  const std::array<double, 6> middles = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
  // A regular one, exact and off by less than a significant difference; and a flat one.
  for (const double shift : {0.0, 1e-12, -1e-12}) {
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<Point, 4> corners = {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
      corners[i][i % 3] += shift;
      CHECK(turn_of(eight_of(corners, middles)) == 0);
    }
  }
  CHECK(turn_of(eight_of({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, middles)) == 0);
}

TEST_CASE("walks begin elsewhere only where a vertex has left its tetrahedron",
          "[topology][cells]") {
  std::mt19937_64 random(31);
  for (const MapKernel kernel : {MapKernel::dense, MapKernel::lcc}) {
    VolumeMap map = built(jittered(kuhn_box({2, 2, 1}), 0.1, 7));
    map.set_kernel(kernel);
    for (int step = 0; step < 12; ++step) {
      std::vector<TetId> begins;
      for (std::size_t v = 0; v < map.vertices(); ++v) {
        begins.push_back(map.incident_tetrahedron(VertexId{v}));
      }
      const TetId t{below(random, map.tetrahedra())};
      const CellEdit edit = step % 3 == 2
                                ? refine_marked(map, std::span(&t, 1)).edit
                                : insert_vertex(map, {t, static_cast<int>(below(random, 6))}, 0.4);
      std::map<VertexId, TetId> moved;
      for (std::size_t i = 0; i < map.vertices(); ++i) {
        const VertexId v{i};
        const bool is_new = i >= begins.size();
        TetId expected = is_new ? TetId::none() : begins[i];
        if (is_new || !has(map, begins[i], v)) {
          // The first of the children that have it.
          const auto child = std::ranges::find_if(edit.cells, [&](const ChildCell& c) {
            return (is_new || c.parent == begins[i]) && has(map, c.tetrahedron, v);
          });
          REQUIRE(child != edit.cells.end());
          expected = child->tetrahedron;
          if (!is_new) moved[v] = begins[i];
        }
        CHECK(map.incident_tetrahedron(v) == expected);
      }
      std::map<VertexId, TetId> taken_back;
      for (const auto& [vertex, tetrahedron] : edit.undo.begins) {
        CHECK(taken_back.emplace(vertex, tetrahedron).second);
      }
      CHECK(taken_back == moved);
    }
  }
}
