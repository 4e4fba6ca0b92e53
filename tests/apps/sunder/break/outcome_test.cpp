// SPDX-License-Identifier: MIT
// The sentence about the outcome.
#include "apps/sunder/break/outcome.hpp"

#include <catch2/catch.hpp>
#include <vector>

using namespace sunder;

TEST_CASE("the outcome is one sentence with shares of the mass", "[break]") {
  CHECK(outcome_sentence(std::vector<double>{2.0}, 0) == "1 piece: it did not break");
  CHECK(outcome_sentence(std::vector<double>{2.0}, 1) == "1 piece with 1 crack");
  CHECK(outcome_sentence(std::vector<double>{2.0}, 7) == "1 piece with 7 cracks");
  CHECK(outcome_sentence(std::vector<double>{60, 35, 0.4, 4.6}, 9) ==
        "4 pieces, 3 large ones with 100 % of the mass, largest 60 %");
  std::vector<double> dust(100, 0.005);
  dust.push_back(0.5);
  CHECK(outcome_sentence(dust, 9) == "101 pieces, 1 large one with 50 % of the mass, largest 50 %");
}
