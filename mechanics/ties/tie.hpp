// SPDX-License-Identifier: MIT
// A split face that still holds: the crack between its sides takes energy.
#pragma once

#include <array>
#include <cstdint>

#include "mechanics/state/settings/material.hpp"
#include "mechanics/state/vec3.hpp"
#include "mechanics/ties/crack_id.hpp"
#include "topology/base/ids.hpp"

namespace sunder {

/// One corner of a tied face after its vertex has split. In elements of order 2 it is the middle of
/// an edge, because corners carry no uniform traction.
struct TieCorner {
  double area = 0;         ///< m^2, A |n . n_f| / 3
  double strength = 0;     ///< Pa, sigma, before it opens; 0: not split yet
  double opened = 0;       ///< m, delta_max: the largest effective opening so far
  double opening_end = 0;  ///< m, delta_c = 2 G_c / sigma: no traction from here on
  double taken = 0;        ///< J, dissipated so far

  bool is_apart() const { return strength > 0; }
  bool is_spent() const { return is_apart() && opened >= opening_end; }
};

/// Two half-faces of one component that were one face. A law of traction against opening
/// (tie_law.hpp) ties their corners together, or the middles of their edges with elements of order
/// 2.
struct Tie {
  HalfFaceId face, opposite;
  CrackId crack;  ///< the crack that split the face
  /// Places of the tied nodes in their tetrahedra (`nodes_of`), in the order of the darts of
  /// `face`; k meets k.
  std::array<std::uint8_t, 3> corner{}, opposite_corner{};
  Vec3 normal =
      Vec3::UnitZ();           ///< of the crack, rest frame, unit length, from `opposite` to `face`
  double fracture_energy = 0;  ///< J/m^2, G_c
  ShearLaw shear = {};
  std::array<TieCorner, 3> corners;

  /// True if no tie holds the sides any more.
  bool is_spent() const {
    return corners[0].is_spent() && corners[1].is_spent() && corners[2].is_spent();
  }
};

/// Area of a tied face, projected on its crack, m^2.
inline double area_of(const Tie& tie) {
  return tie.corners[0].area + tie.corners[1].area + tie.corners[2].area;
}

/// Energy that a tie has dissipated so far, J.
inline double taken_by(const Tie& tie) {
  return tie.corners[0].taken + tie.corners[1].taken + tie.corners[2].taken;
}

}  // namespace sunder
