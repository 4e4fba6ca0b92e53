// SPDX-License-Identifier: MIT
// Ties in the course of a whole step: gathered, and settled.
#include "mechanics/contact/contact_step.hpp"

namespace sunder {

void begin_ties(ContactStep& step) {
  if (step.deformation() == Deformation::frozen) return;
  step.ties = gather_ties(step.memory, paths_of(step));
  for (const TiePair& pair : step.ties) step.tied.push_back(contact_of(pair));
  step.tied_rows = step.ties.size();
  step.contacts = step.tied;
}

TieReport finish_ties(ContactStep& step) {
  for (std::size_t k = 0; k < step.tied_rows; ++k) step.tied[k].impulse = step.contacts[k].impulse;
  step.contacts.erase(step.contacts.begin(),
                      step.contacts.begin() + static_cast<std::ptrdiff_t>(step.tied_rows));
  step.tied_rows = 0;
  std::vector<Vec3> impulses;
  for (const ContactPoint& tied : step.tied) impulses.push_back(tied.impulse);
  return settle_ties(step.ties, impulses, paths_of(step));
}

}  // namespace sunder
