// SPDX-License-Identifier: MIT
// Edge crack and penny crack against fracture mechanics.
#include "tests/experiments/cases/crack_cases.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace sunder::accuracy;

TEST_CASE(
    "at an edge crack the tip stress goes as h^-1/2, and with toughness the breaking load "
    "stays while a bare strength loses sqrt 2 a halving",
    "[accuracy][crack]") {
  const auto rows = edge_cracks({8, 16, 32});
  const double exponent = std::log(rows[2].tip_stress / rows[0].tip_stress) / std::log(4.0);
  CHECK(exponent == Approx(0.5).margin(0.1));
  for (const CrackAnswer& row : rows) {
    INFO("a/h " << row.cells);
    CHECK(row.load_toughness == Approx(rows[1].load_toughness).epsilon(0.05));
    CHECK(row.load_toughness == Approx(1).epsilon(0.1));
    CHECK(row.load_energy == Approx(1).epsilon(0.08));
    CHECK(row.factor == Approx(rows[1].factor).epsilon(0.05));
    CHECK(row.domain_energy == Approx(row.front_release).epsilon(0.03));
  }
  CHECK(rows[0].load_strength / rows[1].load_strength == Approx(std::sqrt(2.0)).epsilon(0.05));
  CHECK(rows[1].load_strength / rows[2].load_strength == Approx(std::sqrt(2.0)).epsilon(0.05));
}

TEST_CASE("a penny crack releases 4 (1 - nu^2) sigma^2 a / (pi E) per area when its front grows",
          "[accuracy][crack]") {
  const CrackAnswer row = penny_crack({8});
  CHECK(row.front_release == Approx(1).epsilon(0.15));
  CHECK(row.domain_energy == Approx(row.front_release).epsilon(0.03));
}

TEST_CASE(
    "of second order the load with toughness is that of the closed form, at an edge and round a "
    "penny",
    "[accuracy][crack]") {
  const auto rows = edge_cracks({4, 8}, 2);
  for (const CrackAnswer& row : rows) {
    INFO("a/h " << row.cells);
    CHECK(row.load_toughness == Approx(1).epsilon(0.065));
    CHECK(row.load_energy == Approx(1).epsilon(0.03));
    CHECK(row.domain_energy == Approx(row.front_release).epsilon(0.02));
  }
  CHECK(rows[1].load_toughness == Approx(1).epsilon(0.05));
  CHECK(rows[1].tip_stress / rows[0].tip_stress == Approx(std::sqrt(2.0)).epsilon(0.02));
  const CrackAnswer penny = penny_crack({2, 2});
  CHECK(penny.front_release == Approx(1).epsilon(0.03));
  CHECK(penny.load_toughness == Approx(1).epsilon(0.05));
}
