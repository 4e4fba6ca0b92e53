// SPDX-License-Identifier: MIT
// The linear irreversible law of ties [Camacho and Ortiz 1996]: rigid up to a strength, softening
// from there to nothing; what has opened in part unloads and loads again through the origin.
#pragma once

#include "mechanics/ties/tie.hpp"

namespace sunder {

/// beta^2: how much a tangential opening counts against a normal one, and how much larger than the
/// tensile strength the one in shear is, squared.
inline constexpr double shear_weight = 1;

/// sqrt(<delta_n>^2 + beta^2 delta_t^2), m: the opening that the law goes by. `normal`: unit length.
double effective_opening(const Vec3& opening, const Vec3& normal);

/// sqrt(<t_n>^2 + t_t^2 / beta^2), Pa: the traction that reaches a strength of that size.
double effective_traction(const Vec3& traction, const Vec3& normal);

/// Pa: what the corner bears at most with its largest opening at `opening`, m.
double traction_at(const TieCorner& corner, double opening);

/// Pa: mean of `traction_at` over the openings from the largest so far to `opening`, if that is
/// more; a force of that size takes just the energy that the law asks for.
double mean_traction(const TieCorner& corner, double opening);

/// N/m: secant through the origin along which the corner unloads; infinite where it has not opened.
double secant_stiffness(const TieCorner& corner);

/// J that opening the corner as far as `opening` dissipates, from 0, once it is unloaded.
double dissipated_energy(const TieCorner& corner, double opening);

/// J stored in the corner at an effective opening of `opening`, not above the largest.
double stored_energy(const TieCorner& corner, double opening);

}  // namespace sunder
