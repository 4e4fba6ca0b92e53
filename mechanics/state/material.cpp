// SPDX-License-Identifier: MIT
// Lame constants and wave speeds.
#include "mechanics/state/material.hpp"

#include <cmath>

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

}  // namespace sunder
