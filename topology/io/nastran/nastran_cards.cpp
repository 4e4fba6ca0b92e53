// SPDX-License-Identifier: MIT
// Lines of bulk data cut into fields, and fields read as numbers.
#include "topology/io/nastran/nastran_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>

#include "topology/io/abaqus/abaqus_lines.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

constexpr std::size_t small_width = 8, large_width = 16;

char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// The kind of a line, by its first field.
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
  const bool is_image = trimmed(line).starts_with('=');
  kind.is_free = comma != std::string_view::npos && (comma <= small_width + 1 || is_image);
  kind.name = trimmed(line.substr(0, kind.is_free ? comma : byte_of_column(line, small_width)));
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
    const std::size_t begin = byte_of_column(line, small_width + k * width);
    const std::size_t end = byte_of_column(line, small_width + (k + 1) * width);
    add_field(card, line.substr(begin, end - begin));
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

void fail_field(std::string_view text, const Card& card, std::size_t i, std::string_view what,
                std::errc reason) {
  const std::string_view field = field_of(card, i);
  const bool is_big = reason == std::errc::result_out_of_range;
  // Fields that replication made stand nowhere in the file.
  const bool is_there = !field.empty() && std::less_equal<>{}(text.data(), field.data()) &&
                        std::less<>{}(field.data(), text.data() + text.size());
  const std::size_t at = is_there ? static_cast<std::size_t>(field.data() - text.data()) : card.at;
  const std::string found = field.empty() ? "a blank field" : in_quotes(field);
  fail(text, at,
       {.code = is_big ? "number_out_of_range" : "bad_number",
        .text = is_big ? fmt::format("{} is too big or too small to be {}", found, what)
                       : fmt::format("{} stands in field {} of a card {}, where {} was expected",
                                     found, i + 2, in_quotes(card.name), what),
        .remedy = "correct this card, or write the file again"});
}

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

std::size_t byte_of_column(std::string_view line, std::size_t column) {
  if (line.find('\t') == std::string_view::npos) return std::min(column, line.size());
  std::size_t at = 0, byte = 0;
  while (byte < line.size() && at < column) {
    at = line[byte] == '\t' ? (at / 8 + 1) * 8 : at + 1;
    ++byte;
  }
  return byte;
}

namespace {

/// The fields of a line and of those that it goes on in.
void take_fields(CardLines& lines, std::string_view line, Card& card) {
  card.fields.clear();
  add_fields(lines.text, card, line, kind_of(line));
  while (true) {
    CardLines behind{lines.text, lines.next, lines.end};
    std::size_t begin = 0;
    line = next_line(behind, begin);
    if (line.empty() || !kind_of(line).goes_on) return;
    add_fields(lines.text, card, line, kind_of(line));
    lines.next = behind.next;
  }
}

/// A line named = or =(3): how often the card before is repeated, and how.
void begin_replication(CardLines& lines, std::string_view line, std::size_t begin) {
  Replication& replication = lines.replication;
  const std::string_view name = kind_of(line).name;
  std::string_view digits = name.substr(1);
  if (digits.starts_with('(') && digits.ends_with(')'))
    digits = digits.substr(1, digits.size() - 2);
  std::size_t images = 1;
  const char* const end = digits.data() + digits.size();
  const auto [stop, reason] = std::from_chars(digits.data(), end, images);
  if (!digits.empty() && digits != "=" && (reason != std::errc{} || stop != end)) {
    fail(lines.text, begin,
         {.code = "bad_number",
          .text = fmt::format("{} stands where =(n) was expected, which repeats a card n times",
                              in_quotes(name)),
          .remedy = "correct this card, or write the file without replication"});
  }
  Card own;
  take_fields(lines, line, own);
  const bool is_bare =
      std::ranges::all_of(own.fields, [](std::string_view field) { return field.empty(); });
  // =(3) alone goes on as the line before, == alone keeps all.
  if (digits == "=") own.fields.assign(1, "==");
  if (!is_bare || digits == "=") replication.fields = std::move(own.fields);
  if (replication.fields.empty()) replication.fields.assign(1, "==");
  const std::size_t most = 2000 + lines.text.size() / 32;
  if (images > most - std::min(most, replication.made)) {
    fail(lines.text, begin,
         {.code = "count_too_big",
          .text = fmt::format("{} repeats a card more often than a file of {} bytes should",
                              in_quotes(name), lines.text.size()),
          .remedy = "correct the count, or write the cards out"});
  }
  replication.made += images;
  replication.left = images;
}

}  // namespace

bool next_card(CardLines& lines, Card& card) {
  Replication& replication = lines.replication;
  while (replication.left == 0) {
    std::size_t begin = 0;
    std::string_view line = next_line(lines, begin);
    // A continuation without a card before it belongs to nothing.
    while (!line.empty() && kind_of(line).goes_on) line = next_line(lines, begin);
    if (line.empty()) return false;
    const LineKind kind = kind_of(line);
    if (!kind.name.starts_with('=')) {
      replication.fields.clear();
      card.at = begin;
      card.name = card_word(kind.name);
      take_fields(lines, line, card);
      return true;
    }
    if (card.name.empty()) {
      fail(lines.text, begin,
           {.code = "wrong_section_order",
            .text =
                fmt::format("{} repeats a card, but none stands before it", in_quotes(kind.name)),
            .remedy = "put the card that is repeated before this line"});
    }
    begin_replication(lines, line, begin);
    card.at = begin;
  }
  --replication.left;
  replicate_card(lines.text, replication, card);
  return true;
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
