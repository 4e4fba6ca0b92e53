// SPDX-License-Identifier: MIT
// A list as a set: rising, each value once.
#pragma once

#include <algorithm>
#include <vector>

namespace sunder {

/// Sorts `values` and drops duplicates. O(n log n).
template <class Value>
void sort_unique(std::vector<Value>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace sunder
