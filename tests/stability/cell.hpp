// SPDX-License-Identifier: MIT
// The possible outcomes of a method in a scenario, and the methods there are.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mechanics/contact/settings/contact_settings.hpp"
#include "mechanics/state/settings/settings.hpp"

namespace sunder::stability {

/// From good to bad.
enum class Outcome {
  not_for_it,    ///< the scenario says nothing about this method
  holds,         ///< conserved quantities stay, and values with a closed form are right
  refuses,       ///< the run is refused or stopped with the reason, before it shows nonsense
  off_path,      ///< the mass centre leaves its parabola
  loses,         ///< rigid motion is damped: the spin of the whole body goes
  false_stress,  ///< stress or strain without a cause, which would break the body
  gains,         ///< motion out of nothing: kinetic energy or spin
  diverges,      ///< the run ends in `diverged` or `not_a_number`, which is reported
  // Of contact alone:
  restless,        ///< bodies that should lie still do not, though no energy comes
  passes_through,  ///< bodies sink into one another or come out on the other side
};
inline constexpr std::string_view outcome_names[] = {
    "-",     "holds",    "refuses",  "off path",      "loses", "false stress",
    "gains", "diverges", "restless", "passes through"};
inline std::string_view name_of(Outcome outcome) {
  return outcome_names[static_cast<std::size_t>(outcome)];
}

/// The outcome, and the figure that shows how clear it is; the scenario defines the figure.
struct Cell {
  Outcome outcome = Outcome::not_for_it;
  double figure = 0;
};

/// Springs of `ContactMethod::penalty`, by the effect of one of their steps on the lightest vertex.
struct Springs {
  double turn = 0;        ///< w h, w^2 = k / m: stable up to 2; 0: contact by impulses
  double damping = 0;     ///< over c = 2 m w, which is critical
  double ball_share = 1;  ///< the paper's
};

/// An integrator with its model and options; `time_step` is the scenario's.
struct Method {
  std::string name;
  IntegratorSettings settings;
  /// Energy swings about its mean by some of the vibration's, without a drift: explicit schemes.
  bool energy_swings = false;
  bool is_damped = true;  ///< whether it takes Rayleigh damping
  Springs springs = {};
  int order = 1;  ///< of the tetrahedra
};

/// All methods; a new one is one line.
const std::vector<Method>& methods();

/// The same, and other ways of contact, with the default integrator.
std::vector<Method> contact_methods();

/// Those of a list that tetrahedra of second order take, of second order and of the same names.
std::vector<Method> of_second_order(std::vector<Method> some);

}  // namespace sunder::stability
