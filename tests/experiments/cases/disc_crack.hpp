// SPDX-License-Identifier: MIT
// The Brazilian test: a disc pressed on two arcs splits along the loaded diameter.
#pragma once

#include <cstddef>

namespace sunder::accuracy {

struct DiscAnswer {
  int cells = 0;  ///< over the diameter
  std::size_t vertices = 0;
  double tension = 0;  ///< node stress (volume) at the centre over Hondros'
  double load = 0;     ///< at the first fan of the run, over Hondros'
  double first = 0;    ///< of the first fan from the loaded diameter, in elements
  /// Of the fans until they cover three quarters of the loaded diameter; then the halves bend and
  /// break at their rims.
  std::size_t fans = 0;
  double farthest = 0;  ///< from the diameter, in elements
  double area = 0;      ///< of their faces over the section that they cover
  double upright = 0;   ///< |n . e|, e across the diameter, mean over their faces
  double length = 0;    ///< of the diameter that they cover
};

/// A disc of radius 1 m, two elements thick, pressed on two opposite arcs of 20 degrees (2 alpha)
/// each. The tension at its centre is 2 P / (pi D t) (sin 2 alpha - alpha) / sin alpha = 0.9645
/// times that of point loads [Hondros 1959], P = p D t sin alpha the resultant of the pressure p.
/// Static for `tension`; the rest from a run, pressed slowly, with `relax` 2.
DiscAnswer brazilian_disc(int cells);

}  // namespace sunder::accuracy
