// SPDX-License-Identifier: MIT
// The energy that a fan gave up, for reports.
#pragma once

#include <cstdint>

namespace sunder {

/// The energy that a fan gave up.
struct CrackEnergy {
  std::uint64_t fan = 0;
  double time = 0;  ///< s
  double area = 0;  ///< m^2, of the faces at rest
  /// Area of the faces projected on the plane, sum A |n . n_f|, m^2. The faces zigzag about the
  /// plane, and their own area is 1.5 to 1.6 times larger on even meshes [Rimoli and Rojas, arXiv
  /// 1302.1161]. The projected area is the crack's within 4 % (docs/lab/crack_objects.md).
  double projected = 0;
  double energy = 0;  ///< J
  /// Energy per projected area, J/m^2.
  double per_area() const { return projected > 0 ? energy / projected : 0; }
};

}  // namespace sunder
