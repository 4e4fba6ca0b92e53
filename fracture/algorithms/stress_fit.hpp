// SPDX-License-Identifier: MIT
// Node stress by a linear fit over two rings of tetrahedra: weights from rest geometry, kept until
// a crack comes by.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fracture/algorithms/node_stress.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// One tetrahedron of a vertex's patch, and how it counts in the vertex's stress.
struct PatchTerm {
  double weight = 0;
  TetId tetrahedron;
};

/// The patch of one vertex, by rising row; weights add up to 1.
struct StressPatch {
  std::vector<PatchTerm> terms;
  /// Made from the map as it is.
  bool valid = false;
  /// False: the fit is not to be trusted, and the weights are those of the mean over the star.
  bool fitted = false;
};

/// Patches of all vertices, made at their first use. A cache: it depends on the map and the rest
/// volumes alone, and detects the vertices that have split since its last use.
struct StressFit {
  std::vector<StressPatch> patches;  ///< |V|
  /// Rows of one point of the mesh, as chains: first by point, next by row.
  std::vector<std::uint32_t> first_row, next_row;
};

/// Patch of `vertex`: its star and the stars of that one's vertices, all reached through adjacency,
/// so that it goes round a crack but never across one.
///
/// Weights of the linear least-squares fit of the element stresses, taken at rest centres x_e and
/// weighted by rest volume V_e, evaluated at the vertex: with the volume-weighted mean m and
/// covariance C of the centres, w_e = V_e / sum V (1 - (m - v)^T C^-1 (x_e - m)). They depend on
/// rest geometry alone, and reproduce every linear stress field exactly. Falls back to the mean
/// over the star (`fitted` false) where the patch has fewer than eight tetrahedra, C is singular to
/// 1e-6, or the vertex lies so far outside of the centres, (m - v)^T C^-1 (m - v) > 25, that the
/// fit would amplify errors of the stresses fivefold. `volume`: |T|, m^3. O(patch), some 10 us.
StressPatch make_stress_patch(const VolumeMap& map, std::span<const double> volume,
                              VertexId vertex);

/// Takes note of the vertices that came since the last call: patches around them, and around the
/// vertices they came from, are not valid any longer.
void follow_splits(StressFit& fit, const VolumeMap& map);

/// Stress of one vertex by the fit, Pa; makes its patch if need be. Needs `follow_splits` after the
/// last split, and the rest volumes as `elements.weight`.
Mat3 fit_node_stress(StressFit& fit, const VolumeMap& map, const ElementStress& elements,
                     VertexId vertex);

/// The same for every vertex into `node_stress` (resized); zero for retired rows. After the first
/// time O(patches) multiplications of a tensor, some 100 a vertex.
void fit_node_stress(std::vector<Mat3>& node_stress, StressFit& fit, const VolumeMap& map,
                     const ElementStress& elements);

}  // namespace sunder
