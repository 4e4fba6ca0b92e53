// SPDX-License-Identifier: MIT
// Files that were read wrongly once, each with its content: cells, labels, and findings.
#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

using Regions = std::vector<std::int32_t>;

FileMesh fault(const std::string& name, const std::string& said = "") {
  const Result<FileMesh> mesh = read_file_mesh(sample("faults/" + name));
  std::string texts;
  for (const Finding& f : mesh.findings) {
    CHECK(f.severity == Severity::warning);
    texts += f.text + "; ";
  }
  INFO(name << ": " << texts);
  REQUIRE(mesh);
  CHECK(texts == said);
  return *mesh;
}

double volume_of(const FileMesh& mesh) { return volume(tet_mesh_of(FileMesh(mesh))); }

}  // namespace

TEST_CASE("partitioned MSH keeps its groups, and the partition as a column", "[io][faults][msh]") {
  const FileMesh mesh = fault("two_parts.msh");
  CHECK(mesh.tetrahedra.region == Regions{7, 8});
  CHECK(mesh.tetrahedra.entity == Regions{1, 2});
  CHECK(mesh.region_name[3] == std::map<std::int32_t, std::string>{{7, "core"}, {8, "shell"}});
  REQUIRE(mesh.tetrahedra.data.size() == 1);
  CHECK(mesh.tetrahedra.data[0].name == "partition");
  CHECK(mesh.tetrahedra.data[0].type == NumberType::int32);
  CHECK(std::get<1>(mesh.tetrahedra.data[0].values) == std::vector<std::int64_t>{1, 2});
}

TEST_CASE("sections and times that a mesh does not hold are reported", "[io][faults][msh]") {
  const FileMesh sections =
      fault("sections.msh", "sections are left out: $ElementNodeData, $Periodic; ");
  REQUIRE(sections.tetrahedra.data.size() == 1);
  CHECK(std::get<1>(sections.tetrahedra.data[0].values) == std::vector<std::int64_t>{2});
  const FileMesh steps =
      fault("two_steps.msh", "times of data are left out: t of step 1, time 1; ");
  REQUIRE(steps.point_data.size() == 2);
  CHECK(std::get<0>(steps.point_data[1].values) == std::vector<double>{15, 16, 17, 18});
}

TEST_CASE("names of MSH 2.0 go to the dimension whose cells have the group", "[io][faults][msh]") {
  const FileMesh mesh = fault("two_zero.msh");
  CHECK(mesh.tetrahedra.region == Regions{5});
  CHECK(mesh.triangles.region == Regions{6});
  CHECK(mesh.region_name[3] == std::map<std::int32_t, std::string>{{5, "core"}});
  CHECK(mesh.region_name[2] == std::map<std::int32_t, std::string>{{6, "rim"}});
}

TEST_CASE("Nastran's replication and tabs are read", "[io][faults][nastran]") {
  const FileMesh images = fault("rep.bdf");
  using Corners = std::array<std::uint32_t, 4>;
  CHECK(images.tetrahedra.corners == std::vector<Corners>{{0, 1, 2, 3}, {4, 2, 1, 3}});
  CHECK(images.tetrahedra.region == Regions{1, 1});
  CHECK(volume_of(fault("tabs.bdf")) == Approx(1 / 6.0));
  CHECK(volume_of(fault("tab_xyz.bdf")) == Approx(10 / 6.0));
}

TEST_CASE("decks are known by the lines before BEGIN BULK", "[io][faults][nastran]") {
  const std::string cards = "cards are left out: PSOLID; lines before BEGIN BULK are left out: ";
  for (const auto& [name, words] : {std::pair{"deck.fem", "ANALYSIS, SUBCASE, LOAD; "},
                                    {"case_first.bdf", "DISPLACEMENT, SUBCASE, LOAD; "},
                                    {"control.bdf", "SOL; "}}) {
    Result<FileMesh> mesh = read_file_mesh(sample(std::string("faults/") + name));
    std::erase_if(mesh.findings, [](const Finding& f) { return f.code == "misleading_name"; });
    REQUIRE(mesh);
    CHECK(mesh->points.size() == 4);
    CHECK(mesh->tetrahedra.region == Regions{1});
    std::string said;
    for (const Finding& f : mesh.findings) said += f.text + "; ";
    CHECK(said == cards + words);
  }
}

TEST_CASE("attributes of VTK are kept, or left out with a warning", "[io][faults][vtk]") {
  struct Case {
    std::string name, said, array;
    std::vector<double> values;
  };
  const Case cases[] = {
      {"one.vtk", "", "", {}},
      {"grid_field.vtk", "field data of the grid are left out: TIME, load_steps; ", "", {}},
      {"grid_field.vtu", "field data of the grid are left out: TimeValue, load_steps; ", "", {}},
      {"string_field.vtk", "data that are strings are left out: names; ", "", {}},
      {"string_field_of_grid.vtk", "field data of the grid are left out: Title; ", "", {}},
      {"global_ids.vtk", "", "nodes", {3, 5, 7, 9}},
      {"pedigree_ids.vtk", "", "nodes", {3, 5, 7, 9}},
      {"edge_flags.vtk", "", "e", {1, 1, 1, 1}},
      {"lower_case_lookup.vtk", "", "a", {1, 2, 3, 4}},
      {"color_scalars.vtk", "", "c", {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1}},
      {"tangents.vtk", "", "t", {1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}},
      {"tensors6.vtk", "", "q", {1, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0,
                                 1, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0}}};
  for (const Case& c : cases) {
    const FileMesh mesh = fault(c.name, c.said);
    INFO(c.name);
    CHECK(mesh.points.size() == 4);
    CHECK(mesh.tetrahedra.corners.size() == 1);
    REQUIRE(mesh.point_data.size() == (c.array.empty() ? 0 : 1));
    if (c.array.empty()) continue;
    CHECK(mesh.point_data[0].name == c.array);
    CHECK(std::visit([](const auto& v) { return std::vector<double>(v.begin(), v.end()); },
                     mesh.point_data[0].values) == c.values);
  }
  CHECK(std::get<1>(fault("global_ids.vtk").tetrahedra.data.at(0).values).at(0) == 7);
}

TEST_CASE("surfaces without normals, with strips, and with a header in any order are read",
          "[io][faults][surface]") {
  const FileMesh bare = fault("bare.stl");
  CHECK(bare.points.size() == 4);
  CHECK(bare.triangles.corners.size() == 4);
  const FileMesh strip = fault("strip.ply");
  using Corners = std::array<std::uint32_t, 3>;
  CHECK(strip.triangles.corners == std::vector<Corners>{{0, 1, 2}, {2, 1, 3}});
  const FileMesh off = fault("ncoff.off", "data of points are left out: normals, colours; ");
  CHECK(off.points.size() == 3);
  CHECK(off.triangles.corners.size() == 1);
}
