// SPDX-License-Identifier: MIT
// PLY's header: a line per property, under a line per element.
#include "topology/io/surface/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "topology/io/surface/ply.hpp"
#include "topology/io/vtk/vtk_columns.hpp"

namespace sunder::io {
namespace {

/// Far above any use, and low enough for the memory that a column takes.
constexpr std::size_t most_properties = 1000;

NumberType type_called(const Scanner& s, std::string_view word) {
  constexpr std::string_view sized[] = {"float64", "float32", "int8",  "uint8",
                                        "int16",   "uint16",  "int32", "uint32"};
  for (std::size_t i = 0; i < std::size(ply_types); ++i) {
    if (word == ply_types[i] || (i < std::size(sized) && word == sized[i])) {
      return static_cast<NumberType>(i);
    }
  }
  fail(
      s.text, s.at,
      {.code = "bad_attribute",
       .text = fmt::format("{} is not one of PLY's types char, uchar, ... double", in_quotes(word)),
       .remedy = "correct the header, or write the file again"});
}

void read_format_line(Scanner& s, PlyHeader& h) {
  const std::size_t at = s.at;
  const std::string_view encoding = next_word(s), version = next_word(s);
  const bool is_big = encoding == "binary_big_endian";
  h.is_binary = is_big || encoding == "binary_little_endian";
  h.swap = h.is_binary && is_big != (std::endian::native == std::endian::big);
  if ((h.is_binary || encoding == "ascii") && version == "1.0") return;
  fail(s.text, at,
       {.code = "unknown_version",
        .text = fmt::format("PLY of the format {} {} is not read", in_quotes(encoding),
                            in_quotes(version)),
        .remedy = "write it as ascii, binary_little_endian or binary_big_endian 1.0"});
}

void read_property_line(Scanner& s, PlyHeader& h) {
  if (h.elements.empty()) {
    fail(s.text, s.at,
         {.code = "wrong_section_order",
          .text = "a property stands before every element",
          .remedy = "correct the header, or write the file again"});
  }
  const std::size_t at = s.at;
  std::size_t sum = 0;
  for (const Element& e : h.elements) sum += e.properties.size();
  if (sum == most_properties) {
    fail(s.text, s.at,
         {.code = "count_too_big",
          .text = fmt::format("the header has more than {} properties", most_properties),
          .remedy = "take away properties that are not used"});
  }
  Property p;
  std::string_view word = next_word(s);
  p.is_list = word == "list";
  if (p.is_list) {
    p.count_type = type_called(s, next_word(s));
    word = next_word(s);
  }
  p.type = type_called(s, word);
  p.name = rest_of_line(s);
  h.elements.back().properties.push_back(p);
  if (!p.is_list || !is_real(p.count_type)) return;
  fail(s.text, at,
       {.code = "bad_attribute",
        .text = fmt::format("the list {} is counted by real numbers", in_quotes(p.name)),
        .remedy = "correct the header, or write the file again"});
}

void read_element_line(Scanner& s, PlyHeader& h, std::size_t at) {
  Element& e = h.elements.emplace_back();
  e.at = at;
  e.name = next_word(s);
  e.count = read_count(s, fmt::format("rows of {}", in_quotes(e.name)), 1);
  const auto same = [&](const Element& other) { return other.name == e.name; };
  if (std::ranges::count_if(h.elements, same) == 1 && h.elements.size() <= most_properties) return;
  fail(s.text, at,
       {.code = "wrong_section_order",
        .text = fmt::format("a second element {}", in_quotes(e.name)),
        .remedy = "join the two elements"});
}

/// column ELEMENT PROPERTY COMPONENTS "NAME"; any other comment is nothing.
void read_comment(PlyHeader& h, std::string_view line) {
  Scanner s{line};
  if (next_word(s) != "column") return;
  JoinedColumn column{.element = next_word(s), .property = next_word(s)};
  const std::string_view number = next_word(s), name = rest_of_line(s);
  const auto [end, reason] =
      std::from_chars(number.data(), number.data() + number.size(), column.components);
  const bool is_whole = reason == std::errc{} && end == number.data() + number.size();
  if (!is_whole || name.size() < 2 || name.front() != '"' || name.back() != '"') return;
  column.name = name.substr(1, name.size() - 2);
  if (h.joined.size() < most_properties) h.joined.push_back(column);
}

/// A comment without its keyword, as Blender 2.47 writes: Created by Blender3D ...
bool names_a_program(std::string_view word, std::string_view rest) {
  constexpr std::string_view verbs[] = {"created", "exported", "generated", "made", "written"};
  std::string lower(word);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return std::ranges::find(verbs, lower) != std::end(verbs) && first_word(rest) == "by";
}

/// Before the first element a line cannot change the contents of the rows.
void read_unknown_line(Scanner& s, PlyHeader& h, std::string_view word, std::size_t at) {
  if (h.elements.empty()) {
    if (!names_a_program(word, rest_of_line(s))) h.unknown.push_back({word, at});
    return;
  }
  fail(s.text, at,
       {.code = "unknown_section",
        .text = fmt::format("{} stands where element, property, comment or end_header was "
                            "expected",
                            in_quotes(word)),
        .remedy = "correct the header, or write the file again"});
}

}  // namespace

PlyHeader read_ply_header(Scanner& s) {
  PlyHeader h;
  next_word(s);
  bool has_format = false;
  while (true) {
    const std::string_view word = next_word(s);
    const std::size_t at = s.at - word.size();
    if (word == "end_header") break;
    if (word == "format") {
      read_format_line(s, h);
      has_format = true;
    } else if (word == "element") {
      read_element_line(s, h, at);
    } else if (word == "property") {
      read_property_line(s, h);
    } else if (word == "comment") {
      read_comment(h, rest_of_line(s));
    } else if (word == "obj_info") {
      rest_of_line(s);
    } else if (word.empty()) {
      fail_expected(s, "a line end_header");
    } else {
      read_unknown_line(s, h, word, at);
    }
  }
  rest_of_line(s);
  if (has_format) return h;
  fail(s.text, 0,
       {.code = "unknown_version",
        .text = "the header has no line format",
        .remedy = "add one, such as: format ascii 1.0"});
}

}  // namespace sunder::io
