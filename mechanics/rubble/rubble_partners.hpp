// SPDX-License-Identifier: MIT
// Contact of faces that were one and still face each other. For the sources of this room only.
#pragma once

#include <vector>

#include "mechanics/rubble/rubble_find.hpp"

namespace sunder {

/// Notes in `scratch.facing` which partners still face each other: those that have neither parted
/// everywhere nor slid anywhere by their reach. O(partners). Needs: solids of `find_pairs`.
void find_facing(FindScratch& scratch, const FindInput& input);

/// Whether two shapes touch by faces that still face their partners and share a point of the mesh.
/// Their contact is then that of the partners.
bool touch_as_partners(const FindScratch& scratch, const FindInput& input, const RowPair& pair);

/// Appends a patch for each pair of partners that face each other and may touch: their corners,
/// with the gaps n . (x_A - x_B) along the mean normal n of the two faces.
void add_partner_patches(std::vector<RubblePatch>& patches, const FindScratch& scratch,
                         const FindInput& input);

}  // namespace sunder
