// SPDX-License-Identifier: MIT
// Which cells are scaled, and how their nodes respond.
#include "mechanics/contact/waves/scaled_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "mechanics/contact/waves/wave_bodies.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/state/inertia.hpp"
#include "topology/base/union_find.hpp"

namespace sunder {
namespace {

/// Nodes of a cluster at most: responses are dense.
constexpr std::size_t most_nodes = 32;

/// s: the step that the stiffness at a node allows.
double step_at(const WaveNodes& nodes, const std::vector<double>& stiffness, std::size_t i) {
  return step_of(stiffness[i] * nodes.inverse_mass[i], 0);
}

/// Cells around each node.
struct CellsOfNodes {
  std::vector<std::uint32_t> first;
  std::vector<TetId> cell;
};

template <class Visit>
void for_each_cell(const WaveBodies& waves, const MechanicsState& state, const StepInput& input,
                   Visit visit) {
  for (const WaveBody& body : waves.bodies) {
    for (const TetId t : state.components[body.id.index()].tetrahedra) {
      const ElementNodes own = nodes_of(state.elements, input.corners, t);
      for (std::size_t a = 0; a < own.count; ++a) {
        visit(t, a, waves.node_of_vertex[own.row[a].index()]);
      }
    }
  }
}

CellsOfNodes cells_of_nodes(const WaveBodies& waves, const MechanicsState& state,
                            const StepInput& input) {
  CellsOfNodes cells;
  cells.first.assign(waves.nodes.size() + 1, 0);
  for_each_cell(waves, state, input,
                [&](TetId, std::size_t, std::uint32_t node) { ++cells.first[node + 1]; });
  for (std::size_t i = 0; i < waves.nodes.size(); ++i) cells.first[i + 1] += cells.first[i];
  cells.cell.resize(cells.first.back());
  std::vector<std::uint32_t> next(cells.first.begin(), cells.first.end() - 1);
  for_each_cell(waves, state, input,
                [&](TetId t, std::size_t, std::uint32_t node) { cells.cell[next[node]++] = t; });
  return cells;
}

/// c k of a cell at a node, N/m.
double stiffness_at(const WaveBodies& waves, const ElementNodes& own, TetId t, std::uint32_t node) {
  double sum = 0;
  for (std::size_t a = 0; a < own.count; ++a) {
    if (waves.node_of_vertex[own.row[a].index()] == node) sum += waves.stiffness[t.index()][a];
  }
  return sum;
}

/// Marks the stiffest cells around each node that allows no step of `target` s, until it does.
void mark_cells(std::vector<char>& is_scaled, std::vector<double>& stiffness,
                const WaveBodies& waves, const CellsOfNodes& cells, const MechanicsState& state,
                const StepInput& input, double target) {
  std::vector<std::pair<double, TetId>> around;
  for (std::uint32_t i = 0; i < waves.nodes.size(); ++i) {
    if (!(step_at(waves.nodes, stiffness, i) < target)) continue;
    around.clear();
    for (std::uint32_t k = cells.first[i]; k < cells.first[i + 1]; ++k) {
      const TetId t = cells.cell[k];
      if (is_scaled[t.index()]) continue;
      const ElementNodes own = nodes_of(state.elements, input.corners, t);
      around.emplace_back(stiffness_at(waves, own, t, i), t);
    }
    std::ranges::sort(around, std::ranges::greater{});
    for (const auto& [own_stiffness, t] : around) {
      if (!(step_at(waves.nodes, stiffness, i) < target)) break;
      is_scaled[t.index()] = 1;
      const ElementNodes own = nodes_of(state.elements, input.corners, t);
      for (std::size_t a = 0; a < own.count; ++a) {
        double& at = stiffness[waves.node_of_vertex[own.row[a].index()]];
        at = std::max(0.0, at - waves.stiffness[t.index()][a]);
      }
    }
  }
}

/// No node is in a cluster.
void clear_clusters(WaveNodes& nodes) {
  nodes.scaled.clear();
  nodes.cluster.assign(nodes.size(), ScaledCells::none);
  nodes.place.assign(nodes.size(), 0);
}

/// Clusters of the cells that are marked, into `waves.nodes.scaled`; the largest has so many nodes.
std::size_t gather_clusters(WaveBodies& waves, const std::vector<char>& is_scaled,
                            const MechanicsState& state, const StepInput& input) {
  WaveNodes& nodes = waves.nodes;
  clear_clusters(nodes);
  UnionFind joined(nodes.size());
  for_each_cell(waves, state, input, [&](TetId t, std::size_t a, std::uint32_t node) {
    if (!is_scaled[t.index()] || a == 0) return;
    const ElementNodes own = nodes_of(state.elements, input.corners, t);
    joined.join(waves.node_of_vertex[own.row[0].index()], node);
  });
  std::unordered_map<std::uint32_t, std::uint32_t> cluster_of_root;
  std::size_t largest = 0;
  for (std::size_t b = 0; b < waves.bodies.size(); ++b) {
    waves.bodies[b].first_scaled = waves.bodies[b].end_scaled = nodes.scaled.size();
    for (const TetId t : state.components[waves.bodies[b].id.index()].tetrahedra) {
      if (!is_scaled[t.index()]) continue;
      const ElementNodes own = nodes_of(state.elements, input.corners, t);
      const std::uint32_t root = joined.root(waves.node_of_vertex[own.row[0].index()]);
      const auto next = static_cast<std::uint32_t>(nodes.scaled.size());
      const auto [at, is_new] = cluster_of_root.try_emplace(root, next);
      if (is_new) nodes.scaled.emplace_back().body = b;
      waves.bodies[b].end_scaled = nodes.scaled.size();
      ScaledCells& cluster = nodes.scaled[at->second];
      cluster.cell.push_back(t);
      for (std::size_t a = 0; a < own.count; ++a) {
        const std::uint32_t node = waves.node_of_vertex[own.row[a].index()];
        if (nodes.cluster[node] != ScaledCells::none) continue;
        nodes.cluster[node] = at->second;
        nodes.place[node] = static_cast<std::uint32_t>(cluster.node.size());
        cluster.node.push_back(node);
      }
      largest = std::max(largest, cluster.node.size());
    }
  }
  return largest;
}

/// Motions that supports leave to the nodes of a cluster: which of its 3 n, body frame.
std::vector<char> free_motions(const WaveBodies& waves, const ScaledCells& cluster) {
  std::vector<char> is_free(3 * cluster.node.size(), 1);
  for (const HeldNode& held : waves.held) {
    if (waves.nodes.cluster[held.node] == ScaledCells::none) continue;
    if (&waves.nodes.scaled[waves.nodes.cluster[held.node]] != &cluster) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (held.axes[axis]) is_free[3 * waves.nodes.place[held.node] + axis] = 0;
    }
  }
  return is_free;
}

/// M'^-1 of a cluster.
Eigen::MatrixXd response_of(const WaveBodies& waves, const ScaledCells& cluster,
                            const std::vector<char>& is_free, const MechanicsState& state,
                            const StepInput& input, double step) {
  const auto size = static_cast<Eigen::Index>(3 * cluster.node.size());
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t k = 0; k < cluster.node.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(3 * k);
    M.diagonal().segment<3>(at).setConstant(waves.nodes.mass[cluster.node[k]]);
  }
  for (std::size_t e = 0; e < cluster.cell.size(); ++e) {
    const TetId t = cluster.cell[e];
    const double factor = 0.25 * step * (step + 2 * cluster.viscosity[e]);
    const ElementNodes own = nodes_of(state.elements, input.corners, t);
    const auto place = [&](std::size_t a) {
      const std::uint32_t node = waves.node_of_vertex[own.row[a].index()];
      return static_cast<Eigen::Index>(3 * waves.nodes.place[node]);
    };
    for (std::size_t a = 0; a < own.count; ++a) {
      for (std::size_t b = 0; b < own.count; ++b) {
        M.block<3, 3>(place(b), place(a)) +=
            factor * node_block(state.elements.shape_gradient[t.index()],
                                state.elements.rest_volume[t.index()], lame(material_of(state, t)),
                                own.count, b, a);
      }
    }
  }
  for (Eigen::Index k = 0; k < size; ++k) {
    if (is_free[static_cast<std::size_t>(k)]) continue;
    M.row(k).setZero();
    M.col(k).setZero();
    M(k, k) = 1;
  }
  Eigen::MatrixXd inverse = M.llt().solve(Eigen::MatrixXd::Identity(size, size));
  for (Eigen::Index k = 0; k < size; ++k) {
    if (!is_free[static_cast<std::size_t>(k)]) inverse(k, k) = 0;
  }
  return inverse;
}

/// Adds changes of velocities (m/s, body frame) to a cluster's nodes, and a rigid motion with which
/// they bring the angular momentum `turning` (N m s) about its centre: K_e leaves that alone only
/// where nothing has deformed.
template <class Changes>
void respond(ScaledCells& cluster, WaveNodes& nodes, const Changes& changes, Vec3 turning) {
  const std::size_t count = cluster.node.size();
  const Eigen::VectorXd& own = cluster.own = changes;
  cluster.change.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t i = cluster.node[k];
    cluster.change[k] = cluster.R * own.segment<3>(static_cast<Eigen::Index>(3 * k));
    const Vec3 arm = row_of(nodes.position, i) - cluster.centre;
    turning -= arm.cross(nodes.mass[i] * cluster.change[k]);
  }
  const Vec3 spin = cluster.is_free ? Vec3(cluster.inverse_inertia * turning) : Vec3(Vec3::Zero());
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t i = cluster.node[k];
    const Vec3 arm = row_of(nodes.position, i) - cluster.centre;
    row_of(nodes.velocity, i) += cluster.change[k] + spin.cross(arm);
  }
}

std::span<ScaledCells> clusters_of(WaveNodes& nodes, const WaveBody& body) {
  return std::span(nodes.scaled).subspan(body.first_scaled, body.end_scaled - body.first_scaled);
}

/// Mass centre and inverse inertia of a cluster's nodes where they are.
void measure_cluster(ScaledCells& cluster, const WaveNodes& nodes) {
  double mass = 0;
  cluster.centre.setZero();
  for (const std::uint32_t i : cluster.node) {
    mass += nodes.mass[i];
    cluster.centre += nodes.mass[i] * row_of(nodes.position, i);
  }
  cluster.centre /= mass;
  Mat3 inertia = Mat3::Zero();
  for (const std::uint32_t i : cluster.node) {
    add_inertia(inertia, nodes.mass[i], row_of(nodes.position, i) - cluster.centre);
  }
  cluster.inverse_inertia = inertia.inverse();
}

}  // namespace

void choose_scaled_cells(WaveBodies& waves, std::vector<char>& is_scaled,
                         const MechanicsState& state, const StepInput& input) {
  WaveNodes& nodes = waves.nodes;
  is_scaled.assign(state.elements.size(), 0);
  waves.scaled_before = std::move(nodes.scaled);
  clear_clusters(nodes);
  std::vector<double> steps;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes.inverse_mass[i] > 0) steps.push_back(step_at(nodes, nodes.stiffness, i));
  }
  if (steps.empty()) return;
  std::ranges::sort(steps);
  const auto step_without = [&](double share) {
    return steps[static_cast<std::size_t>(share * static_cast<double>(steps.size()))];
  };
  // A scaled node costs as much as thirty others.
  const auto merit = [&](double share) { return step_without(share) / (1 + 30 * share); };
  std::array shares{0.002, 0.005, 0.01, 0.02, 0.04};
  std::ranges::sort(shares, std::ranges::greater{}, merit);
  constexpr double least_gain = 1.5;
  CellsOfNodes cells;
  for (const double share : shares) {
    if (!(merit(share) > least_gain * steps.front())) break;
    const double target = step_without(share);
    if (cells.first.empty()) cells = cells_of_nodes(waves, state, input);
    std::vector<double> stiffness = nodes.stiffness;
    std::ranges::fill(is_scaled, 0);
    mark_cells(is_scaled, stiffness, waves, cells, state, input, target);
    if (gather_clusters(waves, is_scaled, state, input) > most_nodes) continue;
    nodes.stiffness = std::move(stiffness);
    return;
  }
  std::ranges::fill(is_scaled, 0);
  gather_clusters(waves, is_scaled, state, input);
}

void prepare_scaled_cells(WaveBodies& waves, const MechanicsState& state, const StepInput& input,
                          double step) {
  std::unordered_map<std::uint32_t, const ScaledCells*> known;
  for (const ScaledCells& old : waves.scaled_before) known.emplace(old.cell.front().value, &old);
  for (ScaledCells& cluster : waves.nodes.scaled) {
    const std::vector<char> is_free = free_motions(waves, cluster);
    cluster.is_free = std::ranges::find(is_free, char{0}) == is_free.end();
    std::vector<double> key = cluster.viscosity;
    key.push_back(step);
    for (const std::uint32_t i : cluster.node) key.push_back(waves.nodes.mass[i]);
    key.insert(key.end(), is_free.begin(), is_free.end());
    cluster.R = waves.bodies[cluster.body].frame.orientation.toRotationMatrix();
    if (key == cluster.key) continue;
    cluster.key = std::move(key);
    const auto old = known.find(cluster.cell.front().value);
    const bool is_known =
        old != known.end() && old->second->cell == cluster.cell && old->second->key == cluster.key;
    cluster.response =
        is_known ? old->second->response : response_of(waves, cluster, is_free, state, input, step);
  }
}

void begin_scaled_kick(WaveNodes& nodes, const WaveBody& body, const Mat3& R) {
  for (ScaledCells& cluster : clusters_of(nodes, body)) {
    cluster.R = R;
    measure_cluster(cluster, nodes);
    cluster.before.clear();
    for (const std::uint32_t i : cluster.node) cluster.before.push_back(row_of(nodes.velocity, i));
    cluster.given.assign(cluster.node.size(), Vec3::Zero());
  }
}

void end_scaled_kick(WaveNodes& nodes, const WaveBody& body) {
  for (ScaledCells& cluster : clusters_of(nodes, body)) {
    Eigen::VectorXd impulse(3 * static_cast<Eigen::Index>(cluster.node.size()));
    cluster.force.clear();
    Vec3 turning = Vec3::Zero();
    for (std::size_t k = 0; k < cluster.node.size(); ++k) {
      const std::uint32_t i = cluster.node[k];
      const Vec3 force = nodes.mass[i] * (row_of(nodes.velocity, i) - cluster.before[k]);
      cluster.force.push_back(force);
      turning += (row_of(nodes.position, i) - cluster.centre).cross(force);
      impulse.segment<3>(static_cast<Eigen::Index>(3 * k)) = cluster.R.transpose() * force;
      row_of(nodes.velocity, i) = cluster.before[k];
    }
    respond(cluster, nodes, cluster.response * impulse, turning);
  }
}

double scaled_work(const WaveBodies& waves, const WaveBody& body) {
  const WaveNodes& nodes = waves.nodes;
  double work = 0;
  for (std::size_t c = body.first_scaled; c < body.end_scaled; ++c) {
    const ScaledCells& cluster = nodes.scaled[c];
    for (std::size_t k = 0; k < cluster.node.size(); ++k) {
      const std::uint32_t i = cluster.node[k];
      if (nodes.is_held[i]) continue;
      const Vec3 before = row_of(waves.velocity_before, i), after = row_of(nodes.velocity, i);
      const Vec3 had = nodes.mass[i] * (after - before) - cluster.force[k] - cluster.given[k];
      work += 0.5 * had.dot(before + after);
    }
  }
  return work;
}

void push_node(WaveNodes& nodes, std::uint32_t node, const Vec3& impulse) {
  if (nodes.cluster[node] == ScaledCells::none) {
    row_of(nodes.velocity, node) += nodes.inverse_mass[node] * impulse;
    return;
  }
  ScaledCells& cluster = nodes.scaled[nodes.cluster[node]];
  cluster.given[nodes.place[node]] += impulse;
  const auto at = static_cast<Eigen::Index>(3 * nodes.place[node]);
  respond(cluster, nodes, cluster.response.middleCols<3>(at) * (cluster.R.transpose() * impulse),
          (row_of(nodes.position, node) - cluster.centre).cross(impulse));
}

Mat3 response_between(const WaveNodes& nodes, std::uint32_t of, std::uint32_t at) {
  if (nodes.cluster[at] == ScaledCells::none || nodes.cluster[of] != nodes.cluster[at]) {
    return of == at ? Mat3(nodes.inverse_mass[at] * Mat3::Identity()) : Mat3(Mat3::Zero());
  }
  const ScaledCells& cluster = nodes.scaled[nodes.cluster[at]];
  const auto row = static_cast<Eigen::Index>(3 * nodes.place[of]);
  const auto column = static_cast<Eigen::Index>(3 * nodes.place[at]);
  return cluster.R * cluster.response.block<3, 3>(row, column) * cluster.R.transpose();
}

}  // namespace sunder
