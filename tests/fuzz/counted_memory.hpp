// SPDX-License-Identifier: MIT
// How much memory a call takes: every allocation of the program is counted, C's and C++'s.
#pragma once

#include <cstddef>

namespace sunder::test {

/// Bytes allocated since `begin_counting`, and the most there ever were at once. Of one thread.
struct MemoryCount {
  std::ptrdiff_t live = 0;
  std::ptrdiff_t peak = 0;
  /// Bytes that zlib unfolded: a packed file counts with its unpacked size.
  std::size_t unfolded = 0;
};

/// Counts from now on. With a `bound` (bytes, not 0) the program ends where `live` first goes over
/// it; each byte that zlib unfolds raises it by `times` bytes.
void begin_counting(std::size_t bound = 0, std::size_t times = 0);
MemoryCount end_counting();

}  // namespace sunder::test
