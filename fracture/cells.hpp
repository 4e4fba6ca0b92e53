// SPDX-License-Identifier: MIT
// The cells of all bodies and what breaking knows about them: map, components, skin, strength.
#pragma once

#include <span>
#include <vector>

#include "mechanics/mechanics_state.hpp"
#include "topology/components.hpp"
#include "topology/volume_map.hpp"

namespace sunder {

/// The topological half of a simulation's state.
struct Cells {
  VolumeMap map;
  Components labels;
  /// 4 |T|, by half-face: 1 where the face was on the surface before anything broke. A boundary
  /// half-face that is not skin is a crack face.
  std::vector<char> skin;
  /// |V|, Pa: the tensile threshold xi of each vertex (see `vertex_strength`).
  std::vector<double> strength;
  /// |V|: 1 while a vertex waits for a fan that the budget of a step did not allow.
  std::vector<char> waits;
};

/// The cells of a body that has not broken yet. `mechanics`: made from the same rows.
Cells make_cells(VolumeMap map, const MechanicsState& mechanics);

/// Threshold xi of one vertex, Pa: the smallest tensile strength around it; where its material has a
/// toughness K_Ic and the vertex is a crack tip (a cracked face lies in its star), 0.45 K_Ic /
/// sqrt(h) alone, h the mean edge length of its star, because the stress there grows like
/// 1 / sqrt(h) and a bare strength would depend on the mesh (decisions.md, Mesh dependence).
/// `star`: every tetrahedron around `vertex`. Infinite for a material that never breaks.
double vertex_strength(const Cells& cells, const MechanicsState& mechanics, VertexId vertex,
                       std::span<const TetId> star);

/// Whether a half-face lies on the boundary because of a crack.
inline bool is_crack_face(const Cells& cells, HalfFaceId face) {
  return cells.map.neighbour(face).is_none() && !cells.skin[face.index()];
}

}  // namespace sunder
