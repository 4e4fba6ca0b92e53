// SPDX-License-Identifier: MIT
// Laws of one split: the changes that they allow, and those that they refuse.
#include "topology/suite/random/random_run_laws.hpp"

#include <array>
#include <catch2/catch.hpp>

using namespace sunder;
using namespace sunder::suite;

TEST_CASE("every row of the table of changes is in the laws, and nothing else", "[suite][random]") {
  const auto possible = [](std::size_t v, std::size_t e, const std::array<int, 4>& change) {
    SplitAnswer answer;
    answer.did = true;
    answer.vertices.resize(v);
    answer.edges.resize(e);
    answer.separated = change[0] == 1;
    const BettiNumbers before = {5, 5, 5, 5};
    BettiNumbers after;
    for (std::size_t d = 0; d < 4; ++d) after[d] = before[d] + static_cast<std::size_t>(change[d]);
    Checks checks;
    judge_answer(checks, answer);
    judge_change(checks, before, after, answer);
    return !checks.first;
  };
  std::size_t rows = 0;
  for (std::size_t v = 0; v <= 3; ++v) {
    for (std::size_t e = 0; e <= 3; ++e) {
      for (int code = 0; code < 625; ++code) {
        const std::array<int, 4> change = {code % 5 - 2, code / 5 % 5 - 2, code / 25 % 5 - 2,
                                           code / 125 - 2};
        if (!possible(v, e, change)) continue;
        ++rows;
        // The law from the counts alone: dchi = s_v - s_e + 1.
        const int chi = change[0] - change[1] + change[2] - change[3];
        CHECK(chi == static_cast<int>(v) - static_cast<int>(e) + 1);
      }
    }
  }
  CHECK(rows == 14);
}
