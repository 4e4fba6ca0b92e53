// SPDX-License-Identifier: MIT
// Tetrahedra of different pieces, and spheres, that may meet on their ways; how far axes part them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mechanics/contact/detection/contact_detect.hpp"

namespace sunder {

/// m: the corners of a tetrahedron.
using Places = std::array<Vec3, 4>;

/// The corners of a tetrahedron at the predicted end of the step.
Places places_at_end(const StepPaths& paths, TetId t);

double mean_edge(const Places& x);

/// The box around the corners.
Bounds bounds_of(const Places& x);

/// A bit for each face of a tetrahedron that is on the surface.
std::uint32_t outer_faces(const StepPaths& paths, TetId t);

/// Row = component: whether all its pairs are looked for (`BoxQuery::moves`).
void mark_inside(std::vector<char>& moves, const StepPaths& paths);

/// m: the largest distance of an arc of an angle (rad) from its chord, on a circle of radius `arm`.
double sagitta(double angle, double arm);

/// The rotation from one orientation to another by its vector, rad times axis, at most half a turn.
Vec3 turn_between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to);

/// Pairs of tetrahedra on the surfaces of different pieces that may meet on their ways, into
/// `scratch.solid_pairs`. Needs: `scratch.surface`, `measure_balls`.
void pair_on_ways(DetectScratch& scratch, const StepPaths& paths);

/// Whether pairs are kept for the next steps: vertices go little, and everything is searched.
bool keeps_pairs(const DetectScratch& scratch, const StepPaths& paths);

/// Ways, shapes and margin for kept pairs. Needs: `update_near`.
NearQuery near_query(const DetectScratch& scratch);

/// Ways of components, and shapes where the surface has changed. A search of some components keeps
/// no pairs, and needs neither. Needs: `scratch.surface`.
void update_near(DetectScratch& scratch, const StepPaths& paths);

/// Makes `scratch.near_solids` hold for the step: pairs of tetrahedra on the surfaces of different
/// pieces. Needs: `keeps_pairs`.
void refresh_solids(DetectScratch& scratch, const StepPaths& paths);

/// Pairs of tetrahedra on the surfaces of different pieces with boxes that meet as the step ends,
/// by their numbers, into `scratch.swept`.
void pair_at_end(DetectScratch& scratch, const StepPaths& paths);

/// Tetrahedra of members with their boxes as the step ends, into `scratch.solid_pairs`.
void box_at_end(DetectScratch& scratch, const StepPaths& paths);

/// Whether two tetrahedra have crack faces that still face each other.
bool are_partners(const DetectScratch& scratch, const StepPaths& paths, TetId a, TetId b);

/// m: the largest gap along one axis at both of two moments: between the first two tetrahedra, and
/// between the last two, which are the same later. Over all axes of both moments, faces and then
/// pairs of edges, until one parts them by more than `enough`. Negative where they overlap at one
/// of the moments along each axis.
double common_gap(const Places& a, const Places& b, const Places& c, const Places& d,
                  double enough);

/// A sphere on its way, by the row of its obstacle.
struct BallWay {
  std::uint32_t row = 0;
  Vec3 start, end;    ///< m, of the centre
  double radius = 0;  ///< m

  Vec3 at(double part) const { return (1 - part) * start + part * end; }
};

/// Spheres among the members, driven ones too.
std::vector<BallWay> moving_balls(const StepPaths& paths);

/// Calls `visit(tetrahedron)` for each of `pairs` with a box that a ball may come to.
template <class Visit>
void for_each_near(const SolidPairs& pairs, const BallWay& ball, Visit visit) {
  const Vec3 r = Vec3::Constant(ball.radius);
  const Bounds box{ball.start - r, ball.start + r};
  for (std::size_t k = 0; k < pairs.tetrahedra.size(); ++k) {
    if (meet(box, pairs.boxes[k], ball.end - ball.start - pairs.ways[k])) {
      visit(pairs.tetrahedra[k]);
    }
  }
}

}  // namespace sunder
