// SPDX-License-Identifier: MIT
// A tree of axis-parallel boxes that finds those which hold a point.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// From the lowest to the highest corner, both inclusive.
struct BoundingBox {
  Point low, high;
};

/// Extends a box to a point.
constexpr void extend(BoundingBox& box, const Point& p) {
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = std::min(box.low[k], p[k]);
    box.high[k] = std::max(box.high[k], p[k]);
  }
}

constexpr double longest_side(const BoundingBox& box) {
  return std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
}

/// The box around rows of points. Needs: at least one row.
template <class Rows>
BoundingBox box_around(const std::vector<Point>& points, const Rows& rows) {
  BoundingBox box{points[*std::begin(rows)], points[*std::begin(rows)]};
  for (const std::uint32_t row : rows) extend(box, points[row]);
  return box;
}

constexpr bool contains(const BoundingBox& box, const Point& p) {
  return box.low[0] <= p[0] && p[0] <= box.high[0] && box.low[1] <= p[1] && p[1] <= box.high[1] &&
         box.low[2] <= p[2] && p[2] <= box.high[2];
}

/// Whether two boxes have a point in common.
constexpr bool overlap(const BoundingBox& a, const BoundingBox& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  }
  return true;
}

/// Boxes halved at their median centre along the axis in which the centres spread most.
struct BoxTree {
  struct Node {
    BoundingBox box;
    /// Boxes `order[begin]` to `order[end - 1]`.
    std::uint32_t begin = 0, end = 0;
    /// The second child; the first one follows its parent. 0: a leaf.
    std::uint32_t right = 0;
  };
  std::vector<Node> nodes;
  std::vector<std::uint32_t> order;
  std::vector<BoundingBox> boxes;
};

/// Needs: finite boxes, fewer than 2^31. O(n log n).
BoxTree box_tree(std::vector<BoundingBox> boxes);

/// The tree of the boxes around triangles, one row each.
BoxTree box_tree(const std::vector<Point>& points,
                 const std::vector<std::array<std::uint32_t, 3>>& triangles);

/// Calls `work(row)` for every box that `is_near(box)`, which has to be so of a node's box where it
/// is of a box inside. Gives the number of nodes and boxes looked at: some log n where boxes hardly
/// overlap, 2 n at the worst.
template <class IsNear, class Work>
std::size_t for_each_box(const BoxTree& tree, IsNear&& is_near, Work&& work) {
  std::size_t looked_at = 0;
  std::uint32_t stack[64];  // halving leaves fewer levels than a row has bits
  int depth = 0;
  if (!tree.nodes.empty()) stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t n = stack[--depth];
    const BoxTree::Node& node = tree.nodes[n];
    ++looked_at;
    if (!is_near(node.box)) continue;
    if (node.right != 0) {
      stack[depth++] = node.right;
      stack[depth++] = n + 1;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      ++looked_at;
      if (is_near(tree.boxes[tree.order[i]])) work(tree.order[i]);
    }
  }
  return looked_at;
}

/// The same for every box that holds `p`.
template <class Work>
std::size_t for_each_box_at(const BoxTree& tree, const Point& p, Work&& work) {
  return for_each_box(
      tree, [&](const BoundingBox& box) { return contains(box, p); }, work);
}

}  // namespace sunder
