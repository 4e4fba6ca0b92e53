// SPDX-License-Identifier: MIT
// The targets of a fuzzer: defined once for readers of meshes, once for the inputs of a run.
#pragma once

#include <span>

#include "reader_laws.hpp"

namespace sunder::test {

std::span<const FuzzTarget> fuzzed_targets();

/// The largest share of the memory bound that any input took.
double fuzzed_memory_share();

}  // namespace sunder::test
