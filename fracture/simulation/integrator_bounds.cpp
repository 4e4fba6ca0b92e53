// SPDX-License-Identifier: MIT
// Demands of bodies on integrators that are bounded.
#include "fracture/simulation/integrator_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "mechanics/baselines/verlet.hpp"
#include "mechanics/integrators/modal.hpp"
#include "topology/base/counted.hpp"

namespace sunder {
namespace {

void check_explicit(std::vector<Finding>& findings, const Scene& scene, double bound) {
  const IntegratorSettings& settings = scene.integrator;
  const double h = scene.integrator.time_step;
  if (settings.integrator == Integrator::verlet && h > bound) {
    findings.push_back(
        {.code = "explicit_step_too_long",
         .severity = Severity::warning,
         .text = fmt::format("time_step is {:.6g} s; verlet is surely stable up to {:.6g} s only",
                             h, bound),
         .remedy = "take that step, or the method sub_stepped, which divides steps, or "
                   "floating_frame"});
  }
  const std::uint32_t count = sub_step_count(h, bound);
  if (settings.integrator == Integrator::sub_stepped && count > settings.max_sub_steps) {
    findings.push_back(
        {.code = "too_many_sub_steps",
         .text = fmt::format("time_step is {:.6g} s; sub_stepped needs {} of {:.6g} s for it, and "
                             "integrator.max_sub_steps is {}",
                             h, counted(count, "sub-step"), h / count, settings.max_sub_steps),
         .remedy = "raise integrator.max_sub_steps, take a shorter time_step, or the method "
                   "floating_frame"});
  }
}

/// A vertex on one spring: the kick-drift map of its spring and damper is stable up to this step,
/// s.
double penalty_step_bound(const ContactSettings& contact, double mass) {
  const double k = contact.penalty_stiffness, c = contact.penalty_damping;
  return (std::sqrt(c * c + 4 * k * mass) - c) / k;
}

void check_penalty(std::vector<Finding>& findings, const Scene& scene, const MechanicsState& state,
                   double bound) {
  double h = scene.integrator.time_step;
  if (scene.integrator.integrator == Integrator::sub_stepped) h /= sub_step_count(h, bound);
  const double lightest = std::ranges::min(state.vertices.mass);
  const double longest = penalty_step_bound(scene.contact, lightest);
  if (h <= longest) return;
  findings.push_back(
      {.code = "penalty_step_too_long",
       .severity = Severity::warning,
       .text = fmt::format("steps are {:.6g} s; the lightest vertex, {:.3g} kg, on one spring of "
                           "contact.penalty_stiffness is stable up to {:.6g} s",
                           h, lightest, longest),
       .remedy = "take a shorter time_step, softer springs, or contact.method impulses"});
}

void check_modal(std::vector<Finding>& findings, const MechanicsState& state) {
  for (const Component& component : state.components) {
    if (component.vertices.size() <= modal_vertex_limit) continue;
    findings.push_back(
        {.code = "body_too_large_for_modal",
         .ids = {static_cast<std::int64_t>(component.id.value)},
         .text = fmt::format("component {} has {} vertices; the method modal takes up to {}",
                             component.id.value, component.vertices.size(), modal_vertex_limit),
         .remedy = "take the method floating_frame, or a coarser mesh"});
    return;
  }
}

}  // namespace

double least_step_bound(MechanicsScratch& scratch, const MechanicsState& state,
                        const RayleighDamping& damping) {
  double least = std::numeric_limits<double>::infinity();
  for (const Component& component : state.components) {
    if (component.tetrahedra.empty() || component.rigid) continue;
    least = std::min(least, component_step_bound(scratch, state, component, damping));
  }
  return least;
}

std::vector<Finding> check_integrator_bounds(const Scene& scene, const MechanicsState& state,
                                             MechanicsScratch& scratch) {
  std::vector<Finding> findings;
  const bool is_bounded = is_explicit(scene.integrator.integrator);
  const double bound = is_bounded ? least_step_bound(scratch, state, scene.integrator.damping) : 0;
  if (is_bounded) check_explicit(findings, scene, bound);
  if (scene.contact.method == ContactMethod::penalty) check_penalty(findings, scene, state, bound);
  if (scene.integrator.integrator == Integrator::modal) check_modal(findings, state);
  return findings;
}

}  // namespace sunder
