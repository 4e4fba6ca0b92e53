// SPDX-License-Identifier: MIT
// Reports of contact and ties of a step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mechanics/state/vec3.hpp"
#include "topology/base/counters.hpp"
#include "topology/base/ids.hpp"

namespace sunder {

/// Solution of the contact problem of a step.
struct ContactReport {
  std::uint32_t candidates = 0;  ///< contacts in the solve
  std::uint32_t contacts = 0;    ///< contacts with an impulse
  int passes = 0;                ///< predictions of the step with impulses
  int iterations = 0;            ///< sweeps, all passes
  double residual = 0;           ///< m, largest constraint violation left in a gap
  double tolerated = 0;          ///< m, `ContactSettings::tolerance` as a length
  double force_error = 0;        ///< N, by which the last sweep changed a contact's force most
  bool converged = true;         ///< residual <= tolerated in the sweeps of every pass
  double deepest = 0;            ///< m, deepest overlap at the end of the step, >= 0
  /// Contacts outside the solve (over `max_contacts_per_pair`, or met after the last pass) that end
  /// deeper than allowed.
  std::uint64_t left_out = 0;
  /// Impulse of each obstacle on the bodies and balls that it touched, N s. Empty after a step
  /// without contact.
  std::vector<Vec3> obstacle_impulse;

  Vec3 impulse_of(std::size_t obstacle) const {
    return obstacle_impulse.empty() ? Vec3::Zero() : obstacle_impulse[obstacle];
  }
};

/// `add_contact` keeps the residual that exceeds its tolerance most.
constexpr auto counters_of(const ContactReport*) {
  return std::tuple{Counter{"", &ContactReport::candidates, Adds::most},
                    Counter{"most_contacts", &ContactReport::contacts, Adds::most},
                    Counter{"", &ContactReport::passes},
                    Counter{"", &ContactReport::iterations},
                    Counter{"left_out", &ContactReport::left_out},
                    Counter{"deepest_overlap", &ContactReport::deepest, Adds::most}};
}

/// Ties in a step.
struct TieReport {
  std::uint32_t pairs = 0;    ///< rows in the solve
  std::uint32_t opening = 0;  ///< rows that opened farther than before
  /// Largest deviation of a tie from its law in a sub-step, over the opening at which the tie ends.
  double residual = 0;
  double work = 0;        ///< J, work on ties
  double dissipated = 0;  ///< J of that, lost by the law
  double stored = 0;      ///< J of that, recoverable by the law
  /// Components with ties that opened by more than 1 % of the opening at which they end, ascending.
  std::vector<ComponentId> torn;
};

constexpr auto counters_of(const TieReport*) {
  return std::tuple{Counter{"most_ties", &TieReport::pairs, Adds::most},
                    Counter{"most_opening", &TieReport::opening, Adds::most},
                    Counter{"residual", &TieReport::residual, Adds::most},
                    Counter{"work", &TieReport::work},
                    Counter{"dissipated", &TieReport::dissipated},
                    Counter{"stored", &TieReport::stored}};
}

/// Adds the contact of another part of the same step.
void add_contact(ContactReport& sum, const ContactReport& part);

}  // namespace sunder
