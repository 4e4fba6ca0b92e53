// SPDX-License-Identifier: MIT
// A face that has come apart and still holds: the crack between its sides takes energy.
#pragma once

#include <array>
#include <cstdint>

#include "mechanics/state/material.hpp"
#include "mechanics/state/vec3.hpp"
#include "mechanics/ties/crack_id.hpp"
#include "topology/base/ids.hpp"

namespace sunder {

/// One corner of a tied face, once its vertex has come apart; of second order the middle of an edge,
/// where even traction acts (corners bear none of it).
struct TieCorner {
  double area = 0;      ///< m^2, A |n . n_f| / 3
  double strength = 0;  ///< Pa, sigma: what it bears before it opens; 0: not apart yet
  double opened = 0;    ///< m, delta_max: the largest effective opening so far
  double opening_end = 0;  ///< m, delta_c = 2 G_c / sigma: there it bears nothing any more
  double taken = 0;        ///< J, dissipated so far

  bool is_apart() const { return strength > 0; }
  bool is_spent() const { return is_apart() && opened >= opening_end; }
};

/// Two half-faces of one component that were one face and are tied together at their corners, of second
/// order at the middles of their edges, by a law of traction against opening (tie_law.hpp).
struct Tie {
  HalfFaceId face, opposite;
  CrackId crack;  ///< that parted it
  /// Places of those nodes in their tetrahedra (`nodes_of`), by the darts of `face`; k meets k.
  std::array<std::uint8_t, 3> corner{}, opposite_corner{};
  Vec3 normal = Vec3::UnitZ();  ///< of the crack, rest frame, unit length, from `opposite` to `face`
  double fracture_energy = 0;   ///< J/m^2, G_c
  ShearLaw shear = {};
  std::array<TieCorner, 3> corners;

  /// Whether nothing ties the sides any more.
  bool is_spent() const {
    return corners[0].is_spent() && corners[1].is_spent() && corners[2].is_spent();
  }
};

/// m^2: of a tied face, projected on its crack.
inline double area_of(const Tie& tie) {
  return tie.corners[0].area + tie.corners[1].area + tie.corners[2].area;
}

/// J that a tie has dissipated so far.
inline double taken_by(const Tie& tie) {
  return tie.corners[0].taken + tie.corners[1].taken + tie.corners[2].taken;
}

}  // namespace sunder
