// SPDX-License-Identifier: MIT
// Counts with their nouns: one, none and several.
#include "topology/base/counted.hpp"

#include <catch2/catch.hpp>

using namespace sunder;

TEST_CASE("a count of one has a noun in the singular", "[counted]") {
  CHECK(counted(1, "window") == "1 window");
  CHECK(counted(0, "window") == "0 windows");
  CHECK(counted(12, "window") == "12 windows");
  CHECK(counted(1, "copy", "copies") == "1 copy");
  CHECK(counted(2, "copy", "copies") == "2 copies");
  CHECK(counted_tetrahedra(1) == "1 tetrahedron");
  CHECK(counted_tetrahedra(3) == "3 tetrahedra");
  CHECK(for_count(1, "is", "are") == "is");
  CHECK(for_count(0, "is", "are") == "are");
}

TEST_CASE("the text of a finding takes the words that fit its count", "[counted]") {
  const auto* const text = "% [face lies|faces lie] inside (100 [m] | 7)";
  CHECK(text_of_count(text, 1) == "1 face lies inside (100 [m] | 7)");
  CHECK(text_of_count(text, 20) == "20 faces lie inside (100 [m] | 7)");
  CHECK(text_of_count("", 1).empty());
}
