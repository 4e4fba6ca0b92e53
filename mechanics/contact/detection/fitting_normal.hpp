// SPDX-License-Identifier: MIT
// Normals of contacts at edges and corners that both surfaces allow.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mechanics/contact/detection/face_touch.hpp"

namespace sunder {

/// Adds the unit ways along the surface of a piece from a vertex, as the step begins.
void add_ways(std::vector<Vec3>& ways, const StepPaths& paths, const PieceSurface& surface,
              VertexId v);

/// By the Gauss map: whether a vertex, or corner of an obstacle, can come to rest on a face with
/// this normal: its surface goes against it by no more than an angle of about 3 degrees.
bool fits(const FaceTouch& touch, const StepPaths& paths, const PieceSurface& surface);

/// The normal of a contact, changed as little as two surfaces ask for. `ways`: unit, from the
/// contact along the surface of A, and against the surface of B; no way may go against the normal
/// by more than that angle. The ways that do so most are taken out of it, at most
/// two of them. Gives nothing where that does not help, or where the normal would turn by more than
/// about 84 degrees.
std::optional<Vec3> fitting_normal(const Vec3& normal, std::span<const Vec3> ways);

/// Turns the normal of a vertex that comes to an edge or a corner of another piece, where its own
/// surface does not allow the normal of the face: ridges that cross at a vertex push each other
/// along the direction across both. `rim`: m, how far from an edge, or within a face, is still on
/// it. Gaps follow. A touch that fits, one that lies deeper, or that nothing makes fit, stays.
void turn_to_fit(FaceTouch& touch, const StepPaths& paths, const PieceSurface& surface, double rim);

}  // namespace sunder
