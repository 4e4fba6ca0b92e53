// SPDX-License-Identifier: MIT
// A sum over bytes, against mistakes, not against forgery.
#pragma once

#include <cstdint>
#include <string_view>

namespace sunder {

/// FNV-1a, 64 bits.
struct Fnv1a {
  std::uint64_t value = 0xcbf29ce484222325ULL;
  void add(std::string_view bytes) {
    for (const char c : bytes) {
      value = (value ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    }
  }
};

}  // namespace sunder
