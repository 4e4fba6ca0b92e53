// SPDX-License-Identifier: MIT
// Numbers of legacy VTK, text or big-endian.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "topology/io/vtk/vtk_reader.hpp"

namespace sunder::io {
namespace {

/// The words of VTK's own reader, then others that are no types of VTK but occur in files. `long`
/// has 8 bytes where these files are written; ids are written as int.
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
    {"long_long", NumberType::int64, 8},
    {"unsigned_long_long", NumberType::uint64, 8},
    {"vtktypeint8", NumberType::int8, 1},
    {"vtktypeuint8", NumberType::uint8, 1},
    {"vtktypeint16", NumberType::int16, 2},
    {"vtktypeuint16", NumberType::uint16, 2},
    {"vtktypeint32", NumberType::int32, 4},
    {"vtktypeuint32", NumberType::uint32, 4},
    {"vtktypeint64", NumberType::int64, 8},
    {"vtktypeuint64", NumberType::uint64, 8},
    {"vtktypefloat32", NumberType::float32, 4},
    {"vtktypefloat64", NumberType::float64, 8},
    {"int8", NumberType::int8, 1},
    {"uint8", NumberType::uint8, 1},
    {"int16", NumberType::int16, 2},
    {"uint16", NumberType::uint16, 2},
    {"int32", NumberType::int32, 4},
    {"uint32", NumberType::uint32, 4},
    {"int64", NumberType::int64, 8},
    {"uint64", NumberType::uint64, 8},
    {"float32", NumberType::float32, 4},
    {"float64", NumberType::float64, 8},
};

const VtkType* type_called(std::string_view word) {
  const auto* const found = std::ranges::find_if(
      number_types, [&](const VtkType& type) { return lower(type.name) == word; });
  return found == std::end(number_types) ? nullptr : found;
}

}  // namespace

std::string lower(std::string_view word) {
  std::string text(word);
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

void expect_keyword(VtkReader& r, std::string_view word) {
  if (lower(peek_word(r.in.s)) == lower(word)) {
    next_word(r.in.s);
    return;
  }
  expect_word(r.in.s, word);
}

std::string_view without_digits(std::string_view word) {
  return word.substr(0, word.find_last_not_of("0123456789") + 1);
}

const VtkType& read_type(VtkReader& r) {
  std::size_t components = 0;
  return read_type(r, components);
}

const VtkType& read_type(VtkReader& r, std::size_t& components) {
  Scanner& s = r.in.s;
  const std::string word = lower(peek_word(s));
  const std::size_t at = s.at;
  if (const VtkType* const type = type_called(word)) {
    next_word(s);
    return *type;
  }
  const std::string_view name = without_digits(word);
  if (const VtkType* const type = type_called(name)) {
    s.at += name.size();
    components = read_count(s, "components", 1);
    return *type;
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

const VtkType& float_type() { return number_types[1]; }

const VtkType& byte_type() {
  return *std::ranges::find(number_types, "unsigned_char", &VtkType::name);
}

}  // namespace sunder::io
