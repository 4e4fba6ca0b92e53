// SPDX-License-Identifier: MIT
// The input of a step besides the state: loads, settings, the part of a step, and its members.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mechanics/state/mechanics_state.hpp"
#include "mechanics/state/settings/settings.hpp"

namespace sunder {

struct ImpactSettings;

/// Loads from outside during one step, constant over the step.
struct Loads {
  Vec3 gravity = Vec3::Zero();   ///< m/s^2
  std::vector<Vec3> force = {};  ///< N, world, |V| rows; empty: none
  /// Which part of `force` turns with its body during the step, as pressure does, so that its
  /// moment stays what it was at the start; the rest keeps its direction. |V| rows; empty: none.
  std::vector<Vec3> turning = {};
  /// Gravity changes velocities at the start of the step instead of bending paths to parabolas.
  /// This is for bodies pressed by contact, with a rest that would otherwise be a saw-tooth of
  /// +- g h / 2. For implicit Euler; others ignore it.
  bool weight_at_start = false;
};

/// How deformations go through a step of floating_frame, or through a part of one.
enum class Deformation {
  whole,     ///< by generalised-alpha
  frozen,    ///< not at all: the frame moves alone; pulled components (`is_pulled`) catch up
  catch_up,  ///< by generalised-alpha over the whole step, in a part that may be shorter
  wave,      ///< by explicit steps (mechanics/contact/waves/)
};

/// Which part of a step is taken; `IntegratorSettings::time_step` is its length.
struct StepPart {
  Deformation deformation = Deformation::whole;
  double whole_step = 0;  ///< s, for `catch_up` and `frozen`
  /// Given, contact looks out for blows (`advance_with_contact`).
  const ImpactSettings* impact = nullptr;
  /// With `impact`: lowest tensile strength in each component, Pa; |C|.
  std::span<const double> strength = {};
  /// With `impact`: J that a component must hold before it can break, |C|. Blows below it do not
  /// count. Empty: every blow counts.
  std::span<const double> threshold = {};
  /// Of a wave: cells get the viscosity C = this times `Component::cell_travel` times K, but at
  /// most half of critical damping. It keeps wave fronts from overshooting on a mesh, as the linear
  /// bulk viscosity of explicit codes does [von Neumann and Richtmyer 1950].
  double viscosity = 0.3;
  /// s, of a wave: contacts are found for so long; 0: those found before still serve.
  double contacts_for = 0;
  /// Of a wave: equal parts of its length, after each of which it may end
  /// (`StepInput::ends`).
  std::uint32_t sub_steps = 1;
  /// A step in which pieces would pass each other, fast or in a spin, is not taken.
  bool divides = false;
};

/// The members of a step, by rows of components and obstacles: a row of 0 keeps still and meets
/// nothing. Empty: everything moves.
struct StepMembers {
  std::span<const char> component, ball;
  bool has(ComponentId id) const { return component.empty() || component[id.index()] != 0; }
  bool has_ball(std::size_t row) const { return ball.empty() || ball[row] != 0; }
};

/// The input of one step, which does not change. The spans and references must outlive the call.
/// Parts and members are for callers that divide steps (fracture/simulation/plan.hpp).
struct StepInput {
  std::span<const Corners> corners;  ///< |T|
  const Loads& loads;
  const IntegratorSettings& settings;
  StepPart part = {};
  StepMembers members = {};
  /// |T|: the half-face beyond each face, by its place, or none(): the surface that contact between
  /// pieces goes by. Needed where there are several components and contact.
  std::span<const std::array<HalfFaceId, 4>> neighbours = {};
  /// Whether `Component::strain_change` is wanted.
  bool measures_strain = false;
  /// Threads that factors and columns of the inverse are made on. Results are the same bytes for
  /// any number.
  unsigned threads = 1;
  /// Given, a wave calls it after each of its sub-steps but the last. True: the part ends there.
  /// Displacements, element stresses and the time are then those of the moment.
  const std::function<bool()>* ends = nullptr;
  /// Given and true: iterations end where they are.
  const std::atomic<bool>* hurry = nullptr;

  bool is_hurried() const { return hurry && hurry->load(std::memory_order_relaxed); }
  /// s, over which the deformation of a component goes by generalised-alpha.
  double deformation_step(const Component& component) const {
    const bool is_own =
        part.deformation == Deformation::catch_up || part.deformation == Deformation::frozen;
    return is_own && !component.partly_held ? part.whole_step : settings.time_step;
  }
};

/// The same input with other settings, which must outlive it.
inline StepInput with_settings(const StepInput& input, const IntegratorSettings& settings) {
  return {input.corners,    input.loads,           settings,      input.part, input.members,
          input.neighbours, input.measures_strain, input.threads, input.ends, input.hurry};
}

}  // namespace sunder
