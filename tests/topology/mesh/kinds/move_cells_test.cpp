// SPDX-License-Identifier: MIT
// Cells of every kind moved, taken, dealt and joined, compared with rows listed one by one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "tests/support/cell_rows.hpp"
#include "tests/support/random_kinds.hpp"
#include "topology/mesh/kinds/move_cells.hpp"
#include "topology/mesh/kinds/second_order.hpp"
#include "topology/mesh/kinds/split_cells.hpp"
#include "topology/mesh/kinds/take_rows.hpp"

using namespace sunder;
using namespace sunder::test;
using suite::below;
using suite::unit;

namespace {

using Random = std::mt19937_64;

FileMesh moved(FileMesh mesh, CellKind from, CellKind to) {
  std::vector<Rows> cells = cells_of(mesh, to), more = cells_of(mesh, from);
  if (more.empty()) return mesh;
  const std::size_t had = cells.size();
  for (Rows& nodes : more) {
    nodes.resize(traits_of(to).nodes);
    cells.push_back(nodes);
  }
  put(mesh, to, cells, joined(columns_of(mesh, to), had, columns_of(mesh, from), more.size()));
  put(mesh, from, {}, {});
  return mesh;
}

Rows random_rows(Random& random, std::size_t n) {
  Rows rows;
  for (std::size_t i = below(random, 2 * n); i > 0; --i)
    rows.push_back(static_cast<std::uint32_t>(below(random, n)));
  return rows;
}

}  // namespace

TEST_CASE("cells of another kind keep all that is said of them", "[mesh][kinds]") {
  Random random(20261125);
  for (int round = 0; round < 60; ++round) {
    INFO("round " << round);
    const FileMesh mesh = mesh_of_kinds(random);
    FileMesh expected = mesh, got = mesh;
    for (const CellKind kind : all_cell_kinds) {
      const CellKind to = traits_of(kind).lower;
      FileMesh one = mesh;
      if (to != kind) move_cells(one, kind, to);
      if (to != kind) REQUIRE(words(one) == words(moved(mesh, kind, to)));
      const CellKind linear = linear_kind(kind);
      if (linear != kind) expected = moved(expected, kind, linear);
      FileMesh without = mesh, dropped = mesh;
      put(without, kind, {}, {});
      drop_cells(dropped, kind);
      REQUIRE(words(dropped) == words(without));
    }
    make_linear(got);
    REQUIRE(words(got) == words(expected));
  }
}

TEST_CASE("columns of two lists are joined row by row, whatever only one of them has",
          "[mesh][kinds]") {
  Random random(1);
  for (int round = 0; round < 1000; ++round) {
    INFO("round " << round);
    const std::size_t rows = below(random, 4), more = 1 + below(random, 3);
    const CellColumns a = random_columns(random, rows), b = random_columns(random, more);
    CellColumns got = a, from = b;
    append_columns(got, rows, std::move(from), more);
    REQUIRE(words(got) == words(joined(a, rows, b, more)));
  }
}

TEST_CASE("rows of several kinds are dealt to the list of each", "[mesh][kinds]") {
  Random random(2);
  for (int round = 0; round < 150; ++round) {
    INFO("round " << round);
    FileMesh mesh = mesh_of_kinds(random);
    std::vector<CellKind> kind_of_row;
    for (const CellKind kind : all_cell_kinds) {
      columns_of(mesh, kind) = {};
      kind_of_row.insert(kind_of_row.end(), rows_of(mesh, kind).count, kind);
    }
    std::shuffle(kind_of_row.begin(), kind_of_row.end(), random);
    const CellColumns all = random_columns(random, kind_of_row.size());
    FileMesh expected = mesh;
    for (const CellKind kind : all_cell_kinds) {
      Rows own;
      for (std::uint32_t i = 0; i < kind_of_row.size(); ++i) {
        if (kind_of_row[i] == kind) own.push_back(i);
      }
      if (own.empty()) continue;
      CellColumns& cells = columns_of(expected, kind) = some_of(all, own);
      const auto says_nothing = [](const auto& values) {
        return std::ranges::count(values, 0) == static_cast<std::ptrdiff_t>(values.size());
      };
      if (says_nothing(cells.region)) cells.region.clear();
      if (says_nothing(cells.entity)) cells.entity.clear();
      if (says_nothing(cells.source_id)) cells.source_id.clear();
      std::erase_if(cells.data, [](const DataColumn& c) {
        const auto* const reals = std::get_if<std::vector<double>>(&c.values);
        return reals != nullptr && std::ranges::count_if(*reals, [](double x) {
                                     return std::isnan(x);
                                   }) == static_cast<std::ptrdiff_t>(reals->size());
      });
    }
    CellColumns dealt = all;
    deal_columns(mesh, std::move(dealt), kind_of_row);
    REQUIRE(words(mesh) == words(expected));
  }
}

TEST_CASE("points and cells in another order take all that is said of them along",
          "[mesh][kinds]") {
  Random random(3);
  for (int round = 0; round < 60; ++round) {
    INFO("round " << round);
    const FileMesh mesh = mesh_of_kinds(random);
    for (const CellKind kind : all_cell_kinds) {
      const std::vector<Rows> cells = cells_of(mesh, kind);
      if (cells.empty()) continue;
      const Rows rows = random_rows(random, cells.size());
      FileMesh got = mesh, expected = mesh;
      take_cells(got, kind, rows);
      put(expected, kind, some_of(cells, rows, 1), some_of(columns_of(mesh, kind), rows));
      REQUIRE(words(got) == words(expected));
    }
    FileMesh got = mesh, expected = mesh;
    const Rows rows = random_rows(random, mesh.points.size());
    Rows new_row;
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      new_row.push_back(static_cast<std::uint32_t>(below(random, 90)));
    take_points(got, rows, new_row);
    expected.points = some_of(mesh.points, rows, 1);
    Rows number(mesh.points.size());
    std::iota(number.begin(), number.end(), 1U);
    expected.source_point_id = some_of(mesh.source_point_id, rows, 1);
    if (mesh.source_point_id.empty()) {
      const Rows taken = some_of(number, rows, 1);
      expected.source_point_id.assign(taken.begin(), taken.end());
    }
    expected.point_region = some_of(mesh.point_region, rows, 1);
    expected.point_data = some_of(mesh.point_data, rows);
    for (const CellKind kind : all_cell_kinds) {
      std::vector<Rows> cells = cells_of(mesh, kind);
      for (Rows& nodes : cells) nodes = some_of(new_row, nodes, 1);
      put(expected, kind, cells, columns_of(mesh, kind));
    }
    REQUIRE(words(got) == words(expected));
  }
}

TEST_CASE("points that no cell uses any more are dropped, and no others", "[mesh][kinds]") {
  Random random(4);
  for (int round = 0; round < 100; ++round) {
    INFO("round " << round);
    FileMesh mesh = mesh_of_kinds(random, 70);
    std::set<std::uint32_t> before, after;
    const auto used = [&](std::set<std::uint32_t>& nodes) {
      for (const CellKind kind : all_cell_kinds) {
        for (const Rows& cell : cells_of(mesh, kind)) nodes.insert(cell.begin(), cell.end());
      }
    };
    used(before);
    const std::vector<bool> used_before = used_points(mesh);
    for (std::uint32_t p = 0; p < mesh.points.size(); ++p)
      REQUIRE(used_before[p] == before.contains(p));
    if (below(random, 4) != 0) make_linear(mesh);
    used(after);
    FileMesh expected = mesh;
    Rows kept, new_row;
    for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
      new_row.push_back(static_cast<std::uint32_t>(kept.size()));
      if (!before.contains(p) || after.contains(p)) kept.push_back(p);
    }
    if (kept.size() < mesh.points.size()) take_points(expected, kept, new_row);
    const std::size_t all = mesh.points.size();
    CHECK(drop_points_out_of_use(mesh, used_before) == all - kept.size());
    REQUIRE(words(mesh) == words(expected));
  }
}

TEST_CASE("columns alike in all serve once each, without a name too", "[mesh][kinds]") {
  const auto column = [](std::int64_t value) {
    return DataColumn{"", 1, NumberType::int64, std::vector<std::int64_t>{value}};
  };
  CellColumns cells, others;
  cells.data = {column(1), column(2), column(3)};
  others.data = {column(4), column(5)};
  append_columns(cells, 1, std::move(others), 1);
  REQUIRE(cells.data.size() == 3);
  const std::int64_t expected[][2] = {{1, 4}, {2, 5}, {3, 0}};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(std::ranges::equal(std::get<1>(cells.data[i].values), expected[i]));
  }
}

TEST_CASE("kinds without cells keep their columns, which have no rows", "[mesh][kinds]") {
  FileMesh mesh;
  for (const CellKind kind : all_cell_kinds) {
    columns_of(mesh, kind).data = {
        {std::string(traits_of(kind).name), 1, NumberType::int64, std::vector<std::int64_t>{}}};
  }
  FileMesh linear = mesh, raised = mesh, cut = mesh;
  make_linear(linear);
  CHECK(linear == mesh);
  CHECK(raise_order(raised) == 0);
  CHECK(raised == mesh);
  CHECK(split_cells(cut).tetrahedra == 0);
  CHECK(cut == mesh);
}

TEST_CASE("a set of one kind has no other", "[mesh][kinds]") {
  for (const CellKind kind : all_cell_kinds) {
    const KindSet set = kind_set({kind});
    for (const CellKind other : all_cell_kinds) CHECK(contains(set, other) == (other == kind));
  }
}
