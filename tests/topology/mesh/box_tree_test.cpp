// SPDX-License-Identifier: MIT
#include "topology/mesh/box_tree.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>

using namespace sunder;

TEST_CASE("a box tree finds the boxes that a search of all finds", "[mesh][box_tree]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0, 1), size(0, 0.2);
  decltype(BoxTree::boxes) boxes;
  for (int i = 0; i < 300; ++i) {
    const Point low = {place(random), place(random), place(random)};
    boxes.push_back({low, {low[0] + size(random), low[1] + size(random), low[2] + size(random)}});
  }
  boxes.push_back(boxes.front());  // two at one place
  const BoxTree tree = box_tree(boxes);
  std::size_t found_in_all = 0;
  for (int i = 0; i < 200; ++i) {
    const Point p =
        i < 100 ? Point{place(random), place(random), place(random)} : boxes[std::size_t(i)].low;
    std::vector<std::size_t> found, expected;
    for_each_box_at(tree, p, [&](std::size_t row) { found.push_back(row); });
    for (std::size_t row = 0; row < boxes.size(); ++row) {
      if (contains(boxes[row], p)) expected.push_back(row);
    }
    std::sort(found.begin(), found.end());
    REQUIRE(found == expected);
    found_in_all += found.size();
  }
  CHECK(found_in_all > 100);
}

TEST_CASE("a box tree of nothing finds nothing", "[mesh][box_tree]") {
  CHECK(for_each_box_at(box_tree({}), Point{0, 0, 0}, [](std::size_t) { FAIL(); }) == 0);
}

namespace {

/// The nodes as the header says they are, from sorted rows.
void build_slowly(BoxTree& tree, std::vector<std::uint32_t> rows, std::uint32_t begin) {
  const auto centre = [&](std::uint32_t row, std::size_t k) {
    return (tree.boxes[row].low[k] + tree.boxes[row].high[k]) / 2;
  };
  BoundingBox around = tree.boxes[rows[0]];
  std::size_t widest = 0;
  std::array<double, 3> spread{};
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<double> centres;
    for (const auto row : rows) {
      around.low[k] = std::min(around.low[k], tree.boxes[row].low[k]);
      around.high[k] = std::max(around.high[k], tree.boxes[row].high[k]);
      centres.push_back(centre(row, k));
    }
    std::ranges::sort(centres);
    spread[k] = centres.back() - centres.front();
    if (spread[k] > spread[widest]) widest = k;
  }
  const std::size_t n = tree.nodes.size();
  tree.nodes.push_back({around, begin, begin + static_cast<std::uint32_t>(rows.size()), 0});
  if (rows.size() <= 4) {
    tree.order.insert(tree.order.end(), rows.begin(), rows.end());
    return;
  }
  std::ranges::sort(rows, {}, [&](auto row) { return std::pair{centre(row, widest), row}; });
  const auto half = static_cast<std::uint32_t>(rows.size() / 2);
  build_slowly(tree, {rows.begin(), rows.begin() + half}, begin);
  tree.nodes[n].right = static_cast<std::uint32_t>(tree.nodes.size());
  build_slowly(tree, {rows.begin() + half, rows.end()}, begin + half);
}

}  // namespace

TEST_CASE("nodes halve their boxes at the median centre of the widest axis, and every look counts",
          "[mesh][box_tree]") {
  std::mt19937 random(7);
  for (const int n : {1, 4, 5, 8, 9, 10, 33, 100}) {
    for (const bool on_grid : {true, false}) {
      INFO(n << " boxes" << (on_grid ? " on a grid" : ""));
      std::vector<BoundingBox> boxes;
      for (int i = 0; i < n; ++i) {
        const auto number = [&](double range) {
          const double x = std::uniform_real_distribution<double>(0, range)(random);
          return on_grid ? std::floor(x) : x;
        };
        const Point low = {number(4) - 9, number(5) - 2, number(6)};
        boxes.push_back({low, {low[0] + number(9), low[1] + number(9), low[2] + number(9)}});
      }
      const BoxTree tree = box_tree(boxes);
      BoxTree slow;
      slow.boxes = boxes;
      std::vector<std::uint32_t> rows(boxes.size());
      for (std::uint32_t i = 0; i < rows.size(); ++i) rows[i] = i;
      build_slowly(slow, rows, 0);
      REQUIRE(tree.nodes.size() == slow.nodes.size());
      const auto rows_of = [](const BoxTree& t, std::size_t node) {
        return std::set(t.order.begin() + t.nodes[node].begin, t.order.begin() + t.nodes[node].end);
      };
      for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        CHECK(tree.nodes[i].begin == slow.nodes[i].begin);
        CHECK(tree.nodes[i].end == slow.nodes[i].end);
        CHECK(tree.nodes[i].right == slow.nodes[i].right);
        CHECK(tree.nodes[i].box.low == slow.nodes[i].box.low);
        CHECK(tree.nodes[i].box.high == slow.nodes[i].box.high);
        CHECK(rows_of(tree, i) == rows_of(slow, i));
      }
      for (const BoundingBox& at : boxes) {
        // A node is looked at where all above it hold the point; the boxes of a leaf that does.
        std::size_t looks = 0, skip_until = 0;
        for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
          if (tree.nodes[i].begin < skip_until) continue;
          ++looks;
          if (!contains(tree.nodes[i].box, at.high)) {
            skip_until = tree.nodes[i].end;
          } else if (tree.nodes[i].right == 0) {
            looks += tree.nodes[i].end - tree.nodes[i].begin;
          }
        }
        CHECK(for_each_box_at(tree, at.high, [](std::uint32_t) {}) == looks);
      }
    }
  }
}

TEST_CASE("a box holds what lies between its corners, both inclusive", "[mesh][box_tree]") {
  const BoundingBox box{{1, 2, 3}, {4, 5, 6}};
  CHECK(contains(box, box.low));
  CHECK(contains(box, box.high));
  for (std::size_t k = 0; k < 3; ++k) {
    Point below = {2, 3, 4}, above = {2, 3, 4};
    CHECK(contains(box, below));
    below[k] = box.low[k] - 0.5;
    above[k] = box.high[k] + 0.5;
    CHECK_FALSE(contains(box, below));
    CHECK_FALSE(contains(box, above));
  }
}
