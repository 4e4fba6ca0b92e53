// SPDX-License-Identifier: MIT
#include "fuzzed.hpp"
#include "run_laws.hpp"

namespace sunder::test {

std::span<const FuzzTarget> fuzzed_targets() { return run_targets(); }

double fuzzed_memory_share() { return largest_run_share(); }

}  // namespace sunder::test
