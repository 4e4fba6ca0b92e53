// SPDX-License-Identifier: MIT
// Numbers and columns of legacy VTK, text or big-endian.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "topology/io/vtk/vtk_reader.hpp"

namespace sunder::io {
namespace {

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

}  // namespace

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

std::size_t product(VtkReader& r, std::size_t a, std::size_t b, std::string_view what) {
  if (b != 0 && a > r.in.s.text.size() / b) {
    check_count(r.in.s, r.in.s.at, static_cast<std::int64_t>(r.in.s.text.size()) + 1, what, 1);
  }
  return a * b;
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

const VtkType& int_type() { return *std::ranges::find(number_types, "int", &VtkType::name); }

const VtkType& double_type() { return number_types[0]; }

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

}  // namespace sunder::io
