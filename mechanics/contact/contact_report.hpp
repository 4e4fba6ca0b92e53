// SPDX-License-Identifier: MIT
// How contact went in a step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mechanics/state/vec3.hpp"
#include "topology/base/counters.hpp"
#include "topology/base/ids.hpp"

namespace sunder {

/// How the contact problem of a step was solved.
struct ContactReport {
  std::uint32_t candidates = 0;  ///< contacts solved for
  std::uint32_t contacts = 0;    ///< those with an impulse
  int passes = 0;                ///< times the step was predicted with impulses
  int iterations = 0;            ///< sweeps, all passes
  double residual = 0;           ///< m, largest constraint violation left in a gap
  double tolerated = 0;          ///< m, `ContactSettings::tolerance` as a length
  bool converged = true;         ///< residual <= tolerated in the sweeps of every pass
  double deepest = 0;            ///< m, deepest overlap at the end of the step, >= 0
  /// Contacts that were not solved for, over `max_contacts_per_pair` or met after the last pass,
  /// and end deeper than they may.
  std::uint64_t left_out = 0;
  /// N s, one an obstacle: the impulse it gave to the bodies and balls it touched. Empty in a step
  /// without contact.
  std::vector<Vec3> obstacle_impulse;

  Vec3 impulse_of(std::size_t obstacle) const {
    return obstacle_impulse.empty() ? Vec3::Zero() : obstacle_impulse[obstacle];
  }
};

/// Of the residuals `add_contact` keeps the one that is farthest from what is tolerated.
constexpr auto counters_of(const ContactReport*) {
  return std::tuple{Counter{"", &ContactReport::candidates, Adds::most},
                    Counter{"most_contacts", &ContactReport::contacts, Adds::most},
                    Counter{"", &ContactReport::passes},
                    Counter{"", &ContactReport::iterations},
                    Counter{"left_out", &ContactReport::left_out},
                    Counter{"deepest_overlap", &ContactReport::deepest, Adds::most}};
}

/// What ties did in a step.
struct TieReport {
  std::uint32_t pairs = 0;    ///< rows solved for
  std::uint32_t opening = 0;  ///< of them, those that opened farther than ever
  int iterations = 0;         ///< back-solves for them in sub-steps
  /// Farthest a tie of a sub-step was from its law, over the opening that ends it.
  double residual = 0;
  double work = 0;            ///< J, done on ties
  double dissipated = 0;      ///< J of it, by the law; for good
  double stored = 0;          ///< J of it, by the law: in ties that would give it back
  /// Whose ties opened by more than a hundredth of what ends them, ascending.
  std::vector<ComponentId> torn;
};

constexpr auto counters_of(const TieReport*) {
  return std::tuple{Counter{"most_ties", &TieReport::pairs, Adds::most},
                    Counter{"most_opening", &TieReport::opening, Adds::most},
                    Counter{"iterations", &TieReport::iterations},
                    Counter{"residual", &TieReport::residual, Adds::most},
                    Counter{"work", &TieReport::work},
                    Counter{"dissipated", &TieReport::dissipated},
                    Counter{"stored", &TieReport::stored}};
}

/// Adds the contact of another part of the same step.
void add_contact(ContactReport& sum, const ContactReport& part);

}  // namespace sunder
