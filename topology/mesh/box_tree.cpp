// SPDX-License-Identifier: MIT
// Builds a tree of boxes.
#include "topology/mesh/box_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace sunder {
namespace {

constexpr std::uint32_t leaf_size = 4;

/// Halved before they are added: no sum of two finite numbers overflows so.
double centre(const BoundingBox& box, int axis) { return box.low[axis] / 2 + box.high[axis] / 2; }

BoundingBox around(const BoxTree& tree, std::uint32_t begin, std::uint32_t end) {
  BoundingBox all = tree.boxes[tree.order[begin]];
  for (std::uint32_t i = begin + 1; i < end; ++i) {
    const BoundingBox& box = tree.boxes[tree.order[i]];
    extend(all, box.low);
    extend(all, box.high);
  }
  return all;
}

int widest_axis(const BoxTree& tree, std::uint32_t begin, std::uint32_t end) {
  Point spread;
  for (int k = 0; k < 3; ++k) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::uint32_t i = begin; i < end; ++i) {
      const double c = centre(tree.boxes[tree.order[i]], k);
      low = std::min(low, c);
      high = std::max(high, c);
    }
    spread[k] = high - low;
  }
  return static_cast<int>(std::ranges::max_element(spread) - spread.begin());
}

void build(BoxTree& tree, std::uint32_t begin, std::uint32_t end) {
  const auto n = static_cast<std::uint32_t>(tree.nodes.size());
  tree.nodes.push_back({around(tree, begin, end), begin, end, 0});
  if (end - begin <= leaf_size) return;
  const int axis = widest_axis(tree, begin, end);
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto at = [&tree](std::uint32_t i) {
    return tree.order.begin() + static_cast<std::ptrdiff_t>(i);
  };
  // Ties by row: the same halves on every machine.
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    const double x = centre(tree.boxes[a], axis), y = centre(tree.boxes[b], axis);
    return x != y ? x < y : a < b;
  });
  build(tree, begin, middle);
  tree.nodes[n].right = static_cast<std::uint32_t>(tree.nodes.size());
  build(tree, middle, end);
}

}  // namespace

BoxTree box_tree(std::vector<BoundingBox> boxes) {
  BoxTree tree;
  tree.boxes = std::move(boxes);
  tree.order.resize(tree.boxes.size());
  std::iota(tree.order.begin(), tree.order.end(), 0U);
  if (!tree.order.empty()) build(tree, 0, static_cast<std::uint32_t>(tree.order.size()));
  return tree;
}

BoxTree box_tree(const std::vector<Point>& points,
                 const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(triangles.size());
  for (const auto& t : triangles) boxes.push_back(box_around(points, t));
  return box_tree(std::move(boxes));
}

}  // namespace sunder
