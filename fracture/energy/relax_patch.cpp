// SPDX-License-Identifier: MIT
// The patch around some fans, its stiffness, and what their opening does to the stresses.
#include "fracture/energy/relax_patch.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mechanics/element/strain_displacement.hpp"
#include "mechanics/solver/component_system.hpp"
#include "topology/base/assert.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/kernel/fan.hpp"

namespace sunder {
namespace {

using Eigen::Index;

/// What the star of a vertex bears in the state, N, and its mass, kg.
struct Borne {
  Vec3 force = Vec3::Zero();
  double mass = 0;
};

Borne borne(const Cells& cells, const MechanicsState& m, VertexId v) {
  Borne sum;
  for (const TetId t : star(cells.map, v)) {
    const Corners& c = cells.map.corners(t);
    const auto own = std::find(c.begin(), c.end(), v) - c.begin();
    sum.force += m.elements.rest_volume[t.index()] *
                 (m.elements.stress[t.index()] * m.elements.shape_gradient[t.index()].col(own));
    sum.mass += m.elements.mass[t.index()];
  }
  return sum;
}

/// Rows of each vertex that a fan split, the old one first; gives new rows their displacement.
std::map<VertexId, std::vector<VertexId>> rows_of_copies(RelaxedState& relaxed,
                                                         const FanEvent& fan) {
  std::map<VertexId, VertexId> root;
  std::map<VertexId, std::vector<VertexId>> groups;
  for (const FaceSplit& face : fan.faces) {
    for (int i = 0; i < face.vertex_count; ++i) {
      const auto [old_row, new_row] = face.split_vertices[static_cast<std::size_t>(i)];
      SUNDER_ASSERT(new_row.index() == relaxed.displacement.size(), "a fan was not noted");
      relaxed.displacement.push_back(Vec3(relaxed.displacement[old_row.index()]));
      const VertexId first = root.try_emplace(old_row, old_row).first->second;
      root[new_row] = first;
      std::vector<VertexId>& rows = groups[first];
      if (rows.empty()) rows.push_back(first);
      rows.push_back(new_row);
    }
  }
  return groups;
}

/// A piece of the body as if it were a component: `vertices` are the patch's, rim and all.
Component patch_around(const Cells& cells, const MechanicsState& m, std::vector<VertexId>& inner,
                       std::uint32_t rings) {
  Component patch;
  sort_unique(inner);
  std::vector<VertexId> edge = inner, met;
  std::vector<TetId> fresh;
  for (std::uint32_t ring = 1; !edge.empty(); ++ring) {
    fresh.clear();
    for (const VertexId v : edge) {
      const std::vector<TetId> around = star(cells.map, v);
      fresh.insert(fresh.end(), around.begin(), around.end());
    }
    sort_unique(fresh);
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
  for (const TetId t : patch.tetrahedra) {
    const Corners& c = cells.map.corners(t);
    patch.vertices.insert(patch.vertices.end(), c.begin(), c.end());
    patch.mass += m.elements.mass[t.index()];
  }
  sort_unique(patch.vertices);
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
    const Corners& c = cells.map.corners(t);
    const ShapeGradient& G = m.elements.shape_gradient[t.index()];
    const double volume = m.elements.rest_volume[t.index()];
    for (std::size_t a = 0; a < 4; ++a) {
      const std::uint32_t row = relaxed.local_row[c[a].index()];
      if (row >= system.free_count) continue;
      Mat3 stress = -relaxed.stress[t.index()];
      if (!has_share[row]) stress += m.elements.stress[t.index()];
      missing.col(static_cast<Index>(row)) += volume * (stress * G.col(static_cast<Index>(a)));
    }
  }
  return missing.reshaped();
}

}  // namespace

void start_relaxing(RelaxedState& relaxed, const MechanicsState& mechanics) {
  relaxed.displacement = mechanics.vertices.displacement;
  relaxed.stress = mechanics.elements.stress;
  relaxed.share.clear();
  relaxed.split.clear();
}

void note_fan(RelaxedState& relaxed, const Cells& cells, const MechanicsState& m,
              const FanEvent& fan) {
  for (const auto& [first, rows] : rows_of_copies(relaxed, fan)) {
    Borne sum;
    std::vector<double> mass;
    for (const VertexId v : rows) {
      const Borne own = borne(cells, m, v);
      sum.force += own.force;
      sum.mass += own.mass;
      mass.push_back(own.mass);
    }
    const auto known = relaxed.share.find(first);
    if (known != relaxed.share.end()) sum.force = known->second;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      relaxed.share[rows[i]] = mass[i] / sum.mass * sum.force;
    }
    relaxed.split.insert(relaxed.split.end(), rows.begin(), rows.end());
  }
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
    CornerVectors d = CornerVectors::Zero();
    for (std::size_t a = 0; a < 4; ++a) {
      const std::uint32_t row = relaxed.local_row[cells.map.corners(t)[a].index()];
      if (row >= system.free_count) continue;
      d.col(static_cast<Index>(a)) = answer.segment<3>(3 * static_cast<Index>(row));
    }
    relaxed.stress[t.index()] += stress_of(
        displacement_gradient(m.elements.shape_gradient[t.index()], d), lame(material_of(m, t)));
  }
  relaxed.changed = patch.vertices;
}

}  // namespace sunder
