// SPDX-License-Identifier: MIT
// Random solids thrown at each other: the figures of a seed, and their scene.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "tests/mechanics/contact/contact_scene.hpp"

namespace sunder::test {

/// The figures of a throw.
struct ThrowFigures {
  std::string kinds;     ///< such as "chip on plate"
  double ratio = 1;      ///< size of the first over that of the second, 1 to 1 000
  double speed = 0;      ///< m/s
  double turn = 0;       ///< rad per step, of the one that spins faster
  double time_step = 0;  ///< s
  bool is_elastic = false;
};

/// The draw of a seed. Both solids are about the origin, and the second is thrown at the first.
struct RandomThrow {
  ThrowFigures figures;
  Body first, second;            ///< the second is empty if it is a ball
  double ball = 0;               ///< m, radius; 0: no ball
  double ball_mass = 0;          ///< kg
  double small = 1;              ///< m, about twice the radius of the second
  Vec3 start, ahead;             ///< m, of the second; unit, against its velocity
  double reach = 0, gap = 0;     ///< m: radii of both together, and how far apart they start
  std::array<double, 2> turn{};  ///< rad per step
  std::array<Vec3, 2> axis{};
};

/// How the second solid lies before it is thrown.
enum class Lies {
  along_axes,  ///< blocks as they are made: parallel to the first
  askew,       ///< turned at random: no edges or faces are parallel
};

/// The same seed gives the same throw.
RandomThrow draw_throw(std::uint64_t seed, Lies lies = Lies::along_axes);

/// The bodies of a throw as it begins, in a scene without weight.
ContactScene scene_of(const RandomThrow& thrown, const Material& material = material_of(1e10));

}  // namespace sunder::test
