// SPDX-License-Identifier: MIT
// The step with contact: predict, find, solve, predict again, adopt.
#include "mechanics/contact/contact.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/contact/contact_step.hpp"
#include "mechanics/contact/detection/contact_depth.hpp"
#include "mechanics/contact/detection/contact_overlaps.hpp"
#include "mechanics/contact/detection/contact_partners.hpp"
#include "mechanics/contact/response/contact_bounce.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/contact/waves/explicit_wave.hpp"
#include "mechanics/state/living.hpp"
#include "topology/base/sort_unique.hpp"

namespace sunder {

ContactScratch::Buffers::Buffers() = default;
ContactScratch::Buffers::~Buffers() = default;
ContactScratch::ContactScratch() : buffers(std::make_unique<Buffers>()) {}
ContactScratch::~ContactScratch() = default;
ContactScratch::ContactScratch(ContactScratch&&) noexcept = default;
ContactScratch& ContactScratch::operator=(ContactScratch&&) noexcept = default;

StepPaths paths_of(const ContactStep& step) {
  const MechanicsScratch::Predicted& predicted = step.pass.mechanics.predicted;
  StepPaths paths{step.pass.state, step.pass.input.corners, predicted.position,
                  predicted.frame, step.pass.obstacles,     step.scratch.ball_end,
                  step.h(),        step.pass.input.members, step.pass.input.neighbours};
  if (step.ahead > 0) paths.time_step = step.ahead;
  paths.margin = step.margin;
  paths.scope = step.scope;
  return paths;
}

std::array<Vec3, 2> surface_load(const ContactStep& step, const Component& component) {
  std::array<Vec3, 2> sum = {Vec3::Zero(), Vec3::Zero()};
  const std::vector<Vec3>& force = step.pass.input.loads.force;
  if (force.empty()) return sum;
  for (const VertexId v : component.vertices) {
    const Vec3& f = force[v.index()];
    sum[0] += f;
    sum[1] += (step.pass.state.vertices.position[v.index()] - component.centre).cross(f);
  }
  return sum;
}

namespace {

void move_obstacles(ContactStep& step) {
  const Vec3 fall = step.h() * step.pass.input.loads.gravity;
  for (std::size_t k = 0; k < step.pass.obstacles.size(); ++k) {
    Obstacle& obstacle = step.pass.obstacles[k];
    if (!obstacle.mass) {
      translate(obstacle.shape, step.h() * obstacle.velocity);
    } else if (step.pass.input.members.has_ball(k) && !step.is_wave()) {
      const Vec3 momentum = angular_momentum_of(obstacle);
      put(obstacle.shape, step.scratch.ball_end[k]);
      if (!is_sphere(obstacle)) obstacle.spin = spin_of(obstacle, momentum);
      if (!step.scratch.blows.ball_touched[k]) obstacle.velocity += fall;
    }
  }
  if (step.is_wave()) move_free_obstacles(step);
}

void count_contacts(ContactStep& step) {
  ContactReport& report = step.report;
  report.candidates = static_cast<std::uint32_t>(step.contacts.size());
  if (step.contacts.empty()) return;
  report.obstacle_impulse.assign(step.pass.obstacles.size(), Vec3::Zero());
  const StepPaths paths = paths_of(step);
  for (const ContactPoint& contact : step.contacts) {
    // No solid is deeper than the tangent plane says.
    if (-gap_end(contact, path_of(contact, paths)) <= report.deepest) continue;
    report.deepest = std::max(report.deepest, depth_at_end(contact, paths));
  }
  report.left_out = step.scratch.left_out.size();
  for (const ContactPoint& contact : step.scratch.left_out) {
    report.deepest = std::max(report.deepest, depth_at_end(contact, paths));
  }
}

void sum_impulses(ContactStep& step) {
  for (const ContactPoint& contact : step.contacts) {
    ++step.report.contacts;
    if (contact.obstacle != ContactPoint::none) {
      step.report.obstacle_impulse[contact.obstacle] += contact.impulse;
    }
    if (contact.ball != ContactPoint::none) {
      step.report.obstacle_impulse[contact.ball] -= contact.impulse;
    }
  }
}

/// How surface loads accelerate and turn free components.
void note_loads(ContactStep& step) {
  step.scratch.load_acceleration.clear();
  const MechanicsState& state = step.pass.state;
  if (step.pass.input.loads.force.empty()) return;
  step.scratch.load_acceleration.resize(state.components.size(), {Vec3::Zero(), Vec3::Zero()});
  for_each_living(state, step.pass.input.members, [&](const Component& component) {
    if (component.supported) return;
    const auto [sum, moment] = surface_load(step, component);
    if (sum.isZero(0) && moment.isZero(0)) return;
    step.scratch.load_acceleration[component.id.index()] = {
        sum / component.mass, world_inertia(state, component).inverse() * moment};
  });
}

/// As many rows in the scratch as the step needs, and a first prediction.
void begin_step(ContactStep& step) {
  ContactScratch::Buffers& scratch = step.scratch;
  MechanicsState& state = step.pass.state;
  const std::size_t balls = step.pass.obstacles.size();
  scratch.blows.component_touched.assign(state.components.size(), 0);
  scratch.blows.ball_touched.assign(balls, 0);
  scratch.left_out.clear();
  const StepInput& input = step.pass.input;
  if (step.is_wave()) return predict(step.pass.mechanics, state, input, {});
  scratch.blows.vertex_impulse.assign(state.vertices.size(), Vec3::Zero());
  note_loads(step);
  prepare(state, input);
  begin_ties(step);
  for_each_living(state, input.members, [&](const Component& component) {
    predict(step.pass.mechanics, state, input, {&component.id, 1});
  });
  if (input.members.component.empty()) return;
  // Components outside the step stay in place. Their predicted rows are needed also where no member
  // is active.
  predict(step.pass.mechanics, state, input, {});
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    if (input.members.has(state.vertices.component[v])) continue;
    step.pass.mechanics.predicted.position[v] = state.vertices.position[v];
  }
}

std::vector<Vec3> finish_explicit_contacts(ContactStep& step) {
  const std::vector<LumpedRow>& rows = step.scratch.wave->contacts.rows;
  std::vector<Vec3> moments;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < step.contacts.size(); ++k) {
    if (step.contacts[k].impulse.isZero(0)) continue;
    step.contacts[kept++] = step.contacts[k];
    moments.push_back(rows[k].moment);
  }
  step.contacts.resize(kept);
  return moments;
}

/// Before the bodies are adopted: drops contacts without an impulse, and gives the moments of the
/// others.
std::vector<Vec3> finish_contacts(ContactStep& step) {
  if (step.is_wave()) return finish_explicit_contacts(step);
  std::erase_if(step.contacts, [](const ContactPoint& c) { return c.impulse.isZero(0); });
  std::vector<Vec3> moments;
  for (const ContactPoint& c : step.contacts) {
    moments.push_back(place_of_side_a(step.pass, c).cross(c.impulse));
  }
  return moments;
}

/// The damping of explicit steps: the work of stress against motion, less the change of strain
/// energy.
void take_off_strain(StepStatus& status, const MechanicsState& state, const StepInput& input) {
  if (!input.measures_strain) return;
  for_each_living(state, input.members, [&](const Component& component) {
    if (!deforms_in_wave(component)) return;
    status.damping_work -= component.strain_change.after - component.strain_change.before;
  });
}

/// The impulses that a bounce took back or gave act at the end of the part.
void take_back_bounce(std::vector<Vec3>& moments, ContactStep& step) {
  std::vector<Vec3> before;
  for (const ContactPoint& c : step.contacts) before.push_back(c.impulse);
  take_back_bounce(step.contacts, step.scratch.bodies, step.pass, step.settings);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const ContactPoint& c = step.contacts[k];
    moments[k] += place_of_side_a(step.pass, c).cross(c.impulse - before[k]);
  }
}

/// After the bodies were adopted: balls, bounces, memory.
void end_step(ContactStep& step, std::vector<Vec3>& moments, bool fine) {
  move_obstacles(step);
  const bool bounces =
      step.settings.method == ContactMethod::impulses &&
      (step.deformation() == Deformation::whole || step.deformation() == Deformation::catch_up);
  if (fine && bounces) take_back_bounce(moments, step);
  sum_impulses(step);
  remember_contacts(step);
}

}  // namespace

void add_contact(ContactReport& sum, const ContactReport& part) {
  add_part(sum, part);
  if (part.residual - part.tolerated >= sum.residual - sum.tolerated) {
    sum.residual = part.residual;
    sum.tolerated = part.tolerated;
    sum.force_error = part.force_error;
  }
  sum.converged = sum.converged && part.converged;
  const std::size_t obstacles = std::max(sum.obstacle_impulse.size(), part.obstacle_impulse.size());
  sum.obstacle_impulse.resize(obstacles, Vec3::Zero());
  for (std::size_t k = 0; k < part.obstacle_impulse.size(); ++k) {
    sum.obstacle_impulse[k] += part.obstacle_impulse[k];
  }
}

ContactStepResult advance_with_contact(const ContactWorld& world, const StepInput& asked,
                                       const ContactSettings& settings,
                                       const ContactStepScratch& scratch) {
  IntegratorSettings integrator = asked.settings;
  const StepInput input = with_settings(asked, integrator);
  ContactStep step{{input, world.state, world.obstacles, scratch.mechanics},
                   integrator,
                   world.memory,
                   settings,
                   *scratch.contact.buffers,
                   {},
                   {},
                   {}};
  begin_step(step);
  if (!step.is_wave()) predict_balls(step);
  ContactStepResult result;
  if (settings.method == ContactMethod::penalty) {
    push_by_penalty(step);
    predict_balls(step);
  } else {
    if (step.is_wave()) {
      take_explicit_part(step);
    } else {
      update_partners(world.memory, step.scratch.detect, paths_of(step));
      remember_start(step);
      result.adopted = resolve(step);
    }
    if (result.adopted) result.passing_way = way_of_passing(step);
    result.adopted = result.adopted && result.passing_way == 0;
    if (!result.adopted) put_back(step);
  }
  if (result.adopted) {
    result.ties = step.is_wave() ? finish_explicit_ties(step) : finish_ties(step);
    count_contacts(step);
    if (step.is_wave() && input.part.impact) feel_blows(step);
    // Where ties open, waves run: as if it were struck.
    const std::vector<ComponentId>& torn = result.ties.torn;
    step.blows.struck.insert(step.blows.struck.end(), torn.begin(), torn.end());
    sort_unique(step.blows.struck);
    result.moments = finish_contacts(step);
    result.status = adopt(world.state, scratch.mechanics, input);
    if (step.is_wave()) take_off_strain(result.status, world.state, input);
    result.trace = std::move(step.trace);
    result.sub_steps = step.sub_steps;
    result.length = step.h();
    end_step(step, result.moments, result.status.outcome == StepOutcome::fine);
    if (step.report.candidates > 0 || !step.ties.empty()) {
      result.touched = step.scratch.blows.component_touched;
      result.ball_touched = step.scratch.blows.ball_touched;
    }
  }
  result.blows = std::move(step.blows);
  result.report = std::move(step.report);
  result.contacts = std::move(step.contacts);
  return result;
}

}  // namespace sunder
