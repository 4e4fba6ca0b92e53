// SPDX-License-Identifier: MIT
// Columns through operations on cells and back; splits are split_columns_test's.
#include "topology/cells/columns.hpp"

#include "tests/support/built.hpp"
#include "topology/cells/plane_cut.hpp"
#include "topology/cells/refine.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// A column for every rule, of numbers that name their row.
struct All {
  std::vector<double> mass;
  std::vector<int> region;
  std::vector<std::array<double, 2>> pair;
  std::vector<int> nearest;
  std::vector<int> face;
  friend bool operator==(const All&, const All&) = default;
};

struct AllBefore {
  ColumnBefore<double> mass;
  ColumnBefore<int> region;
  ColumnBefore<std::array<double, 2>> pair;
  ColumnBefore<int> nearest, face;
};

AllBefore extend(All& all, const CellEdit& edit) {
  return {
      extend_cells(all.mass, edit, CellRule::share), extend_cells(all.region, edit, CellRule::copy),
      extend_vertices(all.pair, edit, VertexRule::interpolate),
      extend_vertices(all.nearest, edit, VertexRule::nearest), extend_faces(all.face, edit, -1)};
}

void take_back(All& all, const AllBefore& before) {
  take_back(all.mass, before.mass);
  take_back(all.region, before.region);
  take_back(all.pair, before.pair);
  take_back(all.nearest, before.nearest);
  take_back(all.face, before.face);
}

All columns_of(const VolumeMap& map) {
  All all;
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
    all.mass.push_back(1 + static_cast<double>(t));
    all.region.push_back(static_cast<int>(t));
    for (int p = 0; p < 4; ++p) all.face.push_back(static_cast<int>(4 * t) + p);
  }
  for (std::size_t v = 0; v < map.vertices(); ++v) {
    const Point x = map.point(VertexId{v});
    all.pair.push_back({x[0] + 2 * x[1], 3 * x[2] - 1});
    all.nearest.push_back(static_cast<int>(v));
  }
  return all;
}

}  // namespace

TEST_CASE("columns through a vertex in an edge, by hand", "[topology][cells][columns]") {
  VolumeMap map = built(one_tetrahedron());
  All all = columns_of(map);
  all.face = {10, 11, 12, 13};
  const CellEdit edit = insert_vertex(map, {TetId{0}, edge_between(0, 1)}, 0.25);
  extend(all, edit);
  REQUIRE(all.mass.size() == 2);
  // The part that keeps corner 0 has a quarter.
  const bool first_keeps_0 = map.corners(TetId{0})[0] == VertexId{0};
  CHECK(all.mass[first_keeps_0 ? 0 : 1] == 0.25);
  CHECK(all.mass[first_keeps_0 ? 1 : 0] == 0.75);
  CHECK(all.region == std::vector<int>{0, 0});
  CHECK(all.nearest == std::vector<int>{0, 1, 2, 3, 0});
  for (std::size_t t = 0; t < 2; ++t) {
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId f = half_face(TetId{t}, p);
      const int label = all.face[f.index()];
      CHECK((label == -1) == !map.neighbour(f).is_none());
      // The faces at the edge's ends stay whole, the two along it are in both parts.
      if (label >= 0)
        CHECK(label - 10 == (map.corners(TetId{t})[static_cast<std::size_t>(p)] == VertexId{4}
                                 ? (map.corners(TetId{t})[0] == VertexId{0} ? 1 : 0)
                                 : p));
    }
  }
  CHECK(all.pair[4][0] == 0.75 * all.pair[0][0] + 0.25 * all.pair[1][0]);
}

TEST_CASE("numbers are copied where they are no shares", "[topology][cells][columns]") {
  VolumeMap map = built(one_tetrahedron());
  std::vector<double> density = {7.5};
  const CellEdit edit = insert_vertex(map, {TetId{0}, 0}, 0.25);
  extend_cells(density, edit, CellRule::copy);
  CHECK(density == std::vector<double>{7.5, 7.5});
}

TEST_CASE("the nearer end, the first one at the middle", "[topology][cells][columns]") {
  for (const auto& [weight, expected] :
       {std::pair{0.25, 0}, std::pair{0.5, 0}, std::pair{0.75, 1}}) {
    VolumeMap map = built(one_tetrahedron());
    std::vector<int> label = {0, 1, 2, 3};
    const CellEdit edit = insert_vertex(map, {TetId{0}, edge_between(0, 1)}, weight);
    extend_vertices(label, edit, VertexRule::nearest);
    CHECK(label.back() == expected);
    std::vector<double> strength = {0, 1, 2, 3};  // numbers that could be interpolated are not
    extend_vertices(strength, edit, VertexRule::nearest);
    CHECK(strength.back() == expected);
  }
}

TEST_CASE("columns through refinement and cuts, and back to the same",
          "[topology][cells][columns]") {
  VolumeMap map = built(jittered(kuhn_box({3, 2, 2}, 0.1), 0.02, 5));
  All all = columns_of(map);
  std::vector<All> past;
  std::vector<AllBefore> before;
  const auto follow = [&](const CellEdit& edit) {
    past.push_back(all);
    before.push_back(extend(all, edit));
    REQUIRE(all.mass.size() == map.tetrahedra());
    REQUIRE(all.face.size() == 4 * map.tetrahedra());
    REQUIRE(all.nearest.size() == map.vertices());
    for (std::size_t v = 0; v < map.vertices(); ++v) {
      const Point x = map.point(VertexId{v});
      CHECK(all.pair[v][0] == Approx(x[0] + 2 * x[1]).margin(1e-14));
      CHECK(all.pair[v][1] == Approx(3 * x[2] - 1).margin(1e-14));
    }
  };
  const std::vector<TetId> marked = {TetId{3}, TetId{40}};
  follow(refine_marked(map, marked).edit);
  follow(insert_vertex(map, {TetId{7}, 2}, 0.3));
  const auto cut = cut_cells(map, {{1, 0.3, 0.2}, 0.17});
  REQUIRE(cut);
  follow(cut->edit);
  std::vector<double> sum(past[0].mass.size(), 0);
  for (std::size_t t = 0; t < all.mass.size(); ++t) {
    sum[static_cast<std::size_t>(all.region[t])] += all.mass[t];
  }
  for (std::size_t t = 0; t < sum.size(); ++t)
    CHECK(sum[t] == Approx(past[0].mass[t]).epsilon(1e-13));
  for (; !before.empty(); before.pop_back(), past.pop_back()) {
    take_back(all, before.back());
    CHECK(all == past.back());
  }
}
