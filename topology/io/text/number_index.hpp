// SPDX-License-Identifier: MIT
// Internal to the readers: rows by the file's own numbers.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace sunder::io {

/// Rows of numbered things: an array where the numbers are dense, else a hash.
struct NumberIndex {
  std::int64_t lowest = 0;
  std::vector<std::int64_t> dense;
  std::unordered_map<std::int64_t, std::int64_t> sparse;
};

/// The row of a number; -1 where nothing has it.
inline std::int64_t row_of(const NumberIndex& index, std::int64_t number) {
  if (!index.dense.empty()) {
    const std::uint64_t place =
        static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(index.lowest);
    return place < index.dense.size() ? index.dense[place] : -1;
  }
  const auto found = index.sparse.find(number);
  return found == index.sparse.end() ? -1 : found->second;
}

/// Fills `index` from numbers to rows; false, and the rows in `twice`, where two are the same.
bool index_numbers(NumberIndex& index, const std::vector<std::int64_t>& numbers,
                   std::array<std::int64_t, 2>& twice);

}  // namespace sunder::io
