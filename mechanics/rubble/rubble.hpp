// SPDX-License-Identifier: MIT
// Rigid bodies that touch: one tick of their own clock.
#pragma once

#include <memory>
#include <span>

#include "mechanics/contact/shapes/box_pairs.hpp"
#include "mechanics/rubble/rubble_body.hpp"

namespace sunder {

/// Room that `advance_rubble` reuses.
struct RubbleScratch {
  RubbleScratch();
  ~RubbleScratch();
  RubbleScratch(RubbleScratch&&) noexcept;
  RubbleScratch& operator=(RubbleScratch&&) noexcept;
  struct Buffers;
  std::unique_ptr<Buffers> buffers;
};

/// Two bodies that push at each other, and the impulse on the first in the tick, N s.
struct RubbleTouch {
  std::uint32_t a = 0, b = 0;
  Vec3 impulse{0, 0, 0};
};

/// One tick of rigid bodies with contact and friction. Patches are found once; sub-steps then
/// follow them. A sub-step has velocities under gravity, warm start, a sweep to and fro that pushes
/// overlaps out, places, and one without pushing [soft steps: Catto 2024, "Solver2D"]. Normal
/// impulses are by point, friction and its twist by patch. Approaching points are stopped where
/// they touch. Both sides of a patch are pushed at one place, so that momentum and angular momentum
/// are kept to rounding. Bodies turn with their angular momentum (`turn_through_step`).
/// A body falls asleep if it, and all bodies that push at it, have been still for `sleep_after`: it
/// stands as if it were held. It wakes when a body that is not still touches it. A blow, by ten
/// times the speed that counts as still, also wakes all bodies connected with it.
/// `touches` gets the pairs of bodies that push, sorted. The result follows from bodies, shapes
/// and memory alone, the same bytes on any number of threads.
/// Faces of `partners` meet their partners while they face them, and nothing else near these.
/// Needs: shapes sorted by key, half-spaces and boxes on driven bodies or boxes on any.
RubbleReport advance_rubble(std::span<RubbleBody> bodies, std::span<const RubbleShape> shapes,
                            RubbleMemory& memory, const RubbleSettings& settings,
                            RubbleScratch& scratch, std::vector<RubbleTouch>* touches = nullptr,
                            std::span<const RubblePartner> partners = {});

/// J, of motion.
double kinetic_energy(const RubbleBody& body);

/// A tetrahedron or box where its body's centre (m) is, `turned` from its own axes to the world's.
Polytope polytope_of(const RubbleShape& shape, const Vec3& centre, const Mat3& turned);

}  // namespace sunder
