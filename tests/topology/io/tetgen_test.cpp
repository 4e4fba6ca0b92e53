// SPDX-License-Identifier: MIT
// TetGen's files: those of TetGen and meshio, which file may be named, data and markers, the
// remains of an earlier mesh.
#include <zlib.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <set>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

void write(const std::filesystem::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

constexpr std::string_view points = "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
constexpr std::string_view cell = "1 4 0\n0 0 1 2 3\n";

}  // namespace

TEST_CASE("TetGen's own files are read, whichever is named", "[io][tetgen]") {
  const std::string ending = GENERATE(".node", ".ele", ".face", ".edge");
  const Result<FileMesh> mesh = read_file_mesh(sample("tetgen.1" + ending));
  INFO(ending << ": " << summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh.findings.empty());
  CHECK(mesh->points.size() == 12);
  CHECK(mesh->source_point_id.empty());
  CHECK(mesh->tetrahedra.corners.size() == 12);
  CHECK(std::set(mesh->tetrahedra.region.begin(), mesh->tetrahedra.region.end()) ==
        std::set<std::int32_t>{3, 7});
  CHECK(mesh->triangles.corners.size() == 34);
  CHECK(mesh->triangles.region.size() == 34);
  CHECK(mesh->edges.corners.size() == 33);
  CHECK(mesh->point_region == std::vector<std::int32_t>{1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2});
  REQUIRE(mesh->point_data.size() == 1);
  CHECK(mesh->point_data[0].name == "attribute");
  CHECK(std::get<0>(mesh->point_data[0].values)[11] == 11.5);
  CHECK(volume(tet_mesh_of(FileMesh(*mesh))) == Approx(1.7).epsilon(1e-12));
}

TEST_CASE("TetGen's second-order files are read by their corners to compute with", "[io][tetgen]") {
  const Result<FileMesh> mesh = read_file_mesh(sample("tetgen_2nd.1.ele"), {.simplices = true});
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(summary(mesh.findings) == "note corners_only 2");
  CHECK(mesh->tetrahedra.corners.size() == 12);
  CHECK(mesh->triangles.corners.size() == 34);
  CHECK(mesh->edges.corners.size() == 33);
  CHECK(volume(tet_mesh_of(FileMesh(*mesh))) == Approx(1.7).epsilon(1e-12));
  const Result<FileMesh> first = read_file_mesh(sample("tetgen.1.node"));
  CHECK(mesh->triangles.region == first->triangles.region);
  CHECK(mesh->edges.region == first->edges.region);
}

TEST_CASE("meshio's TetGen files are read with the names of their data", "[io][tetgen]") {
  const Result<FileMesh> mesh = read_file_mesh(sample("meshio.node"));
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh.findings.empty());
  CHECK(mesh->points.size() == 23);
  CHECK(mesh->tetrahedra.corners.size() == 48);
  CHECK(std::set(mesh->tetrahedra.region.begin(), mesh->tetrahedra.region.end()) ==
        std::set<std::int32_t>{3, 7});
  // Its marker is whatever data there is, here no integers.
  REQUIRE(mesh->point_data.size() == 1);
  CHECK(mesh->point_data[0].name == "height");
}

TEST_CASE("points are enough, other files and their packed forms come along", "[io][tetgen]") {
  const Folder folder;
  const auto node = folder.path() / "a.b.node";
  write(node, points);
  Result<FileMesh> mesh = read_file_mesh(node);
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->points.size() == 4);
  CHECK(mesh->tetrahedra.corners.empty());
  write(folder.path() / "a.b.ele", cell);
  CHECK(read_file_mesh(node)->tetrahedra.corners.size() == 1);
  std::filesystem::remove(folder.path() / "a.b.ele");
  const std::string zipped = (folder.path() / "a.b.ele.gz").string();
  const gzFile out = gzopen(zipped.c_str(), "wb");
  REQUIRE(gzwrite(out, cell.data(), static_cast<unsigned>(cell.size())) > 0);
  REQUIRE(gzclose(out) == Z_OK);
  CHECK(read_file_mesh(node)->tetrahedra.corners.size() == 1);
  CHECK(read_file_mesh(folder.path() / "a.b.ele.gz")->tetrahedra.corners.size() == 1);
}

TEST_CASE("points may be numbered from any number", "[io][tetgen]") {
  const Folder folder;
  write(folder.path() / "a.node", "# four\n\n4  3\n7 0 0 0 # here\n8 1 0 0\r\n9 0 1 0\n10 0 0 1");
  write(folder.path() / "a.ele", "1\n\n# it\n5 7 8 9 10");
  const Result<FileMesh> mesh = read_file_mesh(folder.path() / "a.ele");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->source_point_id == std::vector<std::int64_t>{7, 8, 9, 10});
  CHECK(mesh->tetrahedra.source_id == std::vector<std::int64_t>{5});
  CHECK(mesh->tetrahedra.corners[0] == std::array<std::uint32_t, 4>{0, 1, 2, 3});
}

TEST_CASE("names of data come back whatever they are", "[io][tetgen]") {
  const Folder folder;
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  mesh.region_name = {};
  const auto with_names = [](std::vector<std::string> names, std::size_t rows) {
    std::vector<DataColumn> columns;
    for (std::string& name : names) {
      const std::size_t components = 1 + columns.size() % 3;
      columns.push_back({std::move(name), components, NumberType::float64,
                         std::vector<double>(rows * components, 4)});
    }
    return columns;
  };
  const std::vector<std::string> odd = {"region", "", "a, b", "x*3", "100% \n\"#\"", "\xc3\xa9"};
  mesh.point_data = with_names(odd, 5);
  mesh.tetrahedra.data = with_names(odd, 2);
  const bool has_region = GENERATE(true, false);
  const bool has_marker = GENERATE(true, false);
  if (!has_region) mesh.tetrahedra.region.clear();
  if (has_marker) mesh.point_region = {1, 0, -7, 2147483647, 0};
  const auto path = folder.path() / "m.node";
  const auto findings = write_file_mesh(path, mesh);
  INFO(summary(findings));
  CHECK(findings.empty());
  const Result<FileMesh> back = read_file_mesh(path);
  INFO(summary(back.findings));
  REQUIRE(back);
  CHECK(back->point_data == mesh.point_data);
  CHECK(back->tetrahedra == mesh.tetrahedra);
  CHECK(back->point_region == mesh.point_region);
}

TEST_CASE("triangles and edges of an earlier mesh do not stay", "[io][tetgen]") {
  const Folder folder;
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  mesh.triangles.corners = {{0, 1, 2}};
  mesh.edges.corners = {{0, 1}};
  CHECK_FALSE(has_error(write_file_mesh(folder.path() / "m.ele", mesh)));
  CHECK(folder.names() ==
        std::vector<std::string>{"m.edge", "m.ele", "m.face", "m.node", "m.node.regions"});
  CHECK(read_file_mesh(folder.path() / "m.face")->region_name == mesh.region_name);
  mesh.triangles = {};
  mesh.edges = {};
  CHECK_FALSE(has_error(write_file_mesh(folder.path() / "m.node", mesh)));
  const Result<FileMesh> back = read_file_mesh(folder.path() / "m.node");
  REQUIRE(back);
  CHECK(*back == mesh);
  CHECK_FALSE(has_error(write_file_mesh(folder.path() / "new.node", mesh)));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "new.face"));
}

TEST_CASE("what TetGen's files do not hold is told", "[io][tetgen]") {
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  mesh.triangles.corners = {{0, 1, 2}};
  mesh.triangles.data = {{"t", 1, NumberType::float64, std::vector<double>{1}}};
  mesh.vertices.corners = {{0}};
  const auto lost =
      lost_on_writing(mesh, {.format = MeshFormat::tetgen, .version = {}, .encoding = {}});
  CHECK(summary(lost) == "warning cells_lost 0, warning data_lost 0");
}

TEST_CASE("a file named as TetGen's is known by its content all the same", "[io][tetgen]") {
  const Folder folder;
  std::filesystem::copy(sample("gmsh.mesh"), folder.path() / "a.node");
  const Result<FileMesh> mesh = read_file_mesh(folder.path() / "a.node");
  REQUIRE(mesh);
  CHECK(summary(mesh.findings) == "note misleading_name 0");
  write(folder.path() / "b.node", "no numbers");
  CHECK(summary(read_file_mesh(folder.path() / "b.node").findings) == "error unknown_format 0");
  write(folder.path() / "b.poly", points);
  const auto findings = read_file_mesh(folder.path() / "b.poly").findings;
  REQUIRE(summary(findings) == "error unknown_format 0");
  CHECK(findings[0].remedy.find("tetgen -p") != std::string::npos);
}
