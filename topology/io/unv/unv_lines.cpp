// SPDX-License-Identifier: MIT
// Lines of universal files and their numbers; kinds of elements and the order of their nodes.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "topology/io/text/scan.hpp"
#include "topology/io/unv/unv_reader.hpp"

namespace sunder::io {
namespace {

constexpr UnvType types[] = {
    {11, CellKind::edge},         {21, CellKind::edge},          {22, CellKind::edge},
    {23, CellKind::edge3},        {24, CellKind::edge3},         {41, CellKind::triangle},
    {42, CellKind::triangle6},    {44, CellKind::quad4},         {45, CellKind::quad8},
    {51, CellKind::triangle},     {52, CellKind::triangle6},     {54, CellKind::quad4},
    {55, CellKind::quad8},        {61, CellKind::triangle},      {62, CellKind::triangle6},
    {64, CellKind::quad4},        {65, CellKind::quad8},         {71, CellKind::quad4},
    {72, CellKind::triangle6},    {74, CellKind::triangle},      {75, CellKind::quad8},
    {81, CellKind::triangle},     {82, CellKind::triangle6},     {84, CellKind::quad4},
    {85, CellKind::quad8},        {91, CellKind::triangle},      {92, CellKind::triangle6},
    {94, CellKind::quad4},        {95, CellKind::quad8},         {101, CellKind::prism6},
    {102, CellKind::prism15},     {104, CellKind::hexahedron8},  {105, CellKind::hexahedron20},
    {111, CellKind::tetrahedron}, {112, CellKind::prism6},       {113, CellKind::prism15},
    {115, CellKind::hexahedron8}, {116, CellKind::hexahedron20}, {118, CellKind::tetrahedron10},
};

// Midpoints stand between the corners that they are between, one ring after the other.
constexpr std::uint8_t edge[] = {0, 2, 1};
constexpr std::uint8_t triangle[] = {0, 3, 1, 4, 2, 5};
constexpr std::uint8_t quad[] = {0, 4, 1, 5, 2, 6, 3, 7};
constexpr std::uint8_t tetrahedron[] = {0, 4, 1, 5, 2, 6, 7, 8, 9, 3};
constexpr std::uint8_t prism[] = {0, 6, 1, 7, 2, 8, 12, 13, 14, 3, 9, 4, 10, 5, 11};
constexpr std::uint8_t hexahedron[] = {0,  8,  1, 9,  2, 10, 3, 11, 16, 17,
                                       18, 19, 4, 12, 5, 13, 6, 14, 7,  15};

[[noreturn]] void fail_number(const UnvLines& lines, std::string_view word, std::string_view what,
                              std::errc reason) {
  const bool is_big = reason == std::errc::result_out_of_range;
  fail(lines.text,
       word.empty() ? lines.at : static_cast<std::size_t>(word.data() - lines.text.data()),
       {.code = is_big ? "number_out_of_range" : "bad_number",
        .text = is_big ? fmt::format("{} is too big or too small to be {}", in_quotes(word), what)
                       : fmt::format("{} stands where {} was expected",
                                     word.empty() ? "the end of a line" : in_quotes(word), what),
        .remedy = "correct this line, or write the file again"});
}

}  // namespace

const UnvType* unv_type(std::int64_t number) {
  const auto* const found =
      std::ranges::find_if(types, [&](const UnvType& t) { return t.number == number; });
  return found == std::end(types) ? nullptr : found;
}

bool is_unv_beam(std::int64_t number) { return number >= 21 && number <= 24; }

std::span<const std::uint8_t> unv_order(CellKind kind) {
  switch (kind) {
    case CellKind::edge3:
      return edge;
    case CellKind::triangle6:
      return triangle;
    case CellKind::quad8:
      return quad;
    case CellKind::tetrahedron10:
      return tetrahedron;
    case CellKind::prism15:
      return prism;
    case CellKind::hexahedron20:
      return hexahedron;
    default:
      return {};
  }
}

bool next_line(UnvLines& lines) {
  if (lines.next >= lines.end) return false;
  lines.at = lines.next;
  const std::size_t end = std::min(lines.text.find('\n', lines.at), lines.end);
  lines.line = lines.text.substr(lines.at, end - lines.at);
  lines.next = std::min(end + 1, lines.end);
  return true;
}

void expect_line(UnvLines& lines, std::string_view what) {
  if (next_line(lines)) return;
  fail(lines.text, lines.end,
       {.code = "truncated_file",
        .text = fmt::format("the data set ends where {} was expected", what),
        .remedy = "the file was cut short, or a count is wrong: write it again"});
}

std::size_t integers_of(const UnvLines& lines, std::span<std::int64_t> numbers,
                        std::string_view what) {
  Scanner s{lines.line};
  std::size_t n = 0;
  for (; n < numbers.size(); ++n) {
    const std::string_view word = next_word(s);
    if (word.empty()) break;
    const auto [stop, reason] = std::from_chars(word.data(), word.data() + word.size(), numbers[n]);
    if (reason != std::errc{} || stop != word.data() + word.size()) {
      fail_number(lines, word, what, reason);
    }
  }
  return n;
}

namespace {

double next_real(const UnvLines& lines, Scanner& s, std::string_view what) {
  const std::string_view word = next_word(s);
  std::string number(word);
  std::ranges::replace(number, 'D', 'e');
  std::ranges::replace(number, 'd', 'e');
  const std::size_t plus = number.starts_with('+') ? 1 : 0;
  double x = 0;
  const auto [stop, reason] =
      std::from_chars(number.data() + plus, number.data() + number.size(), x);
  if (word.empty() || reason != std::errc{} || stop != number.data() + number.size()) {
    fail_number(lines, word, what, reason);
  }
  return x;
}

}  // namespace

double first_real_of(const UnvLines& lines, std::string_view what) {
  Scanner s{lines.line};
  return next_real(lines, s, what);
}

Point point_of(const UnvLines& lines, std::string_view what) {
  Scanner s{lines.line};
  Point point;
  for (double& x : point) x = next_real(lines, s, what);
  return point;
}

}  // namespace sunder::io
