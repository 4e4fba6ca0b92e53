// SPDX-License-Identifier: MIT
// The start of a step, kept in case that the step is not taken.
#include <algorithm>
#include <limits>

#include "mechanics/contact/contact_step.hpp"
#include "mechanics/contact/detection/contact_overlaps.hpp"
#include "mechanics/contact/detection/pairs/solid_pairs.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"

namespace sunder {

void remember_start(ContactStep& step) {
  StepStart& start = step.scratch.start;
  const MechanicsState& state = step.pass.state;
  start.momenta.clear();
  start.rungs.clear();
  for (const Component& c : state.components) {
    start.momenta.push_back({c.momentum, c.angular_momentum});
    start.rungs.push_back(c.rung);
  }
  start.obstacles = step.pass.obstacles;
  if (!is_floating(step.pass.input.settings.integrator)) start.velocity = state.vertices.velocity;
}

void put_back(ContactStep& step) {
  const StepStart& start = step.scratch.start;
  MechanicsState& state = step.pass.state;
  for (Component& c : state.components) {
    c.momentum = start.momenta[c.id.index()][0];
    c.angular_momentum = start.momenta[c.id.index()][1];
    c.rung = start.rungs[c.id.index()];
  }
  step.pass.obstacles = start.obstacles;
  if (!is_floating(step.pass.input.settings.integrator)) state.vertices.velocity = start.velocity;
}

namespace {

/// Row = vertex: a tetrahedron of it, the first.
std::vector<TetId> tetrahedra_of_vertices(const StepPaths& paths) {
  std::vector<TetId> first(paths.predicted.size());
  for (std::size_t t = paths.corners.size(); t-- > 0;) {
    for (const VertexId v : paths.corners[t]) first[v.index()] = TetId{t};
  }
  return first;
}

/// Where a gap ends farther from where it may be than `passing_share` of the mean edge of a
/// tetrahedron, or of the radius of a sphere, that meets there: the longest way of such a contact,
/// in these; else 0. Then bodies turn farther in the step than the response to impulses allows for.
double way_of_far_off(const ContactStep& step) {
  double longest = 0;
  if (step.report.residual <= step.report.tolerated) return longest;
  const StepPaths paths = paths_of(step);
  const std::vector<TetId> first = tetrahedra_of_vertices(paths);
  for (std::size_t k = step.tied_rows; k < step.contacts.size(); ++k) {
    const ContactPoint& c = step.contacts[k];
    double size = std::numeric_limits<double>::infinity();
    const TetId of_vertex = c.vertex.is_none() ? TetId::none() : first[c.vertex.index()];
    for (const TetId t : {of_vertex, c.tetrahedron_a, c.tetrahedron}) {
      if (!t.is_none())
        size = std::min(size, mean_edge(places_of(paths.corners[t.index()], paths)));
    }
    if (c.is_sphere_a()) size = std::min(size, radius_of(step.pass.obstacles[c.ball].shape));
    if (!(row_error(step.scratch.bodies.rows[k]) > passing_share * size)) continue;
    const ContactPath path = path_of(c, paths);
    longest = std::max(longest, (path.end - path.start).norm() / size + passing_share);
  }
  return longest;
}

}  // namespace

double way_of_passing(ContactStep& step) {
  if (!step.pass.input.part.divides) return 0;
  const double way = way_of_far_off(step);
  const StepPaths paths = paths_of(step);
  if (way > 0 || !may_overlap(paths, step.settings)) return way;
  return find_passing(step.scratch.detect, paths);
}

}  // namespace sunder
