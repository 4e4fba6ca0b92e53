// SPDX-License-Identifier: MIT
// Reading legacy VTK: a header of four lines, then keywords with their numbers, text or big-endian.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "topology/io/number_source.hpp"
#include "topology/io/vtk.hpp"
#include "topology/io/vtk_columns.hpp"

namespace sunder::io {
namespace {

struct VtkType {
  std::string_view name;
  NumberType type;
  std::size_t bytes;
};
/// `long` has 8 bytes where these files are written; ids are written as int.
constexpr VtkType number_types[] = {
    {"double", NumberType::float64, 8},
    {"float", NumberType::float32, 4},
    {"char", NumberType::int8, 1},
    {"signed_char", NumberType::int8, 1},
    {"unsigned_char", NumberType::uint8, 1},
    {"short", NumberType::int16, 2},
    {"unsigned_short", NumberType::uint16, 2},
    {"int", NumberType::int32, 4},
    {"unsigned_int", NumberType::uint32, 4},
    {"vtkIdType", NumberType::int32, 4},
    {"long", NumberType::int64, 8},
    {"unsigned_long", NumberType::uint64, 8},
    {"vtktypeint8", NumberType::int8, 1},
    {"vtktypeuint8", NumberType::uint8, 1},
    {"vtktypeint16", NumberType::int16, 2},
    {"vtktypeuint16", NumberType::uint16, 2},
    {"vtktypeint32", NumberType::int32, 4},
    {"vtktypeuint32", NumberType::uint32, 4},
    {"vtktypeint64", NumberType::int64, 8},
    {"vtktypeuint64", NumberType::uint64, 8},
};

struct VtkReader {
  NumberSource in;
  Draft draft;
  VtkCells cells;
  VtkPiece piece;
  VtkNames names;
  bool has_points = false;
  bool has_cells = false;
  bool has_types = false;
  std::size_t cells_at = 0;
  /// What data belong to that come next: 0 nothing, 1 points, 2 cells.
  int data_of = 0;
  std::size_t rows = 0;
};

std::string lower(std::string_view word) {
  std::string text(word);
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

const VtkType& read_type(VtkReader& r) {
  Scanner& s = r.in.s;
  const std::string word = lower(peek_word(s));
  const std::size_t at = s.at;
  for (const VtkType& type : number_types) {
    if (lower(type.name) != word) continue;
    next_word(s);
    return type;
  }
  if (word.empty()) fail_expected(s, "a type of numbers");
  fail(s.text, at,
       {.code = "bad_attribute",
        .text = fmt::format("{} is not one of the types double, float, char ... unsigned_long",
                            in_quotes(word)),
        .remedy = "write the array with one of these types"});
}

/// Hands `n` numbers to `take`, one after the other.
template <class Value, class Take>
void read_numbers(VtkReader& r, std::size_t n, const VtkType& type, Take&& take) {
  if (!r.in.is_binary) {
    for (std::size_t i = 0; i < n; ++i) take(read_number<Value>(r.in.s, "a number"));
    return;
  }
  with_stored(type.type, [&]<class Stored>(Stored) {
    for (std::size_t i = 0; i < n; ++i) {
      take(static_cast<Value>(read_raw<Stored>(r.in, "a number")));
    }
  });
}

/// Raw numbers begin behind the line's end.
void begin_numbers(VtkReader& r, std::size_t n, const VtkType& type, std::string_view what) {
  if (r.in.is_binary) rest_of_line(r.in.s);
  check_count(r.in.s, r.in.s.at, static_cast<std::int64_t>(n), what,
              r.in.is_binary ? type.bytes : 1);
}

std::vector<std::int64_t> read_integers(VtkReader& r, std::size_t n, const VtkType& type) {
  std::vector<std::int64_t> values;
  values.reserve(n);
  read_numbers<std::int64_t>(r, n, type, [&](std::int64_t value) { values.push_back(value); });
  return values;
}

/// A product of two counts that have to fit into the file: too big where it overflows.
std::size_t product(VtkReader& r, std::size_t a, std::size_t b, std::string_view what) {
  if (b != 0 && a > r.in.s.text.size() / b) {
    check_count(r.in.s, r.in.s.at, static_cast<std::int64_t>(r.in.s.text.size()) + 1, what, 1);
  }
  return a * b;
}

void refuse_second(VtkReader& r, bool& seen, std::string_view section) {
  if (std::exchange(seen, true)) {
    fail(r.in.s.text, r.in.s.at,
         {.code = "wrong_section_order",
          .text = fmt::format("a second section {}", section),
          .remedy = "join the two sections, or give them as two files"});
  }
}

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
  read_numbers<double>(r, numbers, type, [&](double x) {
    point[k++] = x;
    if (k < 3) return;
    add_point(r.draft, point, at);
    k = 0;
  });
  r.piece.points = n;
}

/// Up to version 4.2: each cell its number of points, then those.
void read_counted_cells(VtkReader& r, std::size_t n, std::size_t size) {
  const VtkType& integer = number_types[7];  // int
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

const VtkType& read_integer_type(VtkReader& r) {
  const std::size_t at = r.in.s.at;
  const VtkType& type = read_type(r);
  if (!is_real(type.type)) return type;
  fail(r.in.s.text, at,
       {.code = "bad_attribute",
        .text = fmt::format("type {} where integers were expected", type.name),
        .remedy = "write the array with an integer type"});
}

/// From version 5.0 on: where each cell begins, and all points.
void read_offset_cells(VtkReader& r, std::size_t offsets, std::size_t size) {
  expect_word(r.in.s, "OFFSETS");
  const VtkType& offset_type = read_integer_type(r);
  begin_numbers(r, offsets, offset_type, "offsets");
  const std::size_t at = r.in.s.at;
  std::vector<std::int64_t> begins = read_integers(r, offsets, offset_type);
  expect_word(r.in.s, "CONNECTIVITY");
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

void read_cells(VtkReader& r) {
  refuse_second(r, r.has_cells, "CELLS");
  const std::size_t n = read_count(r.in.s, "cells", 1);
  const std::size_t size = read_count(r.in.s, "numbers of cells", 1);
  Scanner ahead = r.in.s;  // raw numbers may begin with what looks like blanks
  const bool has_offsets = peek_word(ahead) == "OFFSETS";
  r.cells_at = ahead.at;
  has_offsets ? read_offset_cells(r, n, size) : read_counted_cells(r, n, size);
}

void read_types(VtkReader& r) {
  refuse_second(r, r.has_types, "CELL_TYPES");
  const std::size_t n = read_count(r.in.s, "cell types", 1);
  const std::size_t at = r.in.s.at;
  const VtkType& integer = number_types[7];
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

/// Names have blanks and the like as %20.
std::string decoded(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    unsigned code = 0;
    if (name[i] == '%' && i + 2 < name.size() &&
        std::from_chars(name.data() + i + 1, name.data() + i + 3, code, 16).ptr ==
            name.data() + i + 3) {
      text += static_cast<char>(code);
      i += 2;
    } else {
      text += name[i];
    }
  }
  return text;
}

void take_column(VtkReader& r, std::string_view name, std::size_t components, std::size_t rows,
                 const VtkType& type) {
  const std::size_t n = product(r, rows, components, "numbers");
  begin_numbers(r, n, type, "numbers");
  const VtkArrayHead head{decoded(name), components, type.type, r.data_of == 2, r.in.s.at};
  const bool is_of_rows = r.data_of != 0 && components > 0;  // others: a time, a cycle
  if (is_of_rows && rows != r.rows) {
    fail(r.in.s.text, head.at,
         {.code = "wrong_count",
          .text =
              fmt::format("array {} has {} rows: {} were expected", in_quotes(name), rows, r.rows),
          .remedy = "give one row for each point or cell"});
  }
  if (!is_of_rows || rows == 0 || !is_new_name(r.draft, r.names, head)) {
    is_real(type.type) ? read_numbers<double>(r, n, type, [](double) {})
                       : read_numbers<std::int64_t>(r, n, type, [](std::int64_t) {});
  } else if (is_vtk_label(head)) {
    add_vtk_label(r.draft, r.piece, head, read_integers(r, n, type));
  } else if (is_real(type.type)) {
    read_numbers<double>(r, n, type, begin_vtk_data<double>(r.draft, r.piece, head, n));
  } else {
    read_numbers<std::int64_t>(r, n, type, begin_vtk_data<std::int64_t>(r.draft, r.piece, head, n));
  }
}

/// Names of components and units, up to a blank line.
void skip_metadata(VtkReader& r) {
  rest_of_line(r.in.s);
  while (r.in.s.at < r.in.s.text.size() && !rest_of_line(r.in.s).empty()) continue;
}

void read_field(VtkReader& r) {
  next_word(r.in.s);  // the field's own name
  const std::size_t arrays = read_count(r.in.s, "arrays", 4);
  for (std::size_t i = 0; i < arrays; ++i) {
    std::string_view name = next_word(r.in.s);
    if (name == "METADATA") {  // of the array before
      skip_metadata(r);
      name = next_word(r.in.s);
    }
    const std::size_t components = read_count(r.in.s, "components", 1);
    const std::size_t rows = read_count(r.in.s, "rows", 1);
    take_column(r, name, components, rows, read_type(r));
  }
}

void read_scalars(VtkReader& r) {
  const std::string_view name = next_word(r.in.s);
  const VtkType& type = read_type(r);
  std::size_t components = 1;
  Scanner line = r.in.s;
  const std::string_view rest = rest_of_line(line);
  if (!rest.empty()) components = read_count(r.in.s, "components", 1);
  expect_word(r.in.s, "LOOKUP_TABLE");
  next_word(r.in.s);
  take_column(r, name, components, r.rows, type);
}

void read_data_head(VtkReader& r, std::size_t at, bool of_points) {
  const std::size_t rows = read_count(r.in.s, "rows", 1);
  const std::size_t expected = of_points ? r.piece.points : r.piece.list_of_cell.size();
  if (rows != expected) {
    fail(r.in.s.text, at,
         {.code = "wrong_count",
          .text = fmt::format("data of {} {} are announced: the file has {}", rows,
                              of_points ? "points" : "cells", expected),
          .remedy = "correct the count, or write the file again"});
  }
  r.data_of = of_points ? 1 : 2;
  r.rows = rows;
}

/// Tables of colours belong to no row.
void skip_lookup_table(VtkReader& r) {
  next_word(r.in.s);
  const std::size_t n = read_count(r.in.s, "colours", 1);
  const std::size_t numbers = product(r, n, 4, "numbers");
  if (r.in.is_binary) rest_of_line(r.in.s);
  skip_numbers(r.in, numbers, numbers, "a colour");
}

void read_keyword(VtkReader& r, std::string_view word, std::size_t at) {
  const std::string keyword = lower(word);
  if (keyword == "points") return read_points(r);
  if (keyword == "cells") return read_cells(r);
  if (keyword == "cell_types") return read_types(r);
  if (keyword == "point_data") return read_data_head(r, at, true);
  if (keyword == "cell_data") return read_data_head(r, at, false);
  if (keyword == "field") return read_field(r);
  if (keyword == "scalars") return read_scalars(r);
  if (keyword == "lookup_table") return skip_lookup_table(r);
  if (keyword == "metadata") return skip_metadata(r);
  const bool is_vector = keyword == "vectors" || keyword == "normals";
  if (is_vector || keyword == "tensors") {
    const std::string_view name = next_word(r.in.s);
    const VtkType& type = read_type(r);
    return take_column(r, name, is_vector ? 3 : 9, r.rows, type);
  }
  if (keyword == "texture_coordinates") {
    const std::string_view name = next_word(r.in.s);
    const std::size_t components = read_count(r.in.s, "components", 1);
    return take_column(r, name, components, r.rows, read_type(r));
  }
  fail(r.in.s.text, at,
       {.code = "unknown_section",
        .text = fmt::format("{} stands where a keyword (POINTS, CELLS, ...) was expected",
                            in_quotes(word)),
        .remedy = "a count before it is wrong, or the file is damaged: write it again"});
}

void read_head(VtkReader& r) {
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
  expect_word(s, "DATASET");
  const std::size_t kind_at = s.at;
  const std::string_view dataset = next_word(s);
  if (lower(dataset) != "unstructured_grid") {
    fail(s.text, kind_at,
         {.code = "unknown_format",
          .text = fmt::format("a VTK file of type {} is not read", in_quotes(dataset)),
          .remedy = "save it as an unstructured grid of tetrahedra"});
  }
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
  read_head(r);
  while (!peek_word(r.in.s).empty()) {
    const std::size_t at = r.in.s.at;
    read_keyword(r, next_word(r.in.s), at);
  }
  for (const auto& [seen, name] :
       {std::pair{r.has_points, "POINTS"}, {r.has_types, "CELL_TYPES"}}) {
    if (seen) continue;
    fail(text, text.size(),
         {.code = "missing_section",
          .text = fmt::format("the file ends without {}", name),
          .remedy = "the file was cut short, or holds no mesh: write it again"});
  }
  finish_vtk_columns(r.draft);
  return std::move(r.draft);
}

}  // namespace sunder::io
