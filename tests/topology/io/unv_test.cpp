// SPDX-License-Identifier: MIT
// Universal files: gmsh's, the data sets of others, groups as regions, refusals.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

std::string section(const std::string& number, const std::string& lines) {
  return "    -1\n  " + number + "\n" + lines + "    -1\n";
}

const std::string nodes =
    section("2411",
            "1 1 1 11\n0.0D+00 0.0D+00 0.0D+00\n2 1 1 11\n1.0D+00 0. 0.\n3 1 1 11\n0. 1.0E+00 0.\n"
            "4 1 1 11\n0. 0. 1.0d0\n");

const std::string tetrahedra = section("2412", "7 111 1 1 7 4\n1 2 3 4\n9 111 1 1 7 4\n2 1 3 4\n");

FileMesh read_whole(const std::string& text) {
  const Result<FileMesh> mesh = read_file_mesh(text, "a.unv");
  INFO(text << summary(mesh.findings));
  for (const Finding& f : mesh.findings) UNSCOPED_INFO(f.text);
  REQUIRE(mesh);
  CHECK(mesh.findings.empty());
  return *mesh;
}

}  // namespace

TEST_CASE("gmsh's universal files hold the mesh they were made from", "[io][unv]") {
  const Result<FileMesh> mesh = read_file_mesh(sample("gmsh.unv"));
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh.findings.empty());
  const Result<FileMesh> source = read_file_mesh(sample("gmsh_41.msh"));
  CHECK(mesh->points == source->points);
  CHECK(mesh->tetrahedra.corners == source->tetrahedra.corners);
  CHECK(mesh->tetrahedra.region == source->tetrahedra.region);
  CHECK(mesh->triangles.corners == source->triangles.corners);
  CHECK(mesh->triangles.region == source->triangles.region);
  CHECK(mesh->region_name[3] == source->region_name[3]);
  CHECK(mesh->region_name[2].at(9) == "all_around");
}

TEST_CASE("groups of nodes are vertices, groups of elements regions of their dimension",
          "[io][unv]") {
  const Result<FileMesh> block = read_file_mesh(sample("gmsh_block_1.unv"));
  REQUIRE(block);
  CHECK(columns_of(*block, CellKind::hexahedron8).region == std::vector<std::int32_t>{5, 5});
  CHECK(columns_of(*block, CellKind::quad4).region == std::vector<std::int32_t>{6});
  CHECK(block->edges.region == std::vector<std::int32_t>{8, 8});
  CHECK(block->region_name[3] == std::map<std::int32_t, std::string>{{5, "block"}});
  CHECK(block->region_name[2] == std::map<std::int32_t, std::string>{{6, "bottom"}});
  CHECK(block->region_name[1] == std::map<std::int32_t, std::string>{{8, "rim"}});
  const Result<FileMesh> sets = read_file_mesh(sample("gmsh_sets.unv"));
  REQUIRE(sets);
  CHECK(sets->vertices.corners.size() == 20);
  CHECK(sets->region_name[0].at(5) == "block");
}

TEST_CASE("tables of properties are regions where there are no groups", "[io][unv]") {
  const std::string tables = section("2412", "7 111 3 1 7 4\n1 2 3 4\n9 111 5 1 7 4\n2 1 3 4\n");
  const FileMesh without = read_whole(nodes + tables);
  CHECK(without.tetrahedra.region == std::vector<std::int32_t>{3, 5});
  CHECK(without.tetrahedra.entity.empty());
  const FileMesh with =
      read_whole(nodes + tables + section("2467", "2 0 0 0 0 0 0 1\ncore\n8 9 0 0\n"));
  CHECK(with.tetrahedra.region == std::vector<std::int32_t>{0, 2});
  CHECK(with.tetrahedra.entity == std::vector<std::int32_t>{3, 5});
}

TEST_CASE("colours and materials are columns where they differ within the file", "[io][unv]") {
  const auto color = [](const std::vector<DataColumn>& columns, const std::string& name) {
    for (const DataColumn& c : columns) {
      if (c.name == name) return std::get<std::vector<std::int64_t>>(c.values);
    }
    return std::vector<std::int64_t>{};
  };
  using Numbers = std::vector<std::int64_t>;
  const FileMesh same = read_whole(nodes + tetrahedra);
  CHECK(same.tetrahedra.data.empty());
  CHECK(same.point_data.empty());
  const FileMesh own =
      read_whole(nodes + section("2412", "7 111 1 2 7 4\n1 2 3 4\n9 111 1 5 3 4\n2 1 3 4\n"));
  CHECK(color(own.tetrahedra.data, "color") == Numbers{7, 3});
  CHECK(color(own.tetrahedra.data, "material") == Numbers{2, 5});
  const FileMesh old = read_whole(
      nodes + section("780", "7 111 1 1 1 2 7 4\n1 2 3 4\n9 111 1 1 1 5 3 4\n2 1 3 4\n"));
  CHECK(old == own);
  // Of two kinds, each with one colour.
  const FileMesh kinds =
      read_whole(nodes + section("2412", "7 111 1 1 7 4\n1 2 3 4\n8 91 1 1 4 3\n1 2 3\n"));
  CHECK(color(kinds.tetrahedra.data, "color") == Numbers{7});
  CHECK(color(kinds.triangles.data, "color") == Numbers{4});
  CHECK(color(kinds.tetrahedra.data, "material").empty());
  std::string painted = nodes;
  painted.replace(painted.find("2 1 1 11"), 8, "2 1 1 12");
  CHECK(color(read_whole(painted + tetrahedra).point_data, "color") == Numbers{11, 12, 11, 11});
}

TEST_CASE("old data sets say the same as new ones", "[io][unv]") {
  const FileMesh expected = read_whole(nodes + tetrahedra);
  CHECK(expected.tetrahedra.source_id == std::vector<std::int64_t>{7, 9});
  const std::string old_nodes = section(
      "15",
      "1 0 0 11 0. 0. 0.\n2 0 0 11 1.00000E+00 0. 0.\n3 0 0 11 0. 1. 0.\n4 0 0 11 0. 0. 1.\n");
  CHECK(read_whole(old_nodes + tetrahedra) == expected);
  CHECK(read_whole(section("781", nodes.substr(14, nodes.size() - 21)) + tetrahedra) == expected);
  const std::string old_tetrahedra =
      section("780", "7 111 1 1 1 1 7 4\n1 2 3 4\n9 111 1 1 1 1 7 4\n2 1 3 4\n");
  CHECK(read_whole(nodes + old_tetrahedra) == expected);
  CHECK(read_whole(section("151", "a name\nof the file\n") + section("164", "1 SI 2\n1. 1. 1.\n") +
                   tetrahedra + nodes) == expected);
}

TEST_CASE("beams have a line with their orientation, rods have none or have it", "[io][unv]") {
  const std::string orientation = "0 0 0\n";
  const FileMesh expected =
      read_whole(nodes + section("2412", "1 21 1 1 7 2\n" + orientation + "1 2\n2 21 1 1 7 2\n" +
                                             orientation + "2 3\n"));
  CHECK(expected.edges.corners.size() == 2);
  CHECK(read_whole(nodes + section("2412", "1 11 1 1 7 2\n1 2\n2 11 1 1 7 2\n2 3\n")) == expected);
  CHECK(read_whole(nodes + section("2412", "1 11 1 1 7 2\n" + orientation + "1 2\n2 22 1 1 7 2\n" +
                                               orientation + "2 3\n")) == expected);
  const FileMesh curved = read_whole(nodes + section("2412", "1 24 1 1 7 3\n0 0 0\n1 3 2\n"));
  CHECK(rows_of(curved, CellKind::edge3)[0][2] == 2);  // the midpoint stands last
}

TEST_CASE("groups of all known data sets become regions, and what is in two keeps the first",
          "[io][unv]") {
  for (const std::string number : {"2435", "2452", "2467", "2477"}) {
    const FileMesh mesh =
        read_whole(nodes + tetrahedra + section(number, "3 0 0 0 0 0 0 1\ncore\n8 9 0 0\n"));
    CHECK(mesh.tetrahedra.region == std::vector<std::int32_t>{0, 3});
    CHECK(mesh.region_name[3] == std::map<std::int32_t, std::string>{{3, "core"}});
  }
  for (const std::string number : {"2417", "2429", "2430", "2432"}) {
    const FileMesh mesh =
        read_whole(nodes + tetrahedra + section(number, "3 0 0 0 0 0 0 2\ncore\n8 9 8 7\n"));
    CHECK(mesh.tetrahedra.region == std::vector<std::int32_t>{3, 3});
  }
  const Result<FileMesh> twice = read_file_mesh(
      nodes + tetrahedra +
          section("2467",
                  "3 0 0 0 0 0 0 2\ncore\n8 9 0 0 8 7 0 0\n3 0 0 0 0 0 0 1\nother\n8 9 0 0\n"
                  "4 0 0 0 0 0 0 2\nnone\n8 55 0 0 1 2 0 0\n"),
      "a.unv");
  REQUIRE(twice);
  CHECK(twice->tetrahedra.region == std::vector<std::int32_t>{3, 3});
  CHECK(summary(twice.findings).find("several_sets") != std::string::npos);
  CHECK(summary(twice.findings).find("unknown_member") != std::string::npos);
  CHECK(summary(twice.findings).find("skipped_members") != std::string::npos);
}

TEST_CASE("what is no part of the mesh is passed over, and told", "[io][unv]") {
  const Result<FileMesh> mesh =
      read_file_mesh(nodes + tetrahedra + section("55", "results\n") + section("2414", "1\n") +
                         section("2412", "20 136 1 1 7 2\n1 2\n"),
                     "a.unv");
  REQUIRE(mesh);
  std::string said;
  for (const Finding& f : mesh.findings) said += f.text + "\n";
  CHECK(said.find("data sets are left out: 55, 2414") != std::string::npos);
  CHECK(said.find("1 element of type 136 is left out") != std::string::npos);
}

TEST_CASE("what the reader of universal files does not take is named", "[io][unv]") {
  struct Defect {
    std::string text, code;
    std::size_t line;
    std::string says;
  };
  const std::string turned =
      section("2420", "1\npart\n1 0 8\nsystem\n1. 0. 0.\n0. 0. 1.\n0. 1. 0.\n0. 0. 0.\n");
  const Defect defects[] = {
      {nodes.substr(0, nodes.size() - 7), "truncated_file", 11, "no line -1"},
      {tetrahedra, "missing_section", 8, "no nodes"},
      {turned + nodes, "unsupported_keyword", 14, "node 1 is given in the coordinate system 1"},
      {section("2411", "1 1 1 11\n0. 0.\n"), "bad_number", 4, "the end of a line"},
      {section("2411", "1 1 1 11\n"), "truncated_file", 4, "coordinates"},
      {nodes + section("2411", "3 1 1 11\n0. 0. 0.\n"), "duplicate_id", 14, "same number 3"},
      {nodes + section("2412", "7 111 1 1 7 4\n1 2 3\n5 111 1 1 7 4\n"), "wrong_count", 16,
       "6 in this line"},
      {nodes + section("2412", "7 111 1 1 7 4\n1 2 3 4 1\n"), "wrong_count", 15, "5 in this line"},
      {nodes + section("2412", "7 111 1\n"), "wrong_count", 14, "6 numbers"},
      {nodes + section("2412", "7 111 1 1 7 4\n1 2 3 8\n"), "index_out_of_range", 14, "point 8"},
      {nodes + section("2412", "7 111 1 1 7 900\n1 2 3 8\n"), "count_too_big", 14, "900 nodes"},
      {nodes + tetrahedra + section("2467", "3 0 0 0 0 0 0 9\ncore\n8 9 0 0\n"), "count_too_big",
       21, "9 members"},
  };
  for (const Defect& d : defects) {
    const Result<FileMesh> mesh = read_file_mesh(d.text, "a.unv");
    INFO(d.text << summary(mesh.findings));
    REQUIRE_FALSE(mesh);
    INFO(mesh.findings[0].text);
    CHECK(mesh.findings[0].code == d.code);
    CHECK(mesh.findings[0].line == d.line);
    CHECK(mesh.findings[0].text.find(d.says) != std::string::npos);
  }
}

TEST_CASE("regions, numbers and names come back from a universal file", "[io][unv]") {
  const Folder folder;
  const auto path = folder.path() / "a.unv";
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  mesh.source_point_id = {9, 4, 107, 1, 2};
  mesh.vertices.corners = {{0}, {3}, {1}};
  mesh.vertices.region = {4, -7, 4};
  mesh.edges.corners = {{0, 1}};
  mesh.triangles.corners = {{0, 1, 2}, {1, 2, 3}};
  mesh.triangles.region = {0, 6};
  mesh.region_name = {};
  mesh.region_name[0] = {{4, "pinned"}};
  mesh.region_name[2] = {{6, "out let, 1"}};
  REQUIRE(write_file_mesh(path, mesh).empty());
  CHECK(*read_file_mesh(path) == mesh);
  // Names that a group cannot have are reported.
  mesh.region_name[2] = {{6, "-1"}, {5, "of none"}};
  const std::vector<Finding> told = write_file_mesh(path, mesh);
  REQUIRE(told.size() == 1);
  CHECK(told[0].code == "names_lost");
  CHECK(told[0].count == 2);
  CHECK(read_file_mesh(path)->triangles.region == mesh.triangles.region);
}

TEST_CASE("numbers that count on once hexahedra are left out say nothing, with vertices too",
          "[io][unv]") {
  const std::string text =
      nodes +
      section("2411",
              "5 1 1 11\n1. 1. 0.\n6 1 1 11\n1. 0. 1.\n7 1 1 11\n0. 1. 1.\n"
              "8 1 1 11\n1. 1. 1.\n") +
      section("2412", "1 111 1 1 7 4\n1 2 3 4\n5 115 1 1 7 8\n1 2 5 3 4 6 8 7\n") +
      section("2467", "1 0 0 0 0 0 0 1\ncorner\n7 1 0 0\n");
  const Result<FileMesh> whole = read_file_mesh(text, "a.unv");
  REQUIRE(whole);
  CHECK(whole->tetrahedra.source_id == std::vector<std::int64_t>{1});
  const Result<FileMesh> part = read_file_mesh(text, "a.unv", {.tetrahedra_only = true});
  REQUIRE(part);
  CHECK(part->vertices.corners.size() == 1);
  CHECK(part->tetrahedra.source_id.empty());
}

TEST_CASE("lengths in units of the file's own become metres", "[io][unv]") {
  const auto with = [](const std::string& factor) {
    return section("164",
                   "         1SI                           2\n" + factor + " 1. 1.\n273.15\n") +
           nodes + tetrahedra;
  };
  for (const std::string factor : {"1000.", "1.0D+03", "1.0e3"}) {
    const Result<FileMesh> mesh = read_file_mesh(with(factor), "a.unv");
    INFO(summary(mesh.findings));
    REQUIRE(mesh);
    CHECK(mesh->points[1] == Point{0.001, 0, 0});
    CHECK(summary(mesh.findings) == "note units_converted 3");
    CHECK(mesh.findings[0].text.find("divided by 1000") != std::string::npos);
  }
  CHECK(read_file_mesh(with("1.0D+00"), "a.unv").findings.empty());
  for (const std::string factor : {"0.", "-1.", "nan", "x"}) {
    const Result<FileMesh> mesh = read_file_mesh(with(factor), "a.unv");
    REQUIRE_FALSE(mesh);
    CHECK(mesh.findings[0].code == "bad_number");
    CHECK(mesh.findings[0].line == 4);
  }
}
