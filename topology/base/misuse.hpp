// SPDX-License-Identifier: MIT
// The library's exception: a mistake of the program that calls it, never of an input.
#pragma once

#include <stdexcept>

namespace sunder {

/// A caller broke what a function needs: an id that was never given out, a simulation that was
/// moved from. Nothing has changed then. In every build; other such mistakes only debug builds
/// find.
class Misuse : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Throws Misuse(`message`) where `is_fine` does not hold.
inline void require(bool is_fine, const char* message) {
  if (!is_fine) [[unlikely]]
    throw Misuse(message);
}

}  // namespace sunder
