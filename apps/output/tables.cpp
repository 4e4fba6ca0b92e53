// SPDX-License-Identifier: MIT
// Pieces and cracks, a line each.
#include "apps/output/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "apps/output/output_columns.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"

namespace sunder {

std::string fragments_csv(std::vector<Fragment> fragments) {
  std::ranges::stable_sort(fragments, std::greater<>(), &Fragment::mass);
  std::string text = csv_heading(fragment_columns());
  for (const Fragment& f : fragments) {
    text += fmt::format("{},{},{},{},{},{}", f.id.value, f.body, f.tetrahedra, f.vertices, f.mass,
                        f.volume);
    for (const Vec3* v : {&f.center, &f.velocity, &f.spin}) {
      text += fmt::format(",{},{},{}", (*v)[0], (*v)[1], (*v)[2]);
    }
    const Mat3& J = f.inertia;
    text += fmt::format(",{},{},{},{},{},{},{},{},{},", J(0, 0), J(1, 1), J(2, 2), J(0, 1), J(1, 2),
                        J(0, 2), f.surface, f.crack_area, f.crack_projected);
    if (!f.parent.is_none()) text += fmt::format("{}", f.parent.value);
    text += fmt::format(",{}\r\n", f.birth_step);
  }
  return text;
}

std::string cracks_csv(std::vector<CrackEnergy> cracks) {
  std::ranges::sort(cracks, {}, &CrackEnergy::fan);
  std::string text = csv_heading(crack_columns());
  for (const CrackEnergy& c : cracks) {
    text += fmt::format("{},{},{},{},{},{}\r\n", c.fan, c.time, c.area, c.projected, c.energy,
                        c.per_area());
  }
  return text;
}

std::vector<ObstacleMotion> free_obstacles(const Simulation& simulation) {
  const SimulationState& s = *simulation.state;
  std::vector<ObstacleMotion> motions;
  for (std::size_t k = 0; k < s.obstacles.size(); ++k) {
    const Obstacle& o = s.obstacles[k];
    if (o.mass) motions.push_back({s.mechanics.time, k, pose_of(o.shape), o.velocity, o.spin});
  }
  return motions;
}

std::string obstacles_csv(const std::vector<ObstacleMotion>& motions) {
  std::string text = csv_heading(obstacle_columns());
  for (const ObstacleMotion& m : motions) {
    const auto& [c, q] = m.pose;
    text += fmt::format("{},{},{},{},{},{},{},{},{}", m.time, m.row, c[0], c[1], c[2], q.w(), q.x(),
                        q.y(), q.z());
    for (const Vec3* v : {&m.velocity, &m.spin}) {
      text += fmt::format(",{},{},{}", (*v)[0], (*v)[1], (*v)[2]);
    }
    text += "\r\n";
  }
  return text;
}

}  // namespace sunder
