// SPDX-License-Identifier: MIT
// Contact of crack faces that still face each other, vertex against vertex; no search.
#pragma once

#include "mechanics/contact/detection/contact_detect.hpp"

namespace sunder {

/// Forgets partners in different components that have parted or slid by their `reach` as the step
/// begins, where contacts of these are looked for (`StepPaths::scope`), and notes which vertices
/// face each other, into `scratch.facing`. In one component none is forgotten: nothing else keeps a
/// crack from closing through itself. O(partners).
void update_partners(ContactMemory& memory, DetectScratch& scratch, const StepPaths& paths);

/// Whether a node faces one of a tetrahedron: then their contact is that of partners.
bool faces(const DetectScratch& scratch, const SpherePair& pair, const StepPaths& paths);

/// Appends the contacts of partners to `scratch.found`, sorted by vertices, then face: the gap of
/// two vertices that were one is n . (x_A - x_B), n the mean normal of the faces they share, one
/// contact for all faces that lie in one plane (to 10 degrees).
void find_between_partners(DetectScratch& scratch, const ContactMemory& memory,
                           const StepPaths& paths, const ContactSettings& settings);

}  // namespace sunder
