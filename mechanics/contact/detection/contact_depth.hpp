// SPDX-License-Identifier: MIT
// How deep the solids of a contact overlap as a step ends.
#pragma once

#include "mechanics/contact/detection/contact_detect.hpp"

namespace sunder {

/// m, >= 0: how deep the two sides of a contact overlap at the predicted end of the step, at most
/// the depth in its tangent plane. A side that has slid off the face it touched overlaps nothing.
/// Spheres, and points against obstacles, by the distance of surfaces; points against tetrahedra by
/// whether they lie within; tetrahedra by the axis that parts them soonest.
double depth_at_end(const ContactPoint& contact, const StepPaths& paths);

}  // namespace sunder
