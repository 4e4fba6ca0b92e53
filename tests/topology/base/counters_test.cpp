// SPDX-License-Identifier: MIT
// Reports add up as their counters say, over a step and over a run.
#include "topology/base/counters.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <string>

using namespace sunder;

namespace {

struct Counts {
  std::size_t made = 0, waiting = 0, failed = 0;
  double deepest = 0;
  std::array<int, 2> of_each{};
  int unlisted = 0;
};

constexpr auto counters_of(const Counts*) {
  return std::tuple{
      Counter{"made", &Counts::made}, Counter{"waiting", &Counts::waiting, Adds::last},
      Counter{"failed", &Counts::failed, Adds::sum, Adds::once},
      Counter{"", &Counts::deepest, Adds::most}, Counter{"of_each", &Counts::of_each}};
}

}  // namespace

TEST_CASE("Parts of a step and steps of a run add up by the rules of each counter",
          "[topology][counters]") {
  Counts run;
  for (int step = 0; step < 3; ++step) {
    Counts sum;
    add_part(sum, Counts{2, 7, 1, 0.5, {1, 2}, 9});
    add_part(sum, Counts{3, 4, 1, 0.25, {10, 20}, 9});
    CHECK(sum.made == 5);
    CHECK(sum.waiting == 4);
    CHECK(sum.failed == 2);
    CHECK(sum.deepest == 0.5);
    CHECK(sum.of_each == std::array{11, 22});
    CHECK(sum.unlisted == 0);
    add_step(run, sum);
  }
  add_step(run, Counts{});
  CHECK(run.made == 15);
  CHECK(run.waiting == 0);
  CHECK(run.failed == 3);
  CHECK(run.deepest == 0.5);
  CHECK(run.of_each == std::array{33, 66});
}

TEST_CASE("Counters are visited in their order, by name", "[topology][counters]") {
  std::string names;
  for_each_counter<Counts>([&](const auto& counter) { names += std::string(counter.name) + ","; });
  CHECK(names == "made,waiting,failed,,of_each,");
}

TEST_CASE("values below zero add up by the same rules", "[topology][counters]") {
  double sum = -1, once = 0;
  add_value(sum, -2.0, Adds::sum);
  add_value(once, -2.0, Adds::once);
  CHECK(sum == -3);
  CHECK(once == 1);
}
