// SPDX-License-Identifier: MIT
// Which row is at fault where numbers are shifted.
#include "topology/io/text/row_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sunder::io {
namespace {

std::size_t words_in(std::string_view text) {
  Scanner s{text};
  std::size_t words = 0;
  while (!next_word(s).empty()) ++words;
  return words;
}

/// From a byte to the end of its line.
std::string_view rest_from(std::string_view text, std::size_t at) {
  return text.substr(at, std::min(text.find('\n', at), text.size()) - at);
}

}  // namespace

void judge_row(RowWatch& watch, const Scanner& s, std::size_t row, bool goes_on) {
  Scanner behind = s;
  skip_blanks(behind);
  const std::size_t own = words_in(s.text.substr(row, s.at - row));
  const std::size_t of_line = words_in(rest_from(s.text, row));
  // Several whole rows in each line are a layout too, and so are rows that take whole lines.
  const bool is_layout = goes_on ? own % std::max<std::size_t>(of_line, 1) == 0
                                 : of_line % std::max<std::size_t>(own, 1) == 0;
  if (is_layout && !watch.is_by_line) return;
  watch.is_short = goes_on;
  watch.fault = goes_on ? row : behind.at;
}

void blame_row(const RowWatch& watch, std::string_view text, ReadFailure& failure) {
  Finding& f = failure.finding;
  const bool is_before = watch.fault != RowWatch::none && watch.fault < failure.at;
  // A row that broke off in a line before the one where a word was met that does not belong to it.
  const bool is_open = watch.fault == RowWatch::none && watch.row != RowWatch::none &&
                       watch.row < failure.at && f.line > line_of(text, watch.row) &&
                       f.code != "truncated_file";
  if (!is_before && !is_open) return;
  const std::size_t fault = is_before ? watch.fault : watch.row;
  const bool is_short = is_open || watch.is_short;
  Scanner at_fault{text, fault};
  f.text = is_short ? fmt::format("the line ends before its row is complete; line {}: {}", f.line,
                                  f.text)
                    : fmt::format("{} stands behind the last number of its row; line {}: {}",
                                  in_quotes(peek_word(at_fault)), f.line, f.text);
  f.code = "wrong_count";
  f.remedy = is_short ? "complete the row" : "take away what the row does not need";
  f.line = line_of(text, fault);
  failure.at = fault;
}

}  // namespace sunder::io
