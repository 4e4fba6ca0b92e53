// SPDX-License-Identifier: MIT
// Internal to the Abaqus reader: lines of data, their fields and numbers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace sunder::io {

/// Without the blanks before and after.
std::string_view trimmed(std::string_view text);

/// Lines of data, up to the next keyword.
struct DataLines {
  std::string_view text;
  std::size_t next = 0;
  /// The line: the text up to its end, and the place of its next field.
  std::string_view line = {};
  std::size_t at = 0;
};

/// How many lines of data there are at byte `at` at most, where each has `least_bytes` or more.
std::size_t most_lines(std::string_view text, std::size_t at, std::size_t least_bytes);

/// Makes room for `n` rows more, at once: growing would take twice the memory.
template <class List>
void reserve_more(List& list, std::size_t n) {
  const std::size_t needed = list.size() + n;
  if (needed <= list.capacity()) return;
  list.reserve(std::max(needed, list.capacity() + list.capacity() / 2));
}

/// Passes a line and those that it goes on in, ending with commas; false where there is none.
bool skip_record(DataLines& lines);

/// Goes to the next line of data, passing comments and blank lines; false where there is none.
bool next_data_line(DataLines& lines);

/// Whether the line has another field.
inline bool has_field(const DataLines& lines) { return lines.at < lines.line.size(); }

/// The next field, without blanks around it; empty at the line's end.
std::string_view next_field(DataLines& lines);

/// A field as a number. Fails with bad_number or number_out_of_range, naming the expected `what`.
std::int64_t integer_of(const DataLines& lines, std::string_view field, std::string_view what);
double real_of(const DataLines& lines, std::string_view field, std::string_view what);

}  // namespace sunder::io
