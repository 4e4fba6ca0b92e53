// SPDX-License-Identifier: MIT
// Cells get nodes in the middles of their edges, and curved ones are reported.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <set>

#include "topology/mesh/kinds/move_cells.hpp"
#include "topology/mesh/kinds/second_order.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

/// Two cells of every kind of first order but vertices, on points of their own, corners shared.
FileMesh some_cells() {
  FileMesh mesh;
  for (int k = 0; k < 12; ++k) {
    mesh.points.push_back({std::sin(3.0 * k), std::cos(7.0 * k), std::sin(11.0 * k + 1)});
  }
  for (const CellKind kind : all_cell_kinds) {
    if (linear_kind(kind) != kind || kind == CellKind::polygon) continue;
    for (std::uint32_t shift : {0U, 2U}) {
      std::vector<std::uint32_t> nodes;
      for (std::uint32_t k = 0; k < traits_of(kind).corners; ++k) nodes.push_back(shift + k);
      append_cell(mesh, kind, nodes);
    }
    columns_of(mesh, kind).region = {4, 5};
  }
  append_cell(mesh, CellKind::polygon, std::array<std::uint32_t, 5>{0, 1, 2, 3, 4});
  return mesh;
}

/// The pairs of corners that edges of cells of first order join, found by their distances alone: a
/// node is the middle of its edge.
std::set<std::pair<std::uint32_t, std::uint32_t>> edges_in(const FileMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const CellKind kind : all_cell_kinds) {
    const CellRows rows = rows_of(mesh, kind);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      for (const auto& [i, j] : edges_of(linear_kind(kind))) {
        edges.insert(std::minmax(rows[row][i], rows[row][j]));
      }
    }
  }
  return edges;
}

}  // namespace

TEST_CASE("every shape has as many edges as Euler says, each corner as often as edges meet there",
          "[topology][kinds]") {
  for (const CellKind kind : all_cell_kinds) {
    if (linear_kind(kind) != kind || traits_of(kind).dimension != 3) continue;
    const std::size_t edges = edges_of(kind).size();
    CHECK(traits_of(kind).corners + faces_of(kind).size() == edges + 2);
    CHECK(traits_of(raised_kind(kind)).nodes == traits_of(kind).corners + edges);
    // Two faces meet at each edge.
    std::map<std::pair<int, int>, int> at;
    for (const FaceCorners& face : faces_of(kind)) {
      const std::size_t n = face[3] == face[2] ? 3 : 4;
      for (std::size_t k = 0; k < n; ++k) ++at[std::minmax<int>(face[k], face[(k + 1) % n])];
    }
    CHECK(at.size() == edges);
    for (const auto& [i, j] : edges_of(kind)) CHECK((at[std::minmax<int>(i, j)] == 2));
  }
  CHECK(edges_of(CellKind::vertex).empty());
  CHECK(edges_of(CellKind::polygon).empty());
  CHECK(raised_kind(CellKind::vertex) == CellKind::vertex);
  CHECK(raised_kind(CellKind::tetrahedron10) == CellKind::tetrahedron10);
}

TEST_CASE("raised cells have one node an edge, in its middle, and go back to what they were",
          "[topology][kinds]") {
  const FileMesh before = some_cells();
  FileMesh mesh = before;
  const std::size_t added = raise_order(mesh);
  const auto edges = edges_in(before);
  CHECK(added == edges.size());
  CHECK(mesh.points.size() == before.points.size() + added);
  std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> ends;
  for (const CellKind kind : all_cell_kinds) {
    CHECK(curved_cells(mesh, kind).count == 0);
    const CellKind raised = raised_kind(kind);
    if (raised == kind) continue;
    CHECK(rows_of(mesh, kind).size() == 0);
    const CellRows rows = rows_of(mesh, raised);
    REQUIRE(rows.size() == 2);
    CHECK(columns_of(mesh, raised).region == std::vector<std::int32_t>{4, 5});
    for (std::size_t row = 0; row < 2; ++row) {
      for (std::size_t e = 0; e < edges_of(kind).size(); ++e) {
        const auto [i, j] = edges_of(kind)[e];
        const std::pair<std::uint32_t, std::uint32_t> at = std::minmax(rows[row][i], rows[row][j]);
        const std::uint32_t node = rows[row][traits_of(kind).corners + e];
        CHECK(ends.try_emplace(node, at).first->second == at);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          CHECK(mesh.points[node][axis] ==
                0.5 * (mesh.points[at.first][axis] + mesh.points[at.second][axis]));
        }
      }
    }
  }
  make_linear(mesh);
  mesh.points.resize(before.points.size());
  CHECK(mesh == before);
  CHECK(rows_of(before, CellKind::polygon).size() == 1);
}

TEST_CASE("what is said of points goes on to the middles, and nodes that are there serve",
          "[topology][kinds]") {
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1.5, 0.5, 0}};
  mesh.source_point_id = {7, 3, 9, 4};
  mesh.point_region = {1, 1, 2, 0};
  mesh.point_data = {{"heat", 1, NumberType::float64, std::vector<double>{1, 3, 5, 0}},
                     {"kind", 1, NumberType::int32, std::vector<std::int64_t>{6, 6, 8, 0}}};
  append_cell(mesh, CellKind::triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  // The node of the edge 1-2 is off its middle.
  append_cell(mesh, CellKind::edge3, std::array<std::uint32_t, 3>{2, 1, 3});
  CHECK(raise_order(mesh) == 2);
  CHECK(mesh.source_point_id == std::vector<std::int64_t>{7, 3, 9, 4, 10, 11});
  CHECK(mesh.point_region == std::vector<std::int32_t>{1, 1, 2, 0, 1, 0});
  CHECK(std::get<0>(mesh.point_data[0].values) == std::vector<double>{1, 3, 5, 0, 2, 3});
  CHECK(std::get<1>(mesh.point_data[1].values) == std::vector<std::int64_t>{6, 6, 8, 0, 6, 0});
  const auto nodes = rows_of(mesh, CellKind::triangle6)[0];
  CHECK(std::vector(nodes.begin(), nodes.end()) == std::vector<std::uint32_t>{0, 1, 2, 4, 3, 5});
  const CurvedCells curved = curved_cells(mesh, CellKind::triangle6);
  CHECK(curved.count == 1);
  CHECK(curved.first == 0);
  CHECK(curved.most == Approx(std::sqrt(0.5) / std::sqrt(8.0)));
  CHECK(curved_cells(mesh, CellKind::edge3).count == 1);
  CHECK(curved_cells(mesh, CellKind::triangle).count == 0);
}

TEST_CASE("an edge counts as bent from a millionth of its length on", "[topology][kinds]") {
  for (const double off : {0.5e-6, 2e-6}) {
    FileMesh mesh;
    mesh.points = {{0, 0, 0}, {4, 0, 0}, {2, 4 * off, 0}};
    append_cell(mesh, CellKind::edge3, std::array<std::uint32_t, 3>{0, 1, 2});
    CHECK(curved_cells(mesh, CellKind::edge3).count == (off > 1e-6 ? 1 : 0));
  }
}
