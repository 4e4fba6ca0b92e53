// SPDX-License-Identifier: MIT
// The random differential test: random splits of many bodies, each held against the laws, against a
// union-find that knows no dart, and against a full walk over components.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sunder::test {

struct RandomSplitOptions {
  /// Over all bodies together; a body whose faces are used up begins again whole.
  std::size_t splits = 1000;
  std::uint64_t seed = 1;
  /// Everything is counted from nothing after every so many splits of a body, and at its end.
  std::size_t full_every = 1000;
  /// Bodies of more tetrahedra than this are left out.
  std::size_t largest = 6000;
};

/// What happened to one body.
struct BodyReport {
  std::string name;
  std::size_t tetrahedra = 0, splits = 0, vertices_split = 0, edges_split = 0;
  /// Oracle said yes; truly separated; said no to a true separation (must be 0).
  std::size_t alarms = 0, separations = 0, missed = 0;
  std::size_t full_counts = 0;
  std::vector<std::string> mismatches;
};

std::vector<BodyReport> run_random_splits(const RandomSplitOptions& options);

}  // namespace sunder::test
