// SPDX-License-Identifier: MIT
// Filling the way from numbers to rows.
#include "topology/io/text/number_index.hpp"

#include <algorithm>

namespace sunder::io {

bool index_numbers(NumberIndex& index, const std::vector<std::int64_t>& numbers,
                   std::array<std::int64_t, 2>& twice) {
  index = {};
  if (numbers.empty()) return true;
  const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
  index.lowest = *low;
  const std::uint64_t spread = static_cast<std::uint64_t>(*high) - static_cast<std::uint64_t>(*low);
  const bool dense = spread / 4 <= numbers.size();
  if (dense) index.dense.assign(spread + 1, -1);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto row = static_cast<std::int64_t>(i);
    if (const std::int64_t before = row_of(index, numbers[i]); before >= 0) {
      twice = {before, row};
      return false;
    }
    if (dense) {
      index.dense[static_cast<std::uint64_t>(numbers[i]) -
                  static_cast<std::uint64_t>(index.lowest)] = row;
    } else {
      index.sparse.emplace(numbers[i], row);
    }
  }
  return true;
}

}  // namespace sunder::io
