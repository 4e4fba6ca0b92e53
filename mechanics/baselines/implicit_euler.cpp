// SPDX-License-Identifier: MIT
// Linearised implicit Euler on the constant factor.
#include "mechanics/baselines/implicit_euler.hpp"

#include "mechanics/frame/rigid_reference.hpp"
#include "mechanics/integrators/model_force.hpp"

namespace sunder {
namespace {

using Field = Eigen::Map<Eigen::Matrix3Xd>;

/// The frame the step is linearised in.
Pose linearisation_frame(const ComponentStep& step) {
  const Component& body = step.component;
  const VertexColumns& vertices = step.state.vertices;
  if (body.supported || step.input.settings.euler_frame == EulerFrame::current) {
    return {body.centre, body.orientation};
  }
  // The rows of `predicted` are free until the end of the step.
  std::vector<Vec3>& ahead = step.scratch.predicted.position;
  for (VertexId v : body.vertices) {
    ahead[v.index()] =
        vertices.position[v.index()] + step.input.settings.time_step * vertices.velocity[v.index()];
  }
  return rigid_reference(body, vertices, ahead);
}

/// Right side: impulse of outer, elastic and damping forces in the body frame, N s.
Field impulse_of_forces(const ComponentStep& step, const Pose& frame, const Field& rate) {
  const IntegratorSettings& settings = step.input.settings;
  const auto [a, b] = settings.damping;
  const double h = settings.time_step;
  const ComponentSystem& system = *step.system;
  // In the frame of x_n the implicit h v is still to be added to d; in the predicted one it is in.
  const bool at_start = step.component.supported || settings.euler_frame == EulerFrame::current;
  const Mat3 R = frame.orientation.toRotationMatrix();

  Field deforming = scratch_field(step.scratch, ScratchField::displacement, system.size());
  deforming = rate;
  if (!step.component.supported) project_acceleration(deforming, system.shape);
  // K takes the displacement and the damped rate in one product.
  Field argument = scratch_field(step.scratch, ScratchField::argument, system.size());
  for (std::size_t i = 0; i < system.size(); ++i) {
    const std::size_t v = system.order[i].index();
    const auto column = static_cast<Eigen::Index>(i);
    Vec3 x = step.state.vertices.position[v];
    if (!at_start) x += h * step.state.vertices.velocity[v];
    argument.col(column) = R.transpose() * (x - frame.centre) - system.shape.arm.col(column);
  }
  argument += (b + (at_start ? h : 0)) * deforming;
  Field elastic = scratch_field(step.scratch, ScratchField::product, system.size());
  multiply_stiffness(as_vector(elastic), system, as_vector(argument));

  Field load = scratch_field(step.scratch, ScratchField::load, system.size());
  load.setZero();
  add_body_load(load, step, R);
  load = h * (load - elastic - a * (deforming * system.shape.mass.asDiagonal()));
  return load;
}

}  // namespace

void step_implicit_euler(const ComponentStep& step) {
  const ComponentSystem& system = *step.system;
  const IntegratorSettings& settings = step.input.settings;
  const Pose frame = linearisation_frame(step);
  const Mat3 R = frame.orientation.toRotationMatrix();

  Field rate = scratch_field(step.scratch, ScratchField::rate, system.size());
  gather(rate, system.order, step.state.vertices.velocity);
  rate = (R.transpose() * (rate.colwise() - step.component.frame_velocity)).eval();

  // Rigid accelerations are exact and undamped; A answers the rest.
  Field change = impulse_of_forces(step, frame, rate);
  RigidField rigid;
  if (!step.component.supported) rigid = project_load(change, system.shape);
  solve_system(system, as_vector(change).head(3 * system.free_count));
  change.rightCols(static_cast<Eigen::Index>(system.size() - system.free_count)).setZero();
  if (!step.component.supported) {
    for (Eigen::Index i = 0; i < change.cols(); ++i) {
      change.col(i) += rigid.translation + rigid.rotation.cross(Vec3(system.shape.arm.col(i)));
    }
  }

  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  const Vec3 shift = parabola_shift(step);
  for (std::size_t i = 0; i < system.size(); ++i) {
    const std::size_t v = system.order[i].index();
    predicted.velocity[v] =
        step.state.vertices.velocity[v] + R * change.col(static_cast<Eigen::Index>(i));
    predicted.position[v] =
        step.state.vertices.position[v] + settings.time_step * predicted.velocity[v] - shift;
  }
  fit_prediction(step);
}

}  // namespace sunder
