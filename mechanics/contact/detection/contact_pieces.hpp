// SPDX-License-Identifier: MIT
// Contacts between pieces: vertices against faces of their surfaces.
#pragma once

#include "mechanics/contact/detection/contact_detect.hpp"

namespace sunder {

/// Appends the contacts of pieces to `scratch.found`, by their surfaces as they move through the
/// step, corners on straight lines: one for each vertex and component. A vertex outside meets the
/// face that its path crosses, of several the one that it ends deepest behind; a vertex inside goes
/// out by the nearest face. Faces on which the vertex could come to rest (by the Gauss map: no edge
/// of it points into the face) are taken before others.
/// Not found: edges that meet between their vertices. Then a vertex enters later.
/// Corners of obstacles (`StepPaths::corner`) are vertices like others, and the only ones unless
/// `among_pieces`. Partners are left out: `find_between_partners` has them. Needs:
/// `StepPaths::neighbours`, `measure_balls` with share 1.
void find_between_pieces(DetectScratch& scratch, const StepPaths& paths,
                         const ContactSettings& settings, bool among_pieces);

}  // namespace sunder
