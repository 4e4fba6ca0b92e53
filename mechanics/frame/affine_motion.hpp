// SPDX-License-Identifier: MIT
// The affine field that fits the ways or velocities of many points best.
#pragma once

#include <cstddef>

#include "mechanics/state/vec3.hpp"

namespace sunder {

/// u(x) = mean + gradient (x - centre), in the units of the fitted ways.
struct AffineMotion {
  Vec3 centre = Vec3::Zero();  ///< m
  Vec3 mean = Vec3::Zero();
  Mat3 gradient = Mat3::Zero();  ///< that unit per m

  Vec3 at(const Vec3& x) const { return mean + gradient * (x - centre); }
};

/// Least squares over `count` points: `place(k)` is in m, `way(k)` is fitted. Points in a plane, on
/// a line or at one place leave no gradient across. O(count).
template <class Place, class Way>
AffineMotion fit_affine_motion(std::size_t count, Place place, Way way) {
  AffineMotion field;
  if (count == 0) return field;
  const double share = 1 / static_cast<double>(count);
  for (std::size_t k = 0; k < count; ++k) {
    field.centre += share * place(k);
    field.mean += share * way(k);
  }
  Mat3 spread = Mat3::Zero(), product = Mat3::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 x = place(k) - field.centre;
    spread += x * x.transpose();
    product += (way(k) - field.mean) * x.transpose();
  }
  constexpr double flat = 1e-9;
  spread.diagonal().array() += flat * spread.trace();
  if (spread.trace() > 0) field.gradient = product * spread.inverse();
  if (!field.gradient.allFinite()) field.gradient.setZero();
  return field;
}

/// By how much of their distance two points that go with the field may come nearer, at most. Needs:
/// ways (m).
double largest_approach(const AffineMotion& field);

}  // namespace sunder
