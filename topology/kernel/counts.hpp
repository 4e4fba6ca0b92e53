// SPDX-License-Identifier: MIT
// Numbers of cells of a body, and invariants that follow from them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace sunder {

/// Numbers of orbits of a map, and invariants that follow from them.
struct Counts {
  std::size_t vertices = 0, edges = 0, faces = 0, tetrahedra = 0, components = 0;
  std::size_t boundary_faces = 0;
  /// Closed surfaces that make up the boundary: faces joined across edges.
  std::size_t boundary_sheets = 0;
  /// vertices - edges + faces - tetrahedra.
  std::ptrdiff_t euler_characteristic = 0;
  /// (b0, b1, b2) of a body in space: b0 components, b2 = sheets - components, b1 = b0 + b2 - chi.
  /// Correct over every field for whole, cut and pinched bodies without overlapping or flat
  /// tetrahedra. Each sheet divides space in two, so a component has one void less than its
  /// boundary has sheets [Alexander duality], and there is no torsion. For other bodies, folded or
  /// impossible in space, only b0 is certain: for an orientable manifold with a boundary on each
  /// component, b2 and b1 are higher by the rank of H1(body) / H1(boundary) over the field at hand.
  /// S2 x S1 less a ball has (1, 1, 1), not (1, 0, 0); a lens space L(p, q) less a ball has (1, 1,
  /// 1) over GF(p) alone. `sunder suite` computes them for any body. Absent if a component has no
  /// boundary.
  std::optional<std::array<std::ptrdiff_t, 3>> betti;
  /// Sum of the signed rest volumes, m^3.
  double volume = 0;
  friend bool operator==(const Counts&, const Counts&) = default;
};

}  // namespace sunder
