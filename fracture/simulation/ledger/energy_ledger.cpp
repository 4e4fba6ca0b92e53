// SPDX-License-Identifier: MIT
// The energy ledger of a step.
#include "fracture/simulation/ledger/energy_ledger.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/contact/detection/contact_detect.hpp"
#include "mechanics/contact/push_out.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/contact/waves/wave_bodies.hpp"
#include "mechanics/integrators/coefficients.hpp"
#include "mechanics/integrators/component_step.hpp"
#include "mechanics/integrators/numerical_loss.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "mechanics/state/living.hpp"
#include "mechanics/state/supports.hpp"

namespace sunder {
namespace {

void add_work(EnergyLedger& ledger, const AdoptedPart& part) {
  const VertexColumns& vertices = part.state.mechanics.vertices;
  const std::vector<Vec3>& before = part.before.position;
  const Loads& loads = part.input.loads;
  const bool is_loaded = !loads.force.empty();
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (!part.input.members.has(vertices.component[v])) continue;
    const Vec3 way = vertices.position[v] - before[v];
    ledger.gravity += vertices.mass[v] * loads.gravity.dot(way);
    if (is_loaded) ledger.loads += loads.force[v].dot(way);
  }
}

/// Where the scheme of a part balances forces, between its start (0) and end (1).
double balance_of(Deformation deformation, const IntegratorSettings& settings) {
  if (deformation == Deformation::frozen) return 0.5;
  return 1 - generalised_alpha(settings.rho_infinity).alpha_f;
}

/// Settings of the component's deformation in the part.
IntegratorSettings deformation_settings(const StepInput& input, const MechanicsState& state,
                                        const Component& component) {
  IntegratorSettings settings = settings_of(input, state, component);
  settings.time_step = input.deformation_step(component);
  return settings;
}

double deformation_loss(const AdoptedPart& part, const Component& component) {
  const StepInput& input = part.input;
  const MechanicsState& m = part.state.mechanics;
  const auto& system = m.systems.present[component.id.index()];
  const bool deforms_now = deforms(component.rung) && !component.rigid &&
                           deformation_of(input, m, component) != Deformation::frozen;
  if (!deforms_now || !system) return 0;
  const PartStart& before = part.before;
  const VertexColumns& v = m.vertices;
  DeformationStep step{{before.displacement, before.rate, before.acceleration},
                       {v.displacement, v.displacement_rate, v.displacement_acceleration},
                       component.strain_change.difference};
  if (component.partly_held) {
    const Vec3 carried = input.settings.time_step * component.frame_velocity;
    step.shift = component.orientation.conjugate() *
                 (component.centre - before.centre[component.id.index()] - carried);
  }
  // Equilibrium at the end under the loads of the whole way: their work exceeds the change of
  // strain.
  if (component.rung == Rung::quasi_static) return 0.5 * step.stiffness_difference;
  return numerical_loss(*system, deformation_settings(input, m, component), step);
}

/// Loss of a free frame. Contact, gravity and loads are an impulse at the start, and the frame
/// moves at the velocity after it. The inelastic stop takes the difference.
double frame_loss(const AdoptedPart& part, const Component& component) {
  const PartStart& before = part.before;
  const std::size_t row = component.id.index();
  if (!is_struck(part.result.touched, row)) return 0;
  const Vec3 change = component.momentum - before.momentum[row];
  // A rigid body takes its impulses in the orientation of the start, and then turns freely.
  const Eigen::Quaterniond& R = component.rigid ? before.orientation[row] : component.orientation;
  const Vec3 turn = R.conjugate() * (component.angular_momentum - before.angular_momentum[row]);
  return 0.5 *
         (change.squaredNorm() / component.mass + turn.dot(solve3(component.rest_inertia, turn)));
}

void add_losses(EnergyLedger& ledger, const AdoptedPart& part) {
  for_each_living(part.state.mechanics, part.input.members, [&](const Component& component) {
    ledger.numerical += deformation_loss(part, component);
    if (!component.supported) ledger.numerical += frame_loss(part, component);
  });
}

/// Way of an obstacle's matter that is at `place` (m) as the part begins; spheres as if they did
/// not turn.
Vec3 way_of_obstacle(const AdoptedPart& part, std::uint32_t row, const Vec3& place) {
  const Obstacle& obstacle = part.state.obstacles[row];
  if (!obstacle.mass || is_sphere(obstacle)) {
    return part.input.settings.time_step * obstacle.velocity;
  }
  return carried_point(part.before.obstacles[row].shape, obstacle.shape, place) - place;
}

/// Where side A is as the part begins, m: a ball's centre.
Vec3 start_of_side_a(const AdoptedPart& part, const ContactPoint& c) {
  if (c.is_body_a()) {
    return nodes_of_a(c, part.input.corners).sum(part.before.position);
  }
  return point_of_obstacle(c, part.before.obstacles[c.ball].shape);
}

/// Way of a rigid body's matter at `place` (m) by its velocity after the blows that it takes as the
/// part begins: along its true way, which is bent, impulses would seem to do another work.
Vec3 way_after_blow(const AdoptedPart& part, const Component& c, const Vec3& place) {
  const std::size_t row = c.id.index();
  const Eigen::Quaterniond& R = part.before.orientation[row];
  const Vec3 spin = R * solve3(c.rest_inertia, R.conjugate() * c.angular_momentum);
  return part.input.settings.time_step *
         (c.momentum / c.mass + spin.cross(place - part.before.centre[row]));
}

bool takes_blows(const Component& c) { return c.rigid && !c.supported; }

/// Way of side A, a point of a body, over the part.
Vec3 way_of_body_a(const AdoptedPart& part, const ContactPoint& contact) {
  const MechanicsState& m = part.state.mechanics;
  const Component& c = m.components[component_of_a(contact, m).index()];
  const Vec3 start = start_of_side_a(part, contact);
  if (takes_blows(c)) return way_after_blow(part, c, start);
  return nodes_of_a(contact, part.input.corners).sum(m.vertices.position) - start;
}

/// Way of the point of side B: of a tetrahedron, or of an obstacle.
Vec3 way_of_other(const AdoptedPart& part, const ContactPoint& contact) {
  const Vec3 place = start_of_side_a(part, contact);
  if (contact.tetrahedron.is_none()) return way_of_obstacle(part, contact.obstacle, place);
  const ComponentId id = part.state.mechanics.elements.component[contact.tetrahedron.index()];
  const Component& component = part.state.mechanics.components[id.index()];
  if (takes_blows(component)) return way_after_blow(part, component, place);
  const TouchedNodes touched = touched_nodes(contact, part.state.mechanics, part.input.corners);
  Vec3 way = Vec3::Zero();
  for (std::size_t i = 0; i < touched.count; ++i) {
    const std::size_t v = touched.row[i].index();
    way += touched.share[i] * (part.state.mechanics.vertices.position[v] - part.before.position[v]);
  }
  if (component.rigid) return way;
  const Vec3 lever = lever_of(touched, place, part.before.position);
  const Vec3 turned =
      component.orientation * (part.before.orientation[id.index()].conjugate() * lever);
  return way + turned - lever;
}

void add_contact_work(EnergyLedger& ledger, const AdoptedPart& part) {
  const double h = part.input.settings.time_step;
  for (const ContactPoint& c : part.result.contacts) {
    const Vec3 other = way_of_other(part, c);
    const Vec3 way = c.is_body_a() ? way_of_body_a(part, c)
                                   : way_of_obstacle(part, c.ball, start_of_side_a(part, c));
    const Vec3 force = c.impulse / h;
    if (c.is_body_a()) ledger.contact += force.dot(way);
    if (c.is_body_b()) ledger.contact -= force.dot(other);
    const Vec3 sliding = force - c.normal.dot(force) * c.normal;
    ledger.friction -= sliding.dot(way - other);
    const double pushed =
        std::min(c.normal.dot(way - other), push_out_distance(part.contact, c.gap_start, h));
    if (pushed > 0) ledger.push_out += c.normal.dot(force) * pushed;
  }
}

/// Work of moving supports: on the frame as a whole, and on vertices that move against the frame.
/// The latter is by the forces K d - f where the scheme balances them.
void add_support_work(EnergyLedger& ledger, const AdoptedPart& part, const Component& component) {
  const StepInput& input = part.input;
  const MechanicsState& m = part.state.mechanics;
  const auto& system = m.systems.present[component.id.index()];
  if (!component.supported || !system) return;
  const std::size_t n = system->size();
  double fastest = component.frame_velocity.norm();
  for (const VertexId v : system->order) {
    const Vec3& rate = m.vertices.displacement_rate[v.index()];
    fastest = std::max(fastest, (rate - free_part(m, v, rate)).norm());
  }
  if (fastest == 0) return;
  const IntegratorSettings settings = deformation_settings(input, m, component);
  const double balance = balance_of(deformation_of(input, m, component), settings);
  const RayleighDamping& damping = settings.damping;
  PartStart& before = part.before;
  before.work.resize(6 * n);
  Eigen::Map<Eigen::Matrix3Xd> at(before.work.data(), 3, static_cast<Eigen::Index>(n));
  Eigen::Map<Eigen::VectorXd> force(before.work.data() + 3 * n, static_cast<Eigen::Index>(3 * n));
  const auto between = [&](const std::vector<Vec3>& a, const std::vector<Vec3>& b, std::size_t v) {
    return Vec3((1 - balance) * a[v] + balance * b[v]);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t v = system->order[i].index();
    at.col(static_cast<Eigen::Index>(i)) =
        between(before.displacement, m.vertices.displacement, v) +
        damping.stiffness_factor * between(before.rate, m.vertices.displacement_rate, v);
  }
  multiply_stiffness(force, *system, at.reshaped());
  const Mat3 R = component.orientation.toRotationMatrix();
  Vec3 outside = Vec3::Zero();  // momentum that comes from elsewhere than the supports
  double given = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t v = system->order[i].index();
    Vec3 f = m.vertices.mass[v] * input.loads.gravity;
    if (!input.loads.force.empty()) f += input.loads.force[v];
    outside += input.settings.time_step * f;
    const Vec3 way = m.vertices.displacement[v] - before.displacement[v];
    const Vec3 led = way - free_part(m, system->order[i], way);
    if (led.isZero(0)) continue;
    const Vec3 pull = force.segment<3>(static_cast<Eigen::Index>(3 * i)) +
                      damping.mass_factor * m.vertices.mass[v] *
                          between(before.rate, m.vertices.displacement_rate, v) -
                      R.transpose() * f;
    given += pull.dot(led);
  }
  for (const ContactPoint& c : part.result.contacts) {
    const bool is_a = component_of_a(c, m) == component.id;
    const bool is_b = component_of_b(c, m) == component.id;
    outside += (int{is_a} - int{is_b}) * c.impulse;
  }
  const Vec3 momentum = component.momentum - before.momentum[component.id.index()];
  ledger.supports += given + component.frame_velocity.dot(momentum - outside);
}

/// Of explicit steps, which measure the work of each force themselves. Rigid members fall by their
/// mass centres. Carried ones do so again on the way on which they were taken back (`carry_back`).
void add_explicit_work(EnergyLedger& ledger, const AdoptedPart& part, const WaveTrace& trace) {
  ledger.gravity += trace.work.gravity;
  ledger.loads += trace.work.loads;
  ledger.supports += trace.work.supports;
  ledger.contact += trace.contact.contact;
  ledger.friction += trace.contact.friction;
  ledger.push_out += trace.contact.push_out;
  ledger.cracks += part.result.ties.work;
  ledger.numerical += trace.bonds;
  const MechanicsState& m = part.state.mechanics;
  for_each_living(m, part.input.members, [&](const Component& c) {
    if (deforms_in_wave(c) || (c.supported && c.rung != Rung::carried)) return;
    ledger.gravity +=
        c.mass * part.input.loads.gravity.dot(c.centre - part.before.centre[c.id.index()]);
  });
}

}  // namespace

bool is_struck(const std::vector<char>& touched, std::size_t row) {
  return !touched.empty() && touched[row];
}

void remember_start(PartStart& before, const SimulationState& state, bool keeps_ledger) {
  const MechanicsState& m = state.mechanics;
  if (keeps_ledger || !state.cracks.empty()) before.displacement = m.vertices.displacement;
  before.position = m.vertices.position;
  before.obstacles = state.obstacles;
  before.momentum.clear();
  before.angular_momentum.clear();
  before.centre.clear();
  before.orientation.clear();
  for (const Component& component : m.components) {
    before.momentum.push_back(component.momentum);
    before.angular_momentum.push_back(component.angular_momentum);
    before.centre.push_back(component.centre);
    before.orientation.push_back(component.orientation);
  }
  if (!keeps_ledger) return;
  before.rate = m.vertices.displacement_rate;
  before.acceleration = m.vertices.displacement_acceleration;
}

void add_part_energy(StepReport& report, const AdoptedPart& part, bool keeps_ledger) {
  const MechanicsState& m = part.state.mechanics;
  const StepMembers& members = part.input.members;
  follow_cracks(report.cracks, part.state.cracks, m,
                {part.before.displacement, members, part.input.settings.time_step});
  if (!keeps_ledger) return;
  EnergyLedger& ledger = report.energy;
  if (part.result.trace) {
    for_each_living(m, members, [&](const Component& component) {
      ledger.strain += component.strain_change.after - component.strain_change.before;
    });
    return add_explicit_work(ledger, part, *part.result.trace);
  }
  add_work(ledger, part);
  add_contact_work(ledger, part);
  ledger.cracks += part.result.ties.work;
  const bool has_closed_forms = part.input.settings.integrator == Integrator::floating_frame;
  for_each_living(m, members, [&](const Component& component) {
    const StrainChange& change = component.strain_change;
    ledger.strain += change.after - change.before;
    if (has_closed_forms && component.rung != Rung::carried) {
      add_support_work(ledger, part, component);
    }
  });
  if (has_closed_forms) add_losses(ledger, part);
}

void close_ledger(StepReport& report, double kinetic, double kinetic_now) {
  EnergyLedger& ledger = report.energy;
  ledger.kinetic = kinetic_now - kinetic;
  const double in[] = {ledger.gravity, ledger.loads, ledger.contact, ledger.supports};
  const double out[] = {ledger.kinetic,
                        ledger.strain,
                        ledger.cracks,
                        ledger.numerical,
                        report.status.damping_work,
                        report.energy_released};
  for (const double work_in : in) {
    ledger.residual += work_in;
    ledger.moved += std::abs(work_in);
  }
  for (const double went_to : out) {
    ledger.residual -= went_to;
    ledger.moved += std::abs(went_to);
  }
}

}  // namespace sunder
