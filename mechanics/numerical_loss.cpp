// SPDX-License-Identifier: MIT
// The loss of generalised-alpha from differences over a step.
#include "mechanics/numerical_loss.hpp"

#include "mechanics/integrators/coefficients.hpp"

namespace sunder {

double numerical_loss(std::vector<double>& work, const ComponentSystem& system,
                      const IntegratorSettings& settings, const DeformationRows& before,
                      const DeformationRows& after) {
  const auto [alpha_m, alpha_f, beta, gamma] = generalised_alpha(settings.rho_infinity);
  const double h = settings.time_step;
  const auto n = static_cast<Eigen::Index>(system.size());
  if (work.size() < 3 * system.size()) work.resize(3 * system.size());
  Eigen::Map<Eigen::VectorXd> moved(work.data(), 3 * n);
  double turned = 0, lent = 0;  // Dd.M Da, and what a . M a holds
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t v = system.order[static_cast<std::size_t>(i)].index();
    const Vec3 way = after.displacement[v] - before.displacement[v];
    const Vec3& old = before.acceleration[v];
    const Vec3& now = after.acceleration[v];
    moved.segment<3>(3 * i) = way;
    const double mass = system.shape.mass[i];
    turned += mass * way.dot(now - old);
    lent += mass * (0.5 * (now.squaredNorm() - old.squaredNorm()) +
                    (gamma - 0.5) * (now - old).squaredNorm());
  }
  return (0.5 - alpha_f) * (quadratic_form(system.stiffness, work.data()) + turned) +
         h * h * (beta - gamma / 2) * lent;
}

}  // namespace sunder
