// SPDX-License-Identifier: MIT
// Tractions and energies of a corner.
#include "mechanics/ties/tie_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sunder {
namespace {

/// J/m^2 under the softening line from 0 to `opening`.
double area_under(const TieCorner& corner, double opening) {
  const double to = std::min(opening, corner.opening_end);
  return corner.strength * to * (1 - 0.5 * to / corner.opening_end);
}

/// Squared: along the normal, where it pulls, and across.
std::array<double, 2> squared_parts(const Vec3& v, const Vec3& normal) {
  const double along = normal.dot(v);
  const double opens = std::max(0.0, along);
  return {opens * opens, (v - along * normal).squaredNorm()};
}

}  // namespace

double effective_opening(const Vec3& opening, const Vec3& normal, const ShearLaw& shear) {
  const auto [along, across] = squared_parts(opening, normal);
  return std::sqrt(along + sliding_stiffness(shear) / shear.energy_ratio * across);
}

double effective_traction(const Vec3& traction, const Vec3& normal, const ShearLaw& shear) {
  const auto [along, across] = squared_parts(traction, normal);
  return std::sqrt(along + across / shear.weight);
}

double sliding_stiffness(const ShearLaw& shear) { return shear.weight / shear.energy_ratio; }

double mode_ratio(const Vec3& opening, const Vec3& normal, const ShearLaw& shear) {
  const auto [along, across] = squared_parts(opening, normal);
  const double stiffness = sliding_stiffness(shear);
  const double squared = along + stiffness / shear.energy_ratio * across;
  return squared > 0 ? (along + stiffness * across) / squared : 1;
}

double mode_ratio_of_traction(const Vec3& traction, const Vec3& normal, const ShearLaw& shear) {
  const double along = normal.dot(traction);
  const Vec3 across = traction - along * normal;
  return mode_ratio(along * normal + across / sliding_stiffness(shear), normal, shear);
}

double traction_at(const TieCorner& corner, double opening) {
  return corner.strength * std::max(0.0, 1 - opening / corner.opening_end);
}

double mean_traction(const TieCorner& corner, double opening) {
  const double from = corner.opened;
  // Below that the mean is the traction itself, to rounding.
  if (opening - from <= 1e-12 * corner.opening_end) return traction_at(corner, from);
  return std::max(0.0, area_under(corner, opening) - area_under(corner, from)) / (opening - from);
}

double secant_stiffness(const TieCorner& corner) {
  if (!(corner.opened > 0)) return std::numeric_limits<double>::infinity();
  return corner.area * traction_at(corner, corner.opened) / corner.opened;
}

double dissipated_energy(const TieCorner& corner, double opening, double mode) {
  const double stored = 0.5 * opening * traction_at(corner, opening);
  return mode * corner.area * (area_under(corner, opening) - stored);
}

double stored_energy(const TieCorner& corner, double opening, double mode) {
  if (!(corner.opened > 0)) return 0;
  return mode * 0.5 * secant_stiffness(corner) * opening * opening;
}

}  // namespace sunder
