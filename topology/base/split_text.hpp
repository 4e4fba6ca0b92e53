// SPDX-License-Identifier: MIT
// Text in parts.
#pragma once

#include <string_view>
#include <vector>

namespace sunder {

/// The parts of a text between separators, empty ones too; none of an empty text. As a stream with
/// `std::getline`, but a stream without memory ends early and reports nothing.
inline std::vector<std::string_view> split_text(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; !text.empty();) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) break;
    begin = end + 1;
  }
  return parts;
}

/// The lines of a text without their ends, those of Unix or of RFC 4180; no line behind the last
/// end.
inline std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines = split_text(text, '\n');
  if (text.ends_with('\n')) lines.pop_back();
  for (std::string_view& line : lines) {
    if (line.ends_with('\r')) line.remove_suffix(1);
  }
  return lines;
}

}  // namespace sunder
