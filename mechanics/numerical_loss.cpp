// SPDX-License-Identifier: MIT
// The loss of generalised-alpha from differences over a step.
#include "mechanics/numerical_loss.hpp"

#include "mechanics/integrators/coefficients.hpp"

namespace sunder {
namespace {

/// sum m x . y.
double inner(const Eigen::VectorXd& mass, const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& y) {
  return x.cwiseProduct(y).colwise().sum().dot(mass.transpose());
}

}  // namespace

double numerical_loss(const ComponentSystem& system, const IntegratorSettings& settings,
                      const DeformationRows& before, const DeformationRows& after) {
  const auto [alpha_m, alpha_f, beta, gamma] = generalised_alpha(settings.rho_infinity);
  const double h = settings.time_step;
  const auto n = static_cast<Eigen::Index>(system.size());
  Eigen::Matrix3Xd moved(3, n), old(3, n), now(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t v = system.order[static_cast<std::size_t>(i)].index();
    moved.col(i) = after.displacement[v] - before.displacement[v];
    old.col(i) = before.acceleration[v];
    now.col(i) = after.acceleration[v];
  }
  Eigen::VectorXd product(3 * n);
  multiply_stiffness(product, system, moved.reshaped());
  const Eigen::VectorXd& mass = system.shape.mass;
  const Eigen::Matrix3Xd change = now - old;
  const double elastic = moved.reshaped().dot(product) + inner(mass, moved, change);
  const double lent = 0.5 * (inner(mass, now, now) - inner(mass, old, old)) +
                      (gamma - 0.5) * inner(mass, change, change);
  return (0.5 - alpha_f) * elastic + h * h * (beta - gamma / 2) * lent;
}

}  // namespace sunder
