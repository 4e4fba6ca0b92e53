// SPDX-License-Identifier: MIT
#include "topology/mesh/box_tree.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

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
