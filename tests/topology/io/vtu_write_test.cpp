// SPDX-License-Identifier: MIT
// Writing VTU frames with columns, PVD lists, and the losses of a format.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/io/vtu/vtu.hpp"

using namespace sunder;
using namespace sunder::test;

TEST_CASE("a mesh written as VTU comes back in every bit, its region names from beside",
          "[io][vtu][round_trip]") {
  TetMesh mesh = two_tetrahedra();
  mesh.source_point_id = {9, 4, 1'000'000'000'000, 4, -2};
  mesh.source_tetrahedron_id = {0, 50};
  const Folder folder;
  CHECK(summary(write_mesh(folder.path() / "a.VTU", mesh)) == "note names_beside 0");
  CHECK(folder.names() == std::vector<std::string>{"a.VTU", "a.VTU.regions"});
  const Result<TetMesh> back = read_mesh(folder.path() / "a.VTU");
  INFO(summary(back.findings));
  REQUIRE(back);
  CHECK(identical(mesh, *back));
}

TEST_CASE("the columns of a frame stand in the file as they were given", "[io][vtu]") {
  const TetMesh mesh = two_tetrahedra();
  const std::vector<Point> velocity(5, {1, 2, 3});
  const std::vector<double> stress{-1.5, 1e9};
  const std::vector<std::int32_t> component{4, 7};
  const std::vector<float> shade(6, 0.5f);
  const std::vector<std::uint8_t> flag{1, 0, 1, 0, 1};
  const NamedColumn points[] = {vector_column("velocity <m/s>", velocity),
                                {"flag", std::span<const std::uint8_t>(flag)}};
  const NamedColumn cells[] = {{"stress", std::span<const double>(stress)},
                               {"region", std::span<const std::int32_t>(component)},
                               {"shade", std::span<const float>(shade), 3}};
  const Folder folder;
  const auto path = folder.path() / "frame.vtu";
  REQUIRE(write_vtu(path, mesh, points, cells).empty());
  const std::string bytes = bytes_of(path);
  CHECK(bytes.find("Name=\"velocity &lt;m/s&gt;\" NumberOfComponents=\"3\"") != std::string::npos);
  CHECK(bytes.find("type=\"Float32\" Name=\"shade\"") != std::string::npos);
  const std::string raw(reinterpret_cast<const char*>(stress.data()), 16);
  CHECK(bytes.find(raw) != std::string::npos);
  // A column may take the place of the mesh's own regions.
  CHECK(bytes.find("Name=\"region\"") == bytes.rfind("Name=\"region\""));
  const Result<TetMesh> back = read_mesh(path);
  REQUIRE(back);
  CHECK(back->region == component);
}

TEST_CASE("zeros in the place of whole numbers that cells of a kind do not have are told",
          "[io][vtu]") {
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  mesh.triangles.corners = {{0, 1, 2}};
  const Folder folder;
  for (const char* name : {"a.vtu", "a.vtk"}) {
    INFO(name);
    mesh.tetrahedra.data = {{"stress", 1, NumberType::float64, std::vector<double>{1, 2}},
                            {"age", 1, NumberType::int32, std::vector<std::int64_t>{3, 4}}};
    mesh.triangles.data = {};
    const auto told = write_file_mesh(folder.path() / name, mesh);
    const auto filled = std::ranges::find(told, "data_filled", &Finding::code);
    REQUIRE(filled != told.end());
    CHECK(filled->severity == Severity::warning);
    CHECK(filled->text.ends_with("has one array for cells of all kinds: those without age get 0"));
    mesh.triangles.data = {{"age", 1, NumberType::int32, std::vector<std::int64_t>{0}}};
    CHECK_FALSE(has_error(write_file_mesh(folder.path() / name, mesh)));
    const Result<FileMesh> back = read_file_mesh(folder.path() / name);
    REQUIRE(back);
    CHECK(back->tetrahedra.data == mesh.tetrahedra.data);
    CHECK(back->triangles.data == mesh.triangles.data);
  }
}

TEST_CASE("a column of the wrong length is refused and nothing is written", "[io][vtu]") {
  const std::vector<double> three{1, 2, 3};
  const NamedColumn column{"stress", std::span<const double>(three)};
  const Folder folder;
  const auto findings = write_vtu(folder.path() / "a.vtu", two_tetrahedra(), {}, {{column}});
  REQUIRE(summary(findings) == "error bad_column 0");
  CHECK(findings[0].text ==
        "column 'stress' has 3 numbers: 2 were expected, 1 for each of 2 "
        "tetrahedra");
  CHECK(folder.names().empty());
}

TEST_CASE("a PVD list names each frame with its time", "[io][vtu]") {
  const Folder folder;
  const PvdFrame frames[] = {{0, "f/0000.vtu"}, {0.1, "f/0001 & more.vtu"}};
  REQUIRE(write_pvd(folder.path() / "run.pvd", frames).empty());
  CHECK(bytes_of(folder.path() / "run.pvd") ==
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n"
        "<DataSet timestep=\"0\" group=\"\" part=\"0\" file=\"f/0000.vtu\"/>\n"
        "<DataSet timestep=\"0.1\" group=\"\" part=\"0\" file=\"f/0001 &amp; more.vtu\"/>\n"
        "</Collection>\n</VTKFile>\n");
}

TEST_CASE("every format is known by its name's ending", "[io]") {
  for (const FormatTraits& row : format_traits()) {
    CHECK(format_of_name("mesh" + std::string(row.extensions[0])) == row.format);
    CHECK(format_of_name("mesh" + std::string(row.extensions[0]) + ".gz") == row.format);
    CHECK(&traits_of(row.format) == &row);
  }
}
