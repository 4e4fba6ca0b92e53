// SPDX-License-Identifier: MIT
// Newton's method, matrix-free but for the product with K.
#include "mechanics/baselines/newton_cg.hpp"

#include "mechanics/baselines/euler_problem.hpp"
#include "mechanics/element/corotational_force.hpp"
#include "mechanics/frame/mean_axis.hpp"
#include "mechanics/frame/rigid_reference.hpp"
#include "mechanics/integrators/baseline_system.hpp"

namespace sunder {
namespace {

/// The linear system of one Newton step, body frame.
struct Tangent {
  const ComponentStep& step;
  Mat3 R;                    ///< body to world
  Eigen::Matrix3Xd inverse;  ///< of the diagonal blocks, 3 x 3 n

  Eigen::Index free() const { return static_cast<Eigen::Index>(step.system->free_count); }
};

Tangent make_tangent(const ComponentStep& step, const Mat3& R) {
  Tangent tangent{step, R, baseline_of(step).diagonal};
  const double h = step.input.settings.time_step;
  for (Eigen::Index i = 0; i < tangent.free(); ++i) {
    Mat3 block = h * h * tangent.inverse.middleCols<3>(3 * i);
    block.diagonal().array() += step.system->shape.mass[i];
    tangent.inverse.middleCols<3>(3 * i) = block.inverse();
  }
  return tangent;
}

/// K p of the elements' own frames, at the positions that the last residual was taken at.
void corotational_stiffness(Eigen::Matrix3Xd& product, const Tangent& tangent,
                            const Eigen::Matrix3Xd& p) {
  const ComponentStep& step = tangent.step;
  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  std::vector<Vec3>& direction = predicted.displacement;
  std::vector<Vec3>& answer = predicted.displacement_rate;
  const Eigen::Matrix3Xd world = tangent.R * p;
  scatter(direction, step.system->order, world);
  const ElasticInput elastic{step.state, step.input.corners, predicted.position};
  corotational_product(answer, {elastic, step.component, baseline_of(step).turn}, direction);
  gather(product, step.system->order, answer);
  product = (tangent.R.transpose() * product).eval();
}

/// (M + h^2 K) p; held columns of p are zero, and stay so.
void multiply(Eigen::Matrix3Xd& product, const Tangent& tangent, const Eigen::Matrix3Xd& p) {
  const ComponentStep& step = tangent.step;
  const double h = step.input.settings.time_step;
  product.resize(3, p.cols());
  if (step.input.settings.model == ElasticModel::corotational) {
    corotational_stiffness(product, tangent, p);
  } else {
    Eigen::Map<Eigen::VectorXd> out(product.data(), product.size());
    const Eigen::Map<const Eigen::VectorXd> in(p.data(), p.size());
    multiply_stiffness(out, *step.system, in);
  }
  product = h * h * product + p * step.system->shape.mass.asDiagonal();
  product.rightCols(product.cols() - tangent.free()).setZero();
}

void precondition(Eigen::Matrix3Xd& z, const Tangent& tangent, const Eigen::Matrix3Xd& r) {
  z.setZero(3, r.cols());
  for (Eigen::Index i = 0; i < tangent.free(); ++i) {
    z.col(i) = tangent.inverse.middleCols<3>(3 * i) * r.col(i);
  }
}

/// s with (M + h^2 K) s = r to |residual| <= target; r is used up. Gives the iterations, at most
/// `most`.
std::uint32_t conjugate_gradients(Eigen::Matrix3Xd& s, const Tangent& tangent, Eigen::Matrix3Xd& r,
                                  double target, std::uint32_t most) {
  s.setZero(3, r.cols());
  Eigen::Matrix3Xd z, product;
  precondition(z, tangent, r);
  Eigen::Matrix3Xd p = z;
  double rz = r.cwiseProduct(z).sum();
  std::uint32_t count = 0;
  while (!(r.norm() <= target) && count < most && std::isfinite(rz)) {
    multiply(product, tangent, p);
    const double length = rz / p.cwiseProduct(product).sum();
    s += length * p;
    r -= length * product;
    precondition(z, tangent, r);
    const double next = r.cwiseProduct(z).sum();
    p = z + (next / rz) * p;
    rz = next;
    ++count;
  }
  return count;
}

/// One Newton step for the residual F (world): F becomes the change of y. Rigid fields r have
/// A r = M r, so they are answered apart.
std::uint32_t newton_step(WorldField& F, const Tangent& tangent, double target,
                          std::uint32_t most) {
  const ComponentStep& step = tangent.step;
  Eigen::Matrix3Xd r = -(tangent.R.transpose() * F), s;
  RigidField rigid;
  if (!step.component.supported) rigid = project_load(r, step.system->shape);
  const std::uint32_t count = conjugate_gradients(s, tangent, r, target, most);
  if (!step.component.supported) {
    project_acceleration(s, step.system->shape);
    for (Eigen::Index i = 0; i < s.cols(); ++i) {
      s.col(i) += rigid.translation + rigid.rotation.cross(Vec3(step.system->shape.arm.col(i)));
    }
  }
  F = tangent.R * s;
  return count;
}

}  // namespace

void step_newton_cg(const ComponentStep& step) {
  constexpr int most_systems = 20;
  const IntegratorSettings& settings = step.input.settings;
  EulerProblem problem = euler_problem(step);
  WorldField y = problem.start, F;
  residual(F, problem, y);
  const double target = good_enough(problem, F.norm());
  SolveReport report;
  for (int k = 0; !(F.norm() <= target); ++k) {
    report.force_evaluations = problem.evaluations;
    const bool going = std::isfinite(F.norm()) && k < most_systems;
    if (!going || report.iterations >= settings.max_iterations) return fall_back(step, report);
    const std::vector<Vec3>& position = step.scratch.predicted.position;
    if (settings.model == ElasticModel::corotational) {
      const ElasticInput elastic{step.state, step.input.corners, position};
      element_rotations(baseline_of(step).turn, elastic, step.component);
    }
    const Tangent tangent = make_tangent(step, predicted_turn(step));
    report.iterations +=
        newton_step(F, tangent, 0.5 * target, settings.max_iterations - report.iterations);
    y += F;
    residual(F, problem, y);
  }
  report.force_evaluations = problem.evaluations;
  if (!is_nearest_root(problem, y)) return fall_back(step, report);
  finish_euler(problem, y, report);
}

}  // namespace sunder
