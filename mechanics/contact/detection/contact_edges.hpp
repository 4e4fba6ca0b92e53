// SPDX-License-Identifier: MIT
// Edges against edges: of pieces, boxes and meshes.
#pragma once

#include "mechanics/contact/detection/contact_detect.hpp"

namespace sunder {

/// Adds the contacts of edges of pieces with edges of other pieces, boxes and meshes to
/// `scratch.found`. The lines of two edges come to touch within both, along a normal that fits the
/// faces at either of them (the arcs of their faces on the Gauss map cross). Where an edge is flat,
/// or lies within a piece, faces and vertices are enough. The ends of an edge are left to its
/// vertices, and edges that begin deeper than ten times `allowed_penetration` to the overlaps
/// (`find_overlaps`). Edges of partners (crack faces that still face each other) are left out.
/// Needs: `scratch.surface`, `scratch.facing`; `reach`: of all vertices. O(edges + pairs).
void find_between_edges(DetectScratch& scratch, const StepPaths& paths,
                        const ContactSettings& settings, const VertexReach& reach);

/// Adds the contacts of edges of free boxes and meshes with edges of other boxes and meshes, by the
/// same rule.
void find_edges_of_obstacles(DetectScratch& scratch, const StepPaths& paths,
                             const ContactSettings& settings);

/// Whether an edge of a box or mesh comes within reach of the vertices.
bool has_obstacle_edges(const StepPaths& paths, const VertexReach& reach);

}  // namespace sunder
