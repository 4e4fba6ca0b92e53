// SPDX-License-Identifier: MIT
// Which shapes touch in a tick, as patches. For the sources of this room only.
#pragma once

#include <span>
#include <vector>

#include "mechanics/rubble/box_pairs.hpp"
#include "mechanics/rubble/rubble_patch.hpp"

namespace sunder {

struct FindScratch {
  std::vector<Bounds> boxes;
  std::vector<Polytope> solids;  ///< row = shape; only of tetrahedra and boxes
  std::vector<double> turning;   ///< m, row = body: how far its surface may come by turning
  std::vector<std::uint32_t> body;
  std::vector<char> moves;
  std::vector<RowPair> pairs;
  BoxScratch grid;
  std::vector<std::vector<RubblePatch>> found;  ///< row = chunk of pairs
  /// Axes of all pairs of the last call, sorted by the keys of their shapes. They save work and
  /// change no result.
  struct Axis {
    std::uint64_t a = 0, b = 0;
    PairAxis axis;
  };
  std::vector<Axis> axes, last_axes;
};

/// What may touch within `time` s.
struct FindInput {
  std::span<const RubbleBody> bodies;
  std::span<const MovingBody> moving;
  std::span<const RubbleShape> shapes;
  const RubbleSettings& settings;
  double time = 0;
};

/// Pairs whose boxes, widened by the ways of their bodies, overlap: into `scratch.pairs`.
void find_pairs(FindScratch& scratch, const FindInput& input);

/// Patches of those pairs with at least one point, those of two bodies merged (`merge_patches`),
/// with the forces that `memory` has of their points in place of impulses.
void find_patches(std::vector<RubblePatch>& patches, FindScratch& scratch, const FindInput& input,
                  const RubbleMemory& memory);

}  // namespace sunder
