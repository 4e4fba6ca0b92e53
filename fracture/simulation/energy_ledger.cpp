// SPDX-License-Identifier: MIT
// The energy ledger of a step.
#include "fracture/simulation/energy_ledger.hpp"

#include <cmath>

#include "mechanics/integrators/coefficients.hpp"
#include "mechanics/integrators/component_step.hpp"
#include "mechanics/state/living.hpp"
#include "mechanics/integrators/numerical_loss.hpp"

namespace sunder {
namespace {

void add_load_impulse(StepWork& work, double length) {
  if (work.loads.force.empty()) return;
  const VertexColumns& vertices = work.sim.state->mechanics.vertices;
  for (std::size_t v = 0; v < work.loads.force.size(); ++v) {
    if (!work.members().has(vertices.component[v])) continue;
    work.report.load_impulse += length * work.loads.force[v];
  }
}

void add_work(StepWork& work) {
  const VertexColumns& vertices = work.sim.state->mechanics.vertices;
  const std::vector<Vec3>& before = work.sim.scratch->before.position;
  const bool is_loaded = !work.loads.force.empty();
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (!work.members().has(vertices.component[v])) continue;
    const Vec3 way = vertices.position[v] - before[v];
    work.report.energy.gravity += vertices.mass[v] * work.loads.gravity.dot(way);
    if (is_loaded) work.report.energy.loads += work.loads.force[v].dot(way);
  }
}

/// Where the scheme of a part balances forces, between its start (0) and end (1).
double balance_of(Deformation deformation, const IntegratorSettings& settings) {
  switch (deformation) {
    case Deformation::wave:
      return WaveScheme::theta;
    case Deformation::frozen:
      return 0.5;
    case Deformation::whole:
    case Deformation::catch_up:
      break;
  }
  return 1 - generalised_alpha(settings.rho_infinity).alpha_f;
}

/// Settings of the component's deformation in the part.
IntegratorSettings deformation_settings(const StepInput& input, const MechanicsState& state,
                                        const Component& component) {
  IntegratorSettings settings = settings_of(input, state, component);
  settings.time_step = input.deformation_step();
  return settings;
}

double deformation_loss(StepWork& work, const StepInput& input, const Component& component) {
  const auto& system = work.sim.scratch->mechanics.systems[component.id.index()];
  const bool deforms_now = deforms(component.rung) && !component.isolated &&
                           input.part.deformation != Deformation::frozen;
  if (!deforms_now || !system) return 0;
  const MechanicsState& m = work.sim.state->mechanics;
  const PartStart& before = work.sim.scratch->before;
  const VertexColumns& v = m.vertices;
  const DeformationStep step{{before.displacement, before.rate, before.acceleration},
                             {v.displacement, v.displacement_rate, v.displacement_acceleration},
                             work.sim.scratch->mechanics.strain[component.id.index()].difference};
  // Equilibrium at the end under the loads of the whole way: they give what strain does not take.
  if (component.rung == Rung::quasi_static) return 0.5 * step.stiffness_difference;
  if (input.part.deformation == Deformation::wave) return wave_loss(*system, step);
  return numerical_loss(*system, deformation_settings(input, m, component), step);
}

/// Of a frame that contact gave momentum. In a wave its impulse moves the centre by theta; else it
/// is a blow at the start, weight and loads with it, and the way of the step is that of the
/// velocity after it: the stop takes what is between.
double frame_loss(const StepWork& work, const StepInput& input, const Component& component) {
  const PartStart& before = work.sim.scratch->before;
  const Vec3 change = component.momentum - before.momentum[component.id.index()];
  if (input.part.deformation == Deformation::wave) {
    const Vec3 weight = input.settings.time_step * component.mass * work.loads.gravity;
    return (WaveScheme::theta - 0.5) * (change - weight).dot(change) / component.mass;
  }
  const Vec3 turn = component.orientation.conjugate() *
                    (component.angular_momentum - before.angular_momentum[component.id.index()]);
  return 0.5 * (change.squaredNorm() / component.mass +
                turn.dot(component.rest_inertia.ldlt().solve(turn)));
}

void add_losses(StepWork& work, const StepInput& input) {
  const auto& contacts = work.sim.scratch->contact.contacts;
  const VertexColumns& vertices = work.sim.state->mechanics.vertices;
  const ElementColumns& elements = work.sim.state->mechanics.elements;
  std::vector<char>& touched = work.sim.scratch->before.touched;
  touched.assign(work.sim.state->mechanics.components.size(), 0);
  for (const ContactPoint& c : contacts) {
    if (!c.vertex.is_none()) touched[vertices.component[c.vertex.index()].index()] = 1;
    if (!c.tetrahedron.is_none()) touched[elements.component[c.tetrahedron.index()].index()] = 1;
  }
  for_each_living(work.sim.state->mechanics, work.members(), [&](const Component& component) {
    work.report.energy.numerical += deformation_loss(work, input, component);
    if (component.supported || !touched[component.id.index()]) return;
    work.report.energy.numerical += frame_loss(work, input, component);
  });
}

/// Way of the point of side B: the middle of a tetrahedron, or an obstacle that moves as it is
/// told.
Vec3 way_of_other(const StepWork& work, const ContactPoint& contact, const Corners& corners,
                  double length) {
  if (contact.tetrahedron.is_none()) {
    return length * work.sim.state->obstacles[contact.obstacle].velocity;
  }
  const VertexColumns& vertices = work.sim.state->mechanics.vertices;
  Vec3 way = Vec3::Zero();
  for (VertexId v : corners) {
    way += 0.25 * (vertices.position[v.index()] - work.sim.scratch->before.position[v.index()]);
  }
  return way;
}

void add_contact_work(StepWork& work, const StepInput& input) {
  const VertexColumns& vertices = work.sim.state->mechanics.vertices;
  const double h = input.settings.time_step;
  EnergyLedger& ledger = work.report.energy;
  for (const ContactPoint& c : work.sim.scratch->contact.contacts) {
    const bool is_vertex = c.ball == ContactPoint::none;
    const Corners corners =
        c.tetrahedron.is_none() ? Corners{} : input.corners[c.tetrahedron.index()];
    const Vec3 other = way_of_other(work, c, corners, h);
    const Vec3 way = is_vertex ? Vec3(vertices.position[c.vertex.index()] -
                                      work.sim.scratch->before.position[c.vertex.index()])
                               : Vec3(h * work.sim.state->obstacles[c.ball].velocity);
    const Vec3 force = c.impulse / h;
    if (is_vertex) ledger.contact += force.dot(way);
    if (!c.tetrahedron.is_none()) ledger.contact -= force.dot(other);
    const Vec3 sliding = force - c.normal.dot(force) * c.normal;
    ledger.friction -= sliding.dot(way - other);
  }
}

/// Supports that move: what they give the frame as a whole, and what they give vertices that move
/// against the frame, by the forces K d - f where the scheme balances them.
void add_support_work(StepWork& work, const StepInput& input, const Component& component) {
  const MechanicsState& m = work.sim.state->mechanics;
  const auto& system = work.sim.scratch->mechanics.systems[component.id.index()];
  if (!component.supported || !system) return;
  const std::size_t n = system->size();
  double fastest = component.frame_velocity.norm();
  for (std::size_t i = system->free_count; i < n; ++i) {
    fastest = std::max(fastest, m.vertices.displacement_rate[system->order[i].index()].norm());
  }
  if (fastest == 0) return;
  const IntegratorSettings settings = deformation_settings(input, m, component);
  const double balance = balance_of(input.part.deformation, settings);
  const RayleighDamping damping = input.part.deformation == Deformation::wave
                                      ? wave_damping(input.settings, system->cell_travel)
                                      : settings.damping;
  PartStart& before = work.sim.scratch->before;
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
    Vec3 f = m.vertices.mass[v] * work.loads.gravity;
    if (!work.loads.force.empty()) f += work.loads.force[v];
    outside += input.settings.time_step * f;
    if (i < system->free_count) continue;
    const Vec3 pull = force.segment<3>(static_cast<Eigen::Index>(3 * i)) +
                      damping.mass_factor * m.vertices.mass[v] *
                          between(before.rate, m.vertices.displacement_rate, v) -
                      R.transpose() * f;
    given += pull.dot(m.vertices.displacement[v] - before.displacement[v]);
  }
  for (const ContactPoint& c : work.sim.scratch->contact.contacts) {
    if (c.vertex.is_none() || m.vertices.component[c.vertex.index()] != component.id) continue;
    outside += c.impulse;
  }
  const Vec3 momentum = component.momentum - before.momentum[component.id.index()];
  work.report.energy.supports += given + component.frame_velocity.dot(momentum - outside);
}

}  // namespace

void begin_part(StepWork& work) {
  const MechanicsState& m = work.sim.state->mechanics;
  PartStart& before = work.sim.scratch->before;
  const bool is_kept = work.sim.scene.energy_ledger;
  work.sim.scratch->mechanics.measures_strain = is_kept;
  if (is_kept || !work.sim.state->cracks.empty()) before.displacement = m.vertices.displacement;
  if (!is_kept) return;
  before.position = m.vertices.position;
  before.rate = m.vertices.displacement_rate;
  before.acceleration = m.vertices.displacement_acceleration;
  before.momentum.clear();
  before.angular_momentum.clear();
  for (const Component& component : m.components) {
    before.momentum.push_back(component.momentum);
    before.angular_momentum.push_back(component.angular_momentum);
  }
}

void end_part(StepWork& work, const StepInput& input) {
  const MechanicsState& m = work.sim.state->mechanics;
  const double length = input.settings.time_step;
  add_load_impulse(work, length);
  follow_cracks(work.report.cracks, work.sim.state->cracks, m,
                {work.sim.scratch->before.displacement, work.members(), length});
  if (!work.sim.scene.energy_ledger) return;
  add_work(work);
  add_contact_work(work, input);
  const bool has_closed_forms = input.settings.integrator == Integrator::floating_frame;
  const MechanicsScratch& scratch = work.sim.scratch->mechanics;
  for_each_living(m, work.members(), [&](const Component& component) {
    const StrainChange& change = scratch.strain[component.id.index()];
    work.report.energy.strain += change.after - change.before;
    if (has_closed_forms) add_support_work(work, input, component);
  });
  if (has_closed_forms) add_losses(work, input);
}

void close_ledger(StepWork& work, double kinetic) {
  EnergyLedger& ledger = work.report.energy;
  if (!work.sim.scene.energy_ledger) {
    ledger = {};
    return;
  }
  ledger.kinetic = kinetic_energy(work.sim.state->mechanics.vertices) - kinetic;
  const double in[] = {ledger.gravity, ledger.loads, ledger.contact, ledger.supports};
  const double out[] = {ledger.kinetic, ledger.strain, ledger.numerical,
                        work.report.status.damping_work, work.report.energy_released};
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
