// SPDX-License-Identifier: MIT
// Pairs of edges of different pieces that may meet: swept for one step, or kept for several.
#pragma once

#include "mechanics/contact/detection/contact_detect.hpp"

namespace sunder {

/// Sine of the angle between two faces, or two edges, below which they count as one plane or line.
inline constexpr double flat_sine = 0.02;

/// Whether a piece is convex at an edge, by more than about a degree, as the step begins.
bool is_sharp(const StepPaths& paths, const SurfaceEdge& edge);

/// Pairs of sharp edges of members by their boxes on their ways, wider by `margin` (m), for one
/// step: rows of `PieceSurface::edges`, into `scratch.swept`.
void find_swept_edges(DetectScratch& scratch, const StepPaths& paths, double margin);

/// Makes `scratch.near_edges` hold for the step: pairs of edges that are, or may become, sharp, by
/// their numbers, their boxes wider by `margin` (m); `scratch.edge_row` has their rows. Needs:
/// `keeps_pairs`.
void refresh_edges(DetectScratch& scratch, const StepPaths& paths, double margin);

/// m: how far two edges are apart as the step begins.
double distance_at_start(const StepPaths& paths, const SurfaceEdge& a, const SurfaceEdge& b);

}  // namespace sunder
