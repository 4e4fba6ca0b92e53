// SPDX-License-Identifier: MIT
// The slow side of scanning: words, lines and the wording of failures.
#include "topology/io/text/scan.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sunder::io {

std::size_t line_of(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, std::min(at, text.size()));
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string out = "'";
  for (const char c : text.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      out += c;
    } else {
      out += fmt::format("\\x{:02x}", byte);
    }
  }
  return out + (text.size() > longest ? "...'" : "'");
}

void fail(std::string_view text, std::size_t at, Finding finding) {
  finding.line = line_of(text, at);
  throw ReadFailure{std::move(finding), at};
}

void fail_expected(const Scanner& s, std::string_view what, std::errc reason) {
  Scanner here = s;
  const std::string_view word = next_word(here);
  if (word.empty()) {
    fail(s.text, s.text.size(),
         {.code = "truncated_file",
          .text = fmt::format("the file ends after {} bytes, where {} was expected", s.text.size(),
                              what),
          .remedy = "the file was cut short: copy or write it again"});
  }
  const std::size_t at = here.at - word.size();
  if (reason == std::errc::result_out_of_range) {
    fail(s.text, at,
         {.code = "number_out_of_range",
          .text = fmt::format("{} is too big or too small to be {}", in_quotes(word), what),
          .remedy = "correct this number"});
  }
  if (word.front() == '$') {
    fail(s.text, at,
         {.code = "wrong_count",
          .text =
              fmt::format("the section ends with {}, where {} was expected", in_quotes(word), what),
          .remedy = "the section announces more rows than it has: correct the count, or write the "
                    "file again"});
  }
  fail(s.text, at,
       {.code = "bad_number",
        .text = fmt::format("{} stands where {} was expected", in_quotes(word), what),
        .remedy = "correct this line, or write the file again"});
}

std::string_view peek_word(Scanner& s) {
  skip_blanks(s);
  std::size_t end = s.at;
  while (end < s.text.size() && !is_blank(s.text[end])) ++end;
  return s.text.substr(s.at, end - s.at);
}

std::string_view next_word(Scanner& s) {
  const std::string_view word = peek_word(s);
  s.at += word.size();
  return word;
}

std::string_view rest_of_line(Scanner& s) {
  const std::size_t end = std::min(s.text.find('\n', s.at), s.text.size());
  std::string_view line = s.text.substr(s.at, end - s.at);
  s.at = std::min(end + 1, s.text.size());
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

void expect_word(Scanner& s, std::string_view word) {
  const std::string_view found = peek_word(s);
  if (found == word) {
    s.at += word.size();
    return;
  }
  if (found.empty()) fail_expected(s, word);
  fail(s.text, s.at,
       {.code = "wrong_count",
        .text = fmt::format("{} stands where {} was expected", in_quotes(found), word),
        .remedy = "the section has more rows than it announces: correct the count, or write the "
                  "file again"});
}

void skip_words(Scanner& s, std::size_t n, std::string_view what) {
  for (; n > 0; --n) {
    if (next_word(s).empty()) fail_expected(s, what);
  }
}

void check_count(const Scanner& s, std::size_t at, std::int64_t count, std::string_view what,
                 std::size_t least_bytes) {
  if (count < 0) {
    fail(s.text, at,
         {.code = "bad_number",
          .text = fmt::format("{} is not a number of {}: it is below 0", count, what),
          .remedy = "correct this line, or write the file again"});
  }
  const std::size_t left = s.text.size() - s.at;
  if (static_cast<std::size_t>(count) <= left / least_bytes) return;
  fail(s.text, at,
       {.code = "count_too_big",
        .text = fmt::format("{} {} are announced, but the {} bytes left can hold at most {}", count,
                            what, left, left / least_bytes),
        .remedy = "correct the count; if it is right, the file was cut short"});
}

std::size_t read_count(Scanner& s, std::string_view what, std::size_t least_bytes) {
  skip_blanks(s);
  const std::size_t at = s.at;
  const auto count = [&] {
    // The words cost more than the number, and files have counts in every line.
    const Scanner before = s;
    try {
      return read_number<std::int64_t>(s, what);
    } catch (const ReadFailure&) {
      s = before;
      return read_number<std::int64_t>(s, fmt::format("a number of {}", what));
    }
  }();
  check_count(s, at, count, what, least_bytes);
  return static_cast<std::size_t>(count);
}

}  // namespace sunder::io
