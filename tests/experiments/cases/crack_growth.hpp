// SPDX-License-Identifier: MIT
// A notched bar pulled slowly until it is in pieces: how many, and by how much crack.
#pragma once

#include <cstddef>
#include <optional>

#include "fracture/algorithms/cells.hpp"
#include "fracture/scene/scene.hpp"

namespace sunder::accuracy {

/// A bar 2 b long, b high and a few elements thick, cut a quarter of b deep at its middle, held at
/// one end and pulled at the other.
struct NotchedBar {
  double height = 0.1;  ///< b, m
  int cells = 8;        ///< elements over b
  int thickness = 2;    ///< elements
  Material material;
  double stress_rate = 1e6;  ///< of the uncracked bar, Pa/s
  double time_step = 1e-3;   ///< s
  double shake = 0;          ///< of vertices inside, over their distance
  bool cut = true;
  double grip = 0;  ///< over b: as far from the ends vertices never split, as in a tester's grips
  double damping = 0;  ///< Rayleigh's, of the stiffness, s
  double in_vain = 10;
  FractureSettings fracture = {.crack = CrackMode::paper};
  /// In place of the cubes: a mesh of the box [0, 2 b] x [0, b] x [0, thickness b / cells].
  std::optional<TetMesh> mesh = {};
};

struct GrowthAnswer {
  std::size_t fans = 0, pieces = 0, steps = 0;  ///< steps: in which fans were split
  double load = 0;                              ///< Pa: nominal stress at the first fan
  double separated = 0;                         ///< s from the first fan to the second piece
  double area = 0;                              ///< of new crack over the section that the cut left
  double projected = 0;                         ///< the same of its projection along the bar
  double parted_area = 0, parted_projected = 0;  ///< both, right after the second piece
  double energy = 0;    ///< J/m^2: given up by the fans over their projected area
  double farthest = 0;  ///< of new crack from the cut's plane, over b
  double smallest = 0;  ///< mass of the smaller end over the bar's
  double worst_ms = 0;  ///< fracture stage of the slowest step
};

/// Area of all crack faces that nothing ties, each counted once, and of their projections along x,
/// m^2.
struct CrackArea {
  double raw = 0, projected = 0;
};
CrackArea crack_area(const Cells& cells);

/// Runs until `after` steps after the second piece, or in vain for `NotchedBar::in_vain` times the
/// time to the first fan.
GrowthAnswer pulled_apart(const NotchedBar& bar, int after = 20);

}  // namespace sunder::accuracy
