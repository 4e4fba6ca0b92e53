// SPDX-License-Identifier: MIT
// Internal to the Nastran reader: cards of ten fields, on one line or on several.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace sunder::io {

/// The fields of a replication, as the file has them (`=`, `==`, `*1`, words).
struct Replication {
  std::vector<std::string_view> fields;
  /// How many more cards are still to be made.
  std::size_t left = 0;
  /// How many were made so far; a few bytes could ask for any number.
  std::size_t made = 0;
  /// Fields that the file does not have: those of the last card and of the one before.
  std::array<std::deque<std::string>, 2> words;
};

/// A part of a file with nothing but bulk data.
struct CardLines {
  std::string_view text;
  std::size_t next = 0;
  std::size_t end = 0;
  Replication replication = {};
};

/// One card: GRID, CTETRA, ...
struct Card {
  /// In upper case, without the star of large fields.
  std::string name;
  /// Behind the name, without the marks of continuation; blank ones are empty. Lines that are cut
  /// short have blank fields up to their end. Of long cards the first `most_fields`.
  std::vector<std::string_view> fields;
  /// Where it begins in the text.
  std::size_t at = 0;
};
inline constexpr std::size_t most_fields = 40;

/// The next card with the lines that it goes on in; false behind the last. `card` is the one
/// before, which replication goes on from: a name = repeats it, a field = or == keeps one or all
/// that follow, *1 adds, and a line =(3) makes three more. Fails with bad_number,
/// wrong_section_order or count_too_big.
bool next_card(CardLines& lines, Card& card);

/// Makes `card` the next image of itself. `text`: the whole file.
void replicate_card(std::string_view text, Replication& replication, Card& card);

/// Bytes of a line up to a column, counted from 0: a tab goes to the next column of 8.
std::size_t byte_of_column(std::string_view line, std::size_t column);

/// The line at `begin` without its end and without a comment ($).
std::string_view card_line(std::string_view text, std::size_t begin);

/// The first word of a line in upper case: up to a blank, comma, star, quote or equals sign.
std::string card_word(std::string_view line);

/// Field `i` of a card; empty where it is blank or not there.
inline std::string_view field_of(const Card& card, std::size_t i) {
  return i < card.fields.size() ? card.fields[i] : std::string_view{};
}

/// A field as a number. Fails with bad_number or number_out_of_range, naming the expected `what`.
/// Reals may have an exponent without its letter (1.5-3), or with D. `text`: the whole file.
[[noreturn]] void fail_field(std::string_view text, const Card& card, std::size_t i,
                             std::string_view what, std::errc reason);
std::int64_t card_integer(std::string_view text, const Card& card, std::size_t i,
                          std::string_view what);
double card_real(std::string_view text, const Card& card, std::size_t i, std::string_view what);

}  // namespace sunder::io
