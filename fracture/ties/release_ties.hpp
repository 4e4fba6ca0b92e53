// SPDX-License-Identifier: MIT
// Ties that are spent: their faces come apart in the map of pieces, and pieces may come off.
#pragma once

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fracture_settings.hpp"
#include "fracture/ties/tie_release.hpp"
#include "mechanics/contact/contact.hpp"

namespace sunder {

/// Takes away spent ties, in their order: each face is unsewn in the map of pieces, and its sides
/// become partners. There the oracle is evaluated and new components are identified (section 4.2).
/// Labels of `cells` follow. Masses and frames are left to `rebuild`, time and part of the release
/// to the caller.
TieRelease release_ties(Cells& cells, ContactMemory& contact, Detection detection,
                        ComponentScratch& scratch);

}  // namespace sunder
