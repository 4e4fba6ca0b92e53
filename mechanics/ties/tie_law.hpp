// SPDX-License-Identifier: MIT
// The linear irreversible law of ties: rigid up to a strength, softening from there to zero. A
// partly opened tie unloads and loads again through the origin.
#pragma once

#include "mechanics/ties/tie.hpp"

namespace sunder {

// With delta the effective opening, s(delta) = sigma (1 - delta / delta_c), n the normal and t the
// direction of sliding, a crack that opens farther than ever bears
//   T = (delta_n n + beta^2 / kappa delta_t t) s(delta) / delta,
// and one that has opened to delta_max the same with s(delta_max) / delta_max [Snozzi and Molinari
// 2013; kappa = 1: Camacho and Ortiz 1996]. Opened it takes G_c, slid kappa G_c. In between the
// energy depends on the path: each d delta_max dissipates sigma / 2 m d delta_max, m the
// `mode_ratio` of the opening, and an unloading crack stores elastic energy, so none is created.

/// sqrt(<delta_n>^2 + beta^2 / kappa^2 delta_t^2), m: the opening that the law goes by. `normal`:
/// unit length.
double effective_opening(const Vec3& opening, const Vec3& normal, const ShearLaw& shear);

/// sqrt(<t_n>^2 + t_t^2 / beta^2), Pa: the traction that reaches a strength of that size.
double effective_traction(const Vec3& traction, const Vec3& normal, const ShearLaw& shear);

/// beta^2 / kappa: the stiffness of a crack against sliding over that against opening.
double sliding_stiffness(const ShearLaw& shear);

/// m = (<delta_n>^2 + beta^2 / kappa delta_t^2) / (<delta_n>^2 + beta^2 / kappa^2 delta_t^2): how
/// much more energy this opening takes and stores than one along the normal; from 1 to kappa. 1
/// where nothing is open.
double mode_ratio(const Vec3& opening, const Vec3& normal, const ShearLaw& shear);

/// The same of the opening that makes a traction.
double mode_ratio_of_traction(const Vec3& traction, const Vec3& normal, const ShearLaw& shear);

/// Pa: effective traction that the corner bears at most with its largest opening at `opening`, m.
double traction_at(const TieCorner& corner, double opening);

/// Pa: mean of `traction_at` over the openings from the largest so far to `opening`, if that is
/// more. A force of that size takes exactly the energy of the law.
double mean_traction(const TieCorner& corner, double opening);

/// N/m: secant through the origin along which the corner unloads when opened along the normal;
/// infinite where it has not opened.
double secant_stiffness(const TieCorner& corner);

/// J that opening the corner as far as `opening` dissipates, from 0, once it is unloaded; all the
/// way in one mode. Proportional to the opening, so that a path takes sums of differences.
double dissipated_energy(const TieCorner& corner, double opening, double mode);

/// J stored in the corner at an effective opening of `opening`, not above the largest.
double stored_energy(const TieCorner& corner, double opening, double mode);

}  // namespace sunder
