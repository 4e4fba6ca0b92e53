// SPDX-License-Identifier: MIT
// Defective files, one defect each: the code, the line and the words that name the value.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

const std::string good_msh_22 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 1 1 1
$EndNodes
$Elements
2
1 4 2 1 1 1 2 3 4
2 4 2 1 1 2 3 4 5
$EndElements
)";

const std::string good_msh_41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 0 0 1
1 0 0 0 1 1 1 1 6 0
$EndEntities
$Nodes
1 4 1 4
3 1 0 4
1
2
3
4
0 0 0
1 0 0
0 1 0
0 0 1
$EndNodes
$Elements
1 1 1 1
3 1 4 1
1 1 2 3 4
$EndElements
)";

const std::string good_medit = R"(MeshVersionFormatted 2
Dimension 3
Vertices 4
0 0 0 0
1 0 0 0
0 1 0 0
0 0 1 0
Tetrahedra 1
1 2 3 4 0
End
)";

std::string vtu(const VtuVariant& variant = {}) { return encode_vtu(two_tetrahedra(), variant); }

/// `text` with the first `from` behind the first `after` made `to`.
std::string changed(std::string text, const std::string& from, const std::string& to,
                    const std::string& after = "") {
  const std::size_t start = text.find(after);
  const std::size_t at = start == std::string::npos ? start : text.find(from, start + after.size());
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

struct Defect {
  std::string what;
  std::string bytes;
  std::string code;
  std::size_t line;
  /// Stands in the text of the finding.
  std::string says;
};

void check_defects(const std::vector<Defect>& defects) {
  for (const Defect& defect : defects) {
    const Result<TetMesh> mesh = read_mesh(defect.bytes, "bad file");
    INFO(defect.what << ": " << summary(mesh.findings));
    REQUIRE_FALSE(mesh);
    const Finding& f = mesh.findings.at(0);
    CHECK(std::count_if(mesh.findings.begin(), mesh.findings.end(), [](const Finding& other) {
            return other.severity == Severity::error;
          }) == 1);
    INFO(f.text << "; " << f.remedy);
    CHECK(f.code == defect.code);
    CHECK(f.severity == Severity::error);
    CHECK(f.line == defect.line);
    CHECK(f.file == "bad file");
    CHECK(f.text.find(defect.says) != std::string::npos);
    CHECK(f.remedy.size() > 5);
  }
}

}  // namespace

TEST_CASE("the good files that the defects start from are read", "[io][defects]") {
  for (const std::string& good : {good_msh_22, good_msh_41, good_medit, vtu()}) {
    const Result<TetMesh> mesh = read_mesh(good, "good");
    INFO(summary(mesh.findings));
    CHECK(mesh);
    CHECK(mesh.findings.empty());
  }
}

TEST_CASE("what is no mesh file is named", "[io][defects]") {
  check_defects({
      {"empty", "", "empty_file", 0, "0 bytes"},
      {"blank", " \n\n\t", "empty_file", 0, "4 bytes"},
      {"garbage", std::string("\x7f\x45\x4c\x46\0\0\0", 7), "unknown_format", 0,
       "begins like none"},
      {"prose", "Dear reader,\n", "unknown_format", 0, "begins like none"},
      {"another VTK", "# vtk DataFile Version 2.0\nx\nASCII\nDATASET STRUCTURED_GRID\n",
       "unknown_format", 4, "STRUCTURED_GRID"},
      {"HDF5", "\x89HDF\r\n", "unknown_format", 0, "HDF5"},
      {"MSH view", "$PostFormat\n1.4 0 8\n$EndPostFormat\n", "unknown_version", 1, "$PostFormat"},
      {"MSH 1", "$NOD\n1\n1 0 0 0\n$ENDNOD\n", "missing_section", 5, "$Elements"},
      {"packed, cut", std::string("\x1f\x8b\x08\0\0\0\0\0\0\3", 10), "truncated_file", 0,
       "packed data end"},
      {"packed, damaged", std::string("\x1f\x8b\x08\0\0\0\0\0\0\3\x07\0\0", 13), "bad_gzip", 0,
       "packed data"},
      {"ImageData", changed(vtu(), "UnstructuredGrid", "ImageData"), "unknown_format", 2,
       "ImageData"},
  });
}

TEST_CASE("each defect of an MSH 2.2 file is found at its line", "[io][defects][msh]") {
  const std::string& good = good_msh_22;
  check_defects({
      {"version", changed(good, "2.2", "3.0"), "unknown_version", 2, "'3.0'"},
      {"binary", changed(good, "2.2 0", "2.2 1"), "bad_number", 2, "tells the byte order"},
      {"cut", good.substr(0, good.find("5\n$EndElements")), "truncated_file", 15, "a node number"},
      {"cut after a section", good.substr(0, good.find("$Elements")), "missing_section", 12,
       "$Elements"},
      {"count far too big", changed(good, "5", "5000000000", "$Nodes"), "count_too_big", 5,
       "5000000000 nodes"},
      {"count one too big", changed(good, "5", "6", "$Nodes"), "wrong_count", 11, "'$EndNodes'"},
      {"count one too small", changed(good, "5", "4", "$Nodes"), "wrong_count", 10, "'5'"},
      {"negative count", changed(good, "5", "-5", "$Nodes"), "bad_number", 5, "-5"},
      {"word for a number", changed(good, "1 0 0", "1 o 0", "$Nodes\n5\n1 0 0 0\n2 "), "bad_number",
       7, "'o'"},
      {"comma for a point", changed(good, "0 1 0", "0,5 1 0", "3 "), "bad_number", 8, "'0,5'"},
      {"number too big", changed(good, "0 1 0", "1e999 1 0", "3 "), "number_out_of_range", 8,
       "'1e999'"},
      {"fraction for a node", changed(good, "1 2 3 4", "1 2 3.5 4", "$Elements"), "bad_number", 14,
       "'3.5'"},
      {"no such node", changed(good, "1 2 3 4", "1 2 3 9", "$Elements"), "index_out_of_range", 14,
       "point 9"},
      {"a node twice", changed(good, "1 2 3 4", "1 2 3 3", "$Elements"), "repeated_vertex", 14,
       "1 2 3 3"},
      {"not a number", changed(good, "0 0 1", "0 nan 1"), "nan_coordinate", 9, "nan"},
      {"infinite", changed(good, "0 0 1", "0 -inf 1"), "nan_coordinate", 9, "-inf"},
      {"same number twice", changed(good, "4 0 0 1", "3 0 0 1"), "duplicate_id", 9, "number 3"},
      {"hexahedra", changed(good, "4 2 1 1 1 2 3 4", "5 2 1 1 1 2 3 4 5 1 2 3"),
       "unsupported_cells", 14, "1 hexahedron"},
      {"unknown element", changed(good, "4 2 1 1 1 2 3 4", "77 2 1 1 1 2 3 4"), "unknown_cell_type",
       14, "77"},
      {"no element", changed(good, "2\n1 4 2 1 1 1 2 3 4\n2 4 2 1 1 2 3 4 5\n", "0\n"),
       "no_tetrahedron", 0, "5 points"},
      {"elements first",
       changed(changed(good, "$EndElements\n", ""), "$Nodes",
               "$Elements\n0\n"
               "$EndElements\n$Nodes"),
       "wrong_section_order", 4, "$Elements stands before $Nodes"},
      {"no format", good.substr(good.find("$Nodes")), "wrong_section_order", 1, "$MeshFormat"},
      {"two lists of nodes", changed(good, "$Elements", "$Nodes\n0\n$EndNodes\n$Elements"),
       "wrong_section_order", 12, "second $Nodes"},
      {"open section", changed(good, "$Nodes", "$Extra\n$Nodes"), "truncated_file", 4, "$EndExtra"},
      {"text between", changed(good, "$Elements", "what?\n$Elements"), "unknown_section", 12,
       "'what?'"},
      {"name without quotes",
       changed(good, "$Nodes",
               "$PhysicalNames\n1\n3 1 body\n"
               "$EndPhysicalNames\n$Nodes"),
       "bad_name", 6, "'body'"},
  });
}

TEST_CASE("each defect of an MSH 4.1 file is found at its line", "[io][defects][msh]") {
  const std::string& good = good_msh_41;
  check_defects({
      {"version", changed(good, "4.1", "4.2"), "unknown_version", 2, "'4.2'"},
      {"binary", changed(good, "4.1 0", "4.1 1"), "bad_number", 2, "tells the byte order"},
      {"block too big", changed(good, "3 1 0 4", "3 1 0 99999"), "count_too_big", 10,
       "99999 nodes"},
      {"total of nodes", changed(good, "1 4 1 4", "1 5 1 5"), "wrong_count", 18,
       "announces 5 nodes"},
      {"total of elements", changed(good, "1 1 1 1\n3", "1 2 1 2\n3"), "wrong_count", 23,
       "announces 2 elements"},
      {"more blocks than there are", changed(good, "1 4 1 4", "2 4 1 4"), "wrong_count", 19,
       "'$EndNodes'"},
      {"no such node", changed(good, "1 1 2 3 4", "1 1 2 3 40"), "index_out_of_range", 23,
       "point 40"},
      {"hexahedron", changed(good, "3 1 4 1\n1 1 2 3 4", "3 1 5 1\n1 1 2 3 4 1 2 3 4"),
       "unsupported_cells", 23, "1 hexahedron"},
      {"entities last",
       changed(changed(good, "$Entities", "$Entitiez"), "$EndEntities", "$EndEntitiez") +
           "$Entities\n0 0 0 0\n$EndEntities\n",
       "wrong_section_order", 25, "$Entities"},
      {"extent missing", changed(good, "1 0 0 0 1 1 1 1 6 0", "1 0 0 0"), "wrong_count", 10,
       "$EndEntities"},
  });
}

TEST_CASE("each defect of a MEDIT file is found at its line", "[io][defects][medit]") {
  const std::string& good = good_medit;
  check_defects({
      {"plane", changed(good, "Dimension 3", "Dimension 2"), "wrong_count", 4, "'0' stands behind"},
      {"four dimensions", changed(good, "Dimension 3", "Dimension 4"), "unsupported_cells", 2,
       "dimension 4"},
      {"dimension last", changed(good, "End", "Dimension 2\nEnd"), "wrong_section_order", 10,
       "behind Vertices"},
      {"cut", changed(good, "1 2 3 4 0\nEnd\n", "1 2 3 0000004"), "truncated_file", 9,
       "a cell's reference"},
      {"count far too big", changed(good, "Vertices 4", "Vertices 4000"), "count_too_big", 3,
       "4000"},
      {"count one too big", changed(good, "Vertices 4", "Vertices 5"), "bad_number", 8,
       "'Tetrahedra'"},
      {"count one too small", changed(good, "Vertices 4", "Vertices 3"), "wrong_count", 7, "'0'"},
      {"vertex 0", changed(good, "1 2 3 4 0", "0 2 3 4 0"), "index_out_of_range", 9, "point 0"},
      {"vertex 5", changed(good, "1 2 3 4 0", "1 2 3 5 0"), "index_out_of_range", 9, "point 5"},
      {"pyramids", changed(good, "End", "Pyramids 1\n1 2 3 4 1 0\nEnd"), "unsupported_cells", 11,
       "1 pyramid"},
      {"no vertices", "MeshVersionFormatted 2\nDimension 3\nEnd\n", "missing_section", 4,
       "Vertices"},
      {"a surface", changed(changed(good, "Tetrahedra", "Triangles"), "1 2 3 4 0", "1 2 3 0"),
       "no_tetrahedron", 0, "4 points"},
  });
}

TEST_CASE("each defect of a VTU file is found at its line", "[io][defects][vtu]") {
  const VtuVariant base64{"binary"}, packed{"binary", "raw", true};
  const std::string raw = vtu({"appended", "raw"});
  const std::string data = "offset=\"0\"";
  check_defects({
      {"no end tag", changed(vtu(), "</Cells>", ""), "bad_xml", 16, "mismatched tag"},
      {"cut", vtu().substr(0, 600), "truncated_file", 13, ""},
      {"document type", changed(vtu(), "<VTKFile", "<!DOCTYPE x [<!ENTITY y \"z\">]><VTKFile"),
       "bad_xml", 2, "document type"},
      {"byte order", changed(vtu(), "LittleEndian", "Middle"), "bad_attribute", 2, "'Middle'"},
      {"count", changed(vtu(), "NumberOfPoints=\"5\"", "NumberOfPoints=\"five\""), "bad_attribute",
       4, "'five'"},
      {"count far too big", changed(vtu(), "NumberOfPoints=\"5\"", "NumberOfPoints=\"5000000000\""),
       "count_too_big", 4, "5000000000"},
      {"count one too big", changed(vtu(), "NumberOfPoints=\"5\"", "NumberOfPoints=\"6\""),
       "wrong_count", 9, "18 were expected"},
      {"cells one too many", changed(raw, "NumberOfCells=\"2\"", "NumberOfCells=\"3\""),
       "wrong_count", 14, "2 bytes are announced, 3"},
      {"word for a number", changed(vtu(), "0.1", "a.1"), "bad_number", 9, "'a.1'"},
      {"not a number", changed(vtu(), "0.1", "nan"), "nan_coordinate", 9, "nan"},
      {"no such point", changed(vtu(), "1 0 2 4", "1 0 2 5"), "index_out_of_range", 12, "point 5"},
      {"repeated point", changed(vtu(), "1 0 2 4", "1 0 2 2"), "repeated_vertex", 12, "1 0 2 2"},
      {"hexahedra", changed(changed(vtu(), "10 10", "10 12"), "1 0 2 4", "1 0 2 4"), "bad_offsets",
       13, "hexahedra have 8"},
      {"unknown cell", changed(vtu(), "10 10", "10 99"), "unknown_cell_type", 12, "99"},
      {"offsets fall", changed(vtu(), "4 8", "4 2"), "bad_offsets", 13, "must not fall"},
      {"tetrahedron of five", changed(vtu(), "4 8", "3 8"), "bad_offsets", 13, "4 points"},
      {"array missing", changed(vtu(), "\"types\"", "\"kinds\""), "missing_array", 4, "types"},
      {"two components", changed(vtu(), "NumberOfComponents=\"3\"", "NumberOfComponents=\"2\""),
       "bad_attribute", 9, "2 components"},
      {"number type", changed(vtu(base64), "Float64", "Float128"), "bad_attribute", 11,
       "'Float128'"},
      {"encoding", changed(vtu(), "format=\"ascii\"", "format=\"bits\""), "bad_attribute", 6,
       "'bits'"},
      {"bad base64", changed(vtu(base64), "A", "!", "\"Points\""), "bad_base64", 11, "'!'"},
      {"short base64", changed(vtu(base64), "AAAA", "", "\"Points\""), "truncated_file", 11,
       "too early"},
      {"bad zlib", changed(vtu({"appended", "raw", true}), "x\x9c", "xx"), "bad_zlib", 6,
       "data error"},
      {"compressor", changed(vtu(packed), "vtkZLibDataCompressor", "vtkLZ4DataCompressor"),
       "unsupported_compressor", 2, "LZ4"},
      {"offset behind the end", changed(raw, data, "offset=\"9999\""), "truncated_file", 6, "9999"},
      {"appended data cut", raw.substr(0, raw.find("  _") + 30), "truncated_file", 9, ""},
      {"no underscore", changed(raw, "  _", "   "), "bad_xml", 18, "underscore"},
  });
}

TEST_CASE("all wrong cells of a file are counted, not only the first", "[io][defects]") {
  std::string bad = changed(good_msh_22, "1 1 2 3 4", "1 1 2 3 8");
  bad = changed(bad, "1 2 3 4 5", "1 2 3 4 4");
  bad = changed(bad, "4 0 0 1", "4 0 0 nan");
  const Result<TetMesh> mesh = read_mesh(bad, "bad");
  CHECK_FALSE(mesh);
  CHECK(summary(mesh.findings) ==
        "error nan_coordinate 9, error index_out_of_range 14, error repeated_vertex 15");
  CHECK(mesh.findings[1].ids == std::vector<std::int64_t>{0});
  CHECK(mesh.findings[2].ids == std::vector<std::int64_t>{1});
}

TEST_CASE("a sample that is not read says how to convert it", "[io][defects]") {
  const Result<TetMesh> mesh = read_mesh(sample("meshio_lzma.vtu"));
  CHECK_FALSE(mesh);
  CHECK(mesh.findings.at(0).code == "unsupported_compressor");
}

TEST_CASE("each defect of a binary MEDIT file is found", "[io][defects][medit]") {
  const Folder folder;
  REQUIRE_FALSE(has_error(write_mesh(folder.path() / "good.meshb", two_tetrahedra())));
  const std::string good = bytes_of(folder.path() / "good.meshb");
  REQUIRE(good.size() == 8 + 16 + (16 + 5 * 28) + (16 + 2 * 20) + 12);
  const auto with = [&good](std::size_t at, std::int32_t number) {
    std::string bad = good;
    return bad.replace(at, 4, reinterpret_cast<const char*>(&number), 4);
  };
  const std::size_t vertices = 24, tetrahedra = vertices + 16 + 5 * 28;
  check_defects({
      {"version", with(4, 9), "unknown_version", 0, "version 9"},
      {"dimension", with(20, 4), "unsupported_cells", 0, "dimension 4"},
      {"cut", good.substr(0, 100), "count_too_big", 0, "5 vertices"},
      {"count", with(vertices + 12, 1000000), "count_too_big", 0, "1000000 vertices"},
      {"below 0", with(vertices + 12, -1), "bad_number", 0, "below 0"},
      {"next before", with(vertices + 4, 8), "wrong_count", 0, "byte 8"},
      {"next behind", with(vertices + 4, 1 << 20), "truncated_file", 0, "byte 1048576"},
      {"no such point", with(tetrahedra + 16, 77), "index_out_of_range", 0, "point 77"},
      {"no vertices", with(vertices, 999), "missing_section", 0, "Vertices"},
  });
}

const std::string good_vtk = R"(# vtk DataFile Version 3.0
title
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 4 double
0 0 0
1 0 0
0 1 0
0 0 1
CELLS 1 5
4 0 1 2 3
CELL_TYPES 1
10
CELL_DATA 1
SCALARS region int 1
LOOKUP_TABLE default
7
POINT_DATA 4
VECTORS v float
0 0 1 0 0 1 0 0 1 0 0 1
)";

TEST_CASE("each defect of a legacy VTK file is found at its line", "[io][defects][vtk]") {
  const std::string& good = good_vtk;
  const Result<FileMesh> mesh = read_file_mesh(good, "good");
  REQUIRE(mesh);
  CHECK(mesh->tetrahedra.region == std::vector<std::int32_t>{7});
  CHECK(mesh->point_data.at(0).type == NumberType::float32);
  check_defects({
      {"kind", changed(good, "ASCII", "ASKII"), "bad_attribute", 3, "'askii'"},
      {"points missing", changed(good, "POINTS 4", "POINTS 5"), "bad_number", 10, "'CELLS'"},
      {"points too many", changed(good, "POINTS 4", "POINTS 400"), "count_too_big", 5, "400"},
      {"type", changed(good, "4 double", "4 real"), "bad_attribute", 5, "'real'"},
      {"cut", good.substr(0, good.find("4 0 1 2 3")), "count_too_big", 10, "5 numbers of cells"},
      {"list too short", changed(good, "4 0 1 2 3", "9 0 1 2 3"), "wrong_count", 10, "cell 0"},
      {"another size", changed(good, "CELLS 1 5\n4 0 1 2 3", "CELLS 1 4\n3 0 1 2"), "bad_offsets",
       11, "tetrahedra have 4"},
      {"types missing", changed(good, "CELL_TYPES 1\n10", "CELL_TYPES 2\n10 10"), "wrong_count", 12,
       "2 cell types"},
      {"no types", good.substr(0, good.find("CELL_TYPES")), "missing_section", 12, "CELL_TYPES"},
      {"no such point", changed(good, "4 0 1 2 3", "4 0 1 2 4"), "index_out_of_range", 11,
       "point 4"},
      {"rows", changed(good, "CELL_DATA 1", "CELL_DATA 2"), "wrong_count", 14, "2 cells"},
      {"keyword", changed(good, "VECTORS", "VEKTORS"), "unknown_section", 19, "'VEKTORS'"},
      {"hexahedron", changed(good, "\n10\n", "\n12\n"), "bad_offsets", 11, "hexahedra have 8"},
  });
}

TEST_CASE("a file that cannot be opened is named with the reason", "[io][defects]") {
  const Folder folder;
  const Result<TetMesh> missing = read_mesh(folder.path() / "none.msh");
  CHECK(summary(missing.findings) == "error cannot_open 0");
  CHECK(missing.findings[0].text.find("No such file") != std::string::npos);
  const Result<TetMesh> directory = read_mesh(folder.path());
  CHECK(directory.findings[0].text.find("Is a directory") != std::string::npos);
}
