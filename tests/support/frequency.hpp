// SPDX-License-Identifier: MIT
// The highest frequency of a body, which bounds explicit steps.
#pragma once

#include <cmath>

#include "mechanics/integrators/component_step.hpp"
#include "tests/support/bodies.hpp"

namespace sunder::test {

/// rad/s, by power iteration on M^-1 K.
inline double highest_frequency(MechanicsState state, const Body& body) {
  const ComponentSystem& system = built_system(state, body.corners, state.components.front());
  const auto size = static_cast<Eigen::Index>(3 * system.size());
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(size, 1, 2), product(size);
  for (Eigen::Index k = 0; k < size; k += 2) x[k] = -x[k];
  double squared = 0;
  for (int i = 0; i < 2000; ++i) {
    multiply_stiffness(product, system, x);
    for (Eigen::Index k = 0; k < size; ++k) product[k] /= system.shape.mass[k / 3];
    squared = product.norm() / x.norm();
    x = product.normalized();
  }
  return std::sqrt(squared);
}

}  // namespace sunder::test
