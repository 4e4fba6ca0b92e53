// SPDX-License-Identifier: MIT
// Virtual crack closure at the vertices that fans part.
#include "fracture/energy/crack_energy.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/element/second_order.hpp"
#include "mechanics/state/wave_travel.hpp"

namespace sunder {
namespace {

/// Rows of one vertex that came apart, and the crack they belong to.
struct Parted {
  std::size_t crack;
  std::vector<VertexId> rows;
};

std::vector<Parted> parted_vertices(std::span<const FanEvent> fans, std::size_t first_crack,
                                    std::vector<std::uint32_t>& group) {
  std::vector<Parted> parted;
  for (std::size_t k = 0; k < fans.size(); ++k) {
    const auto add = [&](const VertexCopy& copy) {
      std::uint32_t& of_old = group[copy.old_row.index()];
      if (of_old == 0) {
        parted.push_back({first_crack + k, {copy.old_row}});
        of_old = static_cast<std::uint32_t>(parted.size());
      }
      group[copy.new_row.index()] = of_old;
      parted[of_old - 1].rows.push_back(copy.new_row);
    };
    for (const FaceSplit& face : fans[k].faces) {
      for (int i = 0; i < face.vertex_count; ++i) {
        add(face.split_vertices[static_cast<std::size_t>(i)]);
      }
    }
    for (const VertexCopy& copy : fans[k].nodes) add(copy);
  }
  return parted;
}

/// Forces of the elements on marked rows, world.
std::vector<Vec3> forces_on(const std::vector<std::uint32_t>& group, const MechanicsState& state,
                            std::span<const Corners> corners) {
  std::vector<Vec3> force(group.size(), Vec3::Zero());
  const ElementColumns& elements = state.elements;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const Eigen::Quaterniond& R = state.components[elements.component[t].index()].orientation;
    const ElementNodes nodes = nodes_of(elements, corners, TetId{t});
    for (std::size_t a = 0; a < nodes.count; ++a) {
      const std::size_t v = nodes.row[a].index();
      if (group[v] == 0) continue;
      force[v] -= R * node_force(elements, elements.stress, elements.corner_stress, TetId{t}, a);
    }
  }
  return force;
}

}  // namespace

CrackEnergy energy_of(const OpenCrack& crack) {
  CrackEnergy energy{crack.fan, crack.time, crack.area, crack.projected, 0};
  for (const CrackSide& side : crack.sides) energy.energy += 0.5 * side.force.dot(side.opening);
  return energy;
}

void open_cracks(std::vector<OpenCrack>& cracks, const NewCracks& fresh,
                 const MechanicsState& state, const Cells& cells) {
  const std::size_t first = cracks.size();
  for (std::size_t k = 0; k < fresh.fans.size(); ++k) {
    OpenCrack& crack = cracks.emplace_back();
    crack.fan = fresh.first_fan + k;
    crack.time = fresh.time;
    for (const FaceSplit& face : fresh.fans[k].faces) {
      const Vec3 area = rest_area_vector(cells.map, face.face);
      crack.area += area.norm();
      crack.projected += projected_area(area, fresh.fans[k].normal);
    }
  }
  std::vector<std::uint32_t> group(state.vertices.size(), 0);  // 1 + row of `parted`; 0: whole
  const std::vector<Parted> parted = parted_vertices(fresh.fans, first, group);
  const std::vector<Vec3> force = forces_on(group, state, cells.map.corners());
  for (const Parted& vertex : parted) {
    // The rest of the sum is the vertex's own inertia and load: the same for every side.
    Vec3 sum = Vec3::Zero();
    for (VertexId v : vertex.rows) sum += force[v.index()];
    const double share = 1.0 / static_cast<double>(vertex.rows.size());
    for (VertexId v : vertex.rows) {
      cracks[vertex.crack].sides.push_back({v, force[v.index()] - share * sum, Vec3::Zero()});
    }
  }
}

void follow_cracks(std::vector<CrackEnergy>& settled, std::vector<OpenCrack>& cracks,
                   const MechanicsState& state, const EnergyPart& step) {
  const VertexColumns& vertices = state.vertices;
  for (OpenCrack& crack : cracks) {
    bool moves = crack.sides.empty();
    double travel = 0;
    for (CrackSide& side : crack.sides) {
      const std::size_t v = side.vertex.index();
      const Component& component = state.components[vertices.component[v].index()];
      travel = std::max(travel, extent_travel(state, component));
      if (!step.members.has(component.id) || component.rung == Rung::carried) continue;
      moves = true;
      if (v >= step.displacement_before.size()) continue;
      side.opening +=
          component.orientation * (vertices.displacement[v] - step.displacement_before[v]);
    }
    if (!moves) continue;
    crack.followed += step.length;
    if (crack.followed < travel * (1 - 1e-9)) continue;
    settled.push_back(energy_of(crack));
    crack.sides.clear();
    crack.followed = -1;
  }
  std::erase_if(cracks, [](const OpenCrack& crack) { return crack.followed < 0; });
}

}  // namespace sunder
