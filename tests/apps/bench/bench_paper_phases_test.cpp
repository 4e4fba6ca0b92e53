// SPDX-License-Identifier: MIT
// Phases of fracturing and the place of the largest step, on series written down by hand.
#include <catch2/catch.hpp>
#include <vector>

#include "apps/bench/paper/bench_paper_phases.hpp"

using namespace sunder;

namespace {

/// 40 steps of 1 ms without fans.
struct Series {
  std::vector<double> ms = std::vector<double>(40, 1.0);
  std::vector<std::uint32_t> fans = std::vector<std::uint32_t>(40, 0);
  FracturePhases phases() const { return fracture_phases(ms, fans); }
};

}  // namespace

TEST_CASE("ten steps without a fan divide phases, nine do not", "[paper]") {
  Series s;
  s.fans[5] = s.fans[15] = 3;
  CHECK(s.phases().phases == 1);
  CHECK(s.phases().breaking_steps == 2);
  CHECK(s.phases().first_break == 6);
  s.fans[15] = 0;
  s.fans[16] = 1;
  CHECK(s.phases().phases == 2);
}

TEST_CASE("the largest step has a place in its phase, and later ones near it are counted",
          "[paper]") {
  Series s;
  s.fans[5] = s.fans[7] = s.fans[8] = s.fans[30] = 1;
  s.ms[7] = 10;
  s.ms[20] = 9.5;
  s.ms[3] = 9.9;
  const FracturePhases p = s.phases();
  CHECK(p.max_step == 8);
  CHECK(p.max_breaks);
  CHECK(p.max_in_phase == 2);
  CHECK(p.phase_length == 3);
  CHECK(p.later_near_max == 1);
}

TEST_CASE("a largest step before all fans has no place, one without fans follows its phase",
          "[paper]") {
  Series s;
  CHECK(s.phases().phases == 0);
  CHECK(s.phases().max_step == 1);
  s.fans[5] = s.fans[6] = 1;
  s.ms[2] = 10;
  CHECK(s.phases().max_in_phase == 0);
  CHECK(s.phases().phase_length == 0);
  s.ms[2] = 1;
  s.ms[35] = 10;
  CHECK_FALSE(s.phases().max_breaks);
  CHECK(s.phases().max_in_phase == 2);
  CHECK(s.phases().later_near_max == 0);
  CHECK(fracture_phases({}, {}).phases == 0);
}
