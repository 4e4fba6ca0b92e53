// SPDX-License-Identifier: MIT
// What a fuzzer enters: defined once for readers of meshes, once for what a run reads.
#pragma once

#include <span>

#include "reader_laws.hpp"

namespace sunder::test {

std::span<const FuzzTarget> fuzzed_targets();

/// The largest share of the memory bound that any input took.
double fuzzed_memory_share();

}  // namespace sunder::test
