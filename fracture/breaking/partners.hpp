// SPDX-License-Identifier: MIT
// Faces that came apart, as contact wants to know them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fracture/algorithms/fan_event.hpp"
#include "mechanics/contact/shapes/partner.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// Both sides of a face that is unsewn, or about to be: which corners meet.
Partner partner_of(const VolumeMap& map, HalfFaceId face, HalfFaceId opposite);

/// Appends the faces that fans have split, in their order.
void add_partners(std::vector<Partner>& partners, const VolumeMap& map,
                  std::span<const FanEvent> fans);

/// The faces of a body that was cut before it was simulated. `sewn`: `neighbours()` of its map
/// before that.
std::vector<Partner> partners_of_cuts(const VolumeMap& map,
                                      std::span<const std::array<HalfFaceId, 4>> sewn);

}  // namespace sunder
