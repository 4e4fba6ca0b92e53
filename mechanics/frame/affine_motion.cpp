// SPDX-License-Identifier: MIT
// How much an affine field brings points together.
#include "mechanics/frame/affine_motion.hpp"

#include <algorithm>

namespace sunder {

double largest_approach(const AffineMotion& field) {
  // |x + A x|^2 >= |x|^2 (1 - 2 s), s the norm of A's symmetric part; and 1 - s - s^2 is no more
  // than the root of 1 - 2 s while s <= 1/2.
  const double s = (0.5 * (field.gradient + field.gradient.transpose())).norm();
  return std::min(1.0, s <= 0.5 ? s + s * s : 1.0);
}

}  // namespace sunder
