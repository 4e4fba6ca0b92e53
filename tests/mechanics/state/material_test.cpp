// SPDX-License-Identifier: MIT
#include "mechanics/state/settings/material.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "mechanics/state/settings/check_settings.hpp"

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

TEST_CASE("bad materials are found with place, value and remedy", "[mechanics][material]") {
  CHECK(check_settings(Material{}, "m").empty());
  const auto place = [](const Material& material) {
    const std::vector<SettingFinding> findings = setting_findings(material, "bodies.0.material");
    REQUIRE(findings.size() == 1);
    const Finding& f = findings[0].finding;
    CHECK(f.severity == Severity::error);
    CHECK(f.code == "out_of_range");
    CHECK(f.text.find(findings[0].place + " is ") == 0);
    CHECK_FALSE(f.remedy.empty());
    return findings[0].place.substr(std::string("bodies.0.material.").size());
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double nu : {0.5, -1.0, nan}) CHECK(place({.poisson_ratio = nu}) == "poisson_ratio");
  for (const double rho : {-2400.0, nan, infinite}) CHECK(place({.density = rho}) == "density");
  CHECK(place({.young_modulus = 0}) == "young_modulus");
  CHECK(place({.tensile_strength = 0}) == "tensile_strength");
  CHECK(place({.tensile_strength = -infinite}) == "tensile_strength");
  CHECK(place({.toughness = -1}) == "toughness");
  CHECK(check_settings(Material{.poisson_ratio = 0.5}, "m")[0].text ==
        "m.poisson_ratio is 0.5; allowed is above -1 and at most 0.49");
  CHECK(check_settings(Material{.young_modulus = -1, .density = 0}, "m").size() == 2);
  CHECK(check_settings(Material{.poisson_ratio = 0.49, .tensile_strength = infinite}, "m").empty());
}
