// SPDX-License-Identifier: MIT
// The order of data columns over all kinds of cells, compared with one that is found again each
// time; kinds contradict each other, and a name stands twice.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "topology/mesh/kinds/column_order.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using suite::below;

namespace {

using Random = std::mt19937_64;
using Columns = std::vector<const DataColumn*>;

/// Of the columns left the first that none is left right before; of all where each has one.
Columns ordered(const FileMesh& mesh) {
  Columns left, order;
  std::map<std::string, std::set<std::string>> before;
  for (const CellKind kind : all_cell_kinds) {
    const DataColumn* last = nullptr;
    for (const DataColumn& column : columns_of(mesh, kind).data) {
      const auto is_same = [&](const DataColumn* c) { return c->name == column.name; };
      if (std::ranges::none_of(left, is_same)) left.push_back(&column);
      if (last != nullptr && last->name != column.name) before[column.name].insert(last->name);
      last = &column;
    }
  }
  while (!left.empty()) {
    const auto is_free = [&](const DataColumn* column) {
      return std::ranges::none_of(
          left, [&](const DataColumn* c) { return before[column->name].contains(c->name); });
    };
    auto next = std::ranges::find_if(left, is_free);
    if (next == left.end()) next = left.begin();
    order.push_back(*next);
    left.erase(next);
  }
  return order;
}

std::string names(const Columns& columns) {
  std::string all;
  for (const DataColumn* column : columns) all += column->name;
  return all;
}

}  // namespace

TEST_CASE("columns of random kinds stand in the order that is looked for one by one",
          "[mesh][columns]") {
  Random random(6);
  std::size_t rising = 0;
  for (int round = 0; round < 3000; ++round) {
    FileMesh mesh;
    const std::size_t letters = 1 + below(random, 8), kinds = 1 + below(random, 5);
    for (std::size_t k = 0; k < kinds; ++k) {
      auto& data = columns_of(mesh, all_cell_kinds[below(random, cell_kinds)]).data;
      for (std::size_t i = below(random, 5); i > 0; --i) {
        const std::string name(1, static_cast<char>('a' + below(random, letters)));
        data.push_back({name, 1, NumberType::float64, std::vector<double>{}});
      }
    }
    const Columns got = ordered_cell_columns(mesh), expected = ordered(mesh);
    INFO("round " << round << ": " << names(got) << ", not " << names(expected));
    REQUIRE(got == expected);
    rising += got.size() > 3;
  }
  CHECK(rising > 500);
}
