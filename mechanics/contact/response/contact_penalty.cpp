// SPDX-License-Identifier: MIT
// Contact as the paper has it: obstacles and the balls of tetrahedra are force fields.
#include <algorithm>

#include "mechanics/contact/contact_step.hpp"
#include "mechanics/contact/shapes/nearest_point.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "topology/base/assert.hpp"

namespace sunder {
namespace {

/// Adds the contact where the step begins with an overlap.
void add_overlap(ContactStep& step, ContactPoint contact, const SurfaceDistance& at) {
  if (!(at.gap < 0)) return;
  contact.normal = at.normal;
  contact.gap_start = at.gap;
  contact.offset = at.gap - at.normal.dot(path_of(contact, paths_of(step)).start);
  step.contacts.push_back(contact);
}

void find_in_obstacles(ContactStep& step) {
  const std::vector<Obstacle>& obstacles = step.pass.obstacles;
  const std::vector<Vec3>& position = step.pass.state.vertices.position;
  for (std::uint32_t row = 0; row < obstacles.size(); ++row) {
    ContactPoint contact{.obstacle = row};
    contact.friction = 0.5 * (step.settings.friction + obstacles[row].friction);
    for (std::size_t v = 0; v < position.size(); ++v) {
      contact.vertex = VertexId{v};
      add_overlap(step, contact, surface_distance(obstacles[row].shape, position[v]));
    }
  }
}

void find_balls(ContactStep& step) {
  const std::vector<Obstacle>& obstacles = step.pass.obstacles;
  for (std::uint32_t a = 0; a < obstacles.size(); ++a) {
    if (!obstacles[a].mass || !is_sphere(obstacles[a])) continue;
    const Sphere& ball = std::get<Sphere>(obstacles[a].shape);
    for (std::uint32_t b = 0; b < obstacles.size(); ++b) {
      if (a == b || (obstacles[b].mass && b < a)) continue;
      SurfaceDistance at = surface_distance(obstacles[b].shape, ball.center);
      at.gap -= ball.radius;
      add_overlap(step,
                  {.ball = a,
                   .obstacle = b,
                   .friction = 0.5 * (obstacles[a].friction + obstacles[b].friction)},
                  at);
    }
  }
}

/// Every vertex in every ball of other components, those that have just come apart too.
void find_between_pieces(ContactStep& step) {
  DetectScratch& detect = step.scratch.detect;
  const StepPaths paths = paths_of(step);
  const MechanicsState& state = step.pass.state;
  measure_balls(detect, paths, step.settings.ball_share);
  find_sphere_pairs(detect.pairs, detect.grid, detect.cache,
                    {state.vertices.position, state.vertices.component, detect.centre_start,
                     detect.radius, state.elements.component});
  for (const SpherePair& pair : detect.pairs) {
    const std::size_t t = pair.tetrahedron.index();
    const Vec3& place = state.vertices.position[pair.vertex.index()];
    ContactPoint contact{.vertex = pair.vertex, .tetrahedron = pair.tetrahedron};
    contact.weights =
        weights_on(contact, nearest_point(places_of(paths.corners[t], paths), place), paths);
    contact.friction = step.settings.friction;
    add_overlap(step, contact,
                surface_distance(Sphere{detect.centre_start[t], detect.radius[t]}, place));
  }
}

/// Velocity of side A against the matter of side B at the same place, m/s.
Vec3 relative_velocity(const ContactStep& step, const ContactPoint& contact) {
  const VertexColumns& vertices = step.pass.state.vertices;
  const std::vector<Obstacle>& obstacles = step.pass.obstacles;
  const Vec3 place = place_of_side_a(step.pass, contact);
  const Vec3 velocity = contact.ball == ContactPoint::none
                            ? vertices.velocity[contact.vertex.index()]
                            : surface_velocity(obstacles[contact.ball], place);
  if (contact.obstacle != ContactPoint::none) {
    return velocity - surface_velocity(obstacles[contact.obstacle], place);
  }
  return velocity -
         touched_nodes(contact, step.pass.state, step.pass.input.corners).sum(vertices.velocity);
}

/// Of spring and damper on side A, N.
Vec3 force_of(const ContactStep& step, const ContactPoint& contact) {
  const Vec3 velocity = relative_velocity(step, contact);
  const double approach = contact.normal.dot(velocity);
  const double pressed = std::max(0.0, -step.settings.penalty_stiffness * contact.gap_start -
                                           step.settings.penalty_damping * approach);
  const Vec3 slip = velocity - approach * contact.normal;
  Vec3 brake = step.settings.penalty_damping * slip;
  const double most = contact.friction * pressed;
  if (brake.norm() > most) brake *= most / brake.norm();
  return pressed * contact.normal - brake;
}

}  // namespace

void push_by_penalty(ContactStep& step) {
  SUNDER_ASSERT(step.deformation() == Deformation::whole && !step.pass.input.part.impact &&
                    step.pass.input.members.component.empty(),
                "penalty: whole steps of everything");
  find_in_obstacles(step);
  find_balls(step);
  if (step.settings.between_pieces) find_between_pieces(step);
  wake_touched(step);
  if (step.contacts.empty()) return;
  step.scratch.change.clear();
  for (ContactPoint& contact : step.contacts) {
    contact.impulse = step.h() * force_of(step, contact);
    step.scratch.change.push_back(contact.impulse);
  }
  gather_rows(step.scratch.bodies, step.contacts, step.pass);
  apply_changes(step.scratch.blows, step.scratch.bodies, step.scratch.change, step.pass);
  predict_touched(step.scratch.blows, step.pass);
  step.report.passes = 1;
}

}  // namespace sunder
