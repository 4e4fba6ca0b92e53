// SPDX-License-Identifier: MIT
// MSH 2.2, 4.0 and 4.1, text and binary: Gmsh's and meshio's files, the contents carried, and the
// way back.
#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "tests/support/io_support.hpp"
#include "topology/io/mesh_file.hpp"

using namespace sunder;
using namespace sunder::test;

TEST_CASE("Gmsh's and meshio's files of two boxes give one and the same body", "[io][msh]") {
  const auto* const name =
      GENERATE("gmsh_22.msh", "gmsh_41.msh", "gmsh_41_all.msh", "gmsh_41_parametric.msh",
               "gmsh_41_no_groups.msh", "meshio_22.msh", "meshio_41.msh", "gmsh_40.msh",
               "gmsh_22_binary.msh", "gmsh_41_binary.msh");
  INFO(name);
  const Result<TetMesh> mesh = read_mesh(sample(name));
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->points.size() == 23);
  CHECK(mesh->tetrahedra.size() == 48);
  CHECK(volume(*mesh) == Approx(1.7).epsilon(1e-12));  // 48 sums of volumes near 0.04
  CHECK(mesh->region.size() == 48);
  CHECK(std::set(mesh->region.begin(), mesh->region.end()).size() == 2);
}

TEST_CASE("physical groups become regions with names", "[io][msh]") {
  const auto* const name = GENERATE("gmsh_22.msh", "gmsh_41.msh", "gmsh_22_binary.msh",
                                    "gmsh_41_binary.msh", "gmsh_40.msh");
  const Result<TetMesh> mesh = read_mesh(sample(name));
  REQUIRE(mesh);
  CHECK(mesh->region_name == std::map<std::int32_t, std::string>{{3, "shell"}, {7, "core"}});
  for (std::size_t i = 0; i < mesh->region.size(); ++i) {
    double x = 0;
    for (const auto p : mesh->tetrahedra[i]) x += mesh->points[p][0] / 4;
    CHECK(mesh->region[i] == (x < 1 ? 7 : 3));
  }
}

TEST_CASE("without physical groups the volumes' numbers are the regions", "[io][msh]") {
  const Result<TetMesh> mesh = read_mesh(sample("gmsh_41_no_groups.msh"));
  REQUIRE(mesh);
  CHECK(std::set(mesh->region.begin(), mesh->region.end()) == std::set<std::int32_t>{1, 2});
  CHECK(mesh->region_name.empty());
}

TEST_CASE("surface, line and point elements are left out with a note", "[io][msh]") {
  const Result<TetMesh> mesh = read_mesh(sample("gmsh_41_all.msh"));
  REQUIRE(mesh.findings.size() == 1);
  CHECK(mesh.findings[0].code == "skipped_cells");
  CHECK(mesh.findings[0].severity == Severity::note);
  CHECK(mesh.findings[0].text.find("triangles") != std::string::npos);
  CHECK(mesh->source_tetrahedron_id.empty());  // they count on from the cells before them
}

TEST_CASE("second-order tetrahedra are read by their corners", "[io][msh]") {
  const Result<TetMesh> mesh = read_mesh(sample("gmsh_41_second_order.msh"));
  REQUIRE(mesh);
  CHECK(summary(mesh.findings) == "note skipped_cells 0, note corners_only 335");
  CHECK(mesh->tetrahedra.size() == 48);
  CHECK(volume(*mesh) == Approx(1.7).epsilon(1e-12));
}

TEST_CASE("a file keeps its surfaces, edges and points with their groups", "[io][msh]") {
  const auto* const name = GENERATE("gmsh_41.msh", "gmsh_41_binary.msh", "gmsh_40.msh",
                                    "gmsh_22.msh", "gmsh_22_binary.msh");
  INFO(name);
  const Result<FileMesh> mesh = read_file_mesh(sample(name));
  REQUIRE(mesh);
  CHECK(mesh.findings.empty());
  CHECK(mesh->triangles.corners.size() == 4);  // "all around" is one side of the first box
  CHECK(std::ranges::count(mesh->triangles.region, 9) == 4);
  CHECK(mesh->region_name[2] == std::map<std::int32_t, std::string>{{9, "all around"}});
  CHECK(mesh->region_name[3].size() == 2);
}

TEST_CASE("the two versions of MSH give the same mesh", "[io][msh]") {
  const Result<TetMesh> a = read_mesh(sample("gmsh_22.msh"));
  const Result<TetMesh> b = read_mesh(sample("gmsh_41.msh"));
  REQUIRE((a && b));
  CHECK(a->tetrahedra == b->tetrahedra);
  CHECK(a->points == b->points);
  CHECK(a->region == b->region);
}

TEST_CASE("a mesh written as MSH comes back in every bit", "[io][msh][round_trip]") {
  TetMesh mesh = two_tetrahedra();
  SECTION("with regions and their names") {}
  SECTION("with nothing but points and tetrahedra") {
    mesh.region.clear(), mesh.region_name.clear();
  }
  SECTION("with one region") { mesh.region = {7, 7}; }
  SECTION("with regions in turns") {
    mesh.tetrahedra.push_back({1, 2, 3, 4});
    mesh.region.push_back(2);
  }
  SECTION("with source numbers") {
    mesh.source_point_id = {9, 4, 1000000007, 1, 2};
    mesh.source_tetrahedron_id = {100, 50};
  }
  SECTION("with points that nothing uses") { mesh.points.push_back({1, 2, 3}); }
  const Folder folder;
  CHECK(write_mesh(folder.path() / "a.msh", mesh).empty());
  const Result<TetMesh> back = read_mesh(folder.path() / "a.msh");
  INFO(summary(back.findings));
  REQUIRE(back);
  CHECK(back.findings.empty());
  CHECK(identical(mesh, *back));
}

TEST_CASE("Gmsh's file survives reading, writing and reading again", "[io][msh][round_trip]") {
  const Result<TetMesh> mesh = read_mesh(sample("gmsh_41_all.msh"));
  REQUIRE(mesh);
  const Folder folder;
  CHECK(write_mesh(folder.path() / "a.msh", *mesh).empty());
  const Result<TetMesh> back = read_mesh(folder.path() / "a.msh");
  REQUIRE(back);
  CHECK(identical(*mesh, *back));
}

TEST_CASE("source numbers that MSH cannot hold are given up with a warning", "[io][msh]") {
  TetMesh mesh = two_tetrahedra();
  SECTION("because two points have the same") { mesh.source_point_id = {1, 2, 3, 4, 4}; }
  SECTION("because one is 0") { mesh.source_point_id = {0, 1, 2, 3, 4}; }
  const Folder folder;
  CHECK(summary(write_mesh(folder.path() / "a.msh", mesh)) == "warning source_ids_lost 0");
  const Result<TetMesh> back = read_mesh(folder.path() / "a.msh");
  REQUIRE(back);
  CHECK(back->tetrahedra == mesh.tetrahedra);
  CHECK(back->source_point_id.empty());
}

TEST_CASE("regions below 1 come back, with a warning about other readers", "[io][msh]") {
  TetMesh mesh = two_tetrahedra();
  mesh.region = {0, -4};
  const Folder folder;
  CHECK(summary(write_mesh(folder.path() / "a.msh", mesh)) == "warning region_not_positive 0");
  const Result<TetMesh> back = read_mesh(folder.path() / "a.msh");
  REQUIRE(back);
  CHECK(back->region == mesh.region);
}

TEST_CASE("line ends of Windows, blank lines, comments and a byte order mark do not matter",
          "[io][msh]") {
  std::string text =
      "\xef\xbb\xbf$Comments\nmade by hand\n$EndComments\n" + bytes_of(sample("gmsh_41.msh"));
  std::string windows;
  for (const char c : text) windows += c == '\n' ? "\r\n\r\n" : std::string(1, c);
  const Result<TetMesh> mesh = read_mesh(windows, "windows.msh");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(identical(*mesh, *read_mesh(sample("gmsh_41.msh"))));
}

TEST_CASE("the content decides the format, and a misleading name is noted", "[io]") {
  const Result<TetMesh> mesh = read_mesh(bytes_of(sample("gmsh_41.msh")), "mesh.vtu");
  REQUIRE(mesh);
  CHECK(summary(mesh.findings) == "note skipped_cells 0, note misleading_name 0");
}

TEST_CASE("cells of which only some have numbers are numbered anew, and it is said", "[io][msh]") {
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  mesh.tetrahedra.source_id = {100, 50};
  mesh.triangles.corners = {{0, 1, 2}};
  const Folder folder;
  CHECK(summary(write_file_mesh(folder.path() / "a.msh", mesh)) == "warning source_ids_lost 0");
  CHECK(read_file_mesh(folder.path() / "a.msh")->tetrahedra.source_id.empty());
  mesh.triangles.source_id = {7};
  CHECK(write_file_mesh(folder.path() / "a.msh", mesh).empty());
  CHECK(read_file_mesh(folder.path() / "a.msh")->tetrahedra.source_id == mesh.tetrahedra.source_id);
}

TEST_CASE("partitions of MSH 2.2 are a column, ghosts are reported", "[io][msh]") {
  const std::string head =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 "
      "1\n$EndNodes\n"
      "$Elements\n";
  const auto read = [&](const std::string& elements) {
    Result<FileMesh> mesh = read_file_mesh(head + elements + "$EndElements\n", "a.msh");
    INFO(summary(mesh.findings));
    REQUIRE(mesh);
    return mesh;
  };
  const Result<FileMesh> plain = read("2\n1 2 2 7 1 1 2 3\n2 4 4 5 1 1 3 1 2 3 4\n");
  CHECK(plain.findings.empty());
  CHECK(plain.value->triangles.data.empty());
  REQUIRE(plain.value->tetrahedra.data.size() == 1);
  CHECK(std::get<1>(plain.value->tetrahedra.data[0].values) == std::vector<std::int64_t>{3});
  const Result<FileMesh> ghosts = read("1\n2 4 6 5 1 3 2 -1 -4 1 2 3 4\n");
  CHECK(summary(ghosts.findings) == "warning skipped_data 13");
  CHECK(ghosts.findings[0].count == 2);
  CHECK(std::get<1>(ghosts.value->tetrahedra.data.at(0).values) == std::vector<std::int64_t>{2});
}

namespace {

/// A binary MSH 4.1 file of one tetrahedron in a partition, with sizes of the type `Size`.
template <class Size>
std::string binary_41(bool is_swapped) {
  std::string text = "$MeshFormat\n4.1 1 " + std::to_string(sizeof(Size)) + "\n";
  const auto put = [&](auto number) {
    std::string bytes(reinterpret_cast<const char*>(&number), sizeof number);
    if (is_swapped) bytes = {bytes.rbegin(), bytes.rend()};
    text += bytes;
  };
  const auto sizes = [&](std::initializer_list<Size> numbers) {
    for (const Size n : numbers) put(n);
  };
  const auto ints = [&](std::initializer_list<std::int32_t> numbers) {
    for (const std::int32_t n : numbers) put(n);
  };
  const auto reals = [&](std::initializer_list<double> numbers) {
    for (const double n : numbers) put(n);
  };
  ints({1});
  text += "\n$EndMeshFormat\n$Entities\n";
  sizes({0, 0, 0, 1});
  ints({9});
  reals({0, 0, 0, 1, 1, 1});
  sizes({1});
  ints({5});
  sizes({0});
  text += "\n$EndEntities\n$PartitionedEntities\n";
  sizes({2, 0, 0, 0, 0, 1});
  ints({10, 3, 9});
  sizes({1});
  ints({2});
  reals({0, 0, 0, 1, 1, 1});
  sizes({1});
  ints({5});
  sizes({2});
  ints({1, 2});
  text += "\n$EndPartitionedEntities\n$Nodes\n";
  sizes({2, 4, 1, 40});
  ints({2, 1, 1});
  sizes({1, 40});
  reals({0, 0, 1, 0.5, 0.5});
  ints({3, 10, 0});
  sizes({3, 1, 2, 3});
  reals({0, 0, 0, 1, 0, 0, 0, 1, 0});
  text += "\n$EndNodes\n$Elements\n";
  sizes({2, 2, 70, 71});
  ints({3, 10, 4});
  sizes({1, 70, 1, 2, 3, 40});
  ints({2, 1, 20});  // of nine nodes, read by its corners
  sizes({1, 71, 1, 2, 3, 40, 40, 40, 40, 40, 40});
  return text + "\n$EndElements\n";
}

}  // namespace

TEST_CASE("sizes of binary MSH 4.1 have the bytes that its head names, 4 or 8", "[io][msh]") {
  const Result<FileMesh> usual = read_file_mesh(binary_41<std::uint64_t>(false), "a.msh");
  INFO(summary(usual.findings));
  REQUIRE(usual);
  CHECK(usual->tetrahedra.corners.size() == 1);
  CHECK(usual->tetrahedra.source_id == std::vector<std::int64_t>{70});
  CHECK(usual->tetrahedra.region == std::vector<std::int32_t>{5});
  CHECK(usual->triangles.corners.size() == 1);
  CHECK(usual->source_point_id == std::vector<std::int64_t>{40, 1, 2, 3});
  CHECK(std::get<1>(usual->tetrahedra.data.at(0).values) == std::vector<std::int64_t>{2});
  for (const bool is_swapped : {false, true}) {
    const Result<FileMesh> narrow = read_file_mesh(binary_41<std::uint32_t>(is_swapped), "a.msh");
    INFO(summary(narrow.findings));
    REQUIRE(narrow);
    CHECK(*narrow == *usual);
    CHECK(summary(narrow.findings) == summary(usual.findings));
  }
}

TEST_CASE("sizes of numbers that MSH does not have are refused, in text they do not matter",
          "[io][msh]") {
  const auto with = [](const std::string& head, const std::string& name) {
    std::string text = bytes_of(sample(name));
    const std::size_t begin = text.find('\n') + 1;
    return text.replace(begin, text.find('\n', begin) - begin, head);
  };
  CHECK(*read_file_mesh(with("2.2 0 4", "gmsh_22.msh"), "a.msh") ==
        *read_file_mesh(sample("gmsh_22.msh")));
  CHECK(*read_file_mesh(with("4.1 0 4", "gmsh_41.msh"), "a.msh") ==
        *read_file_mesh(sample("gmsh_41.msh")));
  for (const auto& [head, name] :
       {std::pair{"2.2 1 4", "gmsh_22_binary.msh"}, std::pair{"4 1 4", "gmsh_41_binary.msh"},
        std::pair{"4.1 1 2", "gmsh_41_binary.msh"}, std::pair{"4.1 0 16", "gmsh_41.msh"},
        std::pair{"2.2 2 8", "gmsh_22.msh"}}) {
    const Result<FileMesh> refused = read_file_mesh(with(head, name), "a.msh");
    INFO(head);
    REQUIRE_FALSE(refused);
    CHECK(refused.findings[0].code == "unknown_version");
  }
}
