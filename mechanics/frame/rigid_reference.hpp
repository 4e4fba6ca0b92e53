// SPDX-License-Identifier: MIT
// The rigid reference of a component: mass-weighted shape matching (algorithm 2, eqs. 3 and 4).
#pragma once

#include <span>

#include "mechanics/state/columns.hpp"
#include "mechanics/state/component.hpp"
#include "mechanics/state/pose.hpp"

namespace sunder {

/// Algorithm 2 for one component: G = sum m x / sum m (eq. 3), the matrix
/// A = sum m (x - G) (x0 - c0)^T (eq. 4 with the masses it drops, and the component's own rest
/// centre c0), and its rotation. With these weights it is the mean-axis frame: the displacement
/// that is left has sum m d = 0 and sum m r0 x d = 0.
/// `positions`: |V|, m. Warm-started from `component.orientation`, exact all the same.
/// O(vertices of the component), 5 ns each. Collinear or coincident positions keep the part of the
/// last orientation that they do not determine.
Pose rigid_reference(const Component& component, const VertexColumns& vertices,
                     std::span<const Vec3> positions);

}  // namespace sunder
