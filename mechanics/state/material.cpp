// SPDX-License-Identifier: MIT
// Lame constants and the check of a material.
#include "mechanics/state/material.hpp"

#include <cmath>
#include <cstdio>
#include <string>

namespace sunder {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

struct Rule {
  const char* code;
  const char* key;
  const char* allowed;
  const char* remedy;
};

Finding broken_rule(const Rule& rule, double value, std::string_view place) {
  Finding finding;
  finding.code = rule.code;
  finding.text = std::string(place) + "." + rule.key + " is " + number(value) + "; allowed is " +
                 rule.allowed + ".";
  finding.remedy = rule.remedy;
  return finding;
}

}  // namespace

Lame lame(const Material& material) {
  const double E = material.young_modulus;
  const double nu = material.poisson_ratio;
  return {E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))};
}

double bar_wave_speed(const Material& material) {
  return std::sqrt(material.young_modulus / material.density);
}

double compression_wave_speed(const Material& material) {
  const auto [lambda, mu] = lame(material);
  return std::sqrt((lambda + 2 * mu) / material.density);
}

std::vector<Finding> check(const Material& material, std::string_view place) {
  std::vector<Finding> findings;
  const auto need = [&](bool holds, double value, const Rule& rule) {
    if (!holds) findings.push_back(broken_rule(rule, value, place));
  };
  // Written so that a NaN fails each test.
  const double E = material.young_modulus;
  need(E > 0 && std::isfinite(E), E,
       {"bad_young_modulus", "young_modulus", "a finite number above 0 Pa",
        "Give it in Pa: concrete is about 30e9."});
  const double nu = material.poisson_ratio;
  need(nu > -1 && nu <= 0.49, nu,
       {"bad_poisson_ratio", "poisson_ratio", "above -1 and at most 0.49",
        "Incompressible material (0.5) cannot be computed with linear tetrahedra; use 0.49 or "
        "less. Concrete is about 0.2."});
  const double rho = material.density;
  need(rho > 0 && std::isfinite(rho), rho,
       {"bad_density", "density", "a finite number above 0 kg/m^3",
        "Give it in kg/m^3: concrete is about 2400."});
  const double xi = material.tensile_strength;
  need(xi > 0, xi,
       {"bad_tensile_strength", "tensile_strength", "above 0 Pa",
        "Give it in Pa: concrete is about 3e6."});
  if (material.toughness) {
    const double K = *material.toughness;
    need(K > 0 && std::isfinite(K), K,
         {"bad_toughness", "toughness", "a finite number above 0 Pa sqrt(m)",
          "Leave it out, or give K_Ic in Pa sqrt(m): concrete is about 1e6."});
  }
  return findings;
}

}  // namespace sunder
