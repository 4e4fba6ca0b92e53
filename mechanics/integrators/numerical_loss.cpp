// SPDX-License-Identifier: MIT
// The losses of generalised-alpha and of the scheme of impacts from differences over a step.
#include "mechanics/integrators/numerical_loss.hpp"

#include "mechanics/integrators/coefficients.hpp"

namespace sunder {

double numerical_loss(const ComponentSystem& system, const IntegratorSettings& settings,
                      const DeformationStep& step) {
  const auto [alpha_m, alpha_f, beta, gamma] = generalised_alpha(settings.rho_infinity);
  const double h = settings.time_step;
  double turned = 0, lent = 0;  // Dd.M Da, and the content of a . M a
  for (std::size_t i = 0; i < system.size(); ++i) {
    const std::size_t v = system.order[i].index();
    const Vec3 way = step.after.displacement[v] - step.before.displacement[v] + step.shift;
    const Vec3& old = step.before.acceleration[v];
    const Vec3& now = step.after.acceleration[v];
    const double mass = system.shape.mass[static_cast<Eigen::Index>(i)];
    turned += mass * way.dot(now - old);
    lent += mass * (0.5 * (now.squaredNorm() - old.squaredNorm()) +
                    (gamma - 0.5) * (now - old).squaredNorm());
  }
  return (0.5 - alpha_f) * (step.stiffness_difference + turned) + h * h * (beta - gamma / 2) * lent;
}

}  // namespace sunder
