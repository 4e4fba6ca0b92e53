// SPDX-License-Identifier: MIT
// How many cells a body has, and the numbers that follow from them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace sunder {

/// Orbits of a map, and what follows from them.
struct Counts {
  std::size_t vertices = 0, edges = 0, faces = 0, tetrahedra = 0, components = 0;
  std::size_t boundary_faces = 0;
  /// Closed surfaces that make up the boundary: faces joined across edges.
  std::size_t boundary_sheets = 0;
  /// vertices - edges + faces - tetrahedra.
  std::ptrdiff_t euler_characteristic = 0;
  /// (b0, b1, b2) of a body in space: b0 components, b2 = sheets - components, b1 = b0 + b2 - chi.
  /// Right over every field, whole, cut or pinched, when no tetrahedra overlap and none is flat:
  /// each sheet parts space in two, so a component has one void less than its boundary has sheets
  /// [Alexander duality], and there is no torsion. Otherwise (a folded body, or one glued as no
  /// body in space is) only b0 is sure: of an orientable manifold whose components all have a
  /// boundary, b2 and b1 are higher by the rank of H1(body) / H1(boundary) over the field at hand.
  /// S2 x S1 less a ball has (1, 1, 1), not (1, 0, 0); a lens space L(p, q) less a ball has
  /// (1, 1, 1) over GF(p) alone. `sunder suite` computes them for any body.
  /// Absent when a component has no boundary at all.
  std::optional<std::array<std::ptrdiff_t, 3>> betti;
  /// Sum of the rest volumes, m^3; a tetrahedron with a negative one counts negative.
  double volume = 0;
  friend bool operator==(const Counts&, const Counts&) = default;
};

}  // namespace sunder
