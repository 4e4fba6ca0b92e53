// SPDX-License-Identifier: MIT
#include "mechanics/state/material.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace sunder;

TEST_CASE("Lame's constants give back modulus and Poisson's ratio", "[mechanics][material]") {
  Material material;
  material.young_modulus = 30e9;
  material.poisson_ratio = GENERATE(-0.5, 0.0, 0.2, 0.49);
  const Lame constants = lame(material);
  const double E =
      constants.mu * (3 * constants.lambda + 2 * constants.mu) / (constants.lambda + constants.mu);
  const double nu = constants.lambda / (2 * (constants.lambda + constants.mu));
  CHECK(E == Approx(material.young_modulus).epsilon(1e-12));
  CHECK(nu == Approx(material.poisson_ratio).epsilon(1e-12));
}

TEST_CASE("waves of bar and solid differ by the P-wave modulus", "[mechanics][material]") {
  Material material;
  material.poisson_ratio = 0;
  CHECK(compression_wave_speed(material) == Approx(bar_wave_speed(material)));
  material.poisson_ratio = 0.45;
  const double modulus = (1 - 0.45) / ((1 + 0.45) * (1 - 2 * 0.45));  // over E
  CHECK(compression_wave_speed(material) == Approx(std::sqrt(modulus) * bar_wave_speed(material)));
}

TEST_CASE("a material's mistakes are found, each with its place", "[mechanics][material]") {
  CHECK(check(Material{}, "m").empty());
  Material material;
  material.young_modulus = 0;
  material.poisson_ratio = 0.5;
  material.density = std::nan("");
  material.tensile_strength = -1;
  material.toughness = 0;
  const std::vector<Finding> findings = check(material, "bodies[0].material");
  CHECK(findings.size() == 5);
  for (const Finding& f : findings) CHECK(f.text.find("bodies[0].material") != std::string::npos);
  material = {};
  material.tensile_strength = std::numeric_limits<double>::infinity();
  CHECK(check(material, "m").empty());
}
