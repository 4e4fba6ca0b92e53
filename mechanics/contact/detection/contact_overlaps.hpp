// SPDX-License-Identifier: MIT
// Tetrahedra of different pieces that overlap as a step ends, or pass each other in it.
#pragma once

#include "mechanics/contact/detection/contact_detect.hpp"

namespace sunder {

/// Share of an edge by which two pieces must overlap, or have overlapped in a step, to have passed
/// into each other.
inline constexpr double passing_share = 0.01;

/// Adds the contacts of tetrahedra of different pieces, and of spheres with pieces, that overlap at
/// the predicted end of the step to `scratch.found`. A contact has the axis that parts them soonest
/// (`collide`) and the corners of the patch between them. These contacts are for overlaps that
/// vertices, edges and faces on straight ways do not see: spins, bodies with more than one way in.
/// Overlaps below `allowed_penetration` twice and a thousandth of an edge are left alone (from the
/// third pass on, five thousandths). So are partners and pairs that begin deeper than 0.05 edges.
/// `pass`: number of passes solved; it is part of the contact's key. Needs: `scratch.surface`,
/// `scratch.facing`, `measure_balls`.
void find_overlaps(DetectScratch& scratch, const StepPaths& paths, const ContactSettings& settings,
                   std::uint8_t pass);

/// How far two pieces, or a sphere and a piece, move against each other in the step, where they do
/// not overlap as it begins and do so later in it by more than `passing_share` of the mean edge of
/// the smaller tetrahedron (of the radius of a smaller sphere). In such edges, the largest of all
/// pairs; 0: there are none. Frames turn evenly, vertices move evenly in them. An axis that parts
/// two tetrahedra at both ends of a time parts them in between, where corners move straight; else
/// the time is halved, until the motion left is below the share. Needs: as `find_overlaps`.
double find_passing(DetectScratch& scratch, const StepPaths& paths);

}  // namespace sunder
