// SPDX-License-Identifier: MIT
// The fall of potential energy through a border of copies that exists for the question only.
#include "fracture/energy/energy_release.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "mechanics/element/second_order.hpp"
#include "mechanics/integrators/component_step.hpp"
#include "mechanics/integrators/quasi_static.hpp"
#include "mechanics/state/dense_solve.hpp"

namespace sunder {
namespace {

using Eigen::Index;
constexpr std::uint32_t no_row = Supernode::none;

/// Rows that loads have for a tetrahedron.
std::size_t most_nodes(const ElementColumns& elements) {
  return elements.edge_nodes.empty() ? 4 : 10;
}

/// A tetrahedron's nodes and which of them one is.
std::pair<ElementNodes, std::size_t> node_in(const ReleaseInput& input, TetId t, VertexId node) {
  const ElementNodes nodes = nodes_of(input.mechanics.elements, input.cells.map.corners(), t);
  return {nodes, static_cast<std::size_t>(std::ranges::find(nodes, node) - nodes.begin())};
}

/// Copies that splitting would make, as rows of a border behind those of the system.
struct Trial {
  const ReleaseInput& input;
  const ComponentSystem& system;
  std::span<const std::uint32_t> local_row;
  std::span<const PartedVertex> parted;
  FactorBorder border;
  std::size_t first = 0;    ///< of its columns that are new
  Eigen::VectorXd missing;  ///< 3 a new copy, N, body frame: the load less the force of its side

  std::uint32_t extended_row(VertexId v) const {
    const std::uint32_t local = local_row[v.index()];
    if (local >= system.free_count) return no_row;
    return system.factor_row.empty() ? local : system.factor_row[local];
  }
};

/// Row of a corner once the faces are split; no_row where it is held.
std::uint32_t row_after(const Trial& trial, TetId t, VertexId v) {
  const std::uint32_t own = trial.extended_row(v);
  if (own == no_row) return no_row;
  std::size_t copy = trial.border.base + trial.first;
  for (const PartedVertex& p : trial.parted) {
    if (trial.extended_row(p.vertex) == no_row) continue;
    if (p.vertex != v) {
      copy += p.sides.size() - 1;
      continue;
    }
    for (std::size_t s = 1; s < p.sides.size(); ++s, ++copy) {
      if (std::binary_search(p.sides[s].begin(), p.sides[s].end(), t)) {
        return static_cast<std::uint32_t>(copy);
      }
    }
    break;
  }
  return own;
}

/// One column of K, of the copy that has the tetrahedra `side` of `vertex`.
void fill_column(Trial& trial, FactorBorder::Column& column, VertexId vertex,
                 std::span<const TetId> side) {
  const MechanicsState& m = trial.input.mechanics;
  for (const TetId t : side) {
    const auto [nodes, own] = node_in(trial.input, t, vertex);
    const Lame constants = lame(material_of(m, t));
    for (std::size_t b = 0; b < nodes.count; ++b) {
      const std::uint32_t row = row_after(trial, t, nodes.row[b]);
      if (row == no_row) continue;
      add_block(trial.border, column, row,
                node_block(m.elements.shape_gradient[t.index()], m.elements.rest_volume[t.index()],
                           constants, nodes.count, b, own));
    }
  }
}

/// Load of a part of a vertex less the force its tetrahedra bear, N, body frame.
Vec3 missing_force(const ReleaseInput& input, VertexId vertex, std::span<const TetId> side) {
  const MechanicsState& m = input.mechanics;
  const Mat3 back = m.components[m.vertices.component[vertex.index()].index()]
                        .orientation.toRotationMatrix()
                        .transpose();
  Vec3 force = Vec3::Zero();
  const std::size_t most = most_nodes(m.elements);
  for (const TetId t : side) {
    const auto [nodes, own] = node_in(input, t, vertex);
    force -= node_force(m.elements, m.elements.stress, m.elements.corner_stress, t, own);
    const double weight = nodes.count == 4 ? 0.25 : node_weight(own);
    force += weight * m.elements.mass[t.index()] * (back * input.gravity);
    if (!input.node_load.empty()) force += back * input.node_load[most * t.index() + own];
  }
  return force;
}

void add_copies(Trial& trial) {
  FactorBorder& border = trial.border;
  for (const PartedVertex& p : trial.parted) {
    const std::uint32_t origin = trial.extended_row(p.vertex);
    if (origin == no_row) continue;
    for (std::size_t s = 1; s < p.sides.size(); ++s) {
      border.columns.push_back({.origin = origin, .vertex_mass = 0, .row = {}, .stiffness = {}});
    }
  }
  trial.missing.resize(static_cast<Index>(3 * (border.columns.size() - trial.first)));
  std::size_t column = trial.first;
  for (const PartedVertex& p : trial.parted) {
    if (trial.extended_row(p.vertex) == no_row) continue;
    for (std::size_t s = 1; s < p.sides.size(); ++s, ++column) {
      // Apart, because rows of other new copies are looked up in the border meanwhile.
      FactorBorder::Column full = border.columns[column];
      fill_column(trial, full, p.vertex, p.sides[s]);
      border.columns[column] = std::move(full);
      trial.missing.segment<3>(static_cast<Index>(3 * (column - trial.first))) =
          missing_force(trial.input, p.vertex, p.sides[s]);
    }
  }
}

/// r . S^-1 r / 2 from the Cholesky factor of S; nothing where S has, to rounding, no inverse.
std::optional<double> energy_of_border(const Trial& trial) {
  const SystemFactor& own = trial.system.step;
  BorderFactor part = own.border;
  if (!extend_border(part, {own.factor, trial.system.analysis, trial.border, 0, 1})) return {};
  const auto begin = static_cast<Index>(3 * trial.first), size = trial.missing.size();
  const auto corner = part.corner.block(begin, begin, size, size);
  const auto pivots = corner.diagonal().cwiseAbs();
  if (!(pivots.minCoeff() > 1e-5 * pivots.maxCoeff())) return {};
  const Eigen::VectorXd y = corner.triangularView<Eigen::Lower>().solve(trial.missing);
  return 0.5 * y.squaredNorm();
}

/// The same from the eigenvalues of S = C - B^T K^-1 B, for pieces that come free: a motion without
/// resistance releases nothing unless a load drives it.
double energy_of_free_piece(const Trial& trial) {
  const FactorBorder& border = trial.border;
  const std::size_t old = trial.first, size = border.columns.size() - old;
  const auto free = static_cast<Index>(3 * trial.system.free_count);
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(free, static_cast<Index>(3 * size));
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(static_cast<Index>(3 * size), B.cols());
  std::vector<Index> local(border.base + old, -1);
  for (std::size_t i = 0; i < trial.system.free_count; ++i) {
    local[trial.extended_row(trial.system.order[i])] = static_cast<Index>(3 * i);
  }
  for (std::size_t j = 0; j < size; ++j) {
    const FactorBorder::Column& column = border.columns[old + j];
    for (std::size_t e = 0; e < column.row.size(); ++e) {
      const auto at = static_cast<Index>(3 * j);
      if (column.row[e] >= border.base + old) {
        const auto row = static_cast<Index>(3 * (column.row[e] - border.base - old));
        S.block<3, 3>(row, at) += column.stiffness[e];
      }
    }
  }
  // Loads on the rows of nodes, not of unknowns: every node of a copy's tetrahedra once.
  std::size_t j = 0;
  const MechanicsState& m = trial.input.mechanics;
  for (const PartedVertex& p : trial.parted) {
    if (trial.extended_row(p.vertex) == no_row) continue;
    for (std::size_t s = 1; s < p.sides.size(); ++s, ++j) {
      for (const TetId t : p.sides[s]) {
        const auto [nodes, own] = node_in(trial.input, t, p.vertex);
        const Lame constants = lame(material_of(m, t));
        for (std::size_t b = 0; b < nodes.count; ++b) {
          const std::uint32_t row = trial.extended_row(nodes.row[b]);
          if (row == no_row) continue;
          B.block<3, 3>(local[row], static_cast<Index>(3 * j)) +=
              node_block(m.elements.shape_gradient[t.index()], m.elements.rest_volume[t.index()],
                         constants, nodes.count, b, own);
        }
      }
    }
  }
  Eigen::MatrixXd X = B;
  solve_system(trial.system, X);
  const double scale = S.diagonal().cwiseAbs().maxCoeff();
  S.noalias() -= B.transpose() * X;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen =
      symmetric_eigen(0.5 * (S + S.transpose()));
  const Eigen::VectorXd along = eigen.eigenvectors().transpose() * trial.missing;
  double energy = 0;
  for (Index k = 0; k < along.size(); ++k) {
    if (eigen.eigenvalues()[k] > 1e-9 * scale) {
      energy += 0.5 * along[k] * along[k] / eigen.eigenvalues()[k];
    } else if (std::abs(along[k]) > 1e-6 * trial.missing.norm()) {
      return std::numeric_limits<double>::infinity();
    }
  }
  return energy;
}

Finding refusal(const char* code, const char* text, const char* remedy) {
  return {.code = code, .text = text, .remedy = remedy};
}

/// The system with K factored; null where that has no inverse.
const ComponentSystem* static_system(const ReleaseInput& input, const Component& component) {
  ComponentSystem& system = built_system(input.mechanics, input.cells.map.corners(), component);
  const bool serves = system.step.factored && system.step.matrix == quasi_static_matrix() &&
                      system.step.border.copies == system.border.columns.size();
  if (!serves) factor_system(system, quasi_static_matrix());
  return system.free_count == 0 || system.step.factor.positive_definite ? &system : nullptr;
}

}  // namespace

std::vector<Vec3> node_loads(std::span<const CornerLoad> loads, const MechanicsState& state,
                             double time) {
  std::vector<Vec3> force;
  const std::size_t most = most_nodes(state.elements);
  if (!loads.empty()) force.assign(most * state.elements.size(), Vec3::Zero());
  for (const CornerLoad& load : loads) {
    const double raised = load.ramp_time > 0 ? std::min(1.0, time / load.ramp_time) : 1.0;
    const std::size_t t = tetrahedron_of(load.corner).index();
    const int node = load.edge < 0 ? place_of(load.corner) : 4 + load.edge;
    const auto& R = state.components[state.elements.component[t].index()].orientation;
    force[most * t + static_cast<std::size_t>(node)] +=
        raised * (load.turns ? R * load.force : load.force);
  }
  return force;
}

Result<EnergyRelease> energy_release(const ReleaseInput& input, std::span<const HalfFaceId> faces,
                                     const Vec3& normal) {
  EnergyRelease release;
  for (const HalfFaceId face : faces) {
    if (input.cells.map.neighbour(face).is_none()) continue;
    const Vec3 area = rest_area_vector(input.cells.map, face);
    release.area += area.norm();
    release.projected += projected_area(area, normal.normalized());
  }
  const MechanicsState& m = input.mechanics;
  std::vector<PartedVertex> parted = parted_vertices(input.cells.map, faces);
  std::ranges::move(parted_edges(m.elements.edge_nodes, input.cells.map, faces),
                    std::back_inserter(parted));
  if (parted.empty()) return release;
  const Component& component =
      m.components[m.vertices.component[parted.front().vertex.index()].index()];
  // Free bodies have a factor too, of rounding.
  const ComponentSystem* system = component.supported ? static_system(input, component) : nullptr;
  if (!system) {
    return refusal("not_supported", "the body has no equilibrium: it is not held",
                   "hold three of its vertices off one line");
  }
  Trial trial{input, *system, input.mechanics.systems.local_row, parted, system->border, 0, {}};
  trial.first = trial.border.columns.size();
  trial.border.base = system->analysis.order.size();
  add_copies(trial);
  release.copies = trial.border.columns.size() - trial.first;
  if (release.copies == 0) return release;
  const std::optional<double> energy = energy_of_border(trial);
  release.comes_free = !energy;
  release.energy = energy ? *energy : energy_of_free_piece(trial);
  if (std::isnan(release.energy)) {
    return refusal("not_a_number", "the energy released is not a number",
                   "look for loads, stiffnesses or sizes that are far too large");
  }
  return release;
}

}  // namespace sunder
