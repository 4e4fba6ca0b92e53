// SPDX-License-Identifier: MIT
// A linear isotropic material, its Lame constants and its wave speeds.
#pragma once

#include <optional>

namespace sunder {

/// Strength and energy of a crack in sliding, relative to those in opening
/// (mechanics/ties/tie_law.hpp).
struct ShearLaw {
  double weight = 1;        ///< beta^2, > 0: (strength in shear / strength in tension)^2
  double energy_ratio = 1;  ///< kappa, > 0: G_II / G_I, energy of sliding over that of opening
  friend bool operator==(const ShearLaw&, const ShearLaw&) = default;
};

/// Isotropic, linear, brittle. The defaults are those of concrete. Poisson ratios above 0.49 are
/// refused, because linear tetrahedra lock there, and lambda is infinite at 0.5.
struct Material {
  double young_modulus = 30e9;    ///< E, Pa, > 0
  double poisson_ratio = 0.2;     ///< nu, in (-1, 0.49]
  double density = 2400;          ///< rho, kg/m^3, > 0
  double tensile_strength = 3e6;  ///< xi, Pa, > 0; infinite: never breaks
  /// K_Ic, Pa sqrt(m), > 0. If given, it replaces the strength at crack tips.
  std::optional<double> toughness = std::nullopt;
  /// G_c, J/m^2, > 0: energy that a crack takes per area (`CrackMode::cohesive`). With only a
  /// toughness given it is K_Ic^2 (1 - nu^2) / E.
  std::optional<double> fracture_energy = std::nullopt;
  ShearLaw shear = {};
};

/// Constants of sigma = lambda tr(eps) I + 2 mu eps, Pa.
struct Lame {
  double lambda = 0;
  double mu = 0;
};

/// lambda = E nu / ((1 + nu)(1 - 2 nu)), mu = E / (2 (1 + nu)). Requires: a material without
/// errors.
Lame lame(const Material& material);

/// Speed of a compression wave along a bar, sqrt(E / rho), m/s.
double bar_wave_speed(const Material& material);

/// Speed of a compression wave in the solid, sqrt((lambda + 2 mu) / rho), m/s: the fastest wave.
double compression_wave_speed(const Material& material);

/// Fracture energy, J/m^2: `fracture_energy`, or G_c = K_Ic^2 (1 - nu^2) / E [Irwin 1957, plane
/// strain]; infinite with neither.
double fracture_energy_of(const Material& material);

/// Toughness, Pa sqrt(m): `toughness`, or K_Ic = sqrt(E G_c / (1 - nu^2)); infinite with neither.
double toughness_of(const Material& material);

/// Largest rotation theta of a part against its rigid reference, rad. Beyond it the false strain
/// theta^2 / 2 exceeds `share` of the breaking strain xi / E (docs/explanation/theory.md).
double largest_valid_turn(const Material& material, double share);

}  // namespace sunder
