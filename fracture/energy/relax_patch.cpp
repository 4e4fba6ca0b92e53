// SPDX-License-Identifier: MIT
// The patch around some fans, its stiffness, and the effect of their opening on the stresses.
#include "fracture/energy/relax_patch.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mechanics/element/second_order.hpp"
#include "mechanics/element/strain_displacement.hpp"
#include "mechanics/solver/component_system.hpp"
#include "topology/base/assert.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/kernel/fan.hpp"

namespace sunder {
namespace {

using Eigen::Index;

/// Force of the star of a vertex in the state, N, and its mass, kg.
struct Borne {
  Vec3 force = Vec3::Zero();
  double mass = 0;
};

/// Appends the tetrahedra around vertices, each once, ascending.
void add_stars(std::vector<TetId>& tetrahedra, const Cells& cells,
               std::span<const VertexId> vertices) {
  for (const VertexId v : vertices) {
    const std::vector<TetId> around = star(cells.map, v);
    tetrahedra.insert(tetrahedra.end(), around.begin(), around.end());
  }
  sort_unique(tetrahedra);
}

/// The rows that a fan split, old ones too, each with the first of its copies; gives new rows their
/// displacement.
std::map<VertexId, VertexId> roots_of_copies(RelaxedState& relaxed, const FanEvent& fan) {
  std::vector<VertexCopy> copies = fan.nodes;
  for (const FaceSplit& face : fan.faces) {
    copies.insert(copies.end(), face.split_vertices.begin(),
                  face.split_vertices.begin() + face.vertex_count);
  }
  std::ranges::sort(copies, {}, &VertexCopy::new_row);
  std::map<VertexId, VertexId> root;
  for (const auto& [old_row, new_row] : copies) {
    SUNDER_ASSERT(new_row.index() == relaxed.displacement.size(), "a fan was not noted");
    relaxed.displacement.push_back(Vec3(relaxed.displacement[old_row.index()]));
    const VertexId first = root.try_emplace(old_row, old_row).first->second;
    root[new_row] = first;
  }
  return root;
}

/// A piece of the body as if it were a component: `vertices` are the patch's, rim and all. `inner`:
/// the split vertices; then all nodes that are free.
Component patch_around(const Cells& cells, const MechanicsState& m, std::vector<VertexId>& inner,
                       std::uint32_t rings) {
  Component patch;
  sort_unique(inner);
  std::vector<VertexId> edge = inner, met;
  std::vector<TetId> fresh;
  for (std::uint32_t ring = 1; !edge.empty(); ++ring) {
    fresh.clear();
    add_stars(fresh, cells, edge);
    patch.tetrahedra.insert(patch.tetrahedra.end(), fresh.begin(), fresh.end());
    if (ring == rings) break;
    met.clear();
    for (const TetId t : fresh) {
      const Corners& c = cells.map.corners(t);
      met.insert(met.end(), c.begin(), c.end());
    }
    sort_unique(met);
    edge.clear();
    std::ranges::set_difference(met, inner, std::back_inserter(edge));
    inner.insert(inner.end(), edge.begin(), edge.end());
    std::ranges::sort(inner);
  }
  sort_unique(patch.tetrahedra);
  std::vector<VertexId> middles;  // of edges that end at a free vertex
  for (const TetId t : patch.tetrahedra) {
    const ElementNodes nodes = nodes_of(m.elements, cells.map.corners(), t);
    patch.vertices.insert(patch.vertices.end(), nodes.begin(), nodes.end());
    patch.mass += m.elements.mass[t.index()];
    for (std::size_t k = 4; k < nodes.count; ++k) {
      const auto [i, j] = edge_ends[k - 4];
      const auto is_free = [&](int end) {
        return std::ranges::binary_search(inner, nodes.row[static_cast<std::size_t>(end)]);
      };
      if (is_free(i) || is_free(j)) middles.push_back(nodes.row[k]);
    }
  }
  sort_unique(patch.vertices);
  inner.insert(inner.end(), middles.begin(), middles.end());
  sort_unique(inner);
  patch.rest_centre = m.vertices.rest_position[patch.vertices.front().index()];
  return patch;
}

/// The patch's system, rim held. Room for |V| rows in `local_row`.
ComponentSystem system_of(const Component& patch, std::span<const VertexId> inner,
                          std::span<std::uint32_t> local_row, const Cells& cells,
                          MechanicsState& m) {
  std::vector<MotionId>& support = m.vertices.support;
  std::vector<VertexId> rim;
  const MotionId rim_motion{m.motions.size()};
  m.motions.push_back({});
  for (const VertexId v : patch.vertices) {
    if (!support[v.index()].is_none() || std::ranges::binary_search(inner, v)) continue;
    rim.push_back(v);
    support[v.index()] = rim_motion;
  }
  ComponentSystem system;
  build_system(system, local_row, m, cells.map.corners(), patch);
  for (const VertexId v : rim) support[v.index()] = MotionId::none();
  m.motions.pop_back();
  return system;
}

/// A piece that lies inside the patch whole has no rim: a trace of mass holds it. It moves far and
/// strains as it should; of sixteen digits seven are left.
void factor_patch(ComponentSystem& system) {
  double stiffest = 0, mass = 0;
  const BlockMatrix& K = system.stiffness;
  for (std::size_t j = 0; j < system.free_count; ++j) {
    // The first block of a column is its diagonal.
    const double* block = K.value.data() + 9 * std::size_t{K.start[j]};
    stiffest = std::max({stiffest, block[0], block[4], block[8]});
    mass = std::max(mass, system.shape.mass[static_cast<Index>(j)]);
  }
  factor_system(system, {.mass = 1e-9 * stiffest / mass, .stiffness = 1});
}

/// Forces that free vertices are left without, N, in the system's order.
Eigen::VectorXd missing_forces(const RelaxedState& relaxed, const ComponentSystem& system,
                               const Component& patch, const Cells& cells,
                               const MechanicsState& m) {
  Eigen::Matrix3Xd missing = Eigen::Matrix3Xd::Zero(3, static_cast<Index>(system.free_count));
  std::vector<char> has_share(system.free_count, 0);
  for (std::size_t i = 0; i < system.free_count; ++i) {
    const auto known = relaxed.share.find(system.order[i]);
    if (known == relaxed.share.end()) continue;
    has_share[i] = 1;
    missing.col(static_cast<Index>(i)) = known->second;
  }
  for (const TetId t : patch.tetrahedra) {
    const ElementNodes nodes = nodes_of(m.elements, cells.map.corners(), t);
    for (std::size_t a = 0; a < nodes.count; ++a) {
      const std::uint32_t row = relaxed.local_row[nodes.row[a].index()];
      if (row >= system.free_count) continue;
      auto own = missing.col(static_cast<Index>(row));
      own -= node_force(m.elements, relaxed.stress, relaxed.corner_stress, t, a);
      if (has_share[row]) continue;
      own += node_force(m.elements, m.elements.stress, m.elements.corner_stress, t, a);
    }
  }
  return missing.reshaped();
}

}  // namespace

void start_relaxing(RelaxedState& relaxed, const MechanicsState& mechanics) {
  relaxed.displacement = mechanics.vertices.displacement;
  relaxed.stress = mechanics.elements.stress;
  relaxed.corner_stress = mechanics.elements.corner_stress;
  relaxed.share.clear();
  relaxed.split.clear();
}

void note_fan(RelaxedState& relaxed, const Cells& cells, const MechanicsState& m,
              const FanEvent& fan) {
  const std::map<VertexId, VertexId> root = roots_of_copies(relaxed, fan);
  std::vector<VertexId> corners;
  for (const FaceSplit& face : fan.faces) {
    corners.insert(corners.end(), face.vertices.begin(), face.vertices.end());
  }
  for (const auto& [row, first] : root) {
    if (!cells.map.is_node(row)) corners.push_back(row);
  }
  sort_unique(corners);
  std::vector<TetId> around;
  add_stars(around, cells, corners);
  std::map<VertexId, Borne> borne;
  for (const TetId t : around) {
    const ElementNodes nodes = nodes_of(m.elements, cells.map.corners(), t);
    for (std::size_t a = 0; a < nodes.count; ++a) {
      if (!root.contains(nodes.row[a])) continue;
      Borne& own = borne[nodes.row[a]];
      own.force += node_force(m.elements, m.elements.stress, m.elements.corner_stress, t, a);
      own.mass += node_share(nodes.count, a) * m.elements.mass[t.index()];
      if (a < 4) {
        relaxed.split.push_back(nodes.row[a]);
      } else {
        for (const int end : edge_ends[a - 4]) {
          relaxed.split.push_back(nodes.row[static_cast<std::size_t>(end)]);
        }
      }
    }
  }
  std::map<VertexId, Borne> whole;  // row = first copy
  for (const auto& [row, first] : root) {
    Borne& sum = whole[first];
    sum.force += borne[row].force;
    sum.mass += borne[row].mass;
  }
  for (auto& [first, sum] : whole) {
    const auto known = relaxed.share.find(first);
    if (known != relaxed.share.end()) sum.force = known->second;
  }
  for (const auto& [row, first] : root) {
    const Borne& sum = whole[first];
    relaxed.share[row] = borne[row].mass / sum.mass * sum.force;
  }
  sort_unique(relaxed.split);
}

void relax_around(RelaxedState& relaxed, const Cells& cells, MechanicsState& m,
                  std::uint32_t rings) {
  SUNDER_ASSERT(rings > 0, "a patch of no ring has nothing free");
  relaxed.changed.clear();
  if (relaxed.split.empty()) return;
  std::vector<VertexId> inner = std::exchange(relaxed.split, {});
  const Component patch = patch_around(cells, m, inner, rings);
  relaxed.local_row.resize(m.vertices.size());
  ComponentSystem system = system_of(patch, inner, relaxed.local_row, cells, m);
  if (system.free_count == 0) return;
  factor_patch(system);
  Eigen::VectorXd answer = missing_forces(relaxed, system, patch, cells, m);
  solve_system(system, answer);
  for (std::size_t i = 0; i < system.free_count; ++i) {
    relaxed.displacement[system.order[i].index()] += answer.segment<3>(static_cast<Index>(3 * i));
  }
  for (const TetId t : patch.tetrahedra) {
    const Lame constants = lame(material_of(m, t));
    if (is_second_order(m.elements, t)) {
      const auto H = corner_gradients(m.elements, cells.map.corners(), relaxed.displacement, t);
      Mat3& mean = relaxed.stress[t.index()];
      mean.setZero();
      for (std::size_t k = 0; k < 4; ++k) {
        relaxed.corner_stress[t.index()][k] = stress_of(H[k], constants);
        mean += 0.25 * relaxed.corner_stress[t.index()][k];
      }
      continue;
    }
    CornerVectors d = CornerVectors::Zero();
    for (std::size_t a = 0; a < 4; ++a) {
      const std::uint32_t row = relaxed.local_row[cells.map.corners(t)[a].index()];
      if (row >= system.free_count) continue;
      d.col(static_cast<Index>(a)) = answer.segment<3>(3 * static_cast<Index>(row));
    }
    Mat3& stress = relaxed.stress[t.index()];
    stress += stress_of(displacement_gradient(m.elements.shape_gradient[t.index()], d), constants);
    if (!relaxed.corner_stress.empty()) relaxed.corner_stress[t.index()].fill(stress);
  }
  relaxed.changed = patch.vertices;
  std::erase_if(relaxed.changed, [&](VertexId v) { return cells.map.is_node(v); });
}

}  // namespace sunder
