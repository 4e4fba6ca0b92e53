// SPDX-License-Identifier: MIT
// Internal to the readers: rows of a text that do not fill their lines.
#pragma once

#include <cstring>
#include <utility>

#include "topology/io/text/scan.hpp"

namespace sunder::io {

/// Readers take numbers wherever lines end. A number too many or too few shifts all behind it, and
/// reading fails lines later: the watch knows the first row that does not fill its line.
struct RowWatch {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  /// The first number too many, or the row that is too short.
  std::size_t fault = none;
  bool is_short = false;
  /// The row that is read; none between rows.
  std::size_t row = none;
  /// Whether rows before filled their lines.
  bool is_by_line = false;
};

/// A row begins at byte `at`, blanks passed.
inline void begin_row(RowWatch& watch, std::size_t at) { watch.row = at; }

/// The same of a row that does not end with its line: is it a fault, or are the rows laid out in
/// another way?
void judge_row(RowWatch& watch, const Scanner& s, std::size_t row, bool goes_on);

/// The row ends at the scanner's place.
inline void end_row(RowWatch& watch, const Scanner& s) {
  const std::size_t row = std::exchange(watch.row, RowWatch::none);
  if (watch.fault != RowWatch::none) return;
  const char* const begin = s.text.data() + row;
  const bool goes_on = std::memchr(begin, '\n', s.at - row) != nullptr;
  std::size_t end = s.at;
  while (end < s.text.size() &&
         (s.text[end] == ' ' || s.text[end] == '\r' || s.text[end] == '\t')) {
    ++end;
  }
  const bool is_end = end == s.text.size() || s.text[end] == '\n' || s.text[end] == '#';
  const bool is_begin = row == 0 || begin[-1] == '\n';
  if (goes_on || !is_end) return judge_row(watch, s, row, goes_on);
  watch.is_by_line = watch.is_by_line || is_begin;
}

/// Gives a failure the line of the row before it that does not fill its line, where there is one.
void blame_row(const RowWatch& watch, std::string_view text, ReadFailure& failure);

}  // namespace sunder::io
