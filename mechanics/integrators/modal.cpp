// SPDX-License-Identifier: MIT
// The dense eigenproblem of a component, and exact oscillators.
#include "mechanics/integrators/modal.hpp"

#include <cmath>

#include "mechanics/integrators/baseline_system.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "topology/base/assert.hpp"
#include "topology/base/elementary.hpp"

namespace sunder {
namespace {

/// One factor a dof: the masses of free vertices, each three times, to the power 1 or -1/2.
Eigen::VectorXd dof_masses(const ComponentSystem& system) {
  Eigen::VectorXd mass(static_cast<Eigen::Index>(3 * system.free_count));
  for (Eigen::Index i = 0; i < mass.size(); ++i) mass[i] = system.shape.mass[i / 3];
  return mass;
}

void make_basis(ModalBasis& basis, const ComponentStep& step) {
  const ComponentSystem& system = *step.system;
  SUNDER_ASSERT(system.size() <= modal_vertex_limit, "modal: too many vertices");
  if (system.free_count == 0) return;  // all held: no mode, and no eigenproblem of no row
  const Eigen::VectorXd scale = dof_masses(system).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd A = leading_scalars(system.stiffness, system.free_count);
  A = scale.asDiagonal() * A * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver = symmetric_eigen(A);
  const Eigen::Index rigid = step.component.supported ? 0 : 6;
  const Eigen::Index count = A.cols() - rigid;
  basis.frequency = solver.eigenvalues().tail(count).cwiseMax(0).cwiseSqrt();
  basis.shape = scale.asDiagonal() * solver.eigenvectors().rightCols(count);
}

/// Leading columns of a field as one long vector.
Eigen::VectorXd free_dofs(const ComponentStep& step, ConstLocalField field) {
  return field.leftCols(static_cast<Eigen::Index>(step.system->free_count)).reshaped();
}

/// S^T M u of free vertices.
Eigen::VectorXd coordinates(const ModalBasis& basis, const ComponentStep& step,
                            ConstLocalField field) {
  return basis.shape.transpose() * dof_masses(*step.system).cwiseProduct(free_dofs(step, field));
}

/// Forces on free vertices, including those of held ones in the middle of the step.
Eigen::VectorXd force_on_free(const ComponentStep& step, const ModalDeformation& d,
                              ConstLocalField load) {
  const auto free = static_cast<Eigen::Index>(step.system->free_count);
  const Eigen::Index held = d.displacement.cols() - free;
  Eigen::VectorXd force = free_dofs(step, load);
  if (held == 0) return force;
  Eigen::Matrix3Xd moved = Eigen::Matrix3Xd::Zero(3, d.displacement.cols());
  moved.rightCols(held) =
      d.displacement.rightCols(held) + 0.5 * step.input.settings.time_step * d.rate.rightCols(held);
  Eigen::VectorXd product(moved.size());
  multiply_stiffness(product, *step.system, moved.reshaped());
  return force - product.head(3 * free);
}

/// sin(wh) / w and (1 - cos wh) / w^2, right where w is 0 too.
struct Oscillator {
  double cosine, sine, sine_over, versine_over;
  Oscillator(double w, double h) : cosine(sunder::cosine(w * h)), sine(sunder::sine(w * h)) {
    const double half = sunder::sine(0.5 * w * h);
    sine_over = w > 0 ? sine / w : h;
    versine_over = w > 0 ? 2 * half * half / (w * w) : 0.5 * h * h;
  }
};

}  // namespace

const ModalBasis& modal_basis(const ComponentStep& step) {
  std::unique_ptr<ModalBasis>& basis = baseline_of(step).modal;
  if (!basis) {
    basis = std::make_unique<ModalBasis>();
    make_basis(*basis, step);
  }
  return *basis;
}

void advance_modes(const ComponentStep& step, const ModalDeformation& d, ConstLocalField load) {
  const ModalBasis& basis = modal_basis(step);
  const double h = step.input.settings.time_step;
  Eigen::VectorXd q = coordinates(basis, step, d.displacement);
  Eigen::VectorXd rate = coordinates(basis, step, d.rate);
  const Eigen::VectorXd p = basis.shape.transpose() * force_on_free(step, d, load);
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double w = basis.frequency[k];
    const Oscillator o(w, h);
    const double next = o.cosine * q[k] + o.sine_over * rate[k] + o.versine_over * p[k];
    rate[k] = o.cosine * rate[k] - w * o.sine * q[k] + o.sine_over * p[k];
    q[k] = next;
  }
  const auto free = static_cast<Eigen::Index>(step.system->free_count);
  LocalField displacement = d.displacement, velocity = d.rate;
  displacement.leftCols(free) = (basis.shape * q).reshaped(3, free);
  velocity.leftCols(free) = (basis.shape * rate).reshaped(3, free);
}

void mean_modal_rate(LocalField rate, const ComponentStep& step, const ModalDeformation& d) {
  const ModalBasis& basis = modal_basis(step);
  const double h = step.input.settings.time_step;
  const Eigen::VectorXd q = coordinates(basis, step, d.displacement);
  Eigen::VectorXd mean = coordinates(basis, step, d.rate);
  for (Eigen::Index k = 0; k < mean.size(); ++k) {
    const double w = basis.frequency[k];
    const Oscillator o(w, h);
    mean[k] = (o.sine_over * mean[k] - w * w * o.versine_over * q[k]) / h;
  }
  const auto free = static_cast<Eigen::Index>(step.system->free_count);
  rate.leftCols(free) = (basis.shape * mean).reshaped(3, free);
  rate.rightCols(rate.cols() - free) = d.rate.rightCols(rate.cols() - free);
}

Eigen::MatrixXd modal_response(const ComponentStep& step, std::span<const std::uint32_t> vertices) {
  const ModalBasis& basis = modal_basis(step);
  const double h = step.input.settings.time_step;
  Eigen::MatrixXd shape(static_cast<Eigen::Index>(3 * vertices.size()), basis.shape.cols());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    shape.middleRows<3>(static_cast<Eigen::Index>(3 * i)) =
        basis.shape.middleRows<3>(3 * static_cast<Eigen::Index>(vertices[i]));
  }
  Eigen::VectorXd weight(basis.frequency.size());
  for (Eigen::Index k = 0; k < weight.size(); ++k) {
    weight[k] = Oscillator(basis.frequency[k], h).versine_over / h;
  }
  return shape * weight.asDiagonal() * shape.transpose();
}

}  // namespace sunder
