// SPDX-License-Identifier: MIT
// Forces by model, and the frame that positions and velocities lead to.
#include "mechanics/integrators/model_force.hpp"

#include "mechanics/element/corotational_force.hpp"
#include "mechanics/element/elastic_force.hpp"
#include "mechanics/frame/fit_motion.hpp"

namespace sunder {

void model_forces(std::span<Vec3> force, const ComponentStep& step, std::span<const Vec3> positions,
                  const Pose& support) {
  const IntegratorSettings& settings = step.input.settings;
  const ElasticInput elastic{step.state, step.input.corners, positions, settings.elastic_force};
  if (settings.model == ElasticModel::corotational) {
    corotational_forces(force, elastic, step.component);
    return;
  }
  const ElasticOutput out{step.scratch.predicted.displacement, force};
  if (step.component.supported) {
    deformation_forces_in(support, out, elastic, step.component);
  } else {
    deformation_forces(out, elastic, step.component);
  }
}

Pose support_at_end(const ComponentStep& step) {
  const Component& body = step.component;
  return {body.centre + step.input.settings.time_step * body.frame_velocity, body.orientation};
}

void fit_prediction(const ComponentStep& step) {
  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  const Component& body = step.component;
  const MotionInput motion{step.state.vertices, predicted.position, predicted.velocity};
  const DeformationOutput out{predicted.displacement, predicted.displacement_rate};
  const FittedMotion fitted = body.supported
                                  ? express_motion(out, motion, body, support_at_end(step))
                                  : fit_motion(out, motion, body);
  for (VertexId v : body.vertices) predicted.displacement_acceleration[v.index()].setZero();
  predicted.frame[body.id.index()] = {fitted.frame.centre,
                                      fitted.frame.orientation,
                                      fitted.momentum,
                                      fitted.angular_momentum,
                                      0,
                                      {}};
}

}  // namespace sunder
