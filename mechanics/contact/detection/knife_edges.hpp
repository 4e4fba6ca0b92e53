// SPDX-License-Identifier: MIT
// Flat surfaces of bodies on the edges and corners of boxes.
#pragma once

#include "mechanics/contact/detection/contact_detect.hpp"

namespace sunder {

/// Turns normals of contacts in `scratch.found` between vertices and obstacles with edges that no
/// surface around the vertex allows. A face of a body that lies on an edge of a box is pushed along
/// its own normal, and not along that of the side of the box that the vertex is nearest to. The new
/// normal is the old one without its part against the surface. It must be a normal of the obstacle
/// where the vertex touches it, within ten times `band` (m). Makes `scratch.surface`.
void turn_to_flat_surfaces(DetectScratch& scratch, const StepPaths& paths, double band);

}  // namespace sunder
