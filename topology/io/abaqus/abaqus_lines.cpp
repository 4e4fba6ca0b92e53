// SPDX-License-Identifier: MIT
// Lines of Abaqus' input: fields between commas, and numbers.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "topology/io/abaqus/abaqus_reader.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

[[noreturn]] void fail_field(const DataLines& lines, std::string_view field, std::string_view code,
                             std::string_view what) {
  const bool is_big = code == "number_out_of_range";
  fail(lines.text, static_cast<std::size_t>(field.data() - lines.text.data()),
       {.code = std::string(code),
        .text = fmt::format("{} {} {}", in_quotes(field),
                            is_big ? "is too big or too small to be" : "stands where",
                            is_big ? std::string(what) : fmt::format("{} was expected", what)),
        .remedy = "correct this line, or write the file again"});
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::size_t most_lines(std::string_view text, std::size_t at, std::size_t least_bytes) {
  const std::size_t keyword = std::min(text.find("\n*", at), text.size());
  const auto ends = std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                               text.begin() + static_cast<std::ptrdiff_t>(keyword), '\n');
  return std::min(static_cast<std::size_t>(ends), (keyword - at) / least_bytes) + 1;
}

bool skip_record(DataLines& lines) {
  bool goes_on = true;
  for (bool is_first = true; goes_on; is_first = false) {
    if (!next_data_line(lines)) return !is_first;
    goes_on = trimmed(lines.line.substr(lines.at)).ends_with(',');
  }
  return true;
}

bool next_data_line(DataLines& lines) {
  while (lines.next < lines.text.size()) {
    const std::size_t begin = lines.next;
    const std::size_t end = std::min(lines.text.find('\n', begin), lines.text.size());
    lines.line = lines.text.substr(0, end);
    lines.at = begin;
    while (lines.at < end && is_blank(lines.line[lines.at])) ++lines.at;
    const bool is_keyword = lines.at < end && lines.line[lines.at] == '*';
    if (is_keyword && (lines.at + 1 >= end || lines.line[lines.at + 1] != '*')) return false;
    lines.next = std::min(end + 1, lines.text.size());
    if (lines.at < end && !is_keyword) return true;
  }
  return false;
}

std::string_view next_field(DataLines& lines) {
  if (!has_field(lines)) return lines.line.substr(lines.line.size());
  const std::size_t comma = std::min(lines.line.find(',', lines.at), lines.line.size());
  const std::string_view field = trimmed(lines.line.substr(lines.at, comma - lines.at));
  lines.at = comma + 1;
  return field;
}

std::int64_t integer_of(const DataLines& lines, std::string_view field, std::string_view what) {
  constexpr std::int64_t highest = 1'000'000'000'000'000'000;
  const char* const end = field.data() + field.size();
  const char* const begin = field.data() + (field.starts_with('+') && field.size() > 1 ? 1 : 0);
  std::int64_t value = 0;
  auto [stop, reason] = std::from_chars(begin, end, value);
  // meshio writes 7.0.
  if (reason == std::errc{} && stop != end && *stop == '.') {
    ++stop;
    while (stop != end && *stop == '0') ++stop;
  }
  if (reason == std::errc::result_out_of_range || value > highest || value < -highest) {
    fail_field(lines, field, "number_out_of_range", what);
  }
  if (reason != std::errc{} || stop != end) fail_field(lines, field, "bad_number", what);
  return value;
}

double real_of(const DataLines& lines, std::string_view field, std::string_view what) {
  const auto parse = [](std::string_view text, double& value) {
    const char* const begin = text.data() + (text.starts_with('+') && text.size() > 1 ? 1 : 0);
    const char* const end = text.data() + text.size();
    const auto [stop, reason] = std::from_chars(begin, end, value);
    return stop == end || reason == std::errc::result_out_of_range ? reason
                                                                   : std::errc::invalid_argument;
  };
  double value = 0;
  std::errc reason = parse(field, value);
  if (reason == std::errc::invalid_argument) {
    // Fortran's exponents: 1.0D-3.
    std::string text(field.substr(0, 400));
    std::ranges::replace(text, 'd', 'e');
    std::ranges::replace(text, 'D', 'e');
    reason = parse(text, value);
  }
  if (reason == std::errc{}) return value;
  fail_field(lines, field,
             reason == std::errc::result_out_of_range ? "number_out_of_range" : "bad_number", what);
}

}  // namespace sunder::io
