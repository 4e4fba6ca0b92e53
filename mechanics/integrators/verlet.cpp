// SPDX-License-Identifier: MIT
// Explicit steps and the step size they stand.
#include "mechanics/integrators/verlet.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "mechanics/elastic_force.hpp"
#include "mechanics/fit_motion.hpp"
#include "mechanics/strain_displacement.hpp"

namespace sunder {
namespace {

/// Half a step of acceleration for free vertices, from the forces at `position`.
void kick(const ComponentStep& step, std::span<const Vec3> position, const RigidFrame& support) {
  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  const Component& body = step.component;
  const ElasticInput elastic{step.state, step.input.corners, position};
  // The acceleration column is free until the end of the step and holds the forces meanwhile.
  std::vector<Vec3>& force = predicted.displacement_acceleration;
  const ElasticOutput out{predicted.displacement, force};
  if (body.supported) {
    deformation_forces_in(support, out, elastic, body);
  } else {
    deformation_forces(out, elastic, body);
  }
  const Loads& loads = step.input.loads;
  const VertexColumns& vertices = step.state.vertices;
  for (VertexId v : body.vertices) {
    if (!vertices.support[v.index()].is_none()) continue;
    Vec3 acceleration = loads.gravity + force[v.index()] / vertices.mass[v.index()];
    if (!loads.force.empty()) acceleration += loads.force[v.index()] / vertices.mass[v.index()];
    predicted.velocity[v.index()] += 0.5 * step.input.settings.time_step * acceleration;
  }
}

}  // namespace

void step_verlet(const ComponentStep& step) {
  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  const Component& body = step.component;
  const VertexColumns& vertices = step.state.vertices;
  const double h = step.input.settings.time_step;
  const RigidFrame before{body.centre, body.orientation};
  const RigidFrame after{body.centre + h * body.frame_velocity, body.orientation};

  for (VertexId v : body.vertices) predicted.velocity[v.index()] = vertices.velocity[v.index()];
  kick(step, vertices.position, before);
  for (VertexId v : body.vertices) {
    predicted.position[v.index()] =
        vertices.position[v.index()] + h * predicted.velocity[v.index()];
  }
  kick(step, predicted.position, after);

  const MotionInput motion{vertices, predicted.position, predicted.velocity};
  const DeformationOutput out{predicted.displacement, predicted.displacement_rate};
  const FittedMotion fitted =
      body.supported ? express_motion(out, motion, body, after) : fit_motion(out, motion, body);
  for (VertexId v : body.vertices) predicted.displacement_acceleration[v.index()].setZero();
  predicted.frame[body.id.index()] = {fitted.frame.centre, fitted.frame.orientation,
                                      fitted.momentum, fitted.angular_momentum, 0};
}

double explicit_step_bound(const MechanicsState& state) {
  const ElementColumns& elements = state.elements;
  double highest = 0;
  for (std::size_t t = 0; t < elements.size(); ++t) {
    const Lame constants = lame(state.materials[elements.material[t].index()]);
    const ElementStiffness K =
        element_stiffness(elements.shape_gradient[t], elements.rest_volume[t], constants);
    const Eigen::SelfAdjointEigenSolver<ElementStiffness> solver(K, Eigen::EigenvaluesOnly);
    highest = std::max(highest, solver.eigenvalues()[11] / (elements.mass[t] / 4));
  }
  return highest > 0 ? 2 / std::sqrt(highest) : std::numeric_limits<double>::infinity();
}

}  // namespace sunder
