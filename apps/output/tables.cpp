// SPDX-License-Identifier: MIT
// Pieces and cracks, a line each.
#include "apps/output/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace sunder {

std::string fragments_csv(std::vector<Fragment> fragments) {
  std::ranges::stable_sort(fragments, std::greater<>(), &Fragment::mass);
  std::string text =
      "component,body,tetrahedra,vertices,mass,volume,center_x,center_y,center_z,velocity_x,"
      "velocity_y,velocity_z,spin_x,spin_y,spin_z,inertia_xx,inertia_yy,inertia_zz,inertia_xy,"
      "inertia_yz,inertia_xz,surface,crack_area,crack_projected,parent,birth_step\r\n";
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
  std::string text = "fan,time,area,projected_area,energy,energy_per_area\r\n";
  for (const CrackEnergy& c : cracks) {
    text += fmt::format("{},{},{},{},{},{}\r\n", c.fan, c.time, c.area, c.projected, c.energy,
                        c.per_area());
  }
  return text;
}

}  // namespace sunder
