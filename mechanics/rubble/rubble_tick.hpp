// SPDX-License-Identifier: MIT
// One tick at work: the data that its parts share. For the sources of this room only.
#pragma once

#include <algorithm>

#include "mechanics/rubble/rubble.hpp"
#include "mechanics/rubble/rubble_find.hpp"
#include "mechanics/rubble/rubble_patch.hpp"

namespace sunder {

struct RubbleScratch::Buffers {
  FindScratch find;
  std::vector<MovingBody> moving;
  std::vector<RubblePatch> patches;
  std::vector<std::uint32_t> order;  ///< of patches in sweeps
  std::vector<char> pressed;         ///< row = body: in a patch
  std::vector<Vec3> velocity, spin;  ///< before contact, row = body
};

inline bool is_awake(const RubbleBody& body) { return body.mass > 0 && !body.asleep; }

/// A body as the tick has it.
MovingBody moving_of(const RubbleBody& body);

inline bool pushes(const RubblePatch& p) {
  return std::any_of(p.point.begin(), p.point.begin() + p.count,
                     [](const RubblePatch::Point& point) { return point.impulse > 0; });
}

/// One tick at work.
struct Tick {
  std::span<RubbleBody> bodies;
  std::span<const RubbleShape> shapes;
  std::span<const RubblePartner> partners;
  RubbleMemory& memory;
  const RubbleSettings& settings;
  RubbleScratch::Buffers& scratch;
  RubbleReport report;

  int sub_steps;  ///< of the whole tick

  double sub_step() const { return settings.length / sub_steps; }
};

/// Wakes bodies touched by others that are not still; after a blow, all bodies connected with them.
/// Gives whether any woke.
bool wake_touched(Tick& tick, double time);

/// Puts bodies to sleep that are still and touch only still bodies: a spinning body keeps its
/// neighbours awake and no others.
void put_to_sleep(Tick& tick);

}  // namespace sunder
