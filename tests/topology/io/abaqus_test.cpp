// SPDX-License-Identifier: MIT
// Abaqus' input: files of gmsh, meshio and CalculiX, sets and sections, our own files.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <set>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

using Regions = std::vector<std::int32_t>;
using Names = std::map<std::int32_t, std::string>;

Result<FileMesh> read(std::string_view text) {
  return read_file_mesh(text, "a.inp", {.simplices = true});
}

const std::string nodes = "*NODE\n1,0,0,0\n2,1\n3,0,1\n4,0,0,1\n5,1,1,1\n";
const std::string tets = "*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n2,2,3,4,5\n";

}  // namespace

TEST_CASE("gmsh's Abaqus files: groups are regions, entities are entities", "[io][abaqus]") {
  const Result<FileMesh> mesh = read_file_mesh(sample("gmsh.inp"));
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh.findings.empty());
  CHECK(mesh->points.size() == 23);
  CHECK(mesh->tetrahedra.corners.size() == 48);
  CHECK(mesh->triangles.corners.size() == 4);
  CHECK(mesh->region_name[3] == Names{{1, "shell"}, {2, "core"}});
  CHECK(mesh->region_name[2] == Names{{1, "all_around"}});
  CHECK(std::ranges::count(mesh->tetrahedra.region, 2) == 24);
  CHECK(std::set(mesh->tetrahedra.entity.begin(), mesh->tetrahedra.entity.end()) ==
        std::set<std::int32_t>{1, 2});
  CHECK(volume(tet_mesh_of(FileMesh(*mesh))) == Approx(1.7).epsilon(1e-12));
}

TEST_CASE("gmsh's second-order Abaqus files are read by their corners to compute with",
          "[io][abaqus]") {
  const Result<FileMesh> mesh = read_file_mesh(sample("gmsh_2nd.inp"), {.simplices = true});
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->tetrahedra.corners.size() == 48);
  CHECK(mesh->triangles.corners.size() == 44);
  CHECK(mesh->edges.corners.size() == 20);
  CHECK(volume(tet_mesh_of(FileMesh(*mesh))) == Approx(1.7).epsilon(1e-12));
}

TEST_CASE("meshio's Abaqus files are read, numbers with points too", "[io][abaqus]") {
  const Result<FileMesh> mesh = read_file_mesh(sample("meshio.inp"));
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->tetrahedra.corners.size() == 48);
  CHECK(volume(tet_mesh_of(FileMesh(*mesh))) == Approx(1.7).epsilon(1e-12));
}

TEST_CASE("CalculiX' files are included, a material's set is the region", "[io][abaqus]") {
  const Result<FileMesh> mesh = read_file_mesh(sample("calculix.inp"));
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->points.size() == 23);
  CHECK(mesh->tetrahedra.corners.size() == 48);
  CHECK(mesh->region_name[3] == Names{{1, "Ecore"}, {2, "Eshell"}});
  CHECK(std::ranges::count(mesh->tetrahedra.region, 1) == 24);
  CHECK(volume(tet_mesh_of(FileMesh(*mesh))) == Approx(1.7).epsilon(1e-12));
}

TEST_CASE("keywords are read in any case, with blanks, comments and long lines", "[io][abaqus]") {
  const Result<FileMesh> mesh = read(R"(

** a comment
*Heading
 whatever, *NODE
* node , nset = Ends
 10 , 0., 0.D0, +0.0E0
** in between
 20 , 1.
30,, 1
 40, 0, 0, 1.0,
*Element, type=C3D10M,
 elset="the body"
7, 10, 20, 30, 40, 10, 10, 10,
 10, 10, 10
*ELEMENT, TYPE=S3R
8, 10, 20, 30
*ELEMENT, TYPE=B31
9, 10, 20
*ELEMENT, TYPE=S4
11, 10, 20, 30, 40
*NSET, NSET=fixed
10, 20,
*nset, nset=ENDS
30
*BOUNDARY
fixed, 1, 3
)");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(summary(mesh.findings) ==
        "warning curved_cells 14, note corners_only 14, note skipped_cells 21, "
        "note skipped_data 26");
  CHECK(mesh->points == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  CHECK(mesh->source_point_id == std::vector<std::int64_t>{10, 20, 30, 40});
  CHECK(mesh->tetrahedra.corners[0] == std::array<std::uint32_t, 4>{0, 1, 2, 3});
  CHECK(mesh->tetrahedra.source_id == std::vector<std::int64_t>{7});
  CHECK(mesh->region_name[3] == Names{{1, "the body"}});
  CHECK(mesh->triangles.corners.size() == 1);
  CHECK(mesh->triangles.region.empty());
  CHECK(mesh->edges.corners.size() == 1);
  CHECK(mesh->region_name[0] == Names{{1, "Ends"}, {2, "fixed"}});
  CHECK(mesh->vertices.region == Regions{1, 1, 1, 1, 2, 2, 1});
}

TEST_CASE("sets name numbers, ranges and sets", "[io][abaqus]") {
  const Result<FileMesh> mesh = read(nodes + tets + R"(*ELSET, ELSET=a
2
*ELSET, ELSET=b, GENERATE
-5, 7, 6
*ELSET, ELSET=c
a, b
*NSET, NSET=odd, GENERATE
1, 1000000000000, 2
*NSET, NSET=both
odd, 2
)");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh.findings.empty());
  CHECK(mesh->tetrahedra.region == Regions{2, 1});
  CHECK(mesh->region_name[3] == Names{{1, "a"}, {2, "b"}});
  CHECK(mesh->vertices.corners ==
        std::vector<std::array<std::uint32_t, 1>>{{0}, {2}, {4}, {0}, {2}, {4}, {1}});
  CHECK(mesh->vertices.region == Regions{1, 1, 1, 2, 2, 2, 2});
}

TEST_CASE("an element of several sets keeps the first and says so", "[io][abaqus]") {
  const std::string sets = "*ELSET,ELSET=a\n1\n*ELSET,ELSET=b\n1,2\n*ELSET,ELSET=c\n1\n";
  Result<FileMesh> mesh = read(nodes + tets + sets);
  REQUIRE(mesh);
  CHECK(summary(mesh.findings) == "warning several_sets 0");
  CHECK(mesh.findings[0].count == 1);
  CHECK(mesh->region_name[3] == Names{{1, "a"}, {2, "b"}});
  CHECK(mesh->tetrahedra.region == Regions{1, 2});
  SECTION("a set of all elements gives way, and what Abaqus made for itself") {
    mesh = read(nodes + tets +
                "*ELSET,ELSET=all\n1,2\n*ELSET,ELSET=_x,INTERNAL\n1\n*ELSET,ELSET=a\n1\n");
    REQUIRE(mesh);
    CHECK(mesh.findings.empty());
    CHECK(mesh->region_name[3] == Names{{1, "all"}, {2, "a"}});
    CHECK(mesh->tetrahedra.region == Regions{2, 1});
  }
  SECTION("a section's set goes first") {
    mesh = read(nodes + tets + sets + "*SOLID SECTION, MATERIAL=x, ELSET=C\n");
    REQUIRE(mesh);
    CHECK(mesh->region_name[3] == Names{{1, "b"}, {2, "c"}});
    CHECK(mesh->tetrahedra.region == Regions{2, 1});
  }
  SECTION("members that are not there") {
    mesh = read(nodes + tets + "*ELSET,ELSET=a\n1,77\n*NSET,NSET=n\n99\n");
    REQUIRE(mesh);
    CHECK(summary(mesh.findings) == "warning unknown_member 0, warning unknown_member 0");
  }
}

TEST_CASE("one part in one place is the mesh", "[io][abaqus]") {
  const Result<FileMesh> mesh =
      read("*Heading\n*Part, name=P\n" + nodes + tets +
           "*End Part\n*Assembly, name=A\n*Instance, name=P-1, part=P\n*End Instance\n"
           "*Nset, nset=fixed, instance=P-1\n2\n*Elset, elset=e, instance=P-1, generate\n1,2,1\n"
           "*End Assembly\n");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh.findings.empty());
  CHECK(mesh->region_name[3] == Names{{1, "e"}});
  CHECK(mesh->region_name[0] == Names{{1, "fixed"}});
}

TEST_CASE("what is written has words for regions and keeps their numbers beside", "[io][abaqus]") {
  const Folder folder;
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  mesh.vertices.corners = {{3}, {1}};
  mesh.triangles.corners = {{0, 1, 2}};
  mesh.triangles.region = {-4};
  mesh.point_data = {{"u", 1, NumberType::float64, std::vector<double>(5)}};
  const auto path = folder.path() / "m.inp";
  const auto findings = write_file_mesh(path, mesh);
  CHECK(summary(findings) == "warning data_lost 0, note names_beside 0");
  const std::string text = bytes_of(path);
  INFO(text);
  CHECK(text.find("*ELEMENT, TYPE=C3D4, ELSET=body\n2, 1, 2, 3, 4\n") != std::string::npos);
  CHECK(text.find("*ELEMENT, TYPE=C3D4, ELSET=foot_of_it\n3, 2, 1, 3, 5\n") != std::string::npos);
  CHECK(text.find("*ELEMENT, TYPE=S3, ELSET=region_-4\n1, 1, 2, 3\n") != std::string::npos);
  CHECK(text.find("*NSET, NSET=region_0\n4, 2\n") != std::string::npos);
  mesh.point_data.clear();
  Result<FileMesh> back = read_file_mesh(path);
  REQUIRE(back);
  CHECK(*back == mesh);
  // Without the separate list the words are the names.
  std::filesystem::remove(folder.path() / "m.inp.regions");
  back = read_file_mesh(path);
  REQUIRE(back);
  CHECK(back->region_name[3] == Names{{1, "body"}, {2, "foot_of_it"}});
  CHECK(back->triangles.region == Regions{-4});
}

TEST_CASE("numbers are written so that their first 20 characters are one too", "[io][abaqus]") {
  const Folder folder;
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  mesh.points[0] = {1.1102230246251565e-16, -1.2345678901234567e-5, 6.123233995736766e-33};
  mesh.points[1] = {0.1 + 0.2, -1.0 / 3, 1e-40 / 3};
  const auto path = folder.path() / "m.inp";
  REQUIRE_FALSE(has_error(write_file_mesh(path, mesh)));
  const std::string text = bytes_of(path);
  const std::string line = text.substr(text.find("\n1, ") + 4);
  INFO(line.substr(0, 200));
  CHECK(line.substr(0, 20) == "0.000000000000000111");
  CHECK(read_file_mesh(path)->points == mesh.points);
}

TEST_CASE("what Abaqus' input does not hold is told", "[io][abaqus]") {
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  const WriteOptions options{
      .format = MeshFormat::abaqus, .version = {}, .encoding = {}, .pack = false};
  CHECK(lost_on_writing(mesh, options).empty());
  mesh.vertices.corners = {{0}};
  mesh.vertices.source_id = {4};
  CHECK(summary(lost_on_writing(mesh, options)) == "warning source_ids_lost 0");
  mesh.vertices = {};
  mesh.source_point_id = {0, 1, 2, 3, 4};
  CHECK(summary(lost_on_writing(mesh, options)) == "warning source_ids_lost 0");
  mesh.source_point_id = {5, 4, 3, 2, 1};
  mesh.tetrahedra.source_id = {3, 9};
  CHECK(lost_on_writing(mesh, options).empty());
  mesh.tetrahedra.source_id = {3, 3};
  CHECK(summary(lost_on_writing(mesh, options)) == "warning source_ids_lost 0");
  mesh.tetrahedra = {};
  mesh.tetrahedra.corners = {{0, 1, 2, 3}};
  mesh.tetrahedra.entity = {4};
  mesh.point_region = {1, 2, 3, 4, 5};
  CHECK(summary(lost_on_writing(mesh, options)) ==
        "warning entities_lost 0, warning point_regions_lost 0");
}

TEST_CASE("an instance that is moved by nothing is read", "[io][abaqus]") {
  const std::string head =
      "*PART, NAME=p\n*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n"
      "*END PART\n*ASSEMBLY, NAME=a\n*INSTANCE, NAME=i, PART=p\n";
  const std::string tail = "*END INSTANCE\n*END ASSEMBLY\n";
  for (const std::string place :
       {"", "0,0,0\n", "0., -0.0, 0.D0\n", "0\n", ", ,\n", "0,0,0\n1,2,3,4,5,6,0.\n"}) {
    const Result<FileMesh> mesh = read_file_mesh(head + place + tail, "a.inp");
    INFO(place << summary(mesh.findings));
    REQUIRE(mesh);
    CHECK(mesh.findings.empty());
    CHECK(mesh->tetrahedra.corners.size() == 1);
  }
  for (const std::string place : {"0,0,1e-9\n", "1,0,0\n", "0,0,0\n0,0,0,0,0,1,90.\n", "0,x,0\n"}) {
    const Result<FileMesh> mesh = read_file_mesh(head + place + tail, "a.inp");
    INFO(place << summary(mesh.findings));
    REQUIRE_FALSE(mesh);
    CHECK(mesh.findings[0].line == 11 + static_cast<std::size_t>(std::ranges::count(place, '\n')));
  }
}
