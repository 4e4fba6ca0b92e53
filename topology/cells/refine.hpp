// SPDX-License-Identifier: MIT
// Red refinement: marked tetrahedra become eight each, their neighbours are closed.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "topology/cells/subdivide.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// One level of a refinement.
struct RefinedLevel {
  CellEdit edit;
  /// Numbers of tetrahedra divided into eight (red), and of neighbours divided to fit (green).
  std::size_t red = 0, green = 0;
};

/// Divides each of `marked` into eight, and neighbours so that faces fit. A neighbour with one
/// edge, two edges or one face divided gives two or four tetrahedra, any other eight [Bey 1995,
/// sections 3 and 4]. `as_they_stand`: see divide_edges. O(|T|).
template <CellKernel K>
RefinedLevel refine_marked(K& map, std::span<const TetId> marked,
                           std::span<const char> as_they_stand = {});

/// Default of the most tetrahedra that `refine` makes: about 10 GiB of map.
inline constexpr std::size_t most_refined = std::size_t{1} << 27;

/// Returns true to divide a tetrahedron; `of` is the original tetrahedron that contains it.
using WantedCells = std::function<bool(const VolumeMap& map, TetId cell, TetId of)>;

/// Refines `levels` times. On each level `wanted` chooses the tetrahedra.
///
/// Green tetrahedra are never divided again. Instead the parent is divided into eight, and the
/// levels from there on are repeated. So every tetrahedron is red or a green child of a red one,
/// and has one of the three shapes (Bey) of the original tetrahedron or of their green parts. Of
/// the three possible sets of shapes the one with the best smallest radius ratio is taken, so
/// quality does not fall with levels. Returns the levels in order, and fewer if the next one would
/// exceed `most` tetrahedra. To undo all, apply their undos from the last to the first. O(levels x
/// |T|) times the few repetitions of levels.
std::vector<RefinedLevel> refine(VolumeMap& map, std::size_t levels, const WantedCells& wanted,
                                 std::size_t most = most_refined);

}  // namespace sunder
