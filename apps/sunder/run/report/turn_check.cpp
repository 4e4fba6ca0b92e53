// SPDX-License-Identifier: MIT
// Turns of elements against the strain at which they break.
#include "apps/sunder/run/report/turn_check.hpp"

#include <fmt/format.h>

#include "mechanics/element/strain_displacement.hpp"

namespace sunder {
namespace {

/// Of a component's volume: the elements that have turned further than `valid`, rad.
double share_turned(const SimulationState& state, const Component& component, double valid) {
  const MechanicsState& m = state.mechanics;
  double turned = 0, whole = 0;
  for (const TetId t : component.tetrahedra) {
    const CornerVectors d = at_corners(m.vertices.displacement, state.cells.map.corners(t));
    const double volume = m.elements.rest_volume[t.index()];
    whole += volume;
    if (turn_of(displacement_gradient(m.elements.shape_gradient[t.index()], d)) > valid) {
      turned += volume;
    }
  }
  return turned / whole;
}

/// Cells at a crack turn before they come off, in every body that breaks, so a small share is no
/// sign of a body that bends too far. The value is a choice; no measurement stands behind it.
constexpr double allowed_share_turned = 0.05;

/// Of the breaking strain. Parts of a cracked body hinge about its cracks: the sample `block` with
/// 0.12 has 349 fans and a largest piece of 1435 kg, with a frame per tetrahedron 375 and 1437 kg.
constexpr double allowed_false_strain = 0.5;

}  // namespace

std::optional<Finding> check_turns(const Simulation& now, const StepReport& report) {
  const MechanicsState& mechanics = now.state->mechanics;
  for (const Component& component : mechanics.components) {
    if (component.tetrahedra.empty() || component.rigid) continue;
    const MaterialId material = mechanics.elements.material[component.tetrahedra[0].index()];
    const double valid =
        largest_valid_turn(mechanics.materials[material.index()], allowed_false_strain);
    if (!(component.largest_turn > valid)) continue;
    const double share = share_turned(*now.state, component, valid);
    if (!(share > allowed_share_turned)) continue;
    return Finding{
        .code = turned_too_far,
        .severity = Severity::warning,
        .ids = {static_cast<std::int64_t>(component.id.index())},
        .text = fmt::format("from step {} (t = {:.6g} s) on {:.0f} % of component {} have "
                            "turned by up to {:.3g} rad against its reference; beyond {:.3g} the "
                            "false strain is over half of the strain that breaks it",
                            report.step, report.time, 100 * share, component.id.index(),
                            component.largest_turn, valid),
        .remedy =
            "stresses there are too high by about E theta^2 / 2; \"model\": \"corotational\" "
            "avoids this, with \"integrator\": {\"method\": \"sub_stepped\"} and some "
            "damping for a short blow, else with \"implicit_euler\""};
  }
  return std::nullopt;
}

}  // namespace sunder
