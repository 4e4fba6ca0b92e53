// SPDX-License-Identifier: MIT
// Lame constants and wave speeds.
#include "mechanics/state/settings/material.hpp"

#include <cmath>
#include <limits>

namespace sunder {

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

double fracture_energy_of(const Material& material) {
  if (material.fracture_energy) return *material.fracture_energy;
  if (!material.toughness) return std::numeric_limits<double>::infinity();
  const double nu = material.poisson_ratio, K = *material.toughness;
  return K * K * (1 - nu * nu) / material.young_modulus;
}

double toughness_of(const Material& material) {
  if (material.toughness) return *material.toughness;
  if (!material.fracture_energy) return std::numeric_limits<double>::infinity();
  const double nu = material.poisson_ratio;
  return std::sqrt(material.young_modulus * *material.fracture_energy / (1 - nu * nu));
}

double largest_valid_turn(const Material& material, double share) {
  return std::sqrt(2 * share * material.tensile_strength / material.young_modulus);
}

}  // namespace sunder
