// SPDX-License-Identifier: MIT
// Reading legacy VTK: a header of four lines, then keywords with their numbers, text or big-endian.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "topology/io/vtk/vtk.hpp"
#include "topology/io/vtk/vtk_polydata.hpp"
#include "topology/io/vtk/vtk_reader.hpp"

namespace sunder::io {
namespace {

void read_points(VtkReader& r) {
  refuse_second(r, r.has_points, "POINTS");
  const std::size_t n = read_count(r.in.s, "points", 3);
  const VtkType& type = read_type(r);
  const std::size_t numbers = product(r, n, 3, "coordinates");
  begin_numbers(r, numbers, type, "coordinates");
  const std::size_t at = r.in.s.at;
  r.draft.mesh.points.reserve(n);
  Point point;
  std::size_t k = 0;
  // Digits of coordinates are kept, whatever the type.
  const VtkType& kept = is_real(type.type) && !r.in.is_binary ? double_type() : type;
  read_numbers<double>(r, numbers, kept, [&](double x) {
    point[k++] = x;
    if (k < 3) return;
    add_point(r.draft, point, at);
    k = 0;
  });
  r.piece.points = n;
}

/// Up to version 4.2: each cell its number of points, then those.
void read_counted_cells(VtkReader& r, std::size_t n, std::size_t size) {
  const VtkType& integer = int_type();
  begin_numbers(r, size, integer, "numbers of cells");
  const std::size_t at = r.in.s.at;
  const std::vector<std::int64_t> list = read_integers(r, size, integer);
  r.cells.ends.reserve(n);
  r.cells.points.reserve(list.size() - std::min(n, list.size()));
  std::size_t next = 0;
  for (std::size_t c = 0; c < n; ++c) {
    const std::int64_t count = next < list.size() ? list[next] : -1;
    if (count < 0 || static_cast<std::size_t>(count) > list.size() - next - 1) {
      fail(r.in.s.text, at,
           {.code = "wrong_count",
            .text = fmt::format("cell {} begins at number {} of the list with {}, but the list has "
                                "{} numbers",
                                c, next, count, list.size()),
            .remedy = "correct the counts, or write the file again"});
    }
    const auto first = list.begin() + static_cast<std::ptrdiff_t>(next) + 1;
    r.cells.points.insert(r.cells.points.end(), first, first + count);
    r.cells.ends.push_back(static_cast<std::int64_t>(r.cells.points.size()));
    next += static_cast<std::size_t>(count) + 1;
  }
}

/// From version 5.0 on: where each cell begins, and all points.
void read_offset_cells(VtkReader& r, std::size_t offsets, std::size_t size) {
  expect_keyword(r, "OFFSETS");
  const VtkType& offset_type = read_integer_type(r);
  begin_numbers(r, offsets, offset_type, "offsets");
  const std::size_t at = r.in.s.at;
  std::vector<std::int64_t> begins = read_integers(r, offsets, offset_type);
  expect_keyword(r, "CONNECTIVITY");
  const VtkType& type = read_integer_type(r);
  begin_numbers(r, size, type, "numbers of cells");
  r.cells.points = read_integers(r, size, type);
  const bool whole = begins.empty()
                         ? size == 0
                         : begins.front() == 0 && begins.back() == static_cast<std::int64_t>(size);
  if (!whole) {
    fail(r.in.s.text, at,
         {.code = "bad_offsets",
          .text = fmt::format("offsets run from {} to {}: from 0 to {} was expected",
                              begins.empty() ? 0 : begins.front(),
                              begins.empty() ? 0 : begins.back(), size),
          .remedy = "the file is damaged: write it again"});
  }
  if (!begins.empty()) begins.erase(begins.begin());
  r.cells.ends = std::move(begins);
}

}  // namespace

void refuse_second(VtkReader& r, bool& seen, std::string_view section) {
  if (std::exchange(seen, true)) {
    fail(r.in.s.text, r.in.s.at,
         {.code = "wrong_section_order",
          .text = fmt::format("a second section {}", section),
          .remedy = "join the two sections, or give them as two files"});
  }
}

void expect_section(VtkReader& r, bool seen, std::string_view name) {
  if (seen) return;
  fail(r.in.s.text, r.in.s.text.size(),
       {.code = "missing_section",
        .text = fmt::format("the file ends without {}", name),
        .remedy = "the file was cut short, or holds no mesh: write it again"});
}

void read_cell_list(VtkReader& r) {
  const std::size_t n = read_count(r.in.s, "cells", 1);
  const std::size_t size = read_count(r.in.s, "numbers of cells", 1);
  Scanner ahead = r.in.s;  // raw numbers may begin with bytes that look like blanks
  const bool has_offsets = lower(peek_word(ahead)) == "offsets";
  r.cells_at = ahead.at;
  has_offsets ? read_offset_cells(r, n, size) : read_counted_cells(r, n, size);
}

namespace {

void read_types(VtkReader& r) {
  refuse_second(r, r.has_types, "CELL_TYPES");
  const std::size_t n = read_count(r.in.s, "cell types", 1);
  const std::size_t at = r.in.s.at;
  const VtkType& integer = int_type();
  begin_numbers(r, n, integer, "cell types");
  r.cells.types = read_integers(r, n, integer);
  if (!r.has_cells || n != r.cells.ends.size()) {
    fail(r.in.s.text, at,
         {.code = "wrong_count",
          .text = fmt::format("{} cell types for {} cells", n, r.cells.ends.size()),
          .remedy = "give each cell its type, behind CELLS"});
  }
  check_vtk_cells(r.cells, r.draft.text, r.cells_at);
  add_vtk_cells(r.draft, r.piece, r.cells, r.cells_at);
  r.cells = {};
}

void read_data_head(VtkReader& r, std::size_t at, bool of_points) {
  // No array has to follow, so the file may end here.
  const auto rows = read_number<std::int64_t>(r.in.s, "a number of rows");
  const std::size_t expected = of_points ? r.piece.points : r.piece.list_of_cell.size();
  if (rows != static_cast<std::int64_t>(expected)) {
    fail(r.in.s.text, at,
         {.code = "wrong_count",
          .text = fmt::format("data of {} {} are announced: the file has {}", rows,
                              of_points ? "points" : "cells", expected),
          .remedy = "correct the count, or write the file again"});
  }
  r.data_of = of_points ? 1 : 2;
  r.rows = expected;
}

/// Tables of colours belong to no row.
void skip_lookup_table(VtkReader& r, std::size_t at) {
  add_skipped(r.draft, "tables of colours", next_word(r.in.s), at);
  const std::size_t n = read_count(r.in.s, "colours", 1);
  const std::size_t numbers = product(r, n, 4, "numbers");
  if (r.in.is_binary) rest_of_line(r.in.s);
  skip_numbers(r.in, numbers, numbers, "a colour");
}

}  // namespace

void read_keyword(VtkReader& r, std::string_view word, std::size_t at) {
  const std::string keyword = lower(word);
  if (keyword == "points") return read_points(r);
  if (keyword == "cells") {
    refuse_second(r, r.has_cells, "CELLS");
    return read_cell_list(r);
  }
  if (keyword == "cell_types") return read_types(r);
  if (keyword == "point_data") return read_data_head(r, at, true);
  if (keyword == "cell_data") return read_data_head(r, at, false);
  if (keyword == "lookup_table") return skip_lookup_table(r, at);
  if (keyword == "metadata") return skip_metadata(r);
  if (read_attribute(r, keyword)) return;
  fail(r.in.s.text, at,
       {.code = "unknown_section",
        .text = fmt::format("{} stands where a keyword (POINTS, CELLS, ...) was expected",
                            in_quotes(word)),
        .remedy = "a count before it is wrong, or the file is damaged: write it again"});
}

namespace {

/// Gives whether the file holds PolyData, and not an unstructured grid.
bool read_head(VtkReader& r) {
  Scanner& s = r.in.s;
  rest_of_line(s);  // # vtk DataFile Version x.y
  rest_of_line(s);  // a title
  const std::size_t at = s.at;
  const std::string kind = lower(next_word(s));
  if (kind != "ascii" && kind != "binary") {
    fail(s.text, at,
         {.code = "bad_attribute",
          .text =
              fmt::format("the third line says {}: ASCII or BINARY was expected", in_quotes(kind)),
          .remedy = "correct the line, or write the file again"});
  }
  r.in.is_binary = kind == "binary";
  r.in.swap = std::endian::native == std::endian::little;
  if (r.in.is_binary) r.draft.text = {};
  expect_keyword(r, "DATASET");
  const std::size_t kind_at = s.at;
  const std::string_view dataset = next_word(s);
  const bool is_polydata = lower(dataset) == "polydata";
  if (lower(dataset) != "unstructured_grid" && !is_polydata) {
    fail(s.text, kind_at,
         {.code = "unknown_format",
          .text = fmt::format("a VTK file of type {} is not read", in_quotes(dataset)),
          .remedy = "save it as an unstructured grid, or as PolyData"});
  }
  return is_polydata;
}

}  // namespace

bool is_vtk(std::string_view text) {
  Scanner s{text};
  while (peek_word(s).starts_with('#')) {
    if (rest_of_line(s).starts_with("# vtk DataFile")) return true;
  }
  return false;
}

Draft read_vtk(std::string_view text) {
  VtkReader r{.in = {.s = {.text = text}}, .draft = {.text = text}};
  if (read_head(r)) return read_polydata(std::move(r));
  while (!peek_word(r.in.s).empty()) {
    const std::size_t at = r.in.s.at;
    read_keyword(r, next_word(r.in.s), at);
  }
  expect_section(r, r.has_points, "POINTS");
  expect_section(r, r.has_types, "CELL_TYPES");
  finish_vtk_columns(r.draft);
  return std::move(r.draft);
}

}  // namespace sunder::io
