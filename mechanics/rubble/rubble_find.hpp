// SPDX-License-Identifier: MIT
// Which shapes touch in a tick, as patches. For the sources of this room only.
#pragma once

#include <span>
#include <vector>

#include "mechanics/contact/shapes/box_pairs.hpp"
#include "mechanics/rubble/rubble_patch.hpp"

namespace sunder {

struct FindScratch {
  /// How a body goes on in the time.
  struct Turn {
    Vec3 way{0, 0, 0};          ///< m, of its centre
    Vec3 turn{0, 0, 0};         ///< rad
    Mat3 chord = Mat3::Zero();  ///< from an arm to where turning takes it, less the arm
  };
  std::vector<Turn> turns;  ///< row = body
  std::vector<Bounds> boxes;
  std::vector<Polytope> solids;  ///< row = shape; only of tetrahedra and boxes
  std::vector<Vec3> ways;        ///< m, row = shape: of its centre in the time
  std::vector<Vec3> centre;      ///< m, row = shape: of its box
  std::vector<double> radius;    ///< m, half the diagonal of that; infinite for half-spaces
  std::vector<std::uint32_t> body;
  std::vector<char> moves;
  std::vector<RowPair> pairs;
  BoxScratch grid;
  std::vector<RowPair> facing;  ///< shape, partner: those that face each other; sorted
  std::vector<std::vector<RubblePatch>> found;  ///< row = chunk of pairs
  /// Axes of all pairs of the last call, sorted by the keys of their shapes. They save work and
  /// change no result.
  struct Axis {
    std::uint64_t a = 0, b = 0;
    PairAxis axis;
  };
  std::vector<Axis> axes, last_axes;
};

/// Input of the search for shapes that may touch within `time` s.
struct FindInput {
  std::span<const RubbleBody> bodies;
  std::span<const MovingBody> moving;
  std::span<const RubbleShape> shapes;
  std::span<const RubblePartner> partners;
  const RubbleSettings& settings;
  double time = 0;
};

/// How far two shapes may come nearer in the time. Needs: ways of `find_pairs`.
Approach approach_of(const FindScratch& scratch, const FindInput& input, const RowPair& pair);

/// A manifold of two shapes, A's side the first, as a patch: of the lower body against the other.
RubblePatch patch_of(const FindInput& input, const RowPair& pair, const Manifold& manifold);

/// Pairs with overlapping boxes, widened by the ways of their bodies: into `scratch.pairs`.
void find_pairs(FindScratch& scratch, const FindInput& input);

/// Patches of those pairs with at least one point, those of two bodies merged (`merge_patches`),
/// with the forces that `memory` has of their points in place of impulses.
void find_patches(std::vector<RubblePatch>& patches, FindScratch& scratch, const FindInput& input,
                  const RubbleMemory& memory);

}  // namespace sunder
