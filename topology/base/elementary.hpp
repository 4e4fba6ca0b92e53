// SPDX-License-Identifier: MIT
// Elementary functions in plain arithmetic: the same bytes in every build.
#pragma once

namespace sunder {

// Libraries of C differ in the last bit of these, some of them from one processor to the next; a
// crack that a last bit decides would then be another one. These need additions, products and
// divisions only, which IEEE 754 rounds alike everywhere.

/// Sine of an angle, radians, within 1.1 units in the last place up to 1 000 radians and within two
/// up to 1.6e6; beyond, that of the angle reduced by a rounded 2 pi. Not a number for angles that
/// are not finite.
double sine(double angle);

/// Cosine, as `sine`.
double cosine(double angle);

/// Cube root within one unit in the last place; of a negative number the negative one.
double cube_root(double x);

/// e^x within two units in the last place; 0 below -700, infinite above 700.
double exponential(double x);

/// Natural logarithm within two units in the last place; of 0 minus infinity, of a negative number
/// not a number.
double logarithm(double x);

/// The angle in (-pi, pi] of the direction (x, y), radians, within three units in the last place; 0
/// of (0, 0).
double direction_angle(double y, double x);

}  // namespace sunder
