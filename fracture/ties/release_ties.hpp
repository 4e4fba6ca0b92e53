// SPDX-License-Identifier: MIT
// Ties that are spent: their faces come apart in the map of pieces, and pieces may come off.
#pragma once

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fracture_settings.hpp"
#include "fracture/ties/tie_release.hpp"
#include "mechanics/contact/contact.hpp"

namespace sunder {

/// Takes away the ties that are spent, in their order: each face is unsewn in the map of pieces,
/// where the oracle is asked and new components are identified (section 4.2), and its sides become
/// partners. Labels of `cells` follow; masses and frames are left to `rebuild`,
/// time and part of the release to the caller.
TieRelease release_ties(Cells& cells, ContactMemory& contact, Detection detection,
                        ComponentScratch& scratch);

}  // namespace sunder
