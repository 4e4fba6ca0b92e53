// SPDX-License-Identifier: MIT
// Predict and adopt: one step of mechanics for every component.
#include "mechanics/step.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "mechanics/baselines/broyden.hpp"
#include "mechanics/baselines/corotational_euler.hpp"
#include "mechanics/baselines/implicit_euler.hpp"
#include "mechanics/baselines/newton_cg.hpp"
#include "mechanics/baselines/verlet.hpp"
#include "mechanics/element/corotational_force.hpp"
#include "mechanics/element/strain_displacement.hpp"
#include "mechanics/integrators/baseline_system.hpp"
#include "mechanics/integrators/floating_frame.hpp"
#include "mechanics/integrators/isolated.hpp"
#include "mechanics/integrators/modal.hpp"
#include "mechanics/integrators/quasi_static.hpp"
#include "mechanics/integrators/rigid_motion.hpp"
#include "mechanics/solver/component_system.hpp"
#include "mechanics/solver/parallel.hpp"
#include "mechanics/state/living.hpp"
#include "topology/base/assert.hpp"

namespace sunder {
namespace {

/// As many rows in `predicted` as the state has.
void fit_rows(MechanicsScratch& scratch, const MechanicsState& state) {
  const std::size_t n = state.vertices.size();
  MechanicsScratch::Predicted& p = scratch.predicted;
  for (std::vector<Vec3>* column : {&p.position, &p.velocity, &p.displacement, &p.displacement_rate,
                                    &p.displacement_acceleration}) {
    column->resize(n, Vec3::Zero());
  }
  p.frame.resize(state.components.size());
}

/// Implicit Euler, in the solver and the model that the settings name.
void step_euler(ComponentStep& step) {
  const IntegratorSettings& settings = step.input.settings;
  const bool corotational = settings.model == ElasticModel::corotational;
  const bool reassembled = settings.integrator == Integrator::implicit_euler && corotational &&
                           settings.corotational_solve == CorotationalSolve::reassembled;
  const bool by_mass =
      settings.integrator == Integrator::broyden && settings.broyden_start == BroydenStart::mass;
  const bool needs_factor =
      !reassembled && !by_mass && settings.integrator != Integrator::newton_cg;
  step.system = needs_factor ? &prepared_system(step.state, step.input, step.component)
                             : &built_system(step.state, step.input.corners, step.component);
  if (settings.integrator == Integrator::broyden) return step_broyden(step);
  if (settings.integrator == Integrator::newton_cg) return step_newton_cg(step);
  if (reassembled) return step_reassembled_euler(step);
  if (corotational) return step_prefactored_euler(step);
  step_implicit_euler(step);
}

void predict_component(MechanicsScratch& scratch, MechanicsState& state, const StepInput& input,
                       const Component& component) {
  ComponentStep step{scratch, state, input, component, nullptr};
  if (component.rung == Rung::asleep) {
    keep_still(step);
    return;
  }
  if (component.rung == Rung::carried) {
    step_carried(step);
    return;
  }
  if (is_isolated(component) && input.settings.isolated == IsolatedTetrahedra::projection) {
    return step_projected(step);
  }
  if (is_isolated(component) && input.settings.isolated == IsolatedTetrahedra::qr) {
    return step_edge_framed(step);
  }
  const bool moves_rigidly = component.rung == Rung::rigid || component.rung == Rung::stiff;
  if (component.rigid || moves_rigidly) {
    step_rigid_body(step);
    return;
  }
  const Integrator integrator = input.settings.integrator;
  SUNDER_ASSERT(
      input.part.deformation == Deformation::whole || integrator == Integrator::floating_frame,
      "predict: only floating_frame takes parts of steps");
  SUNDER_ASSERT(input.part.deformation != Deformation::wave,
                "predict: explicit steps write the bodies that deform");
  switch (integrator) {
    case Integrator::floating_frame:
      step.system = &prepared_system(state, input, component);
      if (component.rung == Rung::quasi_static) return step_quasi_static(step);
      return step_floating_frame(step);
    case Integrator::modal:
      step.system = &built_system(state, input.corners, component);
      return step_floating_frame(step);
    case Integrator::verlet:
      return step_verlet(step);
    case Integrator::sub_stepped:
      return step_sub_stepped(step);
    case Integrator::implicit_euler:
    case Integrator::broyden:
    case Integrator::newton_cg:
      return step_euler(step);
  }
}

/// Columns of the state and of the prediction change places, whole or by rows of members; frames
/// are copied.
void take_prediction(MechanicsState& state, MechanicsScratch& scratch, const StepMembers& members) {
  MechanicsScratch::Predicted& p = scratch.predicted;
  VertexColumns& v = state.vertices;
  const auto take = [&](std::vector<Vec3>& present, std::vector<Vec3>& next) {
    if (members.component.empty()) return present.swap(next);
    for (std::size_t i = 0; i < present.size(); ++i) {
      if (members.has(v.component[i])) present[i] = next[i];
    }
  };
  take(v.position, p.position);
  take(v.velocity, p.velocity);
  take(v.displacement, p.displacement);
  take(v.displacement_rate, p.displacement_rate);
  take(v.displacement_acceleration, p.displacement_acceleration);
  for (Component& component : state.components) {
    if (component.tetrahedra.empty() || !members.has(component.id)) continue;
    const PredictedFrame& frame = p.frame[component.id.index()];
    component.centre = frame.centre;
    component.orientation = frame.orientation;
    component.momentum = frame.momentum;
    component.angular_momentum = frame.angular_momentum;
  }
}

/// The first vertex that is not a number, or else the first that has left its body.
StepStatus judge(const MechanicsState& state, const MechanicsScratch& scratch,
                 const StepMembers& members) {
  // Ten radii: no linear displacement means anything there, and no bounded motion gets there.
  constexpr double most_radii = 10;
  const VertexColumns& vertices = state.vertices;
  StepStatus status;
  status.time = state.time;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (!members.has(vertices.component[v])) continue;
    const bool finite = vertices.position[v].allFinite() && vertices.velocity[v].allFinite();
    const Component& component = state.components[vertices.component[v].index()];
    const double displacement = vertices.displacement[v].norm();
    const bool near = displacement <= most_radii * component.rest_radius;
    if (finite && near) continue;
    if (finite && status.outcome == StepOutcome::diverged) continue;
    status.outcome = finite ? StepOutcome::diverged : StepOutcome::not_a_number;
    status.vertex = VertexId{v};
    status.component = component.id;
    status.displacement = displacement;
    status.turned = scratch.predicted.frame[component.id.index()].spun;
    if (!finite) break;
  }
  return status;
}

/// A turn of a component within a step that is too far.
struct TurnLimit {
  double PredictedFrame::*angle;  ///< rad
  double most;                    ///< rad
  StepOutcome outcome;
};

/// A component that turns farther than a step follows: the cause of its other faults.
constexpr TurnLimit spin_limit{&PredictedFrame::spun, longest_turn, StepOutcome::spun_too_far};

/// A component that turns by more than half a turn under loads with a fixed direction. The load on
/// its deformation is not known at any time of the step.
constexpr TurnLimit load_limit{&PredictedFrame::turned, M_PI, StepOutcome::overturned};

void judge_turns(StepStatus& status, const MechanicsState& state, const MechanicsScratch& scratch,
                 const StepMembers& members, const TurnLimit& limit) {
  for (const Component& component : state.components) {
    if (component.tetrahedra.empty() || !members.has(component.id)) continue;
    const double angle = scratch.predicted.frame[component.id.index()].*limit.angle;
    if (!(angle > limit.most)) continue;
    status.outcome = limit.outcome;
    status.vertex = component.vertices.front();
    status.component = component.id;
    status.turned = angle;
    return;
  }
}

}  // namespace

MechanicsScratch::MechanicsScratch() = default;
MechanicsScratch::~MechanicsScratch() = default;
MechanicsScratch::MechanicsScratch(MechanicsScratch&&) noexcept = default;
MechanicsScratch& MechanicsScratch::operator=(MechanicsScratch&&) noexcept = default;

void prepare(MechanicsState& state, const StepInput& input) {
  if (input.settings.integrator != Integrator::floating_frame) return;
  if (input.part.deformation == Deformation::frozen) return;
  fit_systems(state);
  std::vector<const Component*> missing;
  std::size_t vertices = 0, most = 0;
  for_each_living(state, input.members, [&](const Component& component) {
    if (component.rigid || !deforms(component.rung)) return;
    const ComponentSystem* system = state.systems.present[component.id.index()].get();
    if (system && system->step.factored) return;
    missing.push_back(&component);
    vertices += component.vertices.size();
    most = std::max(most, component.vertices.size());
  });
  // The largest first, so that it does not begin when all others are done.
  std::ranges::stable_sort(missing, std::ranges::greater{},
                           [](const Component* c) { return c->vertices.size(); });
  // A second thread must have enough work to be worth its start.
  constexpr std::size_t least_vertices = 100;
  const unsigned threads = vertices - most >= least_vertices ? input.threads : 1;
  parallel_for(threads, missing.size(),
               [&](std::size_t k, unsigned) { prepared_system(state, input, *missing[k]); });
}

void predict(MechanicsScratch& scratch, MechanicsState& state, const StepInput& input,
             std::span<const ComponentId> components) {
  SUNDER_ASSERT(input.corners.size() == state.elements.size(), "predict: corners of another mesh");
  SUNDER_ASSERT(input.loads.force.empty() || input.loads.force.size() == state.vertices.size(),
                "predict: one force a vertex, or none");
  fit_rows(scratch, state);
  for (ComponentId id : components) {
    SUNDER_ASSERT(id.index() < state.components.size(), "predict: no such component");
    const Component& component = state.components[id.index()];
    if (!component.tetrahedra.empty()) predict_component(scratch, state, input, component);
  }
}

StepStatus adopt(MechanicsState& state, MechanicsScratch& scratch, const StepInput& input) {
  SUNDER_ASSERT(scratch.predicted.position.size() == state.vertices.size(),
                "adopt: nothing predicted for these vertices");
  double damping_work = 0;
  SolveReport solve;
  for (const Component& component : state.components) {
    if (!component.tetrahedra.empty() && input.members.has(component.id)) {
      const PredictedFrame& frame = scratch.predicted.frame[component.id.index()];
      damping_work += frame.damping_work;
      add_part(solve, frame.solve);
    }
  }
  take_prediction(state, scratch, input.members);
  state.time += input.settings.time_step;
  measure_elements(state, scratch, input.corners,
                   {input.members, input.settings.model, input.measures_strain});
  StepStatus status = judge(state, scratch, input.members);
  status.damping_work = damping_work;
  status.time_step = input.settings.time_step;
  if (status.outcome != StepOutcome::not_a_number) {
    judge_turns(status, state, scratch, input.members, load_limit);
  }
  judge_turns(status, state, scratch, input.members, spin_limit);
  status.solve = solve;
  if (solve.sub_steps > input.settings.max_sub_steps) {
    status.outcome = StepOutcome::too_many_sub_steps;
  }
  return status;
}

StepStatus advance(MechanicsState& state, MechanicsScratch& scratch, const StepInput& input) {
  prepare(state, input);
  for (const Component& component : state.components) {
    predict(scratch, state, input, {&component.id, 1});
  }
  return adopt(state, scratch, input);
}

}  // namespace sunder
