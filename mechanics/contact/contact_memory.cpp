// SPDX-License-Identifier: MIT
// Values that a step takes from the last step and leaves to the next.
#include <algorithm>

#include "mechanics/contact/contact_step.hpp"
#include "mechanics/frame/rotation.hpp"

namespace sunder {
namespace {

bool by_key(const ContactMemory::Remembered& a, const ContactMemory::Remembered& b) {
  return key_of(a.contact) < key_of(b.contact);
}

/// Whether all sides of a contact belong to the step, and not all of them are carried. Contacts
/// among carried bodies were solved when these took the step.
bool concerns_step(const ContactStep& step, const ContactPoint& contact) {
  const StepMembers& members = step.pass.input.members;
  const MechanicsState& state = step.pass.state;
  bool all = true, any = false;
  const auto see = [&](ComponentId id) {
    all = all && members.has(id);
    any = any || state.components[id.index()].rung != Rung::carried;
  };
  const auto see_ball = [&](std::uint32_t row) {
    if (row == ContactPoint::none || !step.pass.obstacles[row].mass) return;
    all = all && members.has_ball(row);
    any = true;
  };
  see_ball(contact.ball);
  see_ball(contact.obstacle);
  for_each_component(contact, state, see);
  return all && any;
}

}  // namespace

Vec3 last_impulse(const ContactStep& step, const ContactPoint& contact) {
  const auto& last = step.memory.last_contacts;
  const ContactMemory::Remembered sought{contact, step.h()};
  const auto found = std::lower_bound(last.begin(), last.end(), sought, by_key);
  if (found == last.end() || key_of(found->contact) != key_of(contact)) return Vec3::Zero();
  // Turned with the normal, so that it stays inside the bounds and the circle.
  const Eigen::Quaterniond turn = least_rotation(found->contact.normal, contact.normal);
  return step.h() / found->step * (turn * found->contact.impulse);
}

void guess_from_last_step(ContactStep& step) {
  for (std::size_t k = 0; k < step.contacts.size(); ++k) {
    if (!concerns_step(step, step.contacts[k])) continue;
    step.scratch.bodies.rows[k].guess = last_impulse(step, step.contacts[k]);
  }
}

void remember_contacts(ContactStep& step) {
  auto& last = step.memory.last_contacts;
  std::erase_if(last, [&](const auto& old) { return concerns_step(step, old.contact); });
  for (const std::vector<ContactPoint>* those : {&step.contacts, &step.tied}) {
    for (const ContactPoint& contact : *those) {
      if (concerns_step(step, contact)) last.push_back({contact, step.h()});
    }
  }
  std::sort(last.begin(), last.end(), by_key);
}

}  // namespace sunder
