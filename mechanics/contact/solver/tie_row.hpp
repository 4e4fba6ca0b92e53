// SPDX-License-Identifier: MIT
// Rows of cohesive bonds: bounded pull, secant give, nothing but a gap when pressed.
//
// The impulse of a bond solves a convex problem: its bound is an ellipsoid and its give that of the
// same metric. At the bound the opening is along the ellipsoid's normal, below it along the secant.
// The metric is (1, beta^2 / kappa) of openings, (1, kappa / beta^2) of impulses. The law's own
// bound, (1, 1 / beta^2), is another one where kappa is not 1, and the opening not along its
// normal. At one mode of opening both are the same up to the factor sqrt(m) (`mode_ratio`). So
// `CohesiveBond::most` has that factor for the mode predicted, and the passes correct it as they do
// the bound.
#pragma once

#include <span>

#include "mechanics/contact/solver/contact_rows.hpp"

namespace sunder {

/// m, the whole opening of a bond: with the impulse as it is, plus the motion since.
inline Vec3 opening_of(const Constraint& row, const Vec3& moved) { return row.slip + moved; }

/// Give of a bond for its impulse as it is, m/(N s): that of the secant, none along the normal
/// where the sides are pressed together.
Mat3 bond_give(const Constraint& row);

/// The impulse nearest to `impulse` that a bond can bear: an ellipsoid of pull and shear where it
/// pulls, the cylinder behind it where it is pressed. Nearest in the metric
/// of the file's first lines.
Vec3 bond_kept(const Constraint& row, const Vec3& impulse);

/// Whether the impulse of a bond is short of all that it can bear.
bool bond_is_free(const Constraint& row);

/// How far, in [0, 1], the impulse can go along `change` before it is at a bound, or at a change
/// from pull to pressure of a bond that gives.
double bond_way(const Constraint& row, const Vec3& change);

/// The step of the sweeps, m/(N s): largest eigenvalue of the row's own response and its give, in
/// the metric of `bond_kept`.
double bond_response(const Constraint& row, const Mat3& response);

/// One visit: the impulse that a bond takes for the opening that it sees.
Vec3 bond_wanted(const Constraint& row, const Vec3& opening);

}  // namespace sunder
