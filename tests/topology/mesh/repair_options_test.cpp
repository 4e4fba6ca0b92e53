// SPDX-License-Identifier: MIT
// Which repair an option asks for, and orientation of tetrahedra in general position.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>

#include "topology/base/point_math.hpp"
#include "topology/mesh/repair.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

TEST_CASE("every option of repair asks for its own repair, all of them in order",
          "[topology][repair]") {
  const auto codes = [](const Repairs& repairs) {
    FileMesh mesh = file_mesh_of(suite::two_tetrahedra());
    std::vector<std::string> told;
    for (const Finding& f : repair(mesh, repairs)) {
      CHECK(f.severity == Severity::note);
      CHECK(f.count == 0);
      told.push_back(f.code);
    }
    CHECK(mesh == file_mesh_of(suite::two_tetrahedra()));
    return told;
  };
  using Codes = std::vector<std::string>;
  CHECK(codes({}).empty());
  CHECK(codes({.merge_points = 0}) == Codes{"merged_points"});
  CHECK(codes({.drop_duplicates = true}) == Codes{"dropped_duplicates"});
  CHECK(codes({.split_nonmanifold = true}) == Codes{"split_nonmanifold"});
  CHECK(codes({.largest_component = true}) == Codes{"kept_largest_component"});
  CHECK(codes({.fix_orientation = true}) == Codes{"fixed_orientation"});
  CHECK(codes({.drop_unused = true}) == Codes{"dropped_unused"});
  CHECK(codes({0.0, true, true, true, true, true}) ==
        Codes{"merged_points", "dropped_duplicates", "split_nonmanifold", "kept_largest_component",
              "fixed_orientation", "dropped_unused"});
}

TEST_CASE("a tetrahedron is turned exactly where its volume is negative, in any order of corners",
          "[topology][repair]") {
  const std::array<Point, 4> x = {{{2, 3, 5}, {9, 16, 22}, {19, 32, 48}, {43, 64, 10}}};
  std::array<std::uint32_t, 4> order = {0, 1, 2, 3};
  std::size_t turned = 0;
  do {
    FileMesh mesh;
    mesh.points.assign(x.begin(), x.end());
    mesh.tetrahedra.corners = {order};
    const auto volume = [&] {
      const auto& t = mesh.tetrahedra.corners[0];
      return detail::six_volumes(x[t[0]], x[t[1]], x[t[2]], x[t[3]]);
    };
    const double before = volume();
    const Finding told = fix_orientation(mesh);
    CHECK(told.count == (before < 0 ? 1 : 0));
    CHECK(volume() == std::abs(before));
    CHECK(mesh.tetrahedra.corners[0][0] == order[0]);
    CHECK(mesh.tetrahedra.corners[0][1] == order[1]);
    turned += told.count;
  } while (std::ranges::next_permutation(order).found);
  CHECK(turned == 12);
}

TEST_CASE("repairs of tetrahedra refuse other cells of the volume, and tell them",
          "[topology][repair]") {
  FileMesh mesh = file_mesh_of(suite::two_tetrahedra());
  mesh.points.insert(mesh.points.end(),
                     {{5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}, {5, 0, 1}, {6, 0, 1}});
  append_cell(mesh, CellKind::quad4, std::array<std::uint32_t, 4>{5, 6, 7, 8});
  const auto codes = [](FileMesh there, const Repairs& repairs) {
    std::vector<std::string> told;
    for (const Finding& f : repair(there, repairs)) told.push_back(f.code);
    return told;
  };
  using Codes = std::vector<std::string>;
  const Repairs every[] = {{.drop_duplicates = true},
                           {.split_nonmanifold = true},
                           {.largest_component = true},
                           {.fix_orientation = true}};
  for (const Repairs& repairs : every) CHECK(codes(mesh, repairs) != Codes{"unsupported_cells"});
  CHECK_FALSE(needs_tetrahedra(mesh, "a crack"));
  append_cell(mesh, CellKind::pyramid5, std::array<std::uint32_t, 5>{5, 6, 7, 8, 9});
  for (const Repairs& repairs : every) CHECK(codes(mesh, repairs) == Codes{"unsupported_cells"});
  CHECK(codes(mesh, {.merge_points = 0, .drop_unused = true}) ==
        Codes{"merged_points", "dropped_unused"});
  append_cell(mesh, CellKind::prism6, std::array<std::uint32_t, 6>{5, 6, 9, 8, 7, 10});
  append_cell(mesh, CellKind::prism6, std::array<std::uint32_t, 6>{5, 6, 9, 8, 7, 10});
  const auto refused = needs_tetrahedra(mesh, "a crack");
  REQUIRE(refused);
  CHECK(refused->code == "unsupported_cells");
  CHECK(refused->count == 3);
  CHECK(refused->text ==
        "a crack needs tetrahedra of first order: the mesh has 2 prisms, 1 pyramid");
}

TEST_CASE("what was done is told in words, and so is that nothing was to be done",
          "[topology][repair]") {
  const auto text = [](FileMesh mesh, const Repairs& repairs) {
    return repair(mesh, repairs).at(0).text;
  };
  FileMesh mesh = file_mesh_of(suite::two_tetrahedra());
  std::vector<std::string> texts;
  for (const Finding& f : repair(mesh, {0.0, true, true, true, true, true}))
    texts.push_back(f.text);
  CHECK(texts ==
        std::vector<std::string>{"no points lie within 0 m of others: none was merged",
                                 "no two tetrahedra have the same points: none was dropped",
                                 "no stars of tetrahedra only touch: nothing was split",
                                 "the body is one component: nothing was dropped",
                                 "no tetrahedron is inverted: none was changed",
                                 "every point is used by a cell: none was dropped"});
  mesh.points.push_back(mesh.points[0]);
  CHECK(text(mesh, {.merge_points = 0}) == "1 point was merged into others within 0 m");
  CHECK(text(mesh, {.drop_unused = true}) == "1 point that no cell uses was dropped");
  for (const std::uint32_t corner : {1U, 2U, 3U}) {
    mesh.points.push_back(mesh.points[corner]);
    mesh.points.back()[0] += 10;
  }
  mesh.points[5][0] += 10;
  mesh.tetrahedra.corners.push_back({5, 6, 7, 8});
  CHECK(text(mesh, {.largest_component = true}) ==
        "of 2 components the largest stays: 1 tetrahedron was dropped");
  mesh.points[6] = mesh.points[5];
  CHECK(
      text(mesh, {.merge_points = 0.25}) ==
      "1 point was merged into others within 0.25 m; 1 volume cell was dropped for a lost corner");
}

TEST_CASE("cells of other kinds go where two of their corners become one, and nowhere else",
          "[topology][repair]") {
  FileMesh mesh;
  for (int i = 0; i < 12; ++i) mesh.points.push_back({1.0 * i, 1.0 * (i % 5), 1.0 * (i % 3)});
  mesh.points[11] = mesh.points[10];
  append_cell(mesh, CellKind::polygon, std::array<std::uint32_t, 5>{0, 1, 2, 3, 4});
  append_cell(mesh, CellKind::polygon, std::array<std::uint32_t, 5>{0, 1, 11, 10, 4});
  // Nodes that are no corners may coincide.
  append_cell(mesh, CellKind::tetrahedron10,
              std::array<std::uint32_t, 10>{0, 1, 2, 3, 10, 11, 4, 5, 6, 7});
  append_cell(mesh, CellKind::tetrahedron10,
              std::array<std::uint32_t, 10>{10, 1, 2, 11, 0, 3, 4, 5, 6, 7});
  CHECK(merge_points(mesh, 0).count == 1);
  REQUIRE(rows_of(mesh, CellKind::polygon).count == 1);
  CHECK(std::ranges::equal(rows_of(mesh, CellKind::polygon)[0],
                           std::array<std::uint32_t, 5>{0, 1, 2, 3, 4}));
  REQUIRE(rows_of(mesh, CellKind::tetrahedron10).count == 1);
  CHECK(std::ranges::equal(rows_of(mesh, CellKind::tetrahedron10)[0],
                           std::array<std::uint32_t, 10>{0, 1, 2, 3, 10, 10, 4, 5, 6, 7}));
}

TEST_CASE("repairs of tetrahedra ask nothing but points of other cells", "[topology][repair]") {
  FileMesh mesh;
  for (int i = 0; i < 9; ++i) mesh.points.push_back({1.0 * (i % 2), 1.0 * (i / 2 % 2), i / 4.0});
  mesh.tetrahedra.corners = {{0, 1, 2, 3}, {1, 2, 3, 4}, {3, 2, 1, 0}, {5, 6, 7, 8}};
  const std::array<std::array<std::uint32_t, 5>, 4> pyramids = {
      {{4, 5, 6, 7, 8}, {0, 1, 2, 3, 4}, {0, 2, 1, 3, 4}, {0, 1, 2, 3, 5}}};
  for (const auto& p : pyramids) append_cell(mesh, CellKind::pyramid5, p);
  const auto stay = [&](const FileMesh& there, std::initializer_list<std::size_t> rows) {
    std::vector<std::uint32_t> nodes;
    for (const std::size_t row : rows) {
      nodes.insert(nodes.end(), pyramids[row].begin(), pyramids[row].end());
    }
    return other_cells(there, CellKind::pyramid5).points == nodes;
  };
  FileMesh once = mesh;
  CHECK(drop_duplicate_tetrahedra(once).count == 1);
  CHECK(once.tetrahedra.corners.size() == 3);
  CHECK(stay(once, {0, 1, 2, 3}));
  CHECK(keep_largest_component(once).count == 3);
  CHECK(once.tetrahedra.corners.size() == 2);
  CHECK(stay(once, {1, 2}));
}

TEST_CASE("a tetrahedron without volume is not turned", "[topology][repair]") {
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.tetrahedra.corners = {{0, 1, 2, 3}};
  const FileMesh before = mesh;
  CHECK(fix_orientation(mesh).count == 0);
  CHECK(mesh == before);
}
