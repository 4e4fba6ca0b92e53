// SPDX-License-Identifier: MIT
// Residual, factor and end of an implicit Euler step.
#include "mechanics/baselines/euler_problem.hpp"

#include <limits>

#include "mechanics/baselines/corotational_euler.hpp"
#include "mechanics/baselines/implicit_euler.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/integrators/baseline_system.hpp"
#include "mechanics/integrators/modal.hpp"
#include "mechanics/integrators/model_force.hpp"

namespace sunder {
namespace {

/// K_ii of every vertex, once.
void make_diagonal(const ComponentStep& step) {
  Eigen::Matrix3Xd& diagonal = baseline_of(step).diagonal;
  if (diagonal.cols() > 0) return;
  diagonal = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(3 * step.system->size()));
  const ElementColumns& elements = step.state.elements;
  for (TetId t : step.component.tetrahedra) {
    const ShapeGradient& G = elements.shape_gradient[t.index()];
    const Lame constants = lame(material_of(step.state, t));
    const ElementNodes nodes = nodes_of(elements, step.input.corners, t);
    for (std::size_t a = 0; a < nodes.count; ++a) {
      const std::size_t v = nodes.row[a].index();
      diagonal.middleCols<3>(3 * step.state.systems.local_row[v]) +=
          node_block(G, elements.rest_volume[t.index()], constants, nodes.count, a, a);
    }
  }
}

/// Rounding of positions and displacements, felt through the stiffness.
double rounding_of_impulses(const ComponentStep& step) {
  make_diagonal(step);
  const Eigen::Matrix3Xd& diagonal = baseline_of(step).diagonal;
  double sum = 0;
  for (std::size_t i = 0; i < step.system->size(); ++i) {
    const double reach = step.state.vertices.position[step.system->order[i].index()].norm() +
                         step.component.rest_radius;
    const double stiffness = diagonal.middleCols<3>(static_cast<Eigen::Index>(3 * i)).norm();
    sum += stiffness * stiffness * reach * reach;
  }
  return 4 * std::numeric_limits<double>::epsilon() * step.input.settings.time_step *
         std::sqrt(sum);
}

}  // namespace

BaselineSystem::BaselineSystem() = default;
BaselineSystem::~BaselineSystem() = default;

BaselineSystem& baseline_of(const ComponentStep& step) {
  auto& rows = step.scratch.baselines;
  rows.resize(std::max(rows.size(), step.state.components.size()));
  std::unique_ptr<BaselineSystem>& row = rows[step.component.id.index()];
  if (!row) row = std::make_unique<BaselineSystem>();
  return *row;
}

EulerProblem euler_problem(const ComponentStep& step) {
  EulerProblem problem{step, {}, rounding_of_impulses(step)};
  const VertexColumns& vertices = step.state.vertices;
  const Vec3 fall = step.input.settings.time_step * step.input.loads.gravity;
  problem.start.resize(3, static_cast<Eigen::Index>(step.system->size()));
  for (std::size_t i = 0; i < step.system->size(); ++i) {
    const VertexId v = step.system->order[i];
    const bool held = i >= step.system->free_count;
    problem.start.col(static_cast<Eigen::Index>(i)) =
        held ? support_velocity(step.state, v) : Vec3(vertices.velocity[v.index()] + fall);
  }
  return problem;
}

void residual(WorldField& F, EulerProblem& problem, const WorldField& y) {
  const ComponentStep& step = problem.step;
  const ComponentSystem& system = *step.system;
  const double h = step.input.settings.time_step;
  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  for (std::size_t i = 0; i < system.size(); ++i) {
    const std::size_t v = system.order[i].index();
    predicted.position[v] =
        step.state.vertices.position[v] + h * y.col(static_cast<Eigen::Index>(i));
  }
  // The acceleration column is free until the end of the step and holds the forces meanwhile.
  std::vector<Vec3>& force = predicted.displacement_acceleration;
  model_forces(force, step, predicted.position, support_at_end(step));
  ++problem.evaluations;
  const std::vector<Vec3>& load = step.input.loads.force;
  F.resize(3, y.cols());
  for (std::size_t i = 0; i < system.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const std::size_t v = system.order[i].index();
    if (i >= system.free_count) {
      F.col(column).setZero();
      continue;
    }
    F.col(column) =
        system.shape.mass[column] * (y.col(column) - problem.start.col(column)) - h * force[v];
    if (!load.empty()) F.col(column) -= h * load[v];
  }
}

void factor_step(WorldField& F, const ComponentStep& step, const Mat3& R) {
  const auto free = static_cast<Eigen::Index>(3 * step.system->free_count);
  F = (R.transpose() * F).eval();
  Eigen::Map<Eigen::VectorXd> body(F.data(), F.size());
  solve_system(*step.system, body.head(free));
  F = (-R * F).eval();
}

double good_enough(const EulerProblem& problem, double first) {
  return std::max(problem.step.input.settings.tolerance * first, problem.floor);
}

bool is_nearest_root(const EulerProblem& problem, const WorldField& y) {
  const ComponentStep& step = problem.step;
  if (step.component.supported) return true;
  const ComponentSystem& system = *step.system;
  const double h = step.input.settings.time_step;
  WorldField ahead(3, y.cols());
  for (std::size_t i = 0; i < system.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    ahead.col(column) = step.state.vertices.position[system.order[i].index()];
  }
  const WorldField end = ahead + h * y;
  ahead += h * problem.start;
  const Vec3 centre = ahead * system.shape.mass / system.shape.total_mass;
  ahead.colwise() -= centre;
  const Mat3 S = end * system.shape.mass.asDiagonal() * ahead.transpose();
  const Mat3 stiffness = S.trace() * Mat3::Identity() - 0.5 * (S + S.transpose());
  return Eigen::LLT<Mat3>(stiffness).info() == Eigen::Success;
}

void finish_euler(const EulerProblem& problem, WorldField& y, const SolveReport& report) {
  const ComponentStep& step = problem.step;
  const ComponentSystem& system = *step.system;
  const double h = step.input.settings.time_step;
  if (!step.component.supported) {
    Vec3 wanted = problem.start * system.shape.mass;
    for (const VertexId v : system.order) {
      if (!step.input.loads.force.empty()) wanted += h * step.input.loads.force[v.index()];
    }
    y.colwise() += Vec3((wanted - y * system.shape.mass) / system.shape.total_mass);
  }
  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  const Vec3 shift = parabola_shift(step);
  for (std::size_t i = 0; i < system.size(); ++i) {
    const std::size_t v = system.order[i].index();
    predicted.velocity[v] = y.col(static_cast<Eigen::Index>(i));
    predicted.position[v] = step.state.vertices.position[v] + h * predicted.velocity[v] - shift;
  }
  fit_prediction(step);
  predicted.frame[step.component.id.index()].solve = report;
}

Mat3 predicted_turn(const ComponentStep& step) {
  const Component& body = step.component;
  if (body.supported) return body.orientation.toRotationMatrix();
  return rigid_reference(body, step.state.vertices, step.scratch.predicted.position)
      .orientation.toRotationMatrix();
}

void fall_back(const ComponentStep& step, SolveReport report) {
  ComponentStep by_factor = step;
  report.not_converged = 1;
  if (step.input.settings.model == ElasticModel::corotational) {
    step_reassembled_euler(by_factor);
  } else {
    by_factor.system = &prepared_system(step.state, step.input, step.component);
    step_implicit_euler(by_factor);
  }
  step.scratch.predicted.frame[step.component.id.index()].solve = report;
}

}  // namespace sunder
