// SPDX-License-Identifier: MIT
// Cells of every kind that get nodes in the middles of their edges, and nodes off the middle, held
// against twins that take cells and edges one by one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "tests/support/cell_rows.hpp"
#include "tests/support/random_kinds.hpp"
#include "topology/mesh/kinds/second_order.hpp"

using namespace sunder;
using namespace sunder::test;
using suite::below;
using suite::unit;

namespace {

using Random = std::mt19937_64;
using Ends = std::pair<std::uint32_t, std::uint32_t>;

/// The ends of a cell's edge, the lower row first.
Ends ends_of(CellKind kind, const Rows& nodes, std::size_t edge) {
  const auto [i, j] = edges_of(linear_kind(kind))[edge];
  return {std::min(nodes[i], nodes[j]), std::max(nodes[i], nodes[j])};
}

std::size_t edge_count(CellKind kind) { return edges_of(linear_kind(kind)).size(); }

/// Values of the points between `ends`, behind those of the others.
void append_middles(DataColumn& column, const std::vector<Ends>& ends) {
  for (const auto& [a, b] : ends) {
    for (std::size_t k = 0; k < column.components; ++k) {
      const std::size_t at = a * column.components + k, other = b * column.components + k;
      if (auto* const reals = std::get_if<std::vector<double>>(&column.values)) {
        const double sum = reals->at(at) + reals->at(other);
        reals->push_back(0.5 * sum);
      } else {
        auto& numbers = std::get<std::vector<std::int64_t>>(column.values);
        const std::int64_t number = numbers.at(at) == numbers.at(other) ? numbers.at(at) : 0;
        numbers.push_back(number);
      }
    }
  }
}

/// A second implementation of raise_order.
std::size_t raise(FileMesh& mesh) {
  std::map<Ends, std::uint32_t> node;
  for (const CellKind kind : all_cell_kinds) {
    if (traits_of(kind).lower == kind) continue;
    for (const Rows& nodes : cells_of(mesh, kind)) {
      for (std::size_t e = 0; e < edge_count(kind); ++e)
        node.insert({ends_of(kind, nodes, e), nodes.at(traits_of(kind).corners + e)});
    }
  }
  std::vector<Ends> fresh;
  for (const CellKind kind : all_cell_kinds) {
    const CellKind raised = raised_kind(kind);
    const std::vector<Rows> cells = cells_of(mesh, kind);
    if (raised == kind || cells.empty()) continue;
    std::vector<Rows> all = cells_of(mesh, raised);
    const CellColumns columns =
        joined(columns_of(mesh, raised), all.size(), columns_of(mesh, kind), cells.size());
    for (Rows nodes : cells) {
      for (std::size_t e = 0; e < edge_count(kind); ++e) {
        const Ends ends = ends_of(kind, nodes, e);
        if (!node.contains(ends)) {
          node[ends] = static_cast<std::uint32_t>(mesh.points.size());
          Point middle{};
          for (std::size_t k = 0; k < 3; ++k)
            middle[k] = 0.5 * (mesh.points[ends.first][k] + mesh.points[ends.second][k]);
          mesh.points.push_back(middle);
          fresh.push_back(ends);
        }
        nodes.push_back(node[ends]);
      }
      all.push_back(nodes);
    }
    put(mesh, raised, all, columns);
    put(mesh, kind, {}, {});
  }
  std::int64_t last = 0;
  for (const std::int64_t id : mesh.source_point_id) last = std::max(last, id);
  for (const auto& [a, b] : fresh) {
    if (!mesh.source_point_id.empty()) mesh.source_point_id.push_back(++last);
    if (mesh.point_region.empty()) continue;
    const bool is_alike = mesh.point_region[a] == mesh.point_region[b];
    mesh.point_region.push_back(is_alike ? std::int32_t{mesh.point_region[a]} : 0);
  }
  for (DataColumn& column : mesh.point_data) append_middles(column, fresh);
  return fresh.size();
}

CurvedCells curved(const FileMesh& mesh, CellKind kind) {
  CurvedCells cells{0, 0, 0};
  if (traits_of(kind).lower == kind) return cells;
  const std::vector<Rows> rows = cells_of(mesh, kind);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    double most = 0;
    for (std::size_t e = 0; e < edge_count(kind); ++e) {
      const auto [a, b] = ends_of(kind, rows[row], e);
      const Point& node = mesh.points[rows[row].at(traits_of(kind).corners + e)];
      Point edge{}, off{};
      for (std::size_t k = 0; k < 3; ++k) {
        edge[k] = mesh.points[b][k] - mesh.points[a][k];
        off[k] = node[k] - 0.5 * (mesh.points[a][k] + mesh.points[b][k]);
      }
      const double length = std::hypot(edge[0], edge[1], edge[2]);
      const double distance = std::hypot(off[0], off[1], off[2]);
      // An edge of no length has its node in its middle, or as far off as can be measured.
      if (length == 0) most = std::max(most, distance == 0 ? 0.0 : 1.0);
      if (length > 0 && distance > 1e-6 * length) most = std::max(most, distance / length);
    }
    if (most == 0) continue;
    if (cells.count == 0) cells.first = row;
    ++cells.count;
    cells.most = std::max(cells.most, most);
  }
  return cells;
}

/// Adds up over all kinds how many are curved, and how many of these have a straight one before.
void hold_curved(const FileMesh& mesh, std::size_t& count, std::size_t& behind) {
  for (const CellKind kind : all_cell_kinds) {
    INFO(traits_of(kind).name);
    const CurvedCells got = curved_cells(mesh, kind), expected = curved(mesh, kind);
    CHECK(got.count == expected.count);
    CHECK(got.first == expected.first);
    CHECK(got.most == Approx(expected.most));
    count += got.count;
    behind += got.first > 0;
  }
}

}  // namespace

TEST_CASE("cells of every kind get nodes, and curved ones are told, one by one", "[mesh][kinds]") {
  Random random(20261126);
  std::size_t added = 0, count = 0, behind = 0;
  for (int round = 0; round < 120; ++round) {
    INFO("round " << round);
    FileMesh mesh = mesh_of_kinds(random);
    std::shuffle(mesh.source_point_id.begin(), mesh.source_point_id.end(), random);
    hold_curved(mesh, count, behind);
    // Straight cells are those that were of first order.
    for (const CellKind kind : all_cell_kinds) {
      if (round % 2 == 0 && traits_of(kind).lower != kind) put(mesh, kind, {}, {});
    }
    const std::size_t before = mesh.points.size();
    FileMesh expected = mesh;
    const std::size_t twin = raise(expected);
    CHECK(raise_order(mesh) == twin);
    REQUIRE(words(mesh) == words(expected));
    added += twin;
    hold_curved(mesh, count, behind);
    for (std::size_t p = before; p < mesh.points.size(); ++p) {
      if (below(random, 12) != 0) continue;
      const double size = std::pow(0.1, static_cast<double>(below(random, 9)));
      for (double& x : mesh.points[p]) x += size * (unit(random) - 0.5);
    }
    hold_curved(mesh, count, behind);
  }
  CHECK(added > 1000);
  CHECK(count > 1000);
  CHECK(behind > 50);
}

TEST_CASE("an edge of no length is curved as far as can be told where its node is elsewhere",
          "[mesh][kinds]") {
  FileMesh mesh;
  mesh.points = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3.25}, {1, 2, 3.5}};
  append_cell(mesh, CellKind::edge3, Rows{0, 1, 2});
  CHECK(curved_cells(mesh, CellKind::edge3).count == 0);
  CHECK(curved_cells(mesh, CellKind::edge3).first == 0);
  append_cell(mesh, CellKind::edge3, Rows{0, 1, 3});
  const CurvedCells curved = curved_cells(mesh, CellKind::edge3);
  CHECK(curved.count == 1);
  CHECK(curved.first == 1);
  CHECK(curved.most == 1);
  // One that is shorter than 1 is measured all the same: 0.25 off the middle, 0.5 long.
  mesh = {};
  mesh.points = {{0, 0, 0}, {0, 0, 0.5}, {0, 0.25, 0.25}};
  append_cell(mesh, CellKind::edge3, Rows{0, 1, 2});
  CHECK(curved_cells(mesh, CellKind::edge3).most == 0.5);
}
