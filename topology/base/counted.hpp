// SPDX-License-Identifier: MIT
// Counts with their nouns and verbs: the one place where a message chooses between one and several.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace sunder {

/// `one` for a count of 1, else `several`.
constexpr std::string_view for_count(std::uint64_t count, std::string_view one,
                                     std::string_view several) {
  return count == 1 ? one : several;
}

/// "1 window", "3 windows". `several`: the plural, where an s does not make it.
inline std::string counted(std::uint64_t count, std::string_view one,
                           std::string_view several = {}) {
  if (count == 1 || !several.empty()) {
    return fmt::format("{} {}", count, for_count(count, one, several));
  }
  return fmt::format("{} {}s", count, one);
}

/// The text of a finding: `%` becomes the count, and `[face lies|faces lie]` the part that fits it.
inline std::string text_of_count(std::string_view pattern, std::uint64_t count) {
  std::string text;
  while (!pattern.empty()) {
    const std::size_t bar = pattern.find('|'), end = pattern.find(']');
    if (pattern.front() == '[' && bar < end && end < pattern.size()) {
      text += for_count(count, pattern.substr(1, bar - 1), pattern.substr(bar + 1, end - bar - 1));
      pattern.remove_prefix(end + 1);
      continue;
    }
    text += pattern.front() == '%' ? std::to_string(count) : std::string(1, pattern.front());
    pattern.remove_prefix(1);
  }
  return text;
}

inline std::string counted_tetrahedra(std::uint64_t count) {
  return counted(count, "tetrahedron", "tetrahedra");
}

}  // namespace sunder
