// SPDX-License-Identifier: MIT
// Static solves step by step.
#include "mechanics/integrators/quasi_static.hpp"

#include "topology/base/assert.hpp"

namespace sunder {
namespace {

using Field = Eigen::Map<Eigen::Matrix3Xd>;

/// Displacement at the end of the step, system's numbering: held vertices moved on, free ones in
/// equilibrium.
Field equilibrium(const ComponentStep& step, const Field& before) {
  const ComponentSystem& system = *step.system;
  const std::size_t n = system.size();
  const auto free = static_cast<Eigen::Index>(system.free_count);
  const auto held = static_cast<Eigen::Index>(n) - free;
  const Mat3 back = step.component.orientation.toRotationMatrix().transpose();
  Field d = scratch_field(step.scratch, ScratchField::rate, n);
  d.setZero();
  const auto moved_on = [&](Eigen::Index i) -> Vec3 {
    const VertexId v = system.order[static_cast<std::size_t>(i)];
    const Vec3 relative = support_velocity(step.state, v) - step.component.frame_velocity;
    return before.col(i) + step.input.settings.time_step * (back * relative);
  };
  for (Eigen::Index i = free; i < free + held; ++i) d.col(i) = moved_on(i);
  for (const Eigen::Index row : system.held_scalars)
    d(row % 3, row / 3) = moved_on(row / 3)[row % 3];
  Field load = scratch_field(step.scratch, ScratchField::load, n);
  load.setZero();
  add_body_load(load, step, back.transpose());
  Field product = scratch_field(step.scratch, ScratchField::product, n);
  multiply_stiffness(as_vector(product), system, as_vector(d));
  load -= product;
  solve_system(system, as_vector(load).head(3 * free));
  d.leftCols(free) += load.leftCols(free);
  return d;
}

}  // namespace

void step_quasi_static(const ComponentStep& step) {
  SUNDER_ASSERT(step.component.supported, "quasi-static: a free component has no equilibrium");
  const Component& body = step.component;
  const ComponentSystem& system = *step.system;
  const double h = step.input.settings.time_step;
  Field before = scratch_field(step.scratch, ScratchField::displacement, system.size());
  gather(before, system.order, step.state.vertices.displacement);
  const Field d = equilibrium(step, before);

  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  PredictedFrame next;
  next.centre = body.centre + h * body.frame_velocity;
  next.orientation = body.orientation;
  const Mat3 R = body.orientation.toRotationMatrix();
  for (std::size_t i = 0; i < system.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const std::size_t v = system.order[i].index();
    const Vec3 rate = (d.col(column) - before.col(column)) / h;
    predicted.displacement[v] = d.col(column);
    predicted.displacement_rate[v] = rate;
    predicted.displacement_acceleration[v].setZero();
    predicted.position[v] = next.centre + R * (system.shape.arm.col(column) + d.col(column));
    predicted.velocity[v] = body.frame_velocity + R * rate;
    const Vec3 p = system.shape.mass[column] * predicted.velocity[v];
    next.momentum += p;
    next.angular_momentum += (predicted.position[v] - next.centre).cross(p);
  }
  predicted.frame[body.id.index()] = next;
}

}  // namespace sunder
