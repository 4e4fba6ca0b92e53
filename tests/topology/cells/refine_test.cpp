// SPDX-License-Identifier: MIT
// Refinement: counts as theory has them, shapes as Bey promises, levels taken back.
#include "topology/cells/refine.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "tests/support/built.hpp"
#include "topology/cells/cell_templates.hpp"
#include "topology/cells/refine_impl.hpp"
#include "topology/mesh/radius_ratio.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

using Corners = std::array<Point, 4>;

Corners corners_of(const VolumeMap& map, TetId t) {
  Corners x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = map.point(map.corners(t)[i]);
  return x;
}

/// A number for a tetrahedron's shape, whatever its size, place and turn: its six squared edges
/// over the longest, by corners in all orders the least, rounded.
std::vector<long> shape_of(const Corners& x) {
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  std::vector<long> least;
  std::array<std::array<double, 4>, 4> square{};
  double longest = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t j = 0; j < 3; ++j) square[i][k] += (x[i][j] - x[k][j]) * (x[i][j] - x[k][j]);
      longest = std::max(longest, square[i][k]);
    }
  }
  do {
    std::vector<long> key;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) {
        key.push_back(std::lround(1e5 * square[order[i]][order[k]] / longest));
      }
    }
    if (least.empty() || key < least) least = key;
  } while (std::next_permutation(order.begin(), order.end()));
  return least;
}

std::set<std::vector<long>> shapes(const VolumeMap& map) {
  std::set<std::vector<long>> all;
  for (std::size_t t = 0; t < map.tetrahedra(); ++t)
    all.insert(shape_of(corners_of(map, TetId{t})));
  return all;
}

/// The shapes of a tetrahedron's parts when one or two of its edges or those of a face are divided,
/// in either order.
void add_green_shapes(const Corners& x, std::set<std::vector<long>>& all) {
  for (unsigned edges = 1; edges < 63; ++edges) {
    const bool is_face = edges == edges_of_face(0) || edges == edges_of_face(1) ||
                         edges == edges_of_face(2) || edges == edges_of_face(3);
    if (std::popcount(edges) > 2 && !is_face) continue;
    for (const bool up : {true, false}) {
      const std::array<std::uint32_t, 6> order =
          up ? std::array<std::uint32_t, 6>{0, 1, 2, 3, 4, 5}
             : std::array<std::uint32_t, 6>{5, 4, 3, 2, 1, 0};
      for (const CellPart& part : parts_of_cell(edges, order)) {
        Corners y;
        for (std::size_t i = 0; i < 4; ++i) {
          const auto node = static_cast<std::size_t>(part[i]);
          if (node < 4) {
            y[i] = x[node];
            continue;
          }
          const auto& [a, b] = edge_ends[node - 4];
          for (std::size_t k = 0; k < 3; ++k) {
            y[i][k] = (x[static_cast<std::size_t>(a)][k] + x[static_cast<std::size_t>(b)][k]) / 2;
          }
        }
        all.insert(shape_of(y));
      }
    }
  }
}

bool everywhere(const VolumeMap&, TetId, TetId) { return true; }

}  // namespace

TEST_CASE("uniform refinement: counts by the formula", "[topology][cells]") {
  for (const NamedMesh& named : all_shapes()) {
    INFO(named.name);
    VolumeMap map = built(named.mesh);
    const Counts before = count_cells(map);
    const auto levels = refine(map, 1, everywhere);
    const Counts after = count_cells(map);
    CHECK(after.tetrahedra == 8 * before.tetrahedra);
    CHECK(after.vertices == before.vertices + before.edges);
    CHECK(after.edges == 2 * before.edges + 3 * before.faces + before.tetrahedra);
    CHECK(after.faces == 4 * before.faces + 8 * before.tetrahedra);
    CHECK(after.boundary_faces == 4 * before.boundary_faces);
    CHECK(after.boundary_sheets == before.boundary_sheets);
    CHECK(after.betti == before.betti);
    CHECK(levels[0].red == before.tetrahedra);
    CHECK(levels[0].green == 0);
    CHECK(check(map).empty());
  }
}

TEST_CASE("green are one edge, two, and the three of a face", "[topology][cells]") {
  for (unsigned edges = 1; edges < 64; ++edges) {
    bool is_face = false;  // by the corners that three edges touch
    unsigned corners = 0;
    for (std::size_t e = 0; e < 6; ++e) {
      if ((edges >> e & 1) == 0) continue;
      corners |= 1U << edge_ends[e][0] | 1U << edge_ends[e][1];
    }
    is_face = std::popcount(edges) == 3 && std::popcount(corners) == 3;
    CHECK(detail::is_green(edges) == (std::popcount(edges) <= 2 || is_face));
  }
}

TEST_CASE("a tetrahedron refined again and again has three shapes (Bey)", "[topology][cells]") {
  TetMesh mesh = one_tetrahedron();
  mesh.points = {{0, 0, 0}, {1.1, 0.1, 0.2}, {0.3, 0.9, 0.1}, {0.2, 0.25, 0.8}};
  VolumeMap map = built(mesh);
  map.set_kernel(MapKernel::dense);
  refine(map, 4, everywhere);
  CHECK(map.tetrahedra() == 4096);
  CHECK(shapes(map).size() <= 3);
}

TEST_CASE("of three edges inside the one with the best least radius ratio, and never worse again",
          "[topology][cells]") {
  std::mt19937_64 random(17);
  for (int trial = 0; trial < 50; ++trial) {
    TetMesh mesh = one_tetrahedron();
    for (Point& x : mesh.points) x = {unit(random), unit(random), unit(random)};
    VolumeMap map = built(mesh);
    map.set_kernel(MapKernel::dense);
    const Corners whole = corners_of(map, TetId{0});
    double expected = 0;  // by hand: the four round each edge inside
    for (const auto& [a, b, c, d] :
         {std::array<std::size_t, 4>{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}}) {
      const auto m = [&](std::size_t i, std::size_t j) {
        Point x;
        for (std::size_t k = 0; k < 3; ++k) x[k] = (whole[i][k] + whole[j][k]) / 2;
        return x;
      };
      // The edge from the middle of a b to that of c d; round it the middles of a c, a d, b d, b c.
      const std::array<Point, 4> ring = {m(a, c), m(a, d), m(b, d), m(b, c)};
      double least = 1;
      for (std::size_t i = 0; i < 4; ++i) {
        least = std::min(least, radius_ratio({m(a, b), m(c, d), ring[i], ring[(i + 1) % 4]}));
      }
      expected = std::max(expected, least);
    }
    expected = std::min(expected, radius_ratio(whole));
    for (const std::size_t levels : {1U, 2U, 3U}) {
      VolumeMap fine = map;
      refine(fine, levels, everywhere);
      double least = 1;
      for (std::size_t t = 0; t < fine.tetrahedra(); ++t) {
        least = std::min(least, radius_ratio(corners_of(fine, TetId{t})));
      }
      CHECK(least == Approx(expected).epsilon(1e-9));
      CHECK(shapes(fine).size() <= 3);
    }
  }
}

TEST_CASE("refined here and there: no green one is divided, shapes stay few", "[topology][cells]") {
  TetMesh mesh = kuhn_box({2, 2, 2});
  for (Point& x : mesh.points) x = {x[0] + 0.3 * x[1], x[1] - 0.1 * x[2], 1.2 * x[2]};
  // All that may come: the red shapes of three levels, and their green parts.
  VolumeMap red = built(mesh);
  red.set_kernel(MapKernel::dense);
  std::set<std::vector<long>> allowed = shapes(red);
  VolumeMap once = red;
  refine(once, 1, everywhere);
  allowed.merge(shapes(once));
  refine(red, 2, everywhere);
  allowed.merge(shapes(red));
  for (std::size_t t = 0; t < red.tetrahedra(); ++t) {
    add_green_shapes(corners_of(red, TetId{t}), allowed);
  }
  for (std::size_t levels = 1; levels <= 5; ++levels) {
    VolumeMap map = built(mesh);
    map.set_kernel(MapKernel::dense);
    const auto near_corner = [](const VolumeMap& m, TetId t, TetId) {
      for (const VertexId v : m.corners(t)) {
        const Point x = m.point(v);
        if (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] < 0.01) return true;
      }
      return false;
    };
    const Counts before = count_cells(map);
    const auto done = refine(map, levels, near_corner);
    REQUIRE(done.size() == levels);
    CHECK(check(map).empty());
    const Counts after = count_cells(map);
    CHECK(after.betti == before.betti);
    CHECK(after.boundary_sheets == before.boundary_sheets);
    CHECK(std::abs(after.volume - before.volume) < 1e-12);
    for (const auto& shape : shapes(map)) CHECK(allowed.contains(shape));
    for (std::size_t i = done.size(); i-- > 0;) map.apply(done[i].edit.undo);
    CHECK(cells(count_cells(map)) == cells(before));
  }
}

TEST_CASE("what is wanted is asked by the tetrahedron of the beginning", "[topology][cells]") {
  VolumeMap map = built(kuhn_box({2, 1, 1}));
  const auto levels =
      refine(map, 3, [](const VolumeMap&, TetId, TetId of) { return of == TetId{11}; });
  REQUIRE(levels.size() == 3);
  // By hand: all that was tetrahedron 11 became eight on each level.
  std::vector<TetId> root(12);
  for (std::size_t t = 0; t < 12; ++t) root[t] = TetId{t};
  for (const RefinedLevel& level : levels) {
    for (const ChildCell& cell : level.edit.cells) {
      if (cell.tetrahedron.index() >= root.size()) root.resize(cell.tetrahedron.index() + 1);
      root[cell.tetrahedron.index()] = root[cell.parent.index()];
    }
  }
  REQUIRE(root.size() == map.tetrahedra());
  CHECK(std::ranges::count(root, TetId{11}) == 512);
  CHECK(map.tetrahedra() < 512 + 12 * 64);
}

TEST_CASE("levels made anew leave nothing of what was tried", "[topology][cells]") {
  VolumeMap map = built(jittered(kuhn_box({3, 3, 3}), 0.15, 3));
  const Cells5 before = cells(map);
  const auto done = refine(map, 3, [](const VolumeMap& m, TetId t, TetId) {
    for (const VertexId v : m.corners(t)) {
      const Point x = m.point(v);
      double square = 0;
      for (std::size_t i = 0; i < 3; ++i) square += (x[i] - 1.3) * (x[i] - 1.3);
      if (square < 0.15) return true;
    }
    return false;
  });
  REQUIRE(done.size() == 3);
  CHECK(check(map).empty());
  std::size_t appended = before[3];  // the levels list all cells that are there
  for (const RefinedLevel& level : done) {
    for (const ChildCell& cell : level.edit.cells) appended += cell.tetrahedron != cell.parent;
  }
  CHECK(map.tetrahedra() == appended);
  for (std::size_t i = done.size(); i-- > 0;) map.apply(done[i].edit.undo);
  CHECK(check(map).empty());
  CHECK(cells(map) == before);
}

TEST_CASE("what only the try divided that had to be made anew is whole again",
          "[topology][cells]") {
  const VolumeMap whole = built(kuhn_box({4, 1, 1}));
  const std::size_t n = whole.tetrahedra();
  const TetId far{n - 1};
  for (const MapKernel kernel : {MapKernel::dense, MapKernel::lcc}) {
    VolumeMap map = whole;
    map.set_kernel(kernel);
    // First one end is wanted, then a green one next to it and the other end, which was left alone.
    bool tried = false;
    std::size_t asked = 0;
    const auto levels = refine(map, 2, [&](const VolumeMap& m, TetId t, TetId of) {
      REQUIRE(++asked < 100 * n);  // a cell that is not taken back is tried for ever
      if (m.tetrahedra() == n) return t == TetId{0};
      if (tried) return false;
      const bool is_green = of != TetId{0} && t.index() >= n;
      if (t == far) CHECK(m.corners(far) == whole.corners(far));
      tried = t.index() + 1 == m.tetrahedra();
      return is_green || t == far;
    });
    REQUIRE(levels.size() == 2);
    CHECK(check(map).empty());
    CHECK(map.corners(far) == whole.corners(far));
    CHECK(std::abs(count_cells(map).volume - 4) < 1e-14);
    for (std::size_t i = levels.size(); i-- > 0;) map.apply(levels[i].edit.undo);
    CHECK(std::ranges::equal(map.corners(), whole.corners()));
    CHECK(std::ranges::equal(map.neighbours(), whole.neighbours()));
  }
}

TEST_CASE("levels end before there are more tetrahedra than allowed", "[topology][cells]") {
  const auto all = [](const VolumeMap&, TetId, TetId) { return true; };
  for (const std::size_t levels : {1, 2}) {
    VolumeMap map = built(kuhn_box({2, 1, 1}, 1));
    std::size_t most = map.tetrahedra();
    for (std::size_t i = 0; i < levels; ++i) most *= 8;
    CHECK(refine(map, 5, all, most).size() == levels);
    CHECK(map.tetrahedra() == most);
    VolumeMap less = built(kuhn_box({2, 1, 1}, 1));
    CHECK(refine(less, 5, all, most - 1).size() == levels - 1);
  }
}
