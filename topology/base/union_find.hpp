// SPDX-License-Identifier: MIT
// Sets that are joined and never parted.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace sunder {

/// The root of `i` by parents that may be changed: `parent(i)` gives a reference. Halves the ways
/// it goes.
template <class Parent>
std::uint32_t root_of(std::uint32_t i, Parent parent) {
  while (parent(i) != i) i = parent(i) = parent(parent(i));
  return i;
}

/// Union-find over rows 0, 1, ...: the lowest member of a set is its root.
class UnionFind {
 public:
  UnionFind() = default;
  explicit UnionFind(std::size_t rows) : parent_(rows) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  std::size_t size() const { return parent_.size(); }

  std::uint32_t root(std::uint32_t row) {
    return root_of(row, [this](std::uint32_t i) -> std::uint32_t& { return parent_[i]; });
  }

  /// True where they were apart.
  bool join(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parent_[high] = low;
    return low != high;
  }

  /// The root of every row.
  std::vector<std::uint32_t> roots() && {
    for (std::uint32_t row = 0; row < parent_.size(); ++row) parent_[row] = root(row);
    return std::move(parent_);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace sunder
