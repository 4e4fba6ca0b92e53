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
  /// Tetrahedra that became eight (red), and those divided to meet them (green).
  std::size_t red = 0, green = 0;
};

/// Divides each of `marked` into eight, and others as they have to be so that faces fit: into two
/// or four where one edge, two edges or one face of theirs is divided, else into eight as well [Bey
/// 1995, sections 3 and 4]. `as_they_stand`: see divide_edges. O(|T|).
template <CellKernel K>
RefinedLevel refine_marked(K& map, std::span<const TetId> marked,
                           std::span<const char> as_they_stand = {});

/// Tetrahedra beyond which `refine` makes no further level unless told: some ten GiB of map.
inline constexpr std::size_t most_refined = std::size_t{1} << 27;

/// Whether a tetrahedron shall be divided; `of` is the one of the beginning that it is a part of.
using WantedCells = std::function<bool(const VolumeMap& map, TetId cell, TetId of)>;

/// Refines `levels` times what `wanted` asks for, asked anew on each level.
///
/// Green tetrahedra are never divided again: where one would have to be, its parent becomes eight
/// instead, and the levels from there on are made anew. So every tetrahedron is red or a green
/// child of a red one, and of the three shapes (Bey) and their green parts of its tetrahedron of
/// before, of three threes the one with the best least radius ratio: quality does not fall with
/// levels. Gives the levels in their order, fewer than asked for where the next one would leave
/// more than `most` tetrahedra; to take all back, apply their undos from the last to the first.
/// O(levels x |T|) times how often levels are made anew, of which there are few.
std::vector<RefinedLevel> refine(VolumeMap& map, std::size_t levels, const WantedCells& wanted,
                                 std::size_t most = most_refined);

}  // namespace sunder
