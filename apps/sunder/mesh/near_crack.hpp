// SPDX-License-Identifier: MIT
// Cracks of a mesh, as far as it shows them: boundary faces that lie on each other.
#pragma once

#include <array>
#include <vector>

#include "topology/kernel/volume_map.hpp"
#include "topology/mesh/box_tree.hpp"

namespace sunder {

/// The triangles of cracks, m, and boxes round them to find them by.
struct CrackFaces {
  std::vector<std::array<Point, 3>> triangles;
  BoxTree boxes;
};

/// Boundary faces with all three corners exactly on those of another boundary face, each once.
/// `within`: how far from a face something may be and still be found near it, m. O(n log n).
CrackFaces crack_faces(const VolumeMap& map, double within);

/// Whether a corner of the tetrahedron is nearer to a crack than `within`, the distance the faces
/// were gathered for; a corner on the crack always is.
bool is_near(const CrackFaces& crack, const VolumeMap& map, TetId t, double within);

}  // namespace sunder
