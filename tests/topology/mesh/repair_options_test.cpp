// SPDX-License-Identifier: MIT
// Which repair an option asks for, and orientation of tetrahedra in general position.
#include <catch2/catch.hpp>

#include <algorithm>

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
  CHECK(refused->text == "a crack needs tetrahedra of first order: there are 2 prisms, 1 pyramids");
}
