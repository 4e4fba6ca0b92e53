// SPDX-License-Identifier: MIT
// Files made to take as much memory as they can: Nastran bulk data, universal files, PolyData as
// XML.
#include <fmt/format.h>

#include "hostile.hpp"

using namespace sunder::test;

namespace {

/// Rows "HEAD N TAIL", numbered from 1.
std::string numbered(std::size_t n, std::string_view head, std::string_view tail,
                     std::size_t step = 1) {
  return repeated(n,
                  [&](std::size_t i) { return fmt::format("{}{}{}", head, 1 + i * step, tail); });
}

std::vector<Hostile> hostile_bulk_data() {
  const std::string four = "GRID,1,,0,0,0\nGRID,2,,1\nGRID,3,,,1\nGRID,4,,,,1\n";
  const std::string one = "CTETRA,1,1,1,2,3,4\n";
  return {
      {"bdf", "points without coordinates", numbered(many, "GRID,", "\n") + one},
      {"bdf", "points of scattered numbers", numbered(many, "GRID,", "\n", 999) + one},
      {"bdf", "tetrahedra", four + numbered(many, "CTETRA,", ",1,1,2,3,4\n")},
      {"bdf", "triangles", four + numbered(many, "CTRIA3,", ",1,1,2,3\n")},
      {"bdf", "rods of no property", four + numbered(many, "CROD,", ",,1,2\n") + one},
      {"bdf", "rods of a property each",
       four + one +
           repeated(many, [](std::size_t i) { return fmt::format("CROD,{0},{0},1,2\n", i + 1); })},
      {"bdf", "tetrahedra of ten points",
       four + numbered(many / 4, "CTETRA,", ",1,1,2,3,4,1,2\n,3,4,1,2\n")},
      {"bdf", "tetrahedra without some midpoints",
       four + numbered(many / 4, "CTETRA,", ",1,1,2,3,4,1,\n,3\n")},
      {"bdf", "one card that goes on and on", four + one + "SET1,1" + repeated(many, "\n,1")},
      {"bdf", "cards that nobody knows", four + one + numbered(many, "A", "\n")},
      {"bdf", "one letter as card", four + one + repeated(many, "A\n")},
      {"bdf", "elements that have no like", four + one + numbered(many, "CELAS", ",1\n")},
      {"bdf", "empty cards", four + one + repeated(many, ",\n")},
      {"bdf", "a long word", four + one + std::string(many, 'A')},
      {"bdf", "a file that includes itself",
       four + one + repeated(many / 10, "INCLUDE 'fuzz.bdf'\n")},
      {"bdf", "many included ends",
       four + one + repeated(many / 10, "INCLUDE 'a.x'\n") + "@@@ .x\n" + four},
  };
}

std::string data_set(int number, std::string_view rows) {
  return fmt::format("    -1\n{:6}\n{}    -1\n", number, rows);
}

std::vector<Hostile> hostile_unv() {
  const std::string four =
      data_set(2411, "1 1 1 1\n0 0 0\n2 1 1 1\n1 0 0\n3 1 1 1\n0 1 0\n4 1 1 1\n0 0 1\n");
  const std::string one = data_set(2412, "1 111 1 1 7 4\n1 2 3 4\n");
  const auto group = [](std::size_t members) {
    return [members](std::size_t i) {
      return fmt::format("{} 0 0 0 0 0 0 {}\nx{}\n{}", i + 1, members, i,
                         members == 1 ? "8 1 0 0\n" : "");
    };
  };
  const auto one_group = [](std::size_t members, std::string_view each) {
    return fmt::format("1 0 0 0 0 0 0 {}\nall\n{}", members, repeated(members, each));
  };
  return {
      {"unv", "nodes", data_set(2411, numbered(many, "", " 1\n0 0 0\n")) + one},
      {"unv", "nodes of scattered numbers",
       data_set(2411, numbered(many, "", "\n0 0 0\n", 999)) + one},
      {"unv", "nodes in one line each", data_set(15, numbered(many, "", " 0 0 0 0 0 0\n")) + one},
      {"unv", "tetrahedra", four + data_set(2412, numbered(many, "", " 111 1 1 7 4\n1 2 3 4\n"))},
      {"unv", "triangles", four + data_set(2412, numbered(many, "", " 91 1 1 1 3\n1 2 3\n"))},
      {"unv", "elements of one node of types that nobody knows",
       four +
           data_set(2412, repeated(many,
                                   [](std::size_t i) {
                                     return fmt::format("{} {} 0 0 0 1\n1\n", i + 2, 1000 + i);
                                   })) +
           one},
      {"unv", "groups of one element", four + one + data_set(2467, repeated(many / 4, group(1)))},
      {"unv", "groups of nothing", four + one + data_set(2467, repeated(many, group(0)))},
      {"unv", "one group of nodes", four + one + data_set(2467, one_group(many, "7 1 0 0\n"))},
      {"unv", "one group of nodes, two numbers a member",
       four + one + data_set(2432, one_group(many, "7 1\n"))},
      {"unv", "members that are not there",
       four + one + data_set(2467, one_group(many, "8 9 0 0\n"))},
      {"unv", "data sets of nothing", four + one + repeated(many, "-1\n2411\n-1\n")},
      {"unv", "data sets that nobody knows",
       four + one +
           repeated(many, [](std::size_t i) { return fmt::format("-1\n{}\n-1\n", 10 + i); })},
      {"unv", "coordinate systems",
       data_set(2420, "1\npart\n" + repeated(many / 4,
                                             [](std::size_t i) {
                                               return fmt::format(
                                                   "{} 1 0\n{}\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n",
                                                   i + 1, std::string(40, 'x'));
                                             })) +
           four + one},
  };
}

std::string poly(std::string_view counts, std::string_view inside, std::string_view behind = {}) {
  return fmt::format(
      "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\"><PolyData><Piece {}>{}</Piece>"
      "</PolyData>{}</VTKFile>",
      counts, inside, behind);
}

std::string array(std::string_view attributes, std::string_view text) {
  return fmt::format("<DataArray type=\"Int8\" {}>{}</DataArray>", attributes, text);
}

std::string list(std::string_view name, std::string_view connectivity, std::string_view offsets) {
  return fmt::format("<{0}>{1}{2}</{0}>", name, array("Name=\"connectivity\"", connectivity),
                     array("Name=\"offsets\"", offsets));
}

std::vector<Hostile> hostile_vtp() {
  const std::string three =
      "<Points>" + array("NumberOfComponents=\"3\"", "0 0 0 1 0 0 0 1 0") + "</Points>";
  const std::string bytes(3 * many, '\0');
  const std::string appended = "<AppendedData encoding=\"raw\">_" +
                               raw(static_cast<std::uint32_t>(bytes.size())) + bytes +
                               "</AppendedData>";
  const std::string in_bytes = "type=\"Int8\" format=\"appended\" offset=\"0\"";
  const auto counts = [](std::string_view name, std::size_t n) {
    return fmt::format("NumberOfPoints=\"3\" NumberOf{}=\"{}\"", name, n);
  };
  const auto one_cell = [](std::string_view name) {
    return fmt::format("<{0}>{1}<DataArray type=\"Int64\" Name=\"offsets\">{2}</DataArray></{0}>",
                       name, array("Name=\"connectivity\"", repeated(many, "0 1 2 ")), 3 * many);
  };
  const auto cell_data = [](const std::string& column) {
    return "<CellData>" + column + "</CellData>";
  };
  return {
      {"vtp", "cells of no points, a byte each",
       poly(counts("Verts", 3 * many),
            three + fmt::format("<Verts>{}<DataArray Name=\"offsets\" {}/></Verts>",
                                array("Name=\"connectivity\"", "0"), in_bytes),
            appended)},
      {"vtp", "cells of no points as text",
       poly(counts("Polys", many), three + list("Polys", "", repeated(many, "0 ")))},
      {"vtp", "a strip of many triangles", poly(counts("Strips", 1), three + one_cell("Strips"))},
      {"vtp", "a line of many edges with a column",
       poly(counts("Lines", 1),
            three + one_cell("Lines") +
                cell_data(array("Name=\"a\" NumberOfComponents=\"100\"", repeated(100, "1 "))))},
      {"vtp", "a strip of many triangles with a wide column",
       poly(counts("Strips", 1),
            three + one_cell("Strips") +
                cell_data(array(fmt::format("Name=\"a\" NumberOfComponents=\"{}\"", many),
                                repeated(many, "1 "))))},
      {"vtp", "a polygon of many corners", poly(counts("Polys", 1), three + one_cell("Polys"))},
      {"vtp", "columns of one number",
       poly("NumberOfPoints=\"1\"",
            "<Points>" + array("NumberOfComponents=\"3\"", "0 0 0") + "</Points><PointData>" +
                repeated(many / 4,
                         [](std::size_t i) { return array(fmt::format("Name=\"{}\"", i), "0"); }) +
                "</PointData>")},
      {"vtp", "second lists of a name",
       poly(counts("Verts", 0), three + repeated(many / 4, "<Verts></Verts>"))},
      {"vtk", "polygons of no points",
       fmt::format("# vtk DataFile Version 4.2\n\nASCII\nDATASET POLYDATA\nPOINTS 3 int\n"
                   "0 0 0 1 0 0 0 1 0\nPOLYGONS {0} {0}\n{1}",
                   many, repeated(many, "0\n"))},
      {"vtk", "vertices of one point",
       fmt::format("# vtk DataFile Version 4.2\n\nASCII\nDATASET POLYDATA\nPOINTS 3 int\n"
                   "0 0 0 1 0 0 0 1 0\nVERTICES {} {}\n{}",
                   many, 2 * many, repeated(many, "1 0\n"))},
  };
}

}  // namespace

TEST_CASE("Nastran takes at most ten times the file", "[fuzz][memory][nastran]") {
  check_all(hostile_bulk_data());
}

TEST_CASE("UNV takes at most ten times the file", "[fuzz][memory][unv]") {
  check_all(hostile_unv());
}

TEST_CASE("VTP and PolyData in VTK take at most ten times the file", "[fuzz][memory][vtp]") {
  check_all(hostile_vtp());
}
