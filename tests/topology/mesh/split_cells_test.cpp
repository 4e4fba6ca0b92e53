// SPDX-License-Identifier: MIT
// Cells cut into simplices: neighbours fit together whatever the numbering, and the volume stays.
#include "topology/mesh/kinds/split_cells.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "topology/mesh/boundary_surface.hpp"
#include "topology/mesh/check.hpp"

using namespace sunder;

namespace {

using Random = std::mt19937;
using Nodes = std::vector<std::uint32_t>;

/// A block of n x n x n cubes, its points moved a little and numbered at random; each cube is a
/// hexahedron, two prisms, or six pyramids around a point of its own.
FileMesh block_of_kinds(std::uint32_t n, Random& random) {
  FileMesh mesh;
  const auto point = [n](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return (k * (n + 1) + j) * (n + 1) + i;
  };
  for (std::uint32_t k = 0; k <= n; ++k) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      for (std::uint32_t i = 0; i <= n; ++i) mesh.points.push_back({1.0 * i, 1.0 * j, 1.0 * k});
    }
  }
  std::int32_t region = 0;
  for (std::uint32_t k = 0; k < n; ++k) {
    for (std::uint32_t j = 0; j < n; ++j) {
      for (std::uint32_t i = 0; i < n; ++i) {
        const Nodes c{point(i, j, k),
                      point(i + 1, j, k),
                      point(i + 1, j + 1, k),
                      point(i, j + 1, k),
                      point(i, j, k + 1),
                      point(i + 1, j, k + 1),
                      point(i + 1, j + 1, k + 1),
                      point(i, j + 1, k + 1)};
        const auto add = [&](CellKind kind, const Nodes& nodes) {
          append_cell(mesh, kind, nodes);
          columns_of(mesh, kind).region.push_back(++region);
        };
        // Prisms meet prisms above and below in triangles: all of a pillar are alike.
        const std::uint32_t choice = (i + j) % 3 == 0 ? 1 : random() % 2 == 0 ? 0 : 2;
        if (choice == 0) add(CellKind::hexahedron8, c);
        if (choice == 1) {
          add(CellKind::prism6, {c[0], c[1], c[2], c[4], c[5], c[6]});
          add(CellKind::prism6, {c[0], c[2], c[3], c[4], c[6], c[7]});
        }
        if (choice != 2) continue;
        const auto middle = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back({i + 0.5, j + 0.5, k + 0.5});
        for (const FaceCorners& f : faces_of(CellKind::hexahedron8)) {
          // A pyramid's base looks at its tip from below.
          add(CellKind::pyramid5, {c[f[3]], c[f[2]], c[f[1]], c[f[0]], middle});
        }
      }
    }
  }
  // Faces stay plane, so that the volume is that of any way to cut them: a shear.
  for (Point& p : mesh.points) p = {p[0] + 0.2 * p[1], p[1] - 0.1 * p[2], 1.5 * p[2]};
  Nodes order(mesh.points.size()), place(order.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), random);
  std::vector<Point> points(order.size());
  for (std::uint32_t p = 0; p < order.size(); ++p) points[order[p]] = mesh.points[p];
  mesh.points = std::move(points);
  for (const CellKind kind : all_cell_kinds) {
    for (std::uint32_t& node : nodes_of(mesh, kind)) node = order[node];
  }
  return mesh;
}

double volume_of(const FileMesh& mesh) {
  double sum = 0;
  for (const CellKind kind : all_cell_kinds) {
    const CellRows rows = rows_of(mesh, kind);
    for (std::size_t i = 0; i < rows.count; ++i) {
      sum += std::abs(six_volumes_of(mesh, linear_kind(kind), rows[i])) / 6;
    }
  }
  return sum;
}

FileMesh one_cell(CellKind kind, std::vector<Point> points, Nodes nodes) {
  FileMesh mesh;
  mesh.points = std::move(points);
  append_cell(mesh, kind, nodes);
  return mesh;
}

}  // namespace

TEST_CASE("hexahedra, prisms and pyramids become tetrahedra that glue, however numbered",
          "[mesh][split]") {
  const unsigned seed = Catch::rngSeed() != 0 ? Catch::rngSeed() : 20261125;
  INFO("seed " << seed);
  Random random(seed);
  for (int round = 0; round < 20; ++round) {
    FileMesh mesh = block_of_kinds(3, random);
    INFO("round " << round);
    const double volume = volume_of(mesh);
    CHECK(volume == Approx(27 * 1.5).epsilon(1e-12));
    // The quadrilaterals of the boundary are cut as the cells behind them.
    FileMesh skin = boundary_surface(mesh).mesh;
    const std::size_t quads = rows_of(skin, CellKind::quad4).count;
    const std::size_t triangles = skin.triangles.corners.size() + 2 * quads;
    const SplitCells report = split_cells(mesh);
    CHECK(report.concave_volumes == 0);
    CHECK(report.empty_parts == 0);
    CHECK(report.tetrahedra == mesh.tetrahedra.corners.size());
    CHECK(cell_count(mesh) == report.tetrahedra);
    const MeshCheck check = check_file_mesh(mesh);
    CHECK(std::ranges::none_of(check.findings,
                               [](const Finding& f) { return f.severity != Severity::note; }));
    REQUIRE(check.counts);
    // All faces inside glue: the boundary is the block's, and the Betti numbers are a ball's.
    CHECK(check.counts->boundary_faces == triangles);
    CHECK(check.counts->betti == std::array<std::ptrdiff_t, 3>{1, 0, 0});
    CHECK(check.counts->volume == Approx(volume).epsilon(1e-12));
    CHECK(mesh.tetrahedra.region.size() == mesh.tetrahedra.corners.size());
  }
}

TEST_CASE("quadrilaterals and polygons are cut as the cells that they bound", "[mesh][split]") {
  Random random(3);
  FileMesh mesh = block_of_kinds(2, random);
  const FileMesh skin = boundary_surface(mesh).mesh;
  // The skin's points are fewer, in their order: rows of the body are its numbers less one.
  for (const CellKind kind : {CellKind::triangle, CellKind::quad4}) {
    const CellRows rows = rows_of(skin, kind);
    for (std::size_t i = 0; i < rows.count; ++i) {
      Nodes nodes(rows[i].begin(), rows[i].end());
      for (std::uint32_t& node : nodes) {
        if (skin.source_point_id.empty()) continue;
        node = static_cast<std::uint32_t>(skin.source_point_id[node] - 1);
      }
      append_cell(mesh, kind, nodes);
    }
  }
  split_cells(mesh);
  const MeshCheck check = check_file_mesh(mesh);
  CHECK(std::ranges::none_of(check.findings, [](const Finding& f) {
    return f.code == "stray_triangle" || f.code == "interface_triangle";
  }));
  REQUIRE(check.counts);
  CHECK(check.counts->boundary_faces == mesh.triangles.corners.size());
}

TEST_CASE("a polygon is a fan around its least corner", "[mesh][split]") {
  FileMesh mesh =
      one_cell(CellKind::polygon, {{1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1.5, 0}, {0, 0.5, 0}},
               {3, 4, 0, 1, 2});
  other_cells(mesh, CellKind::polygon).region = {8};
  other_cells(mesh, CellKind::polygon).source_id = {70};
  const SplitCells report = split_cells(mesh);
  CHECK(report.triangles == 3);
  CHECK(report.concave_faces == 0);
  CHECK(report.bent_polygons == 0);
  CHECK(mesh.triangles.corners ==
        std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  CHECK(mesh.triangles.region == std::vector<std::int32_t>{8, 8, 8});
  CHECK(mesh.triangles.source_id == std::vector<std::int64_t>{70, 71, 72});
}

TEST_CASE("concave, bent and collapsed cells are counted", "[mesh][split]") {
  // The corner with row 0 does not see corner 2 through corner 1.
  FileMesh concave =
      one_cell(CellKind::quad4, {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1.5, 1, 0}}, {0, 3, 2, 1});
  CHECK(split_cells(concave).concave_faces == 1);
  FileMesh bent =
      one_cell(CellKind::polygon, {{1, 0, 0}, {2, 1, 0}, {1, 2, 0.5}, {0, 1.5, 0}, {0, 0.5, 0}},
               {0, 1, 2, 3, 4});
  CHECK(split_cells(bent).bent_polygons == 1);
  // A hexahedron with an upper face collapsed to an edge: a prism lying down.
  FileMesh collapsed = one_cell(
      CellKind::hexahedron8, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0.5, 1}, {1, 0.5, 1}},
      {0, 1, 2, 3, 4, 5, 5, 4});
  const SplitCells report = split_cells(collapsed);
  CHECK(report.empty_parts > 0);
  CHECK(report.concave_volumes == 0);
  CHECK(collapsed.tetrahedra.corners.size() == 3);
  CHECK(volume_of(collapsed) == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("concave and bent are told alike of cells of any size", "[mesh][split]") {
  CHECK(SplitCells{}.numbers_added == 0);
  for (const double size : {1e-3, 1.0, 1e3}) {
    INFO("size " << size);
    const auto scaled = [size](CellKind kind, std::vector<Point> points,
                               const std::vector<std::uint32_t>& nodes) {
      for (Point& x : points) {
        for (double& v : x) v *= size;
      }
      FileMesh mesh = one_cell(kind, points, nodes);
      return split_cells(mesh);
    };
    for (const double off : {1e-7, 1e-4}) {
      const SplitCells report =
          scaled(CellKind::polygon, {{1, 0, 0}, {2, 1, 0}, {1, 2, off}, {0, 1.5, 0}, {0, 0.5, 0}},
                 {0, 1, 2, 3, 4});
      CHECK(report.bent_polygons == (off > 1e-6 ? 1 : 0));
      CHECK(report.concave_faces == 0);
      CHECK(report.numbers_added == 0);
    }
    CHECK(scaled(CellKind::quad4, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 3})
              .concave_faces == 0);
    std::vector<Point> cube;
    for (int i = 0; i < 8; ++i)
      cube.push_back({i % 4 == 1 || i % 4 == 2 ? 1.0 : 0, i % 4 >= 2 ? 1.0 : 0, i >= 4 ? 1.0 : 0});
    CHECK(scaled(CellKind::hexahedron8, cube, {0, 1, 2, 3, 4, 5, 6, 7}).concave_volumes == 0);
  }
}
