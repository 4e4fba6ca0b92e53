// SPDX-License-Identifier: MIT
// Data of legacy VTK: arrays of numbers, bits and strings under the keywords that give them a use.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "topology/io/vtk/vtk_reader.hpp"

namespace sunder::io {
namespace {

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

/// An array's name and shape, before its type.
struct ArrayHead {
  std::string_view name;
  std::size_t components = 1;
  std::size_t rows = 0;
  /// Of the name.
  std::size_t at = 0;
};

ArrayHead read_name(VtkReader& r, std::size_t components) {
  skip_blanks(r.in.s);
  const std::size_t at = r.in.s.at;
  return {next_word(r.in.s), components, r.rows, at};
}

/// Whether the array belongs to the points or cells, one row each. Others, such as a time or a
/// title, are of the whole grid.
bool is_of_rows(const VtkReader& r, const ArrayHead& head) {
  return r.data_of != 0 && head.components > 0;
}

void check_rows(VtkReader& r, const ArrayHead& head) {
  if (!is_of_rows(r, head) || head.rows == r.rows) return;
  fail(r.in.s.text, head.at,
       {.code = "wrong_count",
        .text = fmt::format("array {} has {} rows: {} were expected", in_quotes(head.name),
                            head.rows, r.rows),
        .remedy = "give one row for each point or cell"});
}

void skip_array(VtkReader& r, const ArrayHead& head, std::string_view what) {
  if (head.rows == 0 || head.components == 0) return;
  const bool is_of_grid = !is_of_rows(r, head);
  add_skipped(r.draft, is_of_grid ? "field data of the grid" : what, decoded(head.name), head.at);
}

/// The bytes of a string in a binary file; its first two bits say how long the length is.
std::size_t read_string_length(NumberSource& in) {
  const auto first = read_raw<std::uint8_t>(in, "the length of a string");
  --in.s.at;
  switch (first >> 6) {
    case 3:
      return read_raw<std::uint8_t>(in, "the length of a string") & 0x3fU;
    case 2:
      return read_raw<std::uint16_t>(in, "the length of a string") & 0x3fffU;
    case 1:
      return read_raw<std::uint32_t>(in, "the length of a string") & 0x3fffffffU;
    default:
      return read_raw<std::uint64_t>(in, "the length of a string");
  }
}

/// Strings: a line each, or raw with their lengths. The mesh holds numbers only.
void skip_strings(VtkReader& r, const ArrayHead& head, std::size_t words) {
  check_rows(r, head);
  const std::size_t n = product(r, head.rows, head.components, "strings");
  rest_of_line(r.in.s);
  for (std::size_t i = 0; i < n; ++i) {
    if (!r.in.is_binary || words > 1) {
      if (r.in.s.at >= r.in.s.text.size()) fail_expected(r.in.s, "a string");
      rest_of_line(r.in.s);
    } else {
      const std::size_t length = read_string_length(r.in);
      skip_numbers(r.in, 0, length, "a string");
    }
  }
  skip_array(r, head, "data that are strings");
}

/// In text. Fails where the number is neither 0 nor 1.
std::int64_t read_bit(VtkReader& r) {
  const Scanner before = r.in.s;
  const auto bit = read_number<std::int64_t>(r.in.s, "a bit");
  if (bit != 0 && bit != 1) fail_expected(before, "a bit (0 or 1)");
  return bit;
}

/// Bits, one after the other: 0 or 1 in text, eight in each byte in binary files.
template <class Take>
void read_bits(VtkReader& r, std::size_t n, Take take) {
  if (r.in.is_binary) rest_of_line(r.in.s);
  const std::size_t least = r.in.is_binary ? (n + 7) / 8 : n;
  check_count(r.in.s, r.in.s.at, static_cast<std::int64_t>(least), "bits", 1);
  std::uint8_t byte = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (r.in.is_binary && i % 8 == 0) byte = read_raw<std::uint8_t>(r.in, "eight bits");
    take(r.in.is_binary ? (byte >> (7 - i % 8)) & 1 : read_bit(r));
  }
}

/// Whether the bits of an array are kept: each takes 64 in memory, so all of them are bounded by
/// the file's size. A bit for each point or cell stays far below.
bool has_room(VtkReader& r, std::size_t n) {
  r.bits += n;
  return r.bits <= 1000 + r.in.s.text.size() / 8;
}

void take_bits(VtkReader& r, const ArrayHead& head) {
  check_rows(r, head);
  const std::size_t n = product(r, head.rows, head.components, "bits");
  const VtkArrayHead column{decoded(head.name), head.components, NumberType::uint8, r.data_of == 2,
                            head.at};
  const bool is_kept = is_of_rows(r, head) && head.rows > 0 && has_room(r, n);
  if (!is_kept) skip_array(r, head, "data that are bits");
  if (!is_kept || !is_new_name(r.draft, r.names, column)) return read_bits(r, n, [](auto) {});
  if (is_vtk_label(column)) {
    std::vector<std::int64_t> labels;
    read_bits(r, n, [&](std::int64_t bit) { labels.push_back(bit); });
    return add_vtk_label(r.draft, r.piece, column, labels);
  }
  read_bits(r, n, begin_vtk_data<std::int64_t>(r.draft, r.piece, column, n));
}

void take_numbers(VtkReader& r, const ArrayHead& array, const VtkType& type) {
  const std::size_t n = product(r, array.rows, array.components, "numbers");
  check_rows(r, array);
  begin_numbers(r, n, type, "numbers");
  const VtkArrayHead head{decoded(array.name), array.components, type.type, r.data_of == 2,
                          r.in.s.at};
  const bool is_kept = is_of_rows(r, array) && array.rows > 0;
  if (!is_kept) skip_array(r, array, {});
  if (!is_kept || !is_new_name(r.draft, r.names, head)) {
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

/// The type that stands next, then the values.
void take_array(VtkReader& r, const ArrayHead& head) {
  const std::string word = lower(peek_word(r.in.s));
  const bool is_variant = word == "variant";
  const bool is_string = word == "string" || word == "utf8_string" || word == "unicode_string";
  if (word == "bit" || is_variant || is_string) next_word(r.in.s);
  if (word == "bit") return take_bits(r, head);
  if (is_variant || is_string) return skip_strings(r, head, is_variant ? 2 : 1);
  take_numbers(r, head, read_type(r));
}

void read_field(VtkReader& r) {
  next_word(r.in.s);  // the field's own name
  const auto arrays = read_number<std::int64_t>(r.in.s, "a number of arrays");
  check_count(r.in.s, r.in.s.at, arrays, "arrays", 4);
  for (std::int64_t i = 0; i < arrays; ++i) {
    if (lower(peek_word(r.in.s)) == "metadata") {  // of the array before
      next_word(r.in.s);
      skip_metadata(r);
    }
    ArrayHead head = read_name(r, 1);
    if (lower(head.name) == "null_array") continue;
    head.components = read_count(r.in.s, "components", 1);
    head.rows = read_count(r.in.s, "rows", 1);
    take_array(r, head);
  }
}

/// NAME TYPE [COMPONENTS], then the table of colours, which may be none of the file's.
void read_scalars(VtkReader& r) {
  ArrayHead head = read_name(r, 1);
  const std::string word = lower(peek_word(r.in.s));
  const bool is_of_bits = without_digits(word) == "bit";
  if (is_of_bits) r.in.s.at += std::string_view("bit").size();
  const VtkType* const type = is_of_bits ? nullptr : &read_type(r, head.components);
  Scanner line = r.in.s;
  if (!rest_of_line(line).empty()) head.components = read_count(r.in.s, "components", 1);
  expect_keyword(r, "LOOKUP_TABLE");
  next_word(r.in.s);
  is_of_bits ? take_bits(r, head) : take_numbers(r, head, *type);
}

/// Real numbers from 0 to 1 in text, bytes in binary files.
void read_colors(VtkReader& r) {
  ArrayHead head = read_name(r, 1);
  head.components = read_count(r.in.s, "components", 1);
  take_numbers(r, head, r.in.is_binary ? byte_type() : float_type());
}

}  // namespace

void skip_metadata(VtkReader& r) {
  rest_of_line(r.in.s);
  while (r.in.s.at < r.in.s.text.size()) {
    const std::size_t at = r.in.s.at;
    const std::string_view line = rest_of_line(r.in.s);
    if (line.empty()) return;
    // Other words of VTK there are ranges of the numbers.
    if (lower(first_word(line)) != "component_names") continue;
    add_skipped(r.draft, "names of components", {}, at);
  }
}

bool read_attribute(VtkReader& r, std::string_view keyword) {
  struct Fixed {
    std::string_view keyword;
    std::size_t components;
  };
  constexpr Fixed fixed[] = {{"vectors", 3},    {"normals", 3},     {"tangents", 3},
                             {"tensors", 9},    {"tensors6", 6},    {"global_ids", 1},
                             {"edge_flags", 1}, {"pedigree_ids", 1}};
  if (const auto* const it = std::ranges::find(fixed, keyword, &Fixed::keyword);
      it != std::end(fixed)) {
    take_array(r, read_name(r, it->components));
    return true;
  }
  if (keyword == "texture_coordinates") {
    ArrayHead head = read_name(r, 1);
    head.components = read_count(r.in.s, "components", 1);
    take_array(r, head);
    return true;
  }
  if (keyword == "field") {
    read_field(r);
  } else if (keyword == "scalars") {
    read_scalars(r);
  } else if (keyword == "color_scalars") {
    read_colors(r);
  } else {
    return false;
  }
  return true;
}

}  // namespace sunder::io
