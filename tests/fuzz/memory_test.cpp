// SPDX-License-Identifier: MIT
// Files made to take as much memory as they can, a few hundred kilobytes each: the readers stay
// below ten times the file.
#include <fmt/format.h>

#include <bit>

#include "hostile.hpp"
#include "topology/io/text/number_source.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// VTK's legacy files are big-endian.
std::string big(std::int32_t number) { return raw(io::byte_swapped(number)); }

std::string msh_41(std::string_view nodes, std::size_t node_count, std::string_view elements,
                   std::size_t element_count) {
  return fmt::format(
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 {} 1 1\n0 1 0 {}\n{}$EndNodes\n"
      "$Elements\n1 {} 1 1\n0 1 15 {}\n{}$EndElements\n",
      node_count, node_count, nodes, element_count, element_count, elements);
}

std::string msh_22(std::string_view nodes, std::size_t node_count, std::string_view elements,
                   std::size_t element_count) {
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n{}$EndNodes\n"
      "$Elements\n{}\n{}$EndElements\n",
      node_count, nodes, element_count, elements);
}

std::vector<Hostile> hostile_msh() {
  const std::string one_node = "1\n0 0 0\n";
  const std::string points = repeated(many, "1 1\n");
  const auto numbered = [](std::size_t step) {
    return [step](std::size_t i) { return fmt::format("{} 0 0 0\n", 1 + i * step); };
  };
  const auto section = [](std::string_view name) {
    return fmt::format("${0}\n1\n\"\"\n0\n3\n0\n9\n1\n1 0 0 0 0 0 0 0 0 0\n$End{0}\n", name);
  };
  const auto names = [](std::size_t i) { return fmt::format("{} {} \"\"\n", i % 4, i / 4); };
  const auto entities = [](std::size_t i) { return fmt::format("{} 0 0 0 0\n", i); };
  return {
      {"msh", "point elements of 4 bytes", msh_41(one_node, 1, points, many)},
      {"msh", "point elements of 9 bytes",
       msh_22("1 0 0 0\n", 1, repeated(many, "1 15 0 1\n"), many)},
      {"msh", "dense numbers of nodes", msh_22(repeated(many, numbered(1)), many, "", 0)},
      {"msh", "numbers of nodes with gaps", msh_22(repeated(many, numbered(4)), many, "", 0)},
      {"msh", "scattered numbers of nodes", msh_22(repeated(many, numbered(9)), many, "", 0)},
      {"msh", "many data of one element each",
       msh_41(one_node, 1, points, many) + repeated(4'000, section("ElementData"))},
      {"msh", "many data of one node each",
       msh_22(repeated(many, numbered(1)), many, "", 0) + repeated(4'000, section("NodeData"))},
      {"msh", "names",
       fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n{}"
                   "$EndPhysicalNames\n",
                   many, repeated(many, names))},
      {"msh", "entities",
       fmt::format("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n{} 0 0 0\n{}$EndEntities\n",
                   many, repeated(many, entities))},
  };
}

std::vector<Hostile> hostile_medit() {
  const std::string head = "MeshVersionFormatted 2\nDimension 3\n";
  const std::string points = "Vertices\n2\n0 0 0 0\n0 0 1 0\n";
  const std::string edges = fmt::format("Edges\n{}\n{}", many, repeated(many, "1 2 3\n"));
  const auto binary = [](std::string_view first, std::string_view second) {
    return raw(1) + raw(2) + std::string(first) + std::string(second) + raw(54) + raw(0);
  };
  const auto section = [](int code, std::string_view rows, std::size_t count, std::size_t at) {
    return raw(code) + raw(static_cast<std::int32_t>(at + 12 + rows.size())) +
           raw(static_cast<std::int32_t>(count)) + std::string(rows);
  };
  const std::string two_points(56, '\0');
  const std::string rows = repeated(many, raw(1) + raw(2) + raw(3));
  const std::string raw_points = section(4, two_points, 2, 8);
  const std::string raw_edges = section(5, rows, many, 8);
  return {
      {"mesh", "edges behind vertices", head + points + edges},
      {"mesh", "edges before vertices", head + edges + points},
      {"mesh", "raw edges behind vertices",
       binary(raw_points, section(5, rows, many, 8 + raw_points.size()))},
      {"mesh", "raw edges before vertices",
       binary(raw_edges, section(4, two_points, 2, 8 + raw_edges.size()))},
      {"mesh", "vertices",
       fmt::format("{}Vertices\n{}\n{}", head, many, repeated(many, "0 0 0 0\n"))},
      {"mesh", "sections that nobody knows", head + repeated(many, "A\n") + points},
  };
}

std::string vtk(std::string_view kind, std::string_view points, std::string_view rest) {
  return fmt::format("# vtk DataFile Version 4.2\n\n{}\nDATASET UNSTRUCTURED_GRID\nPOINTS {}\n{}",
                     kind, points, rest);
}

/// Cells on the first points, alternately vertices and edges or vertices alone.
std::string vtk_cells(std::size_t n, bool mixed) {
  const auto cell = [&](std::size_t i) {
    return mixed && i % 2 == 1 ? big(2) + big(0) + big(1) : big(1) + big(0);
  };
  const auto type = [&](std::size_t i) { return big(mixed && i % 2 == 1 ? 3 : 1); };
  return fmt::format("CELLS {} {}\n{}\nCELL_TYPES {}\n{}\n", n, mixed ? n / 2 * 5 : 2 * n,
                     repeated(n, cell), n, repeated(n, type));
}

std::vector<Hostile> hostile_vtk() {
  const std::string two = "2 double\n0 0 0 0 0 1\n";
  const std::string no_cells = "CELLS 0 0\nCELL_TYPES 0\n";
  const std::string one_cell = "CELLS 1 2\n1 0\nCELL_TYPES 1\n1\n";
  const std::string four_cells =
      "CELLS 4 14\n1 0\n2 0 1\n3 0 1 1\n4 0 1 2 3\nCELL_TYPES 4\n1\n3\n5\n10\n";
  const std::string raw_two = "2 double\n" + std::string(48, '\0') + "\n";
  const std::string bytes(many, '\1');
  const auto array = [](std::string_view tail) {
    return [tail](std::size_t i) { return fmt::format("{} {}\n", i, tail); };
  };
  const auto columns = [&](std::string_view tail, std::size_t n) {
    return fmt::format("FIELD f {}\n{}", n, repeated(n, array(tail)));
  };
  return {
      {"vtk", "vertices as text",
       vtk("ASCII", two,
           fmt::format("CELLS {} {}\n{}CELL_TYPES {}\n{}", many, 2 * many, repeated(many, "1 0\n"),
                       many, repeated(many, "1\n")))},
      {"vtk", "cells of no points",
       vtk("ASCII", two,
           fmt::format("CELLS {0} {0}\n{1}CELL_TYPES {0}\n{2}", many, repeated(many, "0\n"),
                       repeated(many, "2\n")))},
      {"vtk", "points of one byte a number",
       vtk("BINARY", fmt::format("{} char\n{}\n", many, bytes + bytes + bytes), no_cells)},
      {"vtk", "points as text",
       vtk("ASCII", fmt::format("{} int\n{}", many, repeated(many, "0 0 0\n")), no_cells)},
      {"vtk", "a column of bytes on points",
       vtk("BINARY", fmt::format("{} char\n{}\n", 2, "abcdef"),
           no_cells + "POINT_DATA 2\nFIELD f 1\na 100000 2 char\n" + repeated(200'000, "x"))},
      {"vtk", "a column of bytes on cells of one kind",
       vtk("BINARY", raw_two,
           vtk_cells(2, false) + "CELL_DATA 2\nFIELD f 1\na 100000 2 char\n" +
               repeated(200'000, "x"))},
      {"vtk", "a column of bytes on cells of two kinds",
       vtk("BINARY", raw_two,
           vtk_cells(2, true) + "CELL_DATA 2\nFIELD f 1\na 100000 2 char\n" +
               repeated(200'000, "x"))},
      {"vtk", "columns of bytes on many cells of two kinds",
       vtk("BINARY", raw_two,
           vtk_cells(many / 2, true) +
               fmt::format("CELL_DATA {}\nFIELD f 1\na 5 {} char\n", many / 2, many / 2) +
               repeated(many / 2 * 5, "x"))},
      {"vtk", "empty columns",
       vtk("ASCII", "0 int\n", no_cells + "POINT_DATA 0\n" + columns("1 0 int", many))},
      {"vtk", "columns of one number",
       vtk("ASCII", "1 int\n0 0 0\n", one_cell + "POINT_DATA 1\n" + columns("1 1 int 0", many))},
      {"vtk", "columns of four kinds of cells",
       vtk("ASCII", "4 int\n0 0 0 0 0 1 0 1 0 1 0 0\n",
           four_cells + "CELL_DATA 4\n" + columns("1 4 int 0 0 0 0", many))},
      {"vtk", "the same column again and again",
       vtk("ASCII", two,
           one_cell + "POINT_DATA 2\n" + repeated(many / 4, "FIELD f 1\na 1 2 int 0 0\n"))},
  };
}

std::string vtu(std::string_view attributes, std::string_view inside,
                std::string_view behind = {}) {
  return fmt::format(
      "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" {}><UnstructuredGrid>{}"
      "</UnstructuredGrid>{}</VTKFile>",
      attributes, inside, behind);
}

std::string vtu_piece(std::size_t points, std::size_t cells, std::string_view inside) {
  return fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">{}</Piece>", points, cells,
                     inside);
}

std::string vtu_points(std::string_view how, std::string_view text = {}) {
  return fmt::format("<Points><DataArray NumberOfComponents=\"3\" {}>{}</DataArray></Points>", how,
                     text);
}

std::string appended(std::string_view bytes) {
  return fmt::format("<AppendedData encoding=\"raw\">_{}{}</AppendedData>",
                     raw(static_cast<std::uint32_t>(bytes.size())), bytes);
}

std::vector<Hostile> hostile_vtu() {
  const std::string bytes(3 * many, '\1');
  const std::string int8 = "type=\"Int8\" format=\"appended\" offset=\"0\"";
  const std::string one_point = vtu_points("type=\"Int8\"", "0 0 0");
  const auto data = [&](std::size_t i) {
    return fmt::format("<DataArray Name=\"{}\" {}/>", i, int8);
  };
  const auto tags = [](std::size_t i) { return fmt::format("<x{}/>", i); };
  const auto attributes = [](std::size_t i) { return fmt::format(" x{}=\"\"", i); };
  const auto small = [](std::size_t i) {
    return fmt::format("<DataArray type=\"Int8\" Name=\"{}\">0</DataArray>", i);
  };
  const auto in_points = [](std::string_view text) {
    return fmt::format("<PointData>{}</PointData>", text);
  };
  const std::string cells =
      "<Cells><DataArray Name=\"types\" type=\"Int8\">1 3</DataArray>"
      "<DataArray Name=\"offsets\" type=\"Int8\">1 3</DataArray>"
      "<DataArray Name=\"connectivity\" type=\"Int8\">0 0 0</DataArray></Cells>";
  // One zlib block that says to hold far more than its 8 bytes do.
  const std::string lie = raw(1u) + raw(3'000'000u) + raw(0u) + raw(8u) + "abcdefgh" + bytes;
  return {
      {"vtu", "points of one byte a number",
       vtu("", vtu_piece(many, 0, vtu_points(int8)), appended(bytes))},
      {"vtu", "arrays that share their bytes",
       vtu("",
           vtu_piece(many, 0,
                     vtu_points(int8) + in_points(repeated(200,
                                                           [&](std::size_t i) {
                                                             return fmt::format(
                                                                 "<DataArray Name=\"{}\" "
                                                                 "NumberOfComponents=\"3\" {}/>",
                                                                 i, int8);
                                                           }))),
           appended(bytes))},
      {"vtu", "a column of bytes on cells of two kinds",
       vtu("",
           vtu_piece(1, 2,
                     one_point + cells +
                         fmt::format("<CellData><DataArray Name=\"a\" "
                                     "NumberOfComponents=\"{}\" {}/></CellData>",
                                     bytes.size() / 2, int8)),
           appended(bytes))},
      {"vtu", "nested tags", vtu("", repeated(many, "<a>"))},
      {"vtu", "tags of many names", vtu("", repeated(many, tags))},
      {"vtu", "attributes of many names", vtu(repeated(many, attributes), "")},
      {"vtu", "empty pieces",
       vtu("", repeated(many / 4, [](std::size_t) { return vtu_piece(0, 0, ""); }))},
      {"vtu", "arrays without anything",
       vtu("", vtu_piece(0, 0, in_points(repeated(many, "<DataArray/>"))))},
      {"vtu", "empty columns", vtu("", vtu_piece(0, 0, in_points(repeated(many / 4, data))))},
      {"vtu", "columns of one number",
       vtu("", vtu_piece(1, 0, one_point + in_points(repeated(many / 4, small))))},
      {"vtu", "a long attribute", vtu("x=\"" + bytes + bytes + "\"", "")},
      {"vtu", "a packed block that lies",
       vtu("compressor=\"vtkZLibDataCompressor\"", vtu_piece(1'000'000, 0, vtu_points(int8)),
           "<AppendedData encoding=\"raw\">_" + lie + "</AppendedData>")},
      {"vtu", "points as text",
       vtu("", vtu_piece(many, 0, vtu_points("type=\"Int8\"", repeated(3 * many, "0 "))))},
  };
}

std::vector<Hostile> hostile_tetgen() {
  const auto rows = [](std::string_view tail) {
    return [tail](std::size_t i) { return fmt::format("{} {}\n", i + 1, tail); };
  };
  const std::string nodes = fmt::format("{} 3 0 0\n{}", many, repeated(many, rows("0 0 0")));
  const std::string four = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  const auto with = [](std::string_view first, std::string_view ending, std::string_view second) {
    return fmt::format("{}@@@ .{}\n{}", first, ending, second);
  };
  return {
      {"node", "nodes", with(nodes, "ele", "1 4 0\n1 1 2 3 4\n")},
      {"node", "tetrahedra",
       with(four, "ele", fmt::format("{} 4 0\n{}", many, repeated(many, rows("1 2 3 4"))))},
      {"node", "attributes of nodes",
       with(fmt::format("{} 3 9 1\n{}", many / 4,
                        repeated(many / 4, rows("0 0 0 1 1 1 1 1 1 1 1 1 1"))),
            "ele", "1 4 0\n1 1 2 3 4\n")},
      {"node", "faces",
       with(with(four, "ele", "1 4 0\n1 1 2 3 4\n"), "face",
            fmt::format("{} 1\n{}", many, repeated(many, rows("1 2 3 5"))))},
  };
}

std::vector<Hostile> hostile_abaqus() {
  const auto rows = [](std::string_view tail) {
    return [tail](std::size_t i) { return fmt::format("{}{}\n", i + 1, tail); };
  };
  const std::string four = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n";
  const std::string one = "*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n";
  const auto sets = [](std::string_view text) {
    return [text](std::size_t i) { return fmt::format("*ELSET,ELSET={}\n{}", i, text); };
  };
  return {
      {"inp", "nodes", "*NODE\n" + repeated(many, rows(",0,0,0")) + one},
      {"inp", "nodes without coordinates", "*NODE\n" + repeated(many, rows(",")) + one},
      {"inp", "tetrahedra", four + "*ELEMENT,TYPE=C3D4\n" + repeated(many, rows(",1,2,3,4"))},
      {"inp", "triangles", four + "*ELEMENT,TYPE=S3\n" + repeated(many, rows(",1,2,3"))},
      {"inp", "sets of one element", four + one + repeated(many / 4, sets("1\n"))},
      {"inp", "empty sets", four + one + repeated(many / 4, sets(""))},
      {"inp", "one set again and again", four + one + repeated(many, "*ELSET,ELSET=a\n1\n")},
      {"inp", "blocks of no elements", four + repeated(many / 4, "*ELEMENT,TYPE=C3D4\n") + one},
      {"inp", "blocks of one node",
       repeated(many / 4, [](std::size_t i) { return fmt::format("*NODE\n{},0,0,0\n", i + 1); }) +
           one},
      {"inp", "keywords that nobody knows", four + one + repeated(many, "*A\n")},
  };
}

std::vector<Hostile> hostile_surfaces() {
  const std::string triangle = "facet\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendfacet\n";
  const std::string off_head = fmt::format("OFF\n3 {} 0\n0 0 0\n0 0 1\n0 1 0\n", many);
  const std::string stl_raw = std::string(80, 'x') + raw(static_cast<std::uint32_t>(many / 4));
  return {
      {"off", "points", fmt::format("OFF\n{} 0 0\n{}", many, repeated(many, "0 0 0\n"))},
      {"off", "triangles", off_head + repeated(many, "3 0 1 2\n")},
      {"off", "polygons", off_head + repeated(many, "0\n")},
      {"stl", "triangles as text", "solid\n" + repeated(many / 8, triangle) + "endsolid\n"},
      {"stl", "raw triangles", stl_raw + std::string(many / 4 * 50, '\0')},
      {"stl", "raw triangles of different points",
       stl_raw + repeated(many / 4,
                          [](std::size_t i) {
                            std::string bytes(12, '\0');
                            for (std::size_t k = 0; k < 9; ++k)
                              bytes += raw(static_cast<float>(9 * i + k));
                            return bytes + std::string(2, '\0');
                          })},
      {"stl", "solids of nothing", repeated(many / 4, "solid a\nendsolid a\n")},
  };
}

}  // namespace

TEST_CASE("MSH takes at most ten times the file", "[fuzz][memory][msh]") {
  check_all(hostile_msh());
}

TEST_CASE("MEDIT takes at most ten times the file", "[fuzz][memory][medit]") {
  check_all(hostile_medit());
}

TEST_CASE("VTK takes at most ten times the file", "[fuzz][memory][vtk]") {
  check_all(hostile_vtk());
}

TEST_CASE("VTU takes at most ten times the file", "[fuzz][memory][vtu]") {
  check_all(hostile_vtu());
}

TEST_CASE("TetGen takes at most ten times the file", "[fuzz][memory][tetgen]") {
  check_all(hostile_tetgen());
}

TEST_CASE("Abaqus takes at most ten times the file", "[fuzz][memory][abaqus]") {
  check_all(hostile_abaqus());
}

TEST_CASE("Surfaces take at most ten times the file", "[fuzz][memory][surfaces]") {
  check_all(hostile_surfaces());
}
