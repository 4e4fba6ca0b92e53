// SPDX-License-Identifier: MIT
// Numbers that tell one topology from another, counted on orbits; and the laws a face split obeys.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "topology/kernel/finding.hpp"
#include "topology/kernel/kernel.hpp"
#include "topology/kernel/split_face.hpp"

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
  /// (1, 1, 1) over GF(p) alone. topology/suite/homology/homology.hpp computes them for any body.
  /// Absent when a component has no boundary at all.
  std::optional<std::array<std::ptrdiff_t, 3>> betti;
  /// Sum of the rest volumes, m^3; a tetrahedron with a negative one counts negative.
  double volume = 0;
};

/// Counts the orbits of the darts (vertices <beta2 beta0, beta3 beta0>, edges <beta2, beta3>),
/// trusting no row but the darts' own numbers. O(|T|), about 0.5 us each for a VolumeMap.
template <Kernel K>
Counts count_cells(const K& map);

/// The `boundary_sheets` of `count_cells` alone. O(|T|) with a small factor.
template <Kernel K>
std::size_t count_boundary_sheets(const K& map);

/// Holds one split against the laws of a face split: with s_v vertices and s_e edges split,
/// dV = s_v, dE = s_e, dF = 1, dT = 0, dchi = s_v - s_e + 1; s_v = 1 implies s_e >= 2, s_v >= 2
/// implies s_e = 3; components only grow by one and only for s_v = 3; and the changes of the Betti
/// numbers are among those possible for (s_v, s_e). Gives one `split_law` finding for each broken
/// law; empty when all hold.
std::vector<Finding> check_split_laws(const Counts& before, const Counts& after,
                                      const FaceSplit& split);

}  // namespace sunder
