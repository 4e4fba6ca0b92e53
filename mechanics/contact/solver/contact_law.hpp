// SPDX-License-Identifier: MIT
// Rows of contacts: pressure within bounds, pushes, friction inside a disk of fixed radius.
#pragma once

#include <array>

#include "mechanics/contact/solver/row_response.hpp"

namespace sunder {

/// Whether the push of a contact is at work, with the impulse as it is.
bool contact_pushes(const Constraint& row, const RowResponse& response);

/// m/(N s), along the normal: give of the contact itself, and of a push at work
/// (`ContactConstraint::push`).
double contact_give(const Constraint& row, const RowResponse& response);

/// N s: least and most normal impulse. A push at work stays at work within them, and one that is
/// overcome stays overcome.
std::array<double, 2> contact_bounds(const Constraint& row, const RowResponse& response);

/// The impulse nearest to `impulse` that a contact can have: inside its bounds and its disk.
Vec3 contact_kept(const Constraint& row, const RowResponse& response, const Vec3& impulse);

/// How far, in [0, 1], the impulse can go along `change` before it is at a bound: its normal part,
/// and friction.
std::array<double, 2> contact_way(const Constraint& row, const RowResponse& response,
                                  const Vec3& change);

/// The normal impulse that a contact needs, if it has `before` (N s) and its gap is `gap` (m). A
/// contact that is too deep is pushed by ever less, and by nothing from `push_most` on. Wedged
/// pieces cannot be pushed apart: a push without end would press them until friction threw them
/// out.
double contact_wanted(const Constraint& row, const RowResponse& response, double before,
                      double gap);

}  // namespace sunder
