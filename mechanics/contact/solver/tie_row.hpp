// SPDX-License-Identifier: MIT
// Rows that tie two sides together: bounded pull, secant give, nothing but a gap when pressed.
//
// Which impulse a row takes is a convex problem because its bound is an ellipsoid and its give that
// of the same metric: at the bound the opening is along the ellipsoid's normal, below it along the
// secant. The metric is (1, beta^2 / kappa) of openings, (1, kappa / beta^2) of impulses. The law's
// own bound, (1, 1 / beta^2), is another one where kappa is not 1, and the opening not along its
// normal; but at one mode of opening both are the same up to the factor sqrt(m) (`mode_ratio`). So
// `tie_most` has that factor for the mode predicted, and the passes correct it as they do the bound.
#pragma once

#include <span>

#include "mechanics/contact/solver/contact_rows.hpp"

namespace sunder {

/// The whole opening that a tie goes by, m: with the impulse as it is, plus what was moved since.
inline Vec3 opening_of(const ContactRow& row, const Vec3& moved) { return row.slip + moved; }

/// Give of a tie for its impulse as it is, m/(N s): that of the secant, none along the normal where
/// the sides are pressed together.
Mat3 tie_give(const ContactRow& row);

/// The impulse nearest to `impulse` that a tie can bear: an ellipsoid of pull and shear where it
/// pulls, the cylinder behind it where it is pressed. Nearest in the metric
/// of the file's first lines.
Vec3 tie_kept(const ContactRow& row, const Vec3& impulse);

/// Whether its impulse is short of all that it can bear.
bool tie_is_free(const ContactRow& row);

/// How far, in [0, 1], the impulse can go along `change` before it is at a bound, or at a change
/// from pull to pressure of a tie that gives.
double tie_way(const ContactRow& row, const Vec3& change);

/// The step of the sweeps: largest eigenvalue of response and give in the metric of `tie_kept`.
double tie_response_of(const ContactRow& row);

/// One visit: the impulse that a tie takes for the opening that it sees.
Vec3 tie_wanted(const ContactRow& row, const Vec3& opening);

}  // namespace sunder
