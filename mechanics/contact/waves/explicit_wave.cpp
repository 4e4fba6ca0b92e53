// SPDX-License-Identifier: MIT
// Explicit steps of a part of an impact.
#include "mechanics/contact/waves/explicit_wave.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/frame/rotation.hpp"
#include "mechanics/integrators/model_force.hpp"
#include "mechanics/integrators/rigid_motion.hpp"
#include "mechanics/measure_elements.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "mechanics/state/living.hpp"

namespace sunder {
namespace {

/// Impulses of contacts and bonds with a kick, until a sweep changes no velocity by more than
/// `tolerance` (m/s) and no bond is off its law.
void solve_impulses(WaveScratch& wave, ContactStep& step, const RowStep& row_step,
                    double tolerance) {
  WaveNodes& nodes = wave.bodies.nodes;
  begin_rows(wave.contacts, nodes, row_step);
  begin_bonds(wave.bonds, step.ties, nodes, row_step);
  constexpr int sweeps_of_bonds = 400;
  double error = 0;
  std::array<double, 2> off{};
  int sweeps = 0;
  do {
    // Without bonds all sweeps are of contacts; else one after each of bonds.
    const int most = step.ties.empty() ? step.settings.max_iterations : sweeps + 1;
    error = relax_rows(wave.contacts, nodes, row_step.length, {tolerance, most}, sweeps);
    off = sweep_bonds(wave.bonds, step.ties, nodes, row_step, tie_tolerance, sweeps_of_bonds);
    // Bonds that contacts have not moved are solved for.
    if (wave.contacts.rows.empty()) break;
  } while ((error > tolerance || off[0] > tie_tolerance) && sweeps < step.settings.max_iterations);
  for (const WaveBody& body : wave.bodies.bodies) follow_supports(wave.bodies, body);
  settle_rows(wave.contacts, wave.bodies);
  settle_bonds(wave.bonds, step.ties, wave.bodies, wave.contacts, row_step);
  step.report.iterations += sweeps;
  step.report.residual = std::max(step.report.residual, row_step.length * error);
  step.report.converged = step.report.converged && error <= tolerance;
  step.tie_residual = std::max(step.tie_residual, off[1]);
}

/// `StepInput::ends` for the part as it is after `elapsed` s. Needs: `find_forces`.
bool ends_here(WaveScratch& wave, ContactStep& step, double elapsed) {
  const StepInput& input = step.pass.input;
  MechanicsState& state = step.pass.state;
  if (wave.stress.empty()) {
    wave.stress = state.elements.stress;
    wave.corner_stress = state.elements.corner_stress;
  }
  std::vector<char> deforms(state.components.size(), 0);
  for (const WaveBody& body : wave.bodies.bodies) {
    deforms[body.id.index()] = 1;
    for (std::size_t i = body.first_node; i < body.end_node; ++i) {
      const std::size_t v = wave.bodies.nodes.vertex[i].index();
      state.vertices.displacement[v] = row_of(wave.bodies.nodes.displacement, i);
    }
  }
  measure_elements(state, step.pass.mechanics, input.corners,
                   {{.component = deforms, .ball = {}}, input.settings.model});
  const double start = state.time;
  state.time += elapsed;
  const bool ends = (*input.ends)();
  state.time = start;
  return ends;
}

/// The stresses with which the part began: `adopt` measures the change of strain energy from them.
void put_back_stresses(WaveScratch& wave, MechanicsState& state) {
  if (wave.stress.empty()) return;
  state.elements.stress.swap(wave.stress);
  state.elements.corner_stress.swap(wave.corner_stress);
  wave.stress.clear();
}

/// Bodies and rigid pieces as the impulses of a step find them: with their weight, loads and forces
/// of `length` s.
void kick_all(WaveScratch& wave, double length) {
  WaveBodies& bodies = wave.bodies;
  if (bodies.measures_work) bodies.velocity_before = bodies.nodes.velocity;
  for (WaveBody& body : bodies.bodies) kick(bodies, body, length);
  for (WaveRigid& body : wave.contacts.rigid) {
    body.velocity_before = body.velocity;
    body.spin_before = body.spin;
    body.velocity += length * (body.fall + body.inverse_mass * body.push);
    body.spin += body.inverse_inertia * (length * body.torque);
    body.twist += length * body.torque;
    body.weight_place += length * body.centre;
    body.loads += impulse_at(body.centre, length * body.push);
    body.loads.tail<3>() += length * body.torque;
  }
}

/// Adds the works of a kick of `length` s, once its impulses are known.
void measure_works(WaveScratch& wave, double length) {
  if (!wave.bodies.measures_work) return;
  for (WaveBody& body : wave.bodies.bodies) measure_work(wave.bodies, body);
  if (!wave.bodies.has_loads) return;
  for (const WaveRigid& body : wave.contacts.rigid) {
    // Supports take the work of loads on the bodies that they lead.
    if (body.inverse_mass == 0) continue;
    wave.contacts.work.loads += 0.5 * length *
                                (body.push.dot(body.velocity_before + body.velocity) +
                                 body.torque.dot(body.spin_before + body.spin));
  }
}

void drift_all(WaveScratch& wave, double h) {
  for (WaveBody& body : wave.bodies.bodies) drift(wave.bodies, body, h);
  for (WaveRigid& body : wave.contacts.rigid) {
    body.centre += h * body.velocity;
    body.turned += h * body.spin;
    body.since_turn += h;
  }
}

/// The steps of a part.
struct StepCount {
  int all = 1;          ///< of the part
  int in_sub_step = 1;  ///< between two questions whether it ends
};

/// rad/s: the change of spin that an angular impulse makes of a body where its nodes are now.
Vec3 spin_of_twist(const WaveNodes& nodes, const WaveBody& body, const Vec3& twist) {
  if (body.supported || twist.isZero(0)) return Vec3::Zero();
  return solve3(inertia_of(nodes, body), twist);
}

/// The moments that the nodes of a body did not get turn it as a whole. Needs: its frame where the
/// nodes are (`find_forces`).
void give_twist(WaveScratch& wave, std::size_t b) {
  WaveNodes& nodes = wave.bodies.nodes;
  const WaveBody& body = wave.bodies.bodies[b];
  const Vec3 spin = spin_of_twist(nodes, body, wave.contacts.twist[b]);
  wave.contacts.twist[b].setZero();
  if (spin.isZero(0)) return;
  for (std::size_t i = body.first_node; i < body.end_node; ++i) {
    auto v = row_of(nodes.velocity, i);
    const Vec3 by_twist = spin.cross(row_of(nodes.position, i) - body.frame.centre);
    wave.contacts.work.contact += nodes.mass[i] * by_twist.dot(v + 0.5 * by_twist);
    v += by_twist;
  }
}

/// rad: rigid bodies turn so far before contacts on them turn along.
constexpr double small_turn = 0.01;

/// Velocity Verlet over the part: kicks with their impulses, and drifts between them. At both ends
/// of the part there is half a kick, with half of the impulses. Gives the number of steps taken.
int run_steps(WaveScratch& wave, ContactStep& step, StepCount count) {
  const double h = step.h() / count.all;
  WaveBodies& bodies = wave.bodies;
  // A gap that is off by so much over a step counts as solved for.
  const double tolerance = 1e-3 * step.settings.allowed_penetration / h;
  const bool asks = step.pass.input.ends && count.in_sub_step < count.all;
  double last = 1;
  int end = count.all;
  for (int k = 0; k <= end; ++k) {
    const bool is_between = k > 0 && k % count.in_sub_step == 0;
    for (WaveBody& body : bodies.bodies) find_forces(bodies, body);
    turn_rigid(wave.contacts, is_between || k == end ? 0 : small_turn);
    for (std::size_t b = 0; is_between && b < bodies.bodies.size(); ++b) give_twist(wave, b);
    const bool may_end = asks && is_between && k < end;
    if (may_end && ends_here(wave, step, k * h)) end = k;
    const double share = k == 0 || k == end ? 0.5 : 1;
    kick_all(wave, share * h);
    measure_gaps(wave.contacts, bodies.nodes, k * h);
    solve_impulses(wave, step, {h, share, share / last, k < end}, tolerance);
    last = share;
    measure_works(wave, share * h);
    if (k < end) drift_all(wave, h);
  }
  put_back_stresses(wave, step.pass.state);
  step.report.tolerated = h * tolerance;
  ++step.report.passes;
  return end;
}

/// The part was so many of its sub-steps long.
void shorten(ContactStep& step, std::uint32_t taken) {
  const std::uint32_t all = step.pass.input.part.sub_steps;
  step.sub_steps = taken;
  if (taken == all) return;
  step.integrator.time_step *= static_cast<double>(taken) / all;
}

/// Rows of a body, and its frame.
void write_body(WaveScratch& wave, ContactStep& step, std::size_t b) {
  MechanicsScratch::Predicted& predicted = step.pass.mechanics.predicted;
  const WaveNodes& nodes = wave.bodies.nodes;
  const WaveBody& body = wave.bodies.bodies[b];
  const MechanicsState& state = step.pass.state;
  const Component& component = state.components[body.id.index()];
  for (std::size_t i = body.first_node; i < body.end_node; ++i) {
    predicted.position[nodes.vertex[i].index()] = row_of(nodes.position, i);
    predicted.velocity[nodes.vertex[i].index()] = row_of(nodes.velocity, i);
  }
  fit_prediction({step.pass.mechanics, step.pass.state, step.pass.input, component, nullptr});
  PredictedFrame& frame = predicted.frame[component.id.index()];
  frame.damping_work = wave.bodies.measures_work ? -body.work.inner : 0;
  if (component.supported) return;
  const Mat3 inertia = deformed_inertia(state.vertices, component);
  const Vec3 momentum = component.orientation.conjugate() * component.angular_momentum;
  frame.spun = step.h() * solve3(inertia, momentum).norm();
}

void write_rigid(const WaveRigid& body, ContactStep& step) {
  MechanicsScratch::Predicted& predicted = step.pass.mechanics.predicted;
  const MechanicsState& state = step.pass.state;
  const Component& c = state.components[body.component.index()];
  if (c.supported || (c.rung == Rung::carried && body.impulse.isZero(0))) {
    predict(step.pass.mechanics, step.pass.state, step.pass.input, {&c.id, 1});
    return;
  }
  const Mat3 inertia = deformed_inertia(state.vertices, c);
  PredictedFrame next;
  next.centre = body.centre;
  next.momentum = c.mass * body.velocity;
  next.angular_momentum = c.angular_momentum + body.twist;
  next.orientation = body.orientation;
  const Mat3 R = next.orientation.toRotationMatrix();
  next.spin = R * solve3(inertia, R.transpose() * next.angular_momentum);
  next.spun = step.h() * solve3(inertia, c.orientation.conjugate() * c.angular_momentum).norm();
  for (const VertexId v : c.vertices) {
    const std::size_t i = v.index();
    const Vec3 arm =
        R * (state.vertices.rest_position[i] - c.rest_centre + state.vertices.displacement[i]);
    predicted.position[i] = next.centre + arm;
    predicted.velocity[i] = next.momentum / c.mass + next.spin.cross(arm);
    predicted.displacement[i] = state.vertices.displacement[i];
    // A carried component keeps how it deforms (`step_carried`).
    const bool keeps = c.rung == Rung::carried;
    predicted.displacement_rate[i] =
        keeps ? state.vertices.displacement_rate[i] : Vec3(Vec3::Zero());
    predicted.displacement_acceleration[i] =
        keeps ? state.vertices.displacement_acceleration[i] : Vec3(Vec3::Zero());
  }
  predicted.frame[c.id.index()] = next;
}

void write_obstacle(const WaveRigid& body, ContactStep& step) {
  StepBlows& blows = step.scratch.blows;
  const Obstacle& free = step.pass.obstacles[body.obstacle];
  blows.ball_touched[body.obstacle] = !body.impulse.isZero(0);
  step.scratch.ball_end[body.obstacle] = {
      body.centre, body.impulse.isZero(0) ? turned_obstacle(free, body.angular_momentum, step.h())
                                          : body.orientation};
}

/// Results of contacts, and contacts as the next part may take them on.
void write_contacts(WaveScratch& wave, ContactStep& step) {
  wave.kept = step.contacts;
  for (std::size_t k = 0; k < step.contacts.size(); ++k) {
    const LumpedRow& row = wave.contacts.rows[k];
    ContactPoint& contact = step.contacts[k];
    wave.kept[k].gap_start = row.gap + target_gap(contact);
    contact.impulse = row.total;
    if (contact.impulse.isZero(0)) continue;
    for_each_component(contact, step.pass.state, [&](ComponentId id) {
      step.scratch.blows.component_touched[id.index()] = 1;
    });
  }
}

void trace(WaveTrace& trace, const WaveScratch& wave, const ContactStep& step) {
  trace.weight_place.assign(step.pass.state.components.size(), Vec3::Zero());
  trace.ball_weight_place.assign(step.pass.obstacles.size(), Vec3::Zero());
  trace.loads.assign(step.pass.state.components.size(), Impulse::Zero());
  for (const WaveBody& body : wave.bodies.bodies) {
    trace.weight_place[body.id.index()] = body.weight_place / step.h();
    trace.loads[body.id.index()] = body.loads;
    trace.work.inner += body.work.inner;
    trace.work.gravity += body.work.gravity;
    trace.work.loads += body.work.loads;
    trace.work.supports += body.work.supports;
  }
  for (const WaveRigid& body : wave.contacts.rigid) {
    const Vec3 place = body.weight_place / step.h();
    if (body.component.is_none()) {
      trace.ball_weight_place[body.obstacle] = place;
    } else {
      trace.weight_place[body.component.index()] = place;
      trace.loads[body.component.index()] = body.loads;
    }
  }
  trace.contact = wave.contacts.work;
  trace.work.loads += trace.contact.loads;
  trace.work.supports -= trace.contact.on_held;
  trace.bonds = wave.bonds.numerical;
  for (const ScaledCells& cluster : wave.bodies.nodes.scaled) {
    trace.scaled_cells += static_cast<std::uint32_t>(cluster.cell.size());
  }
}

}  // namespace

void take_explicit_part(ContactStep& step) {
  if (!step.scratch.wave) step.scratch.wave = std::make_unique<WaveScratch>();
  WaveScratch& wave = *step.scratch.wave;
  gather_contacts(step);
  pack_bodies(wave.bodies, step.pass.state, step.pass.input);
  enlist_rigid(wave, step);
  constexpr double share = 0.9;
  const std::uint32_t sub_steps = step.pass.input.part.sub_steps;
  const double bound = std::min(step.h() / sub_steps, wave.bodies.longest_step);
  const int in_sub_step = static_cast<int>(std::ceil(step.h() / (sub_steps * share * bound)));
  const int count = in_sub_step * static_cast<int>(sub_steps);
  prepare_scaled_cells(wave.bodies, step.pass.state, step.pass.input, step.h() / count);
  make_rows(wave, step, count);
  take_ties(wave, step, count);
  const int taken = run_steps(wave, step, {count, in_sub_step});
  shorten(step, static_cast<std::uint32_t>(taken / in_sub_step));
  wave.search.clock += step.h();
  for (std::size_t b = 0; b < wave.bodies.bodies.size(); ++b) {
    give_twist(wave, b);
    write_body(wave, step, b);
  }
  for (const WaveRigid& body : wave.contacts.rigid) {
    body.component.is_none() ? write_obstacle(body, step) : write_rigid(body, step);
  }
  for_each_living(step.pass.state, step.pass.input.members, [&](const Component& c) {
    if (c.rung != Rung::asleep) return;
    predict(step.pass.mechanics, step.pass.state, step.pass.input, {&c.id, 1});
  });
  write_contacts(wave, step);
  trace(step.trace.emplace(), wave, step);
}

void move_free_obstacles(ContactStep& step) {
  for (const WaveRigid& body : step.scratch.wave->contacts.rigid) {
    if (!body.component.is_none()) continue;
    Obstacle& free = step.pass.obstacles[body.obstacle];
    put(free.shape, step.scratch.ball_end[body.obstacle]);
    free.velocity = body.velocity;
    free.spin = spin_of(free, body.angular_momentum + body.twist);
  }
}

TieReport finish_explicit_ties(ContactStep& step) {
  WaveScratch& wave = *step.scratch.wave;
  for (std::size_t k = 0; k < step.tied.size(); ++k) {
    step.tied[k].impulse = wave.bonds.bonds[k].total;
  }
  TieReport report = report_of(wave.bonds, step.ties, wave.bodies);
  report.residual = step.tie_residual;
  return report;
}

}  // namespace sunder
