// SPDX-License-Identifier: MIT
// Data of legacy VTK in text and raw: every keyword, types that are no plain numbers.
#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Big-endian.
template <class Number>
std::string raw(std::initializer_list<Number> numbers) {
  std::string bytes;
  for (const Number number : numbers) {
    std::string one(reinterpret_cast<const char*>(&number), sizeof number);
    if (std::endian::native == std::endian::little) one = {one.rbegin(), one.rend()};
    bytes += one;
  }
  return bytes;
}

const std::string text_head =
    "# vtk DataFile Version 4.2\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
    "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
const std::string raw_head =
    "# vtk DataFile Version 4.2\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\n"
    "POINTS 4 double\n" +
    raw<double>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) + "\nCELLS 1 5\n" +
    raw<std::int32_t>({4, 0, 1, 2, 3}) + "\nCELL_TYPES 1\n" + raw<std::int32_t>({10}) + "\n";

FileMesh read_whole(const std::string& text) { return test::read_whole(text, "a.vtk"); }

std::vector<double> numbers_of(const DataColumn& column) {
  return std::visit([](const auto& v) { return std::vector<double>(v.begin(), v.end()); },
                    column.values);
}

}  // namespace

TEST_CASE("bits are numbers, in text and eight a byte", "[io][vtk][attributes]") {
  const std::string of_points = "POINT_DATA 4\nFIELD f 2\nb 3 4 bit\n";
  const std::string behind = "after 1 4 int\n";
  const FileMesh text =
      read_whole(text_head + of_points + "1 0 1 1 0 0 0 1 0 1 1 1\n" + behind + "5 6 7 8\n");
  const FileMesh binary =
      read_whole(raw_head + of_points + "\xb1\x70\n" + behind + raw<std::int32_t>({5, 6, 7, 8}));
  CHECK(text.point_data == binary.point_data);
  REQUIRE(text.point_data.size() == 2);
  CHECK(text.point_data[0].type == NumberType::uint8);
  CHECK(text.point_data[0].components == 3);
  CHECK(numbers_of(text.point_data[0]) == std::vector<double>{1, 0, 1, 1, 0, 0, 0, 1, 0, 1, 1, 1});
  CHECK(numbers_of(text.point_data[1]) == std::vector<double>{5, 6, 7, 8});
  const FileMesh scalars =
      read_whole(raw_head + "POINT_DATA 4\nSCALARS s bit\nLOOKUP_TABLE d\n\xa0");
  CHECK(numbers_of(scalars.point_data.at(0)) == std::vector<double>{1, 0, 1, 0});
}

TEST_CASE("bits with the name of a label are labels", "[io][vtk][attributes]") {
  const std::string of_cells = "CELL_DATA 1\nFIELD f 1\nregion 1 1 ";
  CHECK(read_whole(text_head + of_cells + "bit\n1\n") ==
        read_whole(text_head + of_cells + "int\n1\n"));
  CHECK(read_whole(raw_head + of_cells + "bit\n\x80") ==
        read_whole(text_head + of_cells + "bit\n1\n"));
}

TEST_CASE("strings are passed over whatever their lengths", "[io][vtk][attributes]") {
  const std::string longer(100, 'x'), longest(20000, 'y');
  const std::string of_points = "POINT_DATA 4\nFIELD f 2\ns 1 4 string\n";
  const std::string behind = "\nafter 1 4 int\n";
  std::string raw_strings =
      "\xc1"
      "a\xc0";
  raw_strings += raw<std::uint16_t>({0x8000 | 100}) + longer;
  raw_strings += raw<std::uint32_t>({0x40000000 | 20000}) + longest;
  const Result<FileMesh> binary = read_file_mesh(
      raw_head + of_points + raw_strings + behind + raw<std::int32_t>({5, 6, 7, 8}), "a.vtk");
  const Result<FileMesh> text = read_file_mesh(
      text_head + of_points + "a\n\n" + longer + "\n" + longest + behind + "5 6 7 8\n", "a.vtk");
  for (const auto* mesh : {&binary, &text}) {
    INFO(summary(mesh->findings));
    REQUIRE(*mesh);
    CHECK(mesh->findings.at(0).text == "data that are strings are left out: s");
    CHECK(numbers_of(mesh->value->point_data.at(0)) == std::vector<double>{5, 6, 7, 8});
  }
}

TEST_CASE("colours are real numbers in text and bytes in raw data", "[io][vtk][attributes]") {
  const std::string of_cells = "CELL_DATA 1\nCOLOR_SCALARS c 2\n";
  const FileMesh text = read_whole(text_head + of_cells + "0.25 1\n");
  const FileMesh binary = read_whole(raw_head + of_cells + "\x40\xff\n");
  CHECK(numbers_of(text.tetrahedra.data.at(0)) == std::vector<double>{0.25, 1});
  CHECK(numbers_of(binary.tetrahedra.data.at(0)) == std::vector<double>{64, 255});
  CHECK(binary.tetrahedra.data[0].type == NumberType::uint8);
}

TEST_CASE("keywords may be written in lower case", "[io][vtk][attributes]") {
  std::string text = text_head +
                     "POINT_DATA 4\nSCALARS s int 1\nLOOKUP_TABLE default\n1 2 3 4\n"
                     "TENSORS6 t float\n" +
                     std::string("1 2 3 4 5 6\n1 2 3 4 5 6\n") +
                     "1 2 3 4 5 6\n1 2 3 4 5 6\nGLOBAL_IDS g vtkIdType\n9 8 7 6\n";
  const FileMesh upper = read_whole(text);
  for (std::size_t i = text.find("ASCII"); i < text.size(); ++i) {
    if (text[i] >= 'A' && text[i] <= 'Z') text[i] = static_cast<char>(text[i] - 'A' + 'a');
  }
  const FileMesh lower = read_whole(text);
  CHECK(lower.point_data == upper.point_data);
  REQUIRE(lower.point_data.size() == 3);
  CHECK(lower.point_data[1].components == 6);
  CHECK(numbers_of(lower.point_data[2]) == std::vector<double>{9, 8, 7, 6});
  const std::string offsets =
      "# vtk DataFile Version 5.1\nx\nascii\ndataset unstructured_grid\npoints 3 float\n"
      "0 0 0 1 0 0 0 1 0\ncells 2 3\noffsets vtktypeint64\n0 3\nconnectivity vtktypeint64\n0 1 2\n"
      "cell_types 1\n5\nmetadata\ninformation 0\n\n";
  CHECK(read_whole(offsets).triangles.corners.size() == 1);
}

TEST_CASE("data without arrays are none", "[io][vtk][attributes]") {
  for (const std::string behind : {"POINT_DATA 4\n", "POINT_DATA 4\nCELL_DATA 1\n", "CELL_DATA 1",
                                   "POINT_DATA 4\nFIELD f 0\n", "CELL_DATA 1\nPOINT_DATA 4"}) {
    CHECK(read_file_mesh(text_head + behind, "a.vtk").findings.empty());
    CHECK(read_file_mesh(raw_head + behind, "a.vtk").findings.empty());
  }
  const Result<FileMesh> wrong = read_file_mesh(text_head + "POINT_DATA 5\n", "a.vtk");
  CHECK(summary(wrong.findings) == "error wrong_count 11");
}

TEST_CASE("arrays that end too early are refused", "[io][vtk][attributes]") {
  const std::string field = "POINT_DATA 4\nFIELD f 1\n";
  for (const std::string& bad :
       {raw_head + field + "s 1 4 string\n\xc1" + "a", raw_head + field + "b 9 4 bit\n\x01\x02",
        raw_head + field + "s 1 4 string\n" + std::string(8, '\0') + "\x7f",
        text_head + field + "s 1 4 string\na\n", text_head + field + "b 1 4 bit\n1 0\n",
        text_head + field + "b 1 4 bit\n1 0 2 1\n",
        text_head + field + "b 1 99999999 bit\n1 0\n"}) {
    const Result<FileMesh> mesh = read_file_mesh(bad, "a.vtk");
    INFO(summary(mesh.findings));
    CHECK_FALSE(mesh);
  }
}

TEST_CASE("components may stand behind a type without a blank", "[io][vtk][attributes]") {
  const FileMesh expected =
      read_whole(text_head + "CELL_DATA 1\nSCALARS Label int 1\nLOOKUP_TABLE t\n7\n");
  // As FreeFem writes it.
  CHECK(read_whole(text_head + "CELL_DATA 1\nScalars  Label int1\nLOOKUP_TABLE t\n7\n") ==
        expected);
  CHECK(read_whole(raw_head + "CELL_DATA 1\nScalars  Label int1\nLOOKUP_TABLE t\n" +
                   raw<std::int32_t>({7})) == expected);
  const std::string values = "\nLOOKUP_TABLE default\n1 2 3\n";
  const FileMesh three = read_whole(text_head + "CELL_DATA 1\nSCALARS v float 3" + values);
  CHECK(three.tetrahedra.data.at(0).components == 3);
  CHECK(read_whole(text_head + "CELL_DATA 1\nSCALARS v float3" + values) == three);
  CHECK(read_whole(text_head + "CELL_DATA 1\nSCALARS b bit1\nLOOKUP_TABLE t\n1\n") ==
        read_whole(text_head + "CELL_DATA 1\nSCALARS b bit\nLOOKUP_TABLE t\n1\n"));
  for (const std::string type : {"int0", "int99999999999", "integer", "1", "int1x"}) {
    const Result<FileMesh> refused = read_file_mesh(
        text_head + "CELL_DATA 1\nSCALARS v " + type + "\nLOOKUP_TABLE t\n7\n", "a.vtk");
    INFO(type);
    CHECK_FALSE(refused);
  }
}

TEST_CASE("every word that VTK has for a type is read, in any case", "[io][vtk][attributes]") {
  struct Word {
    std::string name;
    NumberType type;
    std::string bytes;
  };
  const Word words[] = {
      {"char", NumberType::int8, raw<std::int8_t>({7})},
      {"signed_char", NumberType::int8, raw<std::int8_t>({7})},
      {"unsigned_char", NumberType::uint8, raw<std::uint8_t>({7})},
      {"short", NumberType::int16, raw<std::int16_t>({7})},
      {"unsigned_short", NumberType::uint16, raw<std::uint16_t>({7})},
      {"int", NumberType::int32, raw<std::int32_t>({7})},
      {"unsigned_int", NumberType::uint32, raw<std::uint32_t>({7})},
      {"vtkIdType", NumberType::int32, raw<std::int32_t>({7})},
      {"long", NumberType::int64, raw<std::int64_t>({7})},
      {"unsigned_long", NumberType::uint64, raw<std::uint64_t>({7})},
      {"long_long", NumberType::int64, raw<std::int64_t>({7})},
      {"unsigned_long_long", NumberType::uint64, raw<std::uint64_t>({7})},
      {"vtktypeint64", NumberType::int64, raw<std::int64_t>({7})},
      {"vtktypeuint64", NumberType::uint64, raw<std::uint64_t>({7})},
      {"vtkTypeInt8", NumberType::int8, raw<std::int8_t>({7})},
      {"vtkTypeFloat32", NumberType::float32, raw<float>({7})},
      {"vtkTypeFloat64", NumberType::float64, raw<double>({7})},
      {"float", NumberType::float32, raw<float>({7})},
      {"double", NumberType::float64, raw<double>({7})},
      {"int16", NumberType::int16, raw<std::int16_t>({7})},
      {"uint8", NumberType::uint8, raw<std::uint8_t>({7})},
      {"float64", NumberType::float64, raw<double>({7})},
  };
  for (const Word& word : words) {
    INFO(word.name);
    const std::string head = "CELL_DATA 1\nSCALARS s " + word.name + "\nLOOKUP_TABLE default\n";
    const FileMesh text = read_whole(text_head + head + "7\n");
    CHECK(text.tetrahedra.data.at(0).type == word.type);
    CHECK(numbers_of(text.tetrahedra.data[0]) == std::vector<double>{7});
    CHECK(read_whole(raw_head + head + word.bytes) == text);
  }
}
