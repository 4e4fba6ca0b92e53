// SPDX-License-Identifier: MIT
// MEDIT's cells of second order: where their nodes are, as sections such as HexahedraQ2Ordering
// say.
#include "topology/io/medit/medit_order.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A mesh of one cell of a kind, its points where its nodes' places are.
std::string medit_of(CellKind kind, std::string_view keyword, std::string_view order,
                     const std::vector<std::size_t>& listed) {
  const std::vector<io::BezierPlace> places = io::bezier_places(kind);
  const std::size_t numbers = io::medit_order_of(kind)->numbers;
  std::string points, rows, nodes;
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const io::BezierPlace& p = places[listed[i]];
    points +=
        std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + " 0\n";
    for (std::size_t k = 0; k < numbers; ++k) rows += std::to_string(p[k]) + " ";
    rows += "\n";
    nodes += std::to_string(i + 1) + " ";
  }
  const std::string count = std::to_string(listed.size());
  return "MeshVersionFormatted 2\nDimension 3\n" + std::string(keyword) + "\n1\n" + nodes +
         "7\nVertices\n" + count + "\n" + points +
         (order.empty() ? "" : std::string(order) + "\n" + count + "\n" + rows) + "End\n";
}

}  // namespace

TEST_CASE("MEDIT's cells of second order have their nodes where an order section says",
          "[io][medit][cells]") {
  for (const io::MeditOrder& order : io::medit_orders) {
    const std::string keyword(order.keyword.substr(0, order.keyword.size() - 8));
    INFO(keyword);
    const std::size_t n = traits_of(order.kind).nodes;
    std::vector<std::size_t> listed(n);
    for (std::size_t i = 0; i < n; ++i) listed[i] = n - 1 - i;
    const auto mesh =
        read_file_mesh(medit_of(order.kind, keyword, order.keyword, listed), "a.mesh");
    REQUIRE(mesh);
    CHECK(mesh.findings.empty());
    const CellRows rows = rows_of(*mesh, order.kind);
    REQUIRE(rows.count == 1);
    CHECK(columns_of(*mesh, order.kind).region == std::vector<std::int32_t>{7});
    for (std::size_t k = 0; k < n; ++k) CHECK(rows[0][k] == n - 1 - k);

    const Folder folder;
    for (const char* name : {"a.mesh", "a.meshb"}) {
      INFO(name);
      CHECK(write_file_mesh(folder.path() / name, *mesh).empty());
      const auto back = read_file_mesh(folder.path() / name);
      REQUIRE(back);
      CHECK(back->points == mesh->points);
      REQUIRE(rows_of(*back, order.kind).count == 1);
      CHECK(std::ranges::equal(rows_of(*back, order.kind)[0], rows[0]));
    }
  }
}

TEST_CASE("without an order section MEDIT's curved cells but simplices are read by their corners",
          "[io][medit][cells]") {
  for (const io::MeditOrder& order : io::medit_orders) {
    const std::string keyword(order.keyword.substr(0, order.keyword.size() - 8));
    INFO(keyword);
    std::vector<std::size_t> listed(traits_of(order.kind).nodes);
    for (std::size_t i = 0; i < listed.size(); ++i) listed[i] = i;
    const auto mesh = read_file_mesh(medit_of(order.kind, keyword, "", listed), "a.mesh");
    REQUIRE(mesh);
    const bool is_open = io::needs_medit_order(order.kind);
    CHECK((summary(mesh.findings).find("corners_only") != std::string::npos) == is_open);
    CHECK(rows_of(*mesh, is_open ? linear_kind(order.kind) : order.kind).count == 1);
  }
}

TEST_CASE("an order section that leaves a node without its own place is refused",
          "[io][medit][cells]") {
  const auto refused = [](std::string_view rows) {
    return read_file_mesh(
        "MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 0 0\nEdgesP2Ordering\n" +
            std::string(rows) + "End\n",
        "a.mesh");
  };
  CHECK(refused("3\n0\n1\n2\n"));
  for (const char* rows : {"3\n0\n2\n2\n", "3\n0\n2\n3\n", "2\n0\n2\n", "4\n0\n2\n1\n1\n", "0\n",
                           "3\n0\n2\n1\nEdgesP2Ordering\n3\n0\n2\n1\n"}) {
    INFO(rows);
    const auto mesh = refused(rows);
    REQUIRE_FALSE(mesh);
    CHECK(mesh.findings[0].line >= 6);
  }
}
