// SPDX-License-Identifier: MIT
// Topological invariants, counted on orbits, and the laws of a face split.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/kernel/counts.hpp"
#include "topology/kernel/kernel.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// Counts the orbits of the darts (vertices <beta2 beta0, beta3 beta0>, edges <beta2, beta3>), from
/// the darts' own numbers alone. O(|T|), about 0.5 µs per tetrahedron for a VolumeMap.
template <Kernel K>
Counts count_cells(const K& map);

/// The `boundary_sheets` of `count_cells` alone. O(|T|) with a small factor.
template <Kernel K>
std::size_t count_boundary_sheets(const K& map);

/// The result of `count_cells` after these splits, computed from their reports: each adds its split
/// vertices and edges, a face and two boundary faces. Only boundary sheets are counted again.
/// `created`: number of components that came off. Requires: `before` counted ahead of the first
/// split. O(|T|), a fifth of the time of `count_cells`.
Counts counts_after(const Counts& before, const VolumeMap& map, std::span<const FaceSplit> splits,
                    std::size_t created);

/// Checks one split against the laws of a face split: with s_v vertices and s_e edges split, dV =
/// s_v, dE = s_e, dF = 1, dT = 0, dchi = s_v - s_e + 1; s_v = 1 implies s_e >= 2, s_v >= 2 implies
/// s_e = 3; the number of components grows by one at most, and only for s_v = 3. The changes of the
/// Betti numbers are among those possible for (s_v, s_e). Returns one `split_law` finding per
/// broken law; empty if all hold.
std::vector<Finding> check_split_laws(const Counts& before, const Counts& after,
                                      const FaceSplit& split);

}  // namespace sunder
