// SPDX-License-Identifier: MIT
// Reassembled and prefactored steps of the corotational model.
#include "mechanics/baselines/corotational_euler.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "mechanics/baselines/euler_problem.hpp"
#include "mechanics/element/corotational_force.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/frame/rigid_reference.hpp"
#include "mechanics/integrators/baseline_system.hpp"
#include "mechanics/integrators/model_force.hpp"

namespace sunder {
namespace {

/// Calls `visit(a, b, column, row)` for the blocks of an element, ten or 55, row >= column; rows of
/// held vertices are `none`.
template <class Visit>
void for_each_block(const ReassembledSystem& system, const ComponentStep& step, TetId t,
                    Visit visit) {
  const ElementNodes nodes = nodes_of(step.state.elements, step.input.corners, t);
  const auto row_of = [&](std::size_t a) {
    const std::uint32_t local = step.state.systems.local_row[nodes.row[a].index()];
    return local < system.row.size() ? system.row[local] : ReassembledSystem::none;
  };
  for (std::size_t a = 0; a < nodes.count; ++a) {
    for (std::size_t b = a; b < nodes.count; ++b) {
      const std::uint32_t i = row_of(a), j = row_of(b);
      if (i >= j) {
        visit(a, b, j, i);
      } else {
        visit(b, a, i, j);
      }
    }
  }
}

/// Free vertices that share an element.
VertexGraph free_graph(const ComponentStep& step) {
  const std::size_t n = step.system->free_count;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> links;
  for (TetId t : step.component.tetrahedra) {
    const ElementNodes nodes = nodes_of(step.state.elements, step.input.corners, t);
    for (VertexId a : nodes) {
      for (VertexId b : nodes) {
        const std::uint32_t i = step.state.systems.local_row[a.index()];
        const std::uint32_t j = step.state.systems.local_row[b.index()];
        if (i < n && j < n && i != j) links.emplace_back(i, j);
      }
    }
  }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  VertexGraph graph;
  graph.start.assign(n + 1, 0);
  for (const auto& [i, j] : links) {
    ++graph.start[i + 1];
    graph.neighbour.push_back(j);
  }
  for (std::size_t i = 0; i < n; ++i) graph.start[i + 1] += graph.start[i];
  return graph;
}

/// Order of elimination, rows, and where each element's blocks go.
void make_pattern(ReassembledSystem& system, const ComponentStep& step) {
  const std::size_t n = step.system->free_count;
  const VertexGraph graph = free_graph(step);
  system.analysis = analyse(graph);
  system.row.resize(n);
  system.mass.resize(static_cast<Eigen::Index>(n));
  for (std::uint32_t i = 0; i < n; ++i) {
    system.row[system.analysis.order[i]] = i;
    system.mass[i] = step.system->shape.mass[system.analysis.order[i]];
  }
  BlockMatrix& K = system.matrix;
  K.start.assign(1, 0);
  for (std::uint32_t j = 0; j < n; ++j) {
    const auto begin = static_cast<std::ptrdiff_t>(K.row.size());
    K.row.push_back(j);
    for (std::uint32_t neighbour : graph.of(system.analysis.order[j])) {
      if (system.row[neighbour] > j) K.row.push_back(system.row[neighbour]);
    }
    std::sort(K.row.begin() + begin, K.row.end());
    K.start.push_back(static_cast<std::uint32_t>(K.row.size()));
  }
  K.value.assign(9 * K.row.size(), 0.0);
  system.places.clear();
  for (const TetId t : step.component.tetrahedra) {
    for_each_block(
        system, step, t, [&](std::size_t, std::size_t, std::uint32_t column, std::uint32_t row) {
          system.places.push_back(ReassembledSystem::none);
          if (row == ReassembledSystem::none) return;
          const auto begin = K.row.begin() + K.start[column];
          const auto end = K.row.begin() + K.start[column + 1];
          system.places.back() =
              static_cast<std::uint32_t>(std::lower_bound(begin, end, row) - K.row.begin());
        });
  }
}

/// Gradients of a tetrahedron's nodes at its points, each turned by the rotation at `turn`. A
/// linear one has one point, one of second order four.
struct TurnedGradients {
  std::array<std::array<Vec3, 10>, 4> node;
  std::size_t points;

  TurnedGradients(const ShapeGradient& G, std::size_t nodes, const Mat3* turn, const Mat3& R)
      : points(nodes == 4 ? 1 : 4) {
    for (std::size_t q = 0; q < points; ++q) {
      const ShapeGradient turned = (R.transpose() * turn[q]) * G;
      for (std::size_t a = 0; a < nodes; ++a) {
        node[q][a] = nodes == 4 ? Vec3(turned.col(static_cast<Eigen::Index>(a)))
                                : node_gradient(turned, a, q);
      }
    }
  }
};

/// K with every element turned. K_ab of an isotropic element turns with its gradients.
void assemble(ReassembledSystem& system, const ComponentStep& step, std::span<const Mat3> turn,
              const Mat3& R) {
  const ElementColumns& elements = step.state.elements;
  std::fill(system.matrix.value.begin(), system.matrix.value.end(), 0.0);
  const Mat3* own_turn = turn.data();
  const std::uint32_t* place = system.places.data();
  for (const TetId t : step.component.tetrahedra) {
    const std::size_t nodes = is_second_order(elements, t) ? 10 : 4;
    const TurnedGradients at(elements.shape_gradient[t.index()], nodes, own_turn, R);
    own_turn += at.points;
    const Lame constants = lame(material_of(step.state, t));
    const double volume = elements.rest_volume[t.index()] / static_cast<double>(at.points);
    for_each_block(
        system, step, t, [&](std::size_t a, std::size_t b, std::uint32_t, std::uint32_t) {
          const std::uint32_t to = *place++;
          if (to == ReassembledSystem::none) return;
          for (std::size_t q = 0; q < at.points; ++q) {
            add_stiffness_block(system.matrix.value.data() + 9 * std::size_t{to}, at.node[q][a],
                                at.node[q][b], {volume * constants.lambda, volume * constants.mu});
          }
        });
  }
}

/// Impulse of all forces but weight where the step is linearised, N s, world, into a field of the
/// system. `start`: velocities with the weight's change in them, which a held body resists.
WorldField impulse_of_forces(const ComponentStep& step, std::vector<Mat3>& turn, bool at_start,
                             const WorldField& start) {
  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  const VertexColumns& vertices = step.state.vertices;
  const Component& body = step.component;
  const double h = step.input.settings.time_step;
  for (std::size_t i = 0; i < step.system->size(); ++i) {
    const std::size_t v = step.system->order[i].index();
    predicted.velocity[v] = start.col(static_cast<Eigen::Index>(i));
    predicted.position[v] = vertices.position[v];
    if (!at_start) predicted.position[v] += h * predicted.velocity[v];
  }
  const ElasticInput elastic{step.state, step.input.corners, predicted.position};
  element_rotations(turn, elastic, body);
  std::vector<Vec3>& force = predicted.displacement_acceleration;
  corotational_forces(force, elastic, body);
  // K h v, where the forces are still those of the start.
  std::vector<Vec3>& ahead = predicted.displacement_rate;
  if (at_start) corotational_product(ahead, {elastic, body, turn}, predicted.velocity);
  WorldField impulse(3, static_cast<Eigen::Index>(step.system->size()));
  for (std::size_t i = 0; i < step.system->size(); ++i) {
    const std::size_t v = step.system->order[i].index();
    Vec3 sum = force[v];
    if (at_start) sum -= h * ahead[v];
    if (!step.input.loads.force.empty()) sum += step.input.loads.force[v];
    impulse.col(static_cast<Eigen::Index>(i)) = h * sum;
  }
  return impulse;
}

ReassembledSystem& reassembled_system(const ComponentStep& step) {
  std::unique_ptr<ReassembledSystem>& system = baseline_of(step).reassembled;
  if (!system) {
    system = std::make_unique<ReassembledSystem>();
    make_pattern(*system, step);
  }
  return *system;
}

/// The change of velocities that an impulse gives, world, in place; held vertices get none.
void solve_reassembled(WorldField& impulse, ReassembledSystem& system, const ComponentStep& step,
                       const Mat3& R) {
  const double h = step.input.settings.time_step;
  const std::size_t n = system.row.size();
  factor(system.factor, system.analysis, {system.matrix, system.mass, 1, h * h}, system.scratch);
  system.solution.resize(3 * n);
  Eigen::Map<Eigen::Matrix3Xd> x(system.solution.data(), 3, static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n; ++i) {
    x.col(system.row[i]) = R.transpose() * impulse.col(static_cast<Eigen::Index>(i));
  }
  if (system.factor.positive_definite) {
    solve(system.solution.data(), system.factor, system.analysis);
  } else {
    x.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  impulse.setZero();
  for (std::size_t i = 0; i < n; ++i) {
    impulse.col(static_cast<Eigen::Index>(i)) = R * x.col(system.row[i]);
  }
}

}  // namespace

void step_reassembled_euler(const ComponentStep& step) {
  const Component& body = step.component;
  const bool at_start = body.supported || step.input.settings.euler_frame == EulerFrame::current;
  ReassembledSystem& system = reassembled_system(step);
  std::vector<Mat3>& turn = baseline_of(step).turn;
  EulerProblem problem = euler_problem(step);
  WorldField change = impulse_of_forces(step, turn, at_start, problem.start);

  const Mat3 R = body.orientation.toRotationMatrix();
  assemble(system, step, turn, R);
  solve_reassembled(change, system, step, R);
  WorldField y = problem.start + change;
  SolveReport report;
  report.iterations = 1;
  report.force_evaluations = 1;
  finish_euler(problem, y, report);
}

void step_prefactored_euler(const ComponentStep& step) {
  const IntegratorSettings& settings = step.input.settings;
  EulerProblem problem = euler_problem(step);
  WorldField y = problem.start, F;
  residual(F, problem, y);
  const Mat3 R = predicted_turn(step);
  const double first = F.norm(), target = good_enough(problem, first);
  SolveReport report;
  double last = first;
  while (!(F.norm() <= target)) {
    report.force_evaluations = problem.evaluations;
    // Slower than halving in ten iterations, or growing: parts have turned too far.
    constexpr std::uint32_t patience = 10;
    if (report.iterations % patience == 0 && report.iterations > 0) {
      if (!(F.norm() <= 0.5 * last)) return fall_back(step, report);
      last = F.norm();
    }
    if (report.iterations >= settings.max_iterations) return fall_back(step, report);
    factor_step(F, step, R);
    y += F;
    residual(F, problem, y);
    ++report.iterations;
  }
  report.force_evaluations = problem.evaluations;
  finish_euler(problem, y, report);
}

}  // namespace sunder
