// SPDX-License-Identifier: MIT
// Fields with one number per point: accepted files, and refused ones with the faulty line.
#include <unistd.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "topology/io/mesh_file.hpp"
#include "topology/io/vtu/vtu.hpp"

using namespace sunder;

namespace {

/// A file that is there as long as this.
struct TemporaryFile {
  std::filesystem::path path;
  explicit TemporaryFile(const std::string& name, const std::string& text = {})
      : path(std::filesystem::temp_directory_path() / (std::to_string(getpid()) + name)) {
    std::ofstream(path) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
};

const std::string msh_mesh =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n40 0 0 0\n10 1 0 0\n20 0 1 0\n30 0 0 1\n"
    "$EndNodes\n$Elements\n1\n1 4 2 0 1 40 10 20 30\n$EndElements\n";

std::string node_data(const std::string& name, const std::string& components,
                      const std::string& rows) {
  return "$NodeData\n2\n\"" + name + "\"\n\"second\"\n1\n0.5\n4\n0\n" + components + "\n" + rows +
         "$EndNodeData\n";
}

std::string code_of(const std::string& text, const std::string& field) {
  const TemporaryFile file("field.msh", text);
  const auto values = read_point_field(file.path, field);
  REQUIRE_FALSE(values);
  REQUIRE_FALSE(values.findings.empty());  // a misleading name may be noted behind it
  CHECK(values.findings[0].file == file.path.string());
  return values.findings[0].code;
}

}  // namespace

TEST_CASE("a node field of MSH stands by the file's own node numbers, the last of a name counts",
          "[io][field]") {
  const TemporaryFile good("good.msh", msh_mesh + node_data("xi", "1", "1\n0\n10 9\n") +
                                           node_data("xi", "1", "3\n0\n10 1\n20 2.5\n40 -4e3\n"));
  const auto values = read_point_field(good.path, "xi");
  REQUIRE(values);
  REQUIRE(values->size() == 4);
  CHECK((*values)[0] == -4e3);
  CHECK((*values)[1] == 1);
  CHECK((*values)[2] == 2.5);
  CHECK(std::isnan((*values)[3]));
}

TEST_CASE("what is wrong with a node field of MSH is told", "[io][field]") {
  CHECK(code_of(msh_mesh, "xi") == "no_such_field");
  CHECK(code_of(msh_mesh + node_data("other", "1", "1\n0\n10 9\n"), "xi") == "no_such_field");
  CHECK(code_of(msh_mesh + node_data("xi", "3", "1\n0\n10 9 9 9\n"), "xi") == "not_a_scalar");
  CHECK(code_of(msh_mesh + node_data("xi", "1", "2\n0\n10 9\n"), "xi") == "wrong_count");
  CHECK(code_of(msh_mesh + node_data("xi", "1", "1\n0\n10 ten\n"), "xi") == "bad_number");
  CHECK(code_of(msh_mesh + node_data("xi", "1", "99999999999\n0\n10 1\n"), "xi") ==
        "count_too_big");
  CHECK(code_of(msh_mesh + "$NodeData\n1\n\"xi\"\n", "xi") == "truncated_file");
  CHECK(code_of("MeshVersionFormatted 2\nDimension 3\nVertices 1\n0 0 0 0\nEnd\n", "xi") ==
        "no_such_field");
  CHECK(code_of("nothing known", "xi") == "unknown_format");
  CHECK_FALSE(read_point_field("/nowhere/at_all.vtu", "xi"));
}

TEST_CASE("values of nodes that are not there are left out with a warning", "[io][field]") {
  const TemporaryFile file("stray.msh", msh_mesh + node_data("xi", "1", "2\n0\n11 9\n10 3\n"));
  const auto values = read_point_field(file.path, "xi");
  REQUIRE(values);
  CHECK(values->at(1) == 3);
  CHECK(values.findings.at(0).code == "stray_data");
}

TEST_CASE("a point array of VTU is read whatever its type", "[io][field]") {
  const TetMesh mesh{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                     .tetrahedra = {{0, 1, 2, 3}}};
  const std::vector<double> doubles = {1e6, 2e6, 3e6, 4e6};
  const std::vector<std::int32_t> whole = {1, 2, 3, 4};
  const std::vector<NamedColumn> columns = {{"xi", std::span(doubles), 1},
                                            {"whole", std::span(whole), 1},
                                            vector_column("x", mesh.points)};
  const TemporaryFile file("field.vtu");
  REQUIRE(write_vtu(file.path, mesh, columns).empty());
  CHECK(*read_point_field(file.path, "xi") == doubles);
  CHECK(*read_point_field(file.path, "whole") == std::vector<double>{1, 2, 3, 4});
  CHECK(read_point_field(file.path, "x").findings.at(0).code == "not_a_scalar");
  const auto missing = read_point_field(file.path, "psi");
  REQUIRE_FALSE(missing);
  CHECK(missing.findings[0].code == "no_such_field");
  CHECK(missing.findings[0].remedy.find("whole") != std::string::npos);
}
