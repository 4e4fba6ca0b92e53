// SPDX-License-Identifier: MIT
#include "fuzzed.hpp"

namespace sunder::test {

std::span<const FuzzTarget> fuzzed_targets() {
  end_at_memory_bound(true);
  return fuzz_targets();
}

double fuzzed_memory_share() { return largest_memory_share(); }

}  // namespace sunder::test
