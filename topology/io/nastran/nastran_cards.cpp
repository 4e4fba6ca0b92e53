// SPDX-License-Identifier: MIT
// Lines of bulk data cut into fields, and fields read as numbers.
#include "topology/io/nastran/nastran_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "topology/io/abaqus/abaqus_lines.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

constexpr std::size_t small_width = 8, large_width = 16;

char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// What a line is, by its first field.
struct LineKind {
  bool is_free = false;
  bool is_large = false;
  bool goes_on = false;
  std::string_view name;
};

LineKind kind_of(std::string_view line) {
  LineKind kind;
  const std::size_t comma = line.find(',');
  // A comma behind the first field only: fixed fields may hold words with commas further on.
  kind.is_free = comma != std::string_view::npos && comma <= small_width + 1;
  kind.name = trimmed(line.substr(0, kind.is_free ? comma : std::min(small_width, line.size())));
  kind.goes_on = kind.name.empty() || kind.name.front() == '+' || kind.name.front() == '*';
  kind.is_large = kind.name.starts_with('*') || kind.name.ends_with('*');
  return kind;
}

void add_field(Card& card, std::string_view field) {
  if (card.fields.size() < most_fields) card.fields.push_back(trimmed(field));
}

void add_free_fields(std::string_view text, Card& card, std::string_view line, std::size_t width) {
  const std::size_t most = width == small_width ? 8 : 4;
  std::size_t found = 0, next = line.find(',');
  while (next < line.size()) {
    const std::size_t begin = next + 1;
    next = std::min(line.find(',', begin), line.size());
    const std::string_view field = line.substr(begin, next - begin);
    if (found++ < most) {
      add_field(card, field);
    } else if (found > most + 1 && !trimmed(field).empty()) {  // one more is the mark
      fail(text, static_cast<std::size_t>(field.data() - text.data()),
           {.code = "wrong_count",
            .text = fmt::format("{} is the field {} of a line that has {}", in_quotes(field),
                                found + 1, most + 2),
            .remedy = "go on in a next line that begins with +"});
    }
  }
  for (; found < most; ++found) add_field(card, {});
}

void add_fixed_fields(Card& card, std::string_view line, std::size_t width) {
  const std::size_t most = width == small_width ? 8 : 4;
  for (std::size_t k = 0; k < most; ++k) {
    const std::size_t begin = std::min(small_width + k * width, line.size());
    add_field(card, line.substr(begin, width));
  }
}

void add_fields(std::string_view text, Card& card, std::string_view line, const LineKind& kind) {
  const std::size_t width = kind.is_large ? large_width : small_width;
  kind.is_free ? add_free_fields(text, card, line, width) : add_fixed_fields(card, line, width);
}

/// The next line that is neither blank nor a comment; empty behind the last. `begin`: where it is.
std::string_view next_line(CardLines& lines, std::size_t& begin) {
  while (lines.next < lines.end) {
    begin = lines.next;
    const std::string_view line = card_line(lines.text.substr(0, lines.end), begin);
    lines.next = std::min(lines.text.find('\n', begin), lines.end - 1) + 1;
    if (!trimmed(line).empty()) return line;
  }
  return {};
}

[[noreturn]] void fail_field(std::string_view text, const Card& card, std::size_t i,
                             std::string_view what, std::errc reason) {
  const std::string_view field = field_of(card, i);
  const bool is_big = reason == std::errc::result_out_of_range;
  const std::size_t at =
      field.empty() ? card.at : static_cast<std::size_t>(field.data() - text.data());
  const std::string found = field.empty() ? "a blank field" : in_quotes(field);
  fail(text, at,
       {.code = is_big ? "number_out_of_range" : "bad_number",
        .text = is_big ? fmt::format("{} is too big or too small to be {}", found, what)
                       : fmt::format("{} stands in field {} of a card {}, where {} was expected",
                                     found, i + 2, in_quotes(card.name), what),
        .remedy = "correct this card, or write the file again"});
}

/// A real as C knows it: 1.5-3 is 1.5e-3, and so is 1.5D-3.
std::string with_exponent(std::string_view field) {
  std::string number;
  for (const char c : field) {
    const bool is_sign = c == '-' || c == '+';
    const bool begins_exponent = is_sign && !number.empty() && number.back() != 'e';
    if (begins_exponent) number += 'e';
    if (c == 'd' || c == 'D' || c == 'E') {
      number += 'e';
    } else if (c != '+') {
      number += c;
    }
  }
  return number;
}

}  // namespace

std::string_view card_line(std::string_view text, std::size_t begin) {
  std::string_view line = text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin);
  line = line.substr(0, line.find('$'));
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

std::string card_word(std::string_view line) {
  line = trimmed(line);
  std::string word(line.substr(0, line.find_first_of(" \t,*'\"=(")));
  std::ranges::transform(word, word.begin(), upper);
  return word;
}

bool next_card(CardLines& lines, Card& card) {
  std::size_t begin = 0;
  std::string_view line = next_line(lines, begin);
  // What goes on without a card before it belongs to nothing.
  while (!line.empty() && kind_of(line).goes_on) line = next_line(lines, begin);
  if (line.empty()) return false;
  const LineKind kind = kind_of(line);
  card.at = begin;
  card.name = card_word(kind.name);
  card.fields.clear();
  add_fields(lines.text, card, line, kind);
  while (true) {
    CardLines behind = lines;
    line = next_line(behind, begin);
    if (line.empty() || !kind_of(line).goes_on) return true;
    add_fields(lines.text, card, line, kind_of(line));
    lines = behind;
  }
}

std::int64_t card_integer(std::string_view text, const Card& card, std::size_t i,
                          std::string_view what) {
  const std::string_view field = field_of(card, i);
  const char* const end = field.data() + field.size();
  const char* const begin = field.data() + (field.starts_with('+') && field.size() > 1 ? 1 : 0);
  std::int64_t value = 0;
  const auto [stop, reason] = std::from_chars(begin, end, value);
  if (field.empty() || reason != std::errc{} || stop != end)
    fail_field(text, card, i, what, reason);
  return value;
}

double card_real(std::string_view text, const Card& card, std::size_t i, std::string_view what) {
  const std::string_view field = field_of(card, i);
  if (field.empty()) return 0;
  const std::string number = with_exponent(field);
  double value = 0;
  const auto [stop, reason] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (reason != std::errc{} || stop != number.data() + number.size()) {
    fail_field(text, card, i, what, reason);
  }
  return value;
}

}  // namespace sunder::io
