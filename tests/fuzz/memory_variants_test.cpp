// SPDX-License-Identifier: MIT
// Memory that a few bytes can ask for: images of cards, bits, strips, partitions, names, content
// that is left out.
#include <fmt/format.h>

#include "hostile.hpp"

using namespace sunder::test;

namespace {

std::vector<Hostile> hostile_images() {
  const std::string four = "GRID,1,,0,0,0\nGRID,2,,1\nGRID,3,,,1\nGRID,4,,,,1\n";
  return {
      {"bdf", "images of points", four + "=,*1,==\n=(1900)\n" + "CTETRA,1,1,1,2,3,4\n"},
      {"bdf", "images of hexahedra",
       four + "CHEXA,1,1,1,2,3,4,1,2,\n,3,4,1,2,3,4,1,2,\n,3,4,1,2,3,4,1,2,\n"
              ",3,4,1,2\n=,*1,==\n=(1900)\n"},
      {"bdf", "images of images", four + repeated(many, "=,*1,==\n") + "CTETRA,1,1,1,2,3,4\n"},
      {"bdf", "images that count nothing",
       four + repeated(many, "=(0)\n") + "CTETRA,1,1,1,2,3,4\n"},
      {"bdf", "too many images", four + repeated(many, "=(9)\n")},
      {"bdf", "tabs", four + repeated(many, "\t\t\n") + "CTETRA,1,1,1,2,3,4\n"},
      {"bdf", "words before bulk data", repeated(many, "A\n") + "BEGIN BULK\n" + four},
      {"bdf", "different words before bulk data",
       repeated(many, [](std::size_t i) { return fmt::format("A{}\n", i); }) + "BEGIN BULK\n" +
           four},
  };
}

std::string msh(std::string_view version, std::string_view before, std::string_view elements,
                std::size_t n, bool is_41) {
  return fmt::format(
      "$MeshFormat\n{} 0 8\n$EndMeshFormat\n{}$Nodes\n{}$EndNodes\n$Elements\n{}{}$EndElements\n",
      version, before, is_41 ? "1 1 1 1\n0 1 0 1\n1\n0 0 0\n" : "1\n1 0 0 0\n",
      is_41 ? fmt::format("1 {0} 1 1\n0 1 15 {0}\n", n) : fmt::format("{}\n", n), elements);
}

std::vector<Hostile> hostile_msh() {
  const std::string parts =
      "$PartitionedEntities\n1\n0\n1 0 0 0\n1 0 1 1 1 0 0 0 0\n$EndPartitionedEntities\n";
  const std::string many_parts = fmt::format(
      "$PartitionedEntities\n1\n0\n{} 0 0 0\n{}$EndPartitionedEntities\n", many,
      repeated(many, [](std::size_t i) { return fmt::format("{} 0 1 1 1 0 0 0 0\n", i); }));
  const auto names = [](std::string_view row) {
    return fmt::format("$PhysicalNames\n{}\n{}$EndPhysicalNames\n", many,
                       repeated(many, [&](std::size_t i) { return fmt::format("{}{}", i, row); }));
  };
  return {
      {"msh", "point elements in a partition",
       msh("4.1", parts, repeated(many, "1 1\n"), many, true)},
      {"msh", "partitioned entities", msh("4.1", many_parts, "1 1\n", 1, true)},
      {"msh", "partitions of elements",
       msh("2.2", "", repeated(many, "1 15 4 0 1 1 1 1\n"), many, false)},
      {"msh", "a partition of the last element",
       msh("2.2", "", repeated(many, "1 15 0 1\n") + "1 15 4 0 1 1 1 1\n", many + 1, false)},
      {"msh", "names of no dimension", msh("2", names("\"\"\n"), "1 15 2 1 1 1\n", 1, false)},
      {"msh", "sections that nobody knows",
       msh("2.2", repeated(many / 4, "$A\n$EndA\n"), "1 15 0 1\n", 1, false)},
  };
}

std::string vtk(std::string_view kind, std::string_view rest) {
  return fmt::format(
      "# vtk DataFile Version 4.2\n\n{}\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 char\n{}\nCELLS 0 0\n"
      "CELL_TYPES 0\n{}",
      kind, kind == "ASCII" ? "0 0 0 1 1 1" : "abcdef", rest);
}

std::vector<Hostile> hostile_vtk() {
  const std::string field = "POINT_DATA 2\nFIELD f 1\n";
  const std::string bytes(many, '\xaa'), strings = repeated(many, "\xc0");
  return {
      {"vtk", "bits", vtk("BINARY", field + fmt::format("b {} 2 bit\n", 4 * many) + bytes)},
      {"vtk", "bits as text",
       vtk("ASCII", field + fmt::format("b {} 2 bit\n{}", many / 2, repeated(many, "1 ")))},
      {"vtk", "strings", vtk("BINARY", field + fmt::format("s {} 2 string\n", many / 2) + strings)},
      {"vtk", "strings as text",
       vtk("ASCII", field + fmt::format("s {} 2 string\n{}", many / 2, repeated(many, "\n")))},
      {"vtk", "fields of the grid",
       vtk("ASCII",
           fmt::format("FIELD f {}\n{}", many / 4,
                       repeated(many / 4,
                                [](std::size_t i) { return fmt::format("{} 1 1 int\n0\n", i); })))},
  };
}

std::string ply(std::string_view kind, std::string_view more, std::string_view type,
                std::size_t n) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex 3\nproperty char x\nproperty char y\nproperty char z\n{}"
      "element tristrips 1\nproperty list int {} vertex_indices\nend_header\n{}{}",
      kind, more, type, kind == "ascii" ? "0 0 0 1 0 0 0 1 0 " : std::string(9, '\1'),
      kind == "ascii" ? fmt::format("{} ", n) : raw(static_cast<std::int32_t>(n)));
}

std::vector<Hostile> hostile_strips() {
  const auto row = [](std::size_t i) { return std::string(1, static_cast<char>(i % 3)); };
  std::string columns = "element face 0\nproperty list uchar int vertex_indices\n";
  for (int i = 0; i < 900; ++i) columns += fmt::format("property char a{}\n", i);
  return {
      {"ply", "strips of bytes",
       ply("binary_little_endian", "", "uchar", many) + repeated(many, row)},
      {"ply", "strips of bytes, as many as are read",
       ply("binary_little_endian", "", "uchar", many / 4) + repeated(many / 4, row) +
           std::string(many, ' ')},
      {"ply", "strips as text",
       ply("ascii", "", "int", many) +
           repeated(many, [](std::size_t i) { return fmt::format("{} ", i % 3); })},
      {"ply", "strips beside wide faces",
       ply("binary_little_endian", columns, "int", many / 4) +
           repeated(many / 4, [](std::size_t i) { return raw(static_cast<std::int32_t>(i % 3)); })},
  };
}

}  // namespace

TEST_CASE("images of Nastran's cards take at most ten times the file", "[fuzz][memory][nastran]") {
  check_all(hostile_images());
}

TEST_CASE("partitions and names of MSH take at most ten times the file", "[fuzz][memory][msh]") {
  check_all(hostile_msh());
}

TEST_CASE("bits and strings of VTK take at most ten times the file", "[fuzz][memory][vtk]") {
  check_all(hostile_vtk());
}

TEST_CASE("strips of PLY take at most ten times the file", "[fuzz][memory][ply]") {
  check_all(hostile_strips());
}
