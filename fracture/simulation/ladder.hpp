// SPDX-License-Identifier: MIT
// Which rung each component takes its next step on: no more than the scene needs
// (docs/explanation/time_and_contact.md).
#pragma once

#include <span>
#include <vector>

#include "fracture/scene/scene.hpp"
#include "fracture/simulation/state.hpp"
#include "fracture/simulation/step_report.hpp"
#include "mechanics/state/impulse.hpp"

namespace sunder {

/// Bound on the largest principal node stress (Pa) that a free component can come to while nothing
/// touches it, from its present energy and motion:
///   sqrt(2 M (U + T_d) / V) + 2 rho s^2
/// U is its strain energy, T_d the kinetic energy of its deformation, V the volume of its smallest
/// star. s is the largest speed of a vertex against the mass centre, M = lambda + 2 mu = rho c_p^2.
/// First term: a volume V under the mean stress of largest eigenvalue sigma holds at least V
/// sigma^2 / (2 M). This is for uniaxial strain; for nu = 0, M is E. The volume cannot hold more
/// than the present energy. Second: centrifugal forces stress a rod with rho s^2 / 2 at most and a
/// disc with 0.41 rho s^2. The factor leaves four times that for notches
/// (`tests/fracture/simulation/ladder_test.cpp` compares it with the equilibria of spinning
/// bodies). O(rows of the component).
double flight_stress_bound(const MechanicsState& state, const Component& component);

/// Marks components with cohesive bonds; rows of `tied` = ComponentId. Parts that bonds alone hold
/// together have no equilibrium by K.
void find_tied(std::vector<char>& tied, const SimulationState& state);

/// Marks components that came off another one or that something came off; rows = ComponentId.
void find_separated(std::vector<char>& separated, const SimulationState& state);

/// Vertices of a free component move with its frame alone from now on. Gives the kinetic energy of
/// its deformation, which is lost, J. Momenta stay. O(vertices of the component).
double stop_deforming(MechanicsState& state, const Component& component);

/// Marks the components that the contacts of a part pushed at; rows of `touched` = ComponentId.
void note_touches(std::vector<char>& touched, const MechanicsState& state,
                  std::span<const ContactPoint> contacts);

/// Energy and momentum given up by components that take a lower rung.
struct GivenUp {
  double energy = 0;                   ///< J
  Impulse momentum = Impulse::Zero();  ///< of components that fall asleep
};

/// Inputs to the choice of rungs, in addition to the state.
struct RungInput {
  const Scene& scene;
  const std::vector<char>& touched;  ///< row = ComponentId: a contact pushed at it in this step
};

/// Whether every piece sleeps and no obstacle moves or could: nothing can happen any more.
bool all_rest(const SimulationState& state);

/// Chooses the rungs of the next step, after everything else in this one:
/// - `rigid`: free, not touched in this step, in no impact window and without surface loads.
///   `flight_stress_bound` is below half of the lowest strength of its vertices, and no vertex
///   swings at more than 1e-7 of the critical speed. Its rates of deformation are given up and
///   counted. It stays while the bound holds and nothing overlaps it.
/// - `quasi_static`: supported by three vertices off one line, without cohesive bonds, not touched
///   in this step and in no impact window. No free vertex moves in its frame at more than a
///   thousandth of the critical speed xi / (rho c). So inertia could not add more than that share
///   of the strength. It stays while that holds.
/// - `asleep`: for `sleep_after`, it and all bodies that it touches had no vertex faster than the
///   rest speed of the step. Gravity and loads are fully raised. It wakes when an awake body
///   touches it, or any moving body overlaps it (mechanics/contact/contact.cpp).
/// - `full`: all others, and everything under other integrators than floating_frame.
/// Gives the number of components on each rung; `given_up` increases by the energy and momentum
/// given up.
LadderReport choose_rungs(GivenUp& given_up, SimulationState& state, const RungInput& input,
                          LadderScratch& scratch);

}  // namespace sunder
