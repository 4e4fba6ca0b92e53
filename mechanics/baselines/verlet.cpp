// SPDX-License-Identifier: MIT
// Explicit steps and the step size they stand.
#include "mechanics/baselines/verlet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/element/corotational_force.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/integrators/model_force.hpp"
#include "mechanics/integrators/rigid_motion.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "topology/base/whole_number.hpp"

namespace sunder {
namespace {

/// Half a step h of acceleration for free vertices, from the forces at `predicted.position`. Gives
/// the energy taken by the damping, exactly, J.
double kick(const ComponentStep& step, const Pose& support, double h) {
  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  // These columns are free until the end of the step and hold forces meanwhile.
  std::vector<Vec3>& force = predicted.displacement_acceleration;
  std::vector<Vec3>& viscous = predicted.displacement_rate;
  model_forces(force, step, predicted.position, support);
  const double factor = step.input.settings.damping.stiffness_factor;
  if (factor > 0) {
    const ElasticInput input{step.state, step.input.corners, predicted.position};
    viscous_forces(viscous, input, predicted.velocity, step.component, factor);
  }
  const Loads& loads = step.input.loads;
  const VertexColumns& vertices = step.state.vertices;
  double taken = 0;
  for (VertexId v : step.component.vertices) {
    Vec3& velocity = predicted.velocity[v.index()];
    const Vec3 before = velocity;
    if (vertices.support[v.index()].is_none()) {
      Vec3 acceleration = loads.gravity + force[v.index()] / vertices.mass[v.index()];
      if (!loads.force.empty()) acceleration += loads.force[v.index()] / vertices.mass[v.index()];
      if (factor > 0) acceleration += viscous[v.index()] / vertices.mass[v.index()];
      velocity += 0.5 * h * acceleration;
    }
    if (factor > 0) taken -= 0.25 * h * viscous[v.index()].dot(before + velocity);
  }
  return taken;
}

/// The longest stable step of one element, s.
double element_bound(const MechanicsState& state, std::size_t t) {
  const ElementColumns& elements = state.elements;
  const Lame constants = lame(material_of(state, TetId{t}));
  const std::size_t count = is_second_order(elements, TetId{t}) ? 10 : 4;
  const auto scale = [&](std::size_t a) {
    return 1 / std::sqrt(node_share(count, a) * elements.mass[t]);
  };
  // Square roots of masses on both sides make a symmetric problem of K x = w^2 M x.
  Eigen::MatrixXd K(3 * count, 3 * count);
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < count; ++b) {
      K.block<3, 3>(static_cast<Eigen::Index>(3 * b), static_cast<Eigen::Index>(3 * a)) =
          scale(a) * scale(b) *
          node_block(elements.shape_gradient[t], elements.rest_volume[t], constants, count, b, a);
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver =
      symmetric_eigen(K, Eigen::EigenvaluesOnly);
  const double highest = solver.eigenvalues().tail<1>()[0];
  return highest > 0 ? 2 / std::sqrt(highest) : std::numeric_limits<double>::infinity();
}

}  // namespace

void step_verlet(const ComponentStep& step, std::uint32_t count) {
  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  const Component& body = step.component;
  const VertexColumns& vertices = step.state.vertices;
  const double h = step.input.settings.time_step / count;

  for (VertexId v : body.vertices) {
    predicted.velocity[v.index()] = vertices.velocity[v.index()];
    predicted.position[v.index()] = vertices.position[v.index()];
  }
  Pose support{body.centre, body.orientation};
  double damping_work = kick(step, support, h);
  for (std::uint32_t k = 1; k <= count; ++k) {
    for (VertexId v : body.vertices) {
      predicted.position[v.index()] += h * predicted.velocity[v.index()];
    }
    support.centre = body.centre + k * h * body.frame_velocity;
    // Two halves in one between sub-steps.
    damping_work += kick(step, support, k < count ? 2 * h : h);
  }
  fit_prediction(step);
  predicted.frame[body.id.index()].damping_work = damping_work;
}

std::uint32_t sub_step_count(double length, double bound) {
  constexpr double share = 0.9;
  const double count = std::ceil(length / (share * bound));
  return whole_number<std::uint32_t>(std::max(1.0, count));
}

double damped_step_bound(double bound, double stiffness_factor) {
  // Written so that nothing cancels where the damping is strong.
  return std::isinf(bound) ? bound
                           : bound * bound /
                                 (std::sqrt(bound * bound + stiffness_factor * stiffness_factor) +
                                  stiffness_factor);
}

double component_step_bound(MechanicsScratch& scratch, const MechanicsState& state,
                            const Component& component, const RayleighDamping& damping) {
  std::vector<double>& bounds = scratch.element_step_bound;
  for (std::size_t t = bounds.size(); t < state.elements.size(); ++t) {
    bounds.push_back(element_bound(state, t));
  }
  double least = std::numeric_limits<double>::infinity();
  for (TetId t : component.tetrahedra) least = std::min(least, bounds[t.index()]);
  return damped_step_bound(least, damping.stiffness_factor);
}

void step_sub_stepped(const ComponentStep& step) {
  const IntegratorSettings& settings = step.input.settings;
  const double bound =
      component_step_bound(step.scratch, step.state, step.component, settings.damping);
  const std::uint32_t count = sub_step_count(settings.time_step, bound);
  if (count > settings.max_sub_steps) {
    keep_still(step);
  } else {
    step_verlet(step, count);
  }
  SolveReport& report = step.scratch.predicted.frame[step.component.id.index()].solve;
  report.sub_steps = count;
  report.force_evaluations = count + 1;
}

double explicit_step_bound(const MechanicsState& state) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < state.elements.size(); ++t) {
    least = std::min(least, element_bound(state, t));
  }
  return least;
}

}  // namespace sunder
