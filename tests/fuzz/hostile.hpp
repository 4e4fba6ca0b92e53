// SPDX-License-Identifier: MIT
// Files made to take as much memory as they can: how they are made and judged.
#pragma once

#include <catch2/catch.hpp>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "reader_laws.hpp"

namespace sunder::test {

/// Rows of most hostile files: a few hundred kilobytes of them.
inline constexpr std::size_t many = 60'000;

inline std::string repeated(std::size_t n, const std::function<std::string(std::size_t)>& part) {
  std::string text;
  for (std::size_t i = 0; i < n; ++i) text += part(i);
  return text;
}

inline std::string repeated(std::size_t n, std::string_view part) {
  return repeated(n, [&](std::size_t) { return std::string(part); });
}

/// The bytes of a number as they stand in memory.
template <class Number>
std::string raw(Number number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

struct Hostile {
  /// A target of the fuzzers.
  const char* reader;
  const char* what;
  std::string bytes;
};

/// Holds every file to the laws of its reader, memory among them.
inline void check_all(const std::vector<Hostile>& files) {
  for (const Hostile& file : files) {
    INFO(file.reader << ": " << file.what << ", " << file.bytes.size() << " bytes");
    const FuzzTarget* target = find_target(file.reader);
    REQUIRE(target != nullptr);
    CHECK(target->broken_law(*target, file.bytes) == "");
  }
}

}  // namespace sunder::test
