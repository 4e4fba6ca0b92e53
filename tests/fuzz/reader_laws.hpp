// SPDX-License-Identifier: MIT
// A file reader's promises whatever the bytes are: held by the fuzzers and by their corpus.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "counted_memory.hpp"

namespace sunder::test {

/// A reader under test.
struct FuzzTarget {
  std::string name;
  /// The first broken promise in words; empty when all are kept.
  std::string (*broken_law)(const FuzzTarget& target, std::string_view bytes);
  /// Of a mesh's format: its place among the formats.
  int format = -1;
};

/// Every reader: one per format of meshes, and those of the small files.
std::span<const FuzzTarget> fuzz_targets();

/// The reader of that name; none: a null pointer.
const FuzzTarget* find_target(std::string_view name);

/// Memory a reader may take besides the file's bytes, which it is given: with them it is ten times
/// the unpacked file. `memory_allowance` is for memory that does not grow with the file (zlib's and
/// expat's tables, findings).
inline constexpr std::size_t memory_times = 9;
inline constexpr std::size_t memory_allowance = 512 << 10;

/// Whether a reader that goes over the bound ends the program at once, with the guilty call on the
/// stack; else it is a broken promise like others.
void end_at_memory_bound(bool yes);

/// The largest share of the bound that any file took.
double largest_memory_share();

}  // namespace sunder::test
