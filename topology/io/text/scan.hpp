// SPDX-License-Identifier: MIT
// Internal to the readers: words and numbers one after the other, and failures with their line.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

#include "topology/base/finding.hpp"

namespace sunder::io {

/// Thrown by the readers' inner functions and caught in read_mesh: it never leaves the library.
struct ReadFailure {
  Finding finding;
  /// Byte of the file.
  std::size_t at = 0;
};

/// A place in a text. Blanks are spaces, tabs and line ends of any kind.
struct Scanner {
  std::string_view text;
  std::size_t at = 0;
};

/// Line, counted from 1, that byte `at` of `text` stands in. O(at): for messages only.
std::size_t line_of(std::string_view text, std::size_t at);

/// `text` cut for a message: at most 40 bytes, control and non-ASCII bytes as \xNN.
std::string in_quotes(std::string_view text);

/// Ends the reading with `code` at the line of byte `at`.
[[noreturn]] void fail(std::string_view text, std::size_t at, Finding finding);

/// Ends the reading because `what` was expected at the scanner's place.
[[noreturn]] void fail_expected(const Scanner& s, std::string_view what, std::errc reason = {});

inline bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

inline void skip_blanks(Scanner& s) {
  while (s.at < s.text.size() && is_blank(s.text[s.at])) ++s.at;
}

/// The next word without passing it; empty at the end.
std::string_view peek_word(Scanner& s);

/// The next word; empty at the end.
std::string_view next_word(Scanner& s);

/// The first word of a text; empty where there is none.
inline std::string_view first_word(std::string_view text) {
  Scanner s{text};
  return peek_word(s);
}

/// UTF-8's, which some editors put before a text.
inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// The rest of the line without blanks before and after; the scanner passes the line's end.
std::string_view rest_of_line(Scanner& s);

/// Passes `word`, or fails because it was expected.
void expect_word(Scanner& s, std::string_view word);

/// Passes `n` words, which belong to `what`; fails at the file's end.
void skip_words(Scanner& s, std::size_t n, std::string_view what);

/// The next number. Fails with bad_number, number_out_of_range or truncated_file. `what`: the
/// expected number with its article ("a coordinate"). "nan" and "inf" are numbers here.
template <class Number>
Number read_number(Scanner& s, std::string_view what) {
  skip_blanks(s);
  const char* const end = s.text.data() + s.text.size();
  const char* begin = s.text.data() + s.at;
  // from_chars knows no plus sign, C's printf does.
  if (begin + 1 < end && *begin == '+' && begin[1] != '-') ++begin;
  Number value{};
  const auto [stop, reason] = std::from_chars(begin, end, value);
  if (reason != std::errc{} || (stop != end && !is_blank(*stop))) fail_expected(s, what, reason);
  s.at = static_cast<std::size_t>(stop - s.text.data());
  return value;
}

/// The next number as a count of things that take at least `least_bytes` of the rest each.
/// Fails also with count_too_big. `what` in the plural ("nodes").
std::size_t read_count(Scanner& s, std::string_view what, std::size_t least_bytes);

/// Fails with bad_number or count_too_big, reported at byte `at`, unless the rest can hold so many.
void check_count(const Scanner& s, std::size_t at, std::int64_t count, std::string_view what,
                 std::size_t least_bytes);

}  // namespace sunder::io
