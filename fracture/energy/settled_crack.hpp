// SPDX-License-Identifier: MIT
// The energy that a fan gave up, as reports tell it.
#pragma once

#include <cstdint>

namespace sunder {

/// What a fan gave up.
struct CrackEnergy {
  std::uint64_t fan = 0;
  double time = 0;  ///< s
  double area = 0;  ///< m^2, of its faces at rest
  /// m^2: of them on its plane, sum A |n . n_f|. The faces zigzag about the plane, and their area
  /// is 1.5 to 1.6 of it on even meshes [Rimoli and Rojas, arXiv 1302.1161]; this one is the
  /// crack's, within 4 per cent (docs/lab/crack_objects.md).
  double projected = 0;
  double energy = 0;  ///< J
  /// J/m^2, over the projected area.
  double per_area() const { return projected > 0 ? energy / projected : 0; }
};

}  // namespace sunder
