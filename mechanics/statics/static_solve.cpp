// SPDX-License-Identifier: MIT
// Static equilibrium with the stiffness of the component systems.
#include "mechanics/statics/static_solve.hpp"

#include <string>

#include "mechanics/element/strain_displacement.hpp"
#include "mechanics/integrators/component_step.hpp"
#include "mechanics/measure_elements.hpp"
#include "mechanics/state/supports.hpp"

namespace sunder {
namespace {

/// Whether three held vertices span a triangle that is not a line (to 1e-6 of the body's size), or
/// single axes held do as much.
bool is_fixed(const MechanicsState& state, const Component& component) {
  if (is_fixed_by_axes(state, component)) return true;
  std::vector<Vec3> held;
  for (VertexId v : component.vertices) {
    if (is_held_whole(state, v)) {
      held.push_back(state.vertices.rest_position[v.index()]);
    }
  }
  if (held.size() < 3) return false;
  Vec3 along = Vec3::Zero();
  for (const Vec3& x : held) {
    if ((x - held[0]).norm() > along.norm()) along = x - held[0];
  }
  double widest = 0;
  for (const Vec3& x : held) widest = std::max(widest, along.cross(x - held[0]).norm());
  return widest > 1e-6 * component.rest_radius * component.rest_radius;
}

Finding not_supported(const Component& component) {
  Finding finding;
  finding.code = "not_supported";
  finding.ids = {static_cast<std::int64_t>(component.id.value)};
  finding.text = "Component " + std::to_string(component.id.value) +
                 " has no three held vertices off one line: it has no equilibrium.";
  finding.remedy = "Hold a face of it.";
  return finding;
}

/// d of one component, all its vertices, in the system's order.
Eigen::VectorXd equilibrium(MechanicsScratch& scratch, const MechanicsState& state,
                            const Component& component, const ComponentStep& step) {
  ComponentSystem& system = *step.system;
  const auto free = static_cast<Eigen::Index>(3 * system.free_count);
  Eigen::VectorXd d = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * system.size()));
  for (std::size_t i = system.free_count; i < system.size(); ++i) {
    d.segment<3>(static_cast<Eigen::Index>(3 * i)) =
        state.vertices.displacement[system.order[i].index()];
  }
  for (const Eigen::Index row : system.held_scalars) {
    d[row] = state.vertices.displacement[system.order[std::size_t(row / 3)].index()][row % 3];
  }
  auto load = scratch_field(scratch, ScratchField::load, system.size());
  load.setZero();
  add_body_load(load, step, component.orientation.toRotationMatrix());
  Eigen::VectorXd held_force(d.size());
  multiply_stiffness(held_force, system, d);
  Eigen::VectorXd answer = as_vector(load).head(free) - held_force.head(free);
  factor_system(system, {.mass = 0, .stiffness = 1});
  solve_system(system, answer);
  d.head(free) += answer;
  return d;
}

}  // namespace

std::vector<Finding> solve_static(MechanicsState& state, MechanicsScratch& scratch,
                                  std::span<const Corners> corners, const Loads& loads) {
  std::vector<Finding> findings;
  for (const Component& component : state.components) {
    if (!component.tetrahedra.empty() && !is_fixed(state, component)) {
      findings.push_back(not_supported(component));
    }
  }
  bool finite = loads.gravity.allFinite();
  for (const Vec3& f : loads.force) finite = finite && f.allFinite();
  if (!finite) {
    Finding finding;
    finding.code = "not_a_number";
    finding.text = "A load is not a finite number.";
    finding.remedy = "Give finite loads.";
    findings.push_back(std::move(finding));
  }
  if (!findings.empty()) return findings;

  // Any step will do: the factor of K replaces that of A at once.
  const IntegratorSettings settings;
  const StepInput input{corners, loads, settings};
  for (const Component& component : state.components) {
    if (component.tetrahedra.empty()) continue;
    ComponentSystem& system = built_system(state, corners, component);
    const Eigen::VectorXd d =
        equilibrium(scratch, state, component, {scratch, state, input, component, &system});
    for (std::size_t i = 0; i < system.size(); ++i) {
      const std::size_t v = system.order[i].index();
      const Vec3 displacement = d.segment<3>(static_cast<Eigen::Index>(3 * i));
      state.vertices.displacement[v] = displacement;
      state.vertices.displacement_rate[v].setZero();
      state.vertices.displacement_acceleration[v].setZero();
      state.vertices.velocity[v] = component.frame_velocity;
      state.vertices.position[v] =
          component.centre + component.orientation * (state.vertices.rest_position[v] -
                                                      component.rest_centre + displacement);
    }
  }
  measure_elements(state, scratch, corners);
  return findings;
}

std::vector<Vec3> support_forces(MechanicsScratch& scratch, MechanicsState& state,
                                 std::span<const Corners> corners, const Loads& loads) {
  std::vector<Vec3> force(state.vertices.size(), Vec3::Zero());
  const IntegratorSettings settings;
  const StepInput input{corners, loads, settings};
  for (const Component& component : state.components) {
    if (component.tetrahedra.empty()) continue;
    ComponentSystem& system = built_system(state, corners, component);
    const Mat3 R = component.orientation.toRotationMatrix();
    Eigen::Matrix3Xd d(3, static_cast<Eigen::Index>(system.size()));
    Eigen::Matrix3Xd load = Eigen::Matrix3Xd::Zero(3, d.cols());
    gather(d, system.order, state.vertices.displacement);
    add_body_load(load, {scratch, state, input, component, &system}, R);
    Eigen::VectorXd elastic(d.size());
    multiply_stiffness(elastic, system, d.reshaped());
    const Eigen::Matrix3Xd missing = elastic.reshaped(3, d.cols()) - load;
    scatter(force, system.order, R * missing);
  }
  return force;
}

}  // namespace sunder
