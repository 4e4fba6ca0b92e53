// SPDX-License-Identifier: MIT
// Tables of pieces and cracks as text.
#pragma once

#include <string>
#include <vector>

#include "apps/output/fragment.hpp"
#include "mechanics/state/pose.hpp"

namespace sunder {

/// The table of fragments as CSV (RFC 4180, one header line, SI units, numbers that read back
/// exactly), by falling mass, then by id.
std::string fragments_csv(std::vector<Fragment> fragments);

/// The energies of fans (`StepReport::cracks` of all steps) as CSV in the order of the fans: fan
/// (counted from 0 through the run), time (s), area and projected_area (m^2), energy (J),
/// energy_per_area (J/m^2, over the latter).
std::string cracks_csv(std::vector<CrackEnergy> cracks);

/// State of a free obstacle at one time.
struct ObstacleMotion {
  double time = 0;      ///< s
  std::size_t row = 0;  ///< in the scene
  Pose pose;            ///< of the mass centre; the rotation of a sphere is not followed
  Vec3 velocity{0, 0, 0}, spin{0, 0, 0};  ///< m/s, rad/s, world
};

/// Present states of the free obstacles of a simulation, by rows.
std::vector<ObstacleMotion> free_obstacles(const Simulation& simulation);

/// The states as CSV: time, obstacle, centre, orientation (unit quaternion w, x, y, z: the
/// obstacle's own axes to the world's), velocity and spin.
std::string obstacles_csv(const std::vector<ObstacleMotion>& motions);

}  // namespace sunder
