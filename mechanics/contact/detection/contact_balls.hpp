// SPDX-License-Identifier: MIT
// Spheres against faces and edges of pieces.
#pragma once

#include "mechanics/contact/detection/contact_detect.hpp"

namespace sunder {

/// Adds the contacts of spheres, driven and free, with faces and edges of pieces to
/// `scratch.found`. Vertices meet spheres as points meet any obstacle: a sphere touches the one
/// feature of the surface with the Voronoi region around its centre. The centre moves on a straight
/// line against each face. Sphere tracing finds the first touch at any speed.
/// A centre that begins inside a piece is led to the nearest face.
/// Needs: `scratch.surface` and `measure_balls`. `friction`: of the bodies. O(faces) for each
/// sphere.
void find_balls_on_pieces(DetectScratch& scratch, const StepPaths& paths, double friction);

}  // namespace sunder
