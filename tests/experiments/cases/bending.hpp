// SPDX-License-Identifier: MIT
// Three-point bending: at which load a beam breaks, where, and along which plane.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "fracture/scene/scene.hpp"

namespace sunder::accuracy {

/// A beam of concrete along x, 0.1 m high and half as wide, on supports 16 heights apart, of cubes
/// of `layers` through its height, six tetrahedra each. The load acts on the line of vertices above
/// the middle, half of it from below on each of the lines at the supports, in equal parts: as beam
/// theory has it, no thrust, no friction. These forces are in balance; the free end face beyond one
/// support is held, without reactions. `force`: N, raised over `ramp_time`.
struct Beam {
  int layers = 4;  ///< even
  double force = 0;
  double ramp_time = 0;
};
Scene bent_beam(const Beam& beam);

/// The load at which beam theory has the outer fibre at the tensile strength, N:
/// 2 sigma_t b h^2 / (3 L).
double beam_breaking_load();

/// One mode of node stress on one mesh, from the equilibrium.
struct BendingAnswer {
  /// Load at which the first vertex with a fan reaches the strength, over beam theory's.
  double load = 0;
  double away = 0;   ///< of that vertex from the middle, along the beam, in elements
  double angle = 0;  ///< of its plane's normal with the axis, degrees
  /// Stress along the beam at the lower surface where no load disturbs it, a quarter of the span
  /// from the middle, over beam theory's: mean over the width.
  double surface = 0;
  std::size_t unfitted = 0;  ///< vertices at which `fit` fell back to `volume`
  /// Thread time of the node stress, a vertex: the first time, when `fit` makes its patches, and
  /// the least of five further ones.
  double first_ns = 0, ns = 0;
};

struct BendingTable {
  std::size_t vertices = 0, tetrahedra = 0;
  std::array<BendingAnswer, 3> modes{};  ///< row = `NodeStress`
};
BendingTable bend_static(int layers);

/// A beam bent in time, the load raised by 0.0028 of the expected one in steps of 20 ms.
struct SlowBend {
  int layers = 4;
  FractureSettings fracture = {.crack = CrackMode::paper};
  std::optional<double> toughness = {};  ///< Pa sqrt(m)
  int divided = 1;  ///< a step in which something breaks is taken again in as many
};
struct BendingRun {
  double load = 0;               ///< over beam theory's, when the first fan came
  double away = 0;               ///< as above, of the fan farthest from the middle in that step
  double angle = 0;              ///< as above, the largest in that step
  std::size_t fans = 0;          ///< in that step
  std::size_t steps = 0;         ///< up to it
  std::size_t quasi_static = 0;  ///< of them on that rung
  /// When it has come apart, into pieces of less than three quarters of it: its load over beam
  /// theory's, pieces, fans in all, crack over the beam's section, projected along the beam too,
  /// and the farthest fan from the middle, in heights.
  std::size_t pieces = 0, all_fans = 0;
  double parted = 0, area = 0, projected = 0, farthest = 0;
  double overload = 0;  ///< stress over strength of the first fan, less 1
};
BendingRun bend_slowly(const SlowBend& bend);

}  // namespace sunder::accuracy
