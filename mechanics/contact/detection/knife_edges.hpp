// SPDX-License-Identifier: MIT
// Flat surfaces of bodies on the edges and corners of boxes.
#pragma once

#include "mechanics/contact/detection/contact_detect.hpp"

namespace sunder {

/// Turns normals of contacts in `scratch.found` between vertices and boxes that no surface around
/// the vertex allows: a face of a body that lies on an edge of a box is pushed along its own
/// normal, and not along that of the side of the box which the vertex is nearest to. The new normal
/// is the old one without what goes against the surface. It must be a normal of the box where the
/// vertex touches it, within ten times `band` (m). Needs: `scratch.surface`.
void turn_to_flat_surfaces(DetectScratch& scratch, const StepPaths& paths, double band);

}  // namespace sunder
