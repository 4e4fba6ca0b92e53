// SPDX-License-Identifier: MIT
// Common parts of integrators: a component's factored system, and loads in its frame.
#include "mechanics/integrators/component_step.hpp"

#include <algorithm>

#include "mechanics/integrators/coefficients.hpp"
#include "mechanics/integrators/quasi_static.hpp"
#include "mechanics/state/supports.hpp"
#include "mechanics/state/wave_travel.hpp"

namespace sunder {

void fit_systems(MechanicsState& state) {
  state.systems.present.resize(state.components.size());
  state.systems.retired.resize(state.components.size());
  state.systems.local_row.resize(state.vertices.size());
}

ComponentSystem& built_system(MechanicsState& state, std::span<const Corners> corners,
                              const Component& component) {
  fit_systems(state);
  std::unique_ptr<ComponentSystem>& system = state.systems.present[component.id.index()];
  if (!system) {
    system = std::make_unique<ComponentSystem>();
    std::unique_ptr<ComponentSystem>& old = state.systems.retired[component.id.index()];
    std::vector<std::uint32_t>& local_row = state.systems.local_row;
    if (!old || !extend_system(*system, *old, local_row, {state, corners, component})) {
      build_system(*system, local_row, state, corners, component);
    }
    old.reset();
  }
  return *system;
}

bool is_pulled(const MechanicsState& state, const Component& component) {
  return component.partly_held ||
         (component.supported &&
          std::ranges::any_of(component.vertices,
                              [&](VertexId v) {
                                return !state.vertices.support[v.index()].is_none() &&
                                       support_velocity(state, v) != component.frame_velocity;
                              })) ||
         is_raised(state, component);
}

Deformation deformation_of(const StepInput& input, const MechanicsState& state,
                           const Component& component) {
  const Deformation asked = input.part.deformation;
  // A component that may slide moves with time, never ahead of it.
  if (component.partly_held) return Deformation::whole;
  const bool must_move = asked == Deformation::frozen && is_pulled(state, component);
  return must_move ? Deformation::catch_up : asked;
}

IntegratorSettings settings_of(const StepInput& input, const MechanicsState& state,
                               const Component& component) {
  IntegratorSettings settings = input.settings;
  if (settings.rho_infinity > 0 && !component.tetrahedra.empty()) {
    settings.rho_infinity = followed_rho(settings.rho_infinity, input.deformation_step(component),
                                         extent_travel(state, component));
  }
  return settings;
}

ComponentSystem& prepared_system(MechanicsState& state, const StepInput& input,
                                 const Component& component) {
  ComponentSystem& system = built_system(state, input.corners, component);
  if (component.rung == Rung::quasi_static) {
    factor_system(system, quasi_static_matrix());
    return system;
  }
  switch (deformation_of(input, state, component)) {
    case Deformation::frozen:
    case Deformation::wave:
      break;
    case Deformation::whole:
    case Deformation::catch_up: {
      IntegratorSettings settings = settings_of(input, state, component);
      settings.time_step = input.deformation_step(component);
      factor_system(system, system_matrix(settings));
    }
  }
  return system;
}

void add_body_load(LocalField load, const ComponentStep& step, const Mat3& R) {
  const Loads& loads = step.input.loads;
  const Vec3 g = R.transpose() * loads.gravity;
  const ComponentSystem& system = *step.system;
  for (std::size_t i = 0; i < system.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    load.col(column) += system.shape.mass[column] * g;
    if (!loads.force.empty()) {
      load.col(column) += R.transpose() * loads.force[system.order[i].index()];
    }
  }
}

}  // namespace sunder
