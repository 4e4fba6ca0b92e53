// SPDX-License-Identifier: MIT
// Reading VTU in every encoding there is.
#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

std::vector<VtuVariant> all_variants() {
  std::vector<VtuVariant> variants{{}};
  for (const bool one_stream : {true, false}) {
    for (const auto order : {std::endian::little, std::endian::big}) {
      for (const int header_bytes : {4, 8}) {
        for (const bool zlib : {false, true}) {
          variants.push_back({"binary", "raw", zlib, header_bytes, order, one_stream});
          variants.push_back({"appended", "raw", zlib, header_bytes, order, one_stream});
          variants.push_back({"appended", "base64", zlib, header_bytes, order, one_stream});
        }
      }
    }
  }
  return variants;
}

}  // namespace

TEST_CASE("every encoding of VTU gives the same mesh in every bit", "[io][vtu]") {
  TetMesh mesh = two_tetrahedra();
  mesh.region_name.clear();
  const std::vector<VtuVariant> variants = all_variants();
  CHECK(variants.size() == 49);
  for (const VtuVariant& variant : variants) {
    const Result<TetMesh> read = read_mesh(encode_vtu(mesh, variant), "a.vtu");
    INFO(to_string(variant) << ": " << summary(read.findings));
    REQUIRE(read);
    CHECK(read.findings.empty());
    CHECK(identical(mesh, *read));
  }
}

TEST_CASE("meshio's VTU files hold the mesh they were made from", "[io][vtu]") {
  const auto* const name =
      GENERATE("meshio_plain.vtu", "meshio_zlib.vtu", "meshio_zlib_32.vtu", "meshio_ascii.vtu");
  const Result<TetMesh> mesh = read_mesh(sample(name));
  INFO(name << ": " << summary(mesh.findings));
  REQUIRE(mesh);
  const Result<TetMesh> source = read_mesh(sample("gmsh_41.msh"));
  CHECK(mesh->points == source->points);
  CHECK(mesh->tetrahedra == source->tetrahedra);
  CHECK(mesh->region == source->region);
}

TEST_CASE("several pieces become one mesh", "[io][vtu]") {
  const std::string file = encode_vtu(two_tetrahedra(), {});
  const std::size_t begin = file.find("<Piece");
  const std::size_t end = file.find("</UnstructuredGrid>");
  const std::string piece = file.substr(begin, end - begin);
  const Result<TetMesh> mesh = read_mesh(file.substr(0, end) + piece + file.substr(end), "a.vtu");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->points.size() == 10);
  CHECK(mesh->tetrahedra.back() == std::array<std::uint32_t, 4>{6, 5, 7, 9});
  CHECK(mesh->region == std::vector<std::int32_t>{2, 5, 2, 5});
}

TEST_CASE("triangles among tetrahedra are left out, with their regions", "[io][vtu]") {
  const Result<TetMesh> mesh = read_mesh(
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>"
      "<Piece NumberOfPoints=\"5\" NumberOfCells=\"3\"><Points>"
      "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">"
      "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</DataArray></Points><Cells>"
      "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">"
      "0 1 2 0 1 2 3 1 2 3 4</DataArray>"
      "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 7 11</DataArray>"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 10 10</DataArray></Cells>"
      "<CellData><DataArray type=\"Int32\" Name=\"gmsh:physical\" format=\"ascii\">8 1 2"
      "</DataArray></CellData></Piece></UnstructuredGrid></VTKFile>",
      "a.vtu");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(summary(mesh.findings) == "note skipped_cells 0");
  CHECK(mesh->region == std::vector<std::int32_t>{1, 2});
  CHECK(mesh->tetrahedra[1] == std::array<std::uint32_t, 4>{1, 2, 3, 4});
}
