// SPDX-License-Identifier: MIT
// The library's exception: a mistake of the program that calls it, never of an input.
#pragma once

#include <stdexcept>

namespace sunder {

/// Thrown when a caller violates a requirement: an id that does not exist, or a simulation that was
/// moved from. The call has then changed nothing. Every build checks these requirements. Only debug
/// builds check the others.
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
