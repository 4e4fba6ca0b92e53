// SPDX-License-Identifier: MIT
// A part of an impact in explicit steps: bodies that deform, rigid pieces and their contacts.
#pragma once

#include "mechanics/contact/contact_step.hpp"
#include "mechanics/contact/waves/lumped_bonds.hpp"
#include "mechanics/contact/waves/lumped_rows.hpp"

namespace sunder {

/// Searches for contacts: their scope, and the expected ways of bodies. Times count from the last
/// search of everything, when a part asked for one (`StepPart::contacts_for`).
struct WaveSearch {
  double lasts = 0;  ///< s: contacts are found up to then
  double clock = 0;  ///< s: now
  /// m and m/s, row = vertex: at time 0 on the straight way of its body's last search, and how fast
  /// along it.
  std::vector<Vec3> position, velocity;
  std::vector<std::array<Vec3, 2>> obstacle;  ///< the same of free obstacles; row = obstacle
  std::vector<Scope> scope;                   ///< row = component: in the part at hand
  bool any = false;                           ///< whether any is inside
};

/// Scratch of explicit steps, kept from part to part. May be thrown away between two steps.
struct WaveScratch {
  WaveBodies bodies;
  LumpedContacts contacts;
  LumpedBonds bonds;
  std::vector<std::uint32_t> rigid_of_component, rigid_of_obstacle;
  std::vector<ContactPoint> kept;  ///< the contacts of the last part, with gaps as it ended
  WaveSearch search;
  /// Element stresses as the part began, kept while the part can end early (`StepInput::ends`).
  std::vector<Mat3> stress;
  std::vector<std::array<Mat3, 4>> corner_stress;
};

/// The contacts of the part, into `step.contacts`. With `StepPart::contacts_for`: along the ways
/// that everything would go in that time. Else those of the part before, but for bodies that have
/// strayed from those ways, which are searched again.
void gather_contacts(ContactStep& step);

/// Gathers rigid pieces and free obstacles into `wave.contacts.rigid`.
void enlist_rigid(WaveScratch& wave, const ContactStep& step);

/// Rows of `step.contacts`, with the impulses of the last part over `count` steps. Needs:
/// `pack_bodies`, `enlist_rigid`.
void make_rows(WaveScratch& wave, const ContactStep& step, double count);

/// Bonds of the ties of the part, likewise.
void take_ties(WaveScratch& wave, ContactStep& step, double count);

/// Takes the part at hand (`Deformation::wave`) in explicit steps, into `predicted`:
/// - contacts (`gather_contacts`);
/// - central differences (velocity Verlet): half a kick, then drifts with kicks between them, half
///   a kick; impulses of contacts between each kick and drift;
/// - frames, displacements and rates from where the nodes end (`fit_motion`).
/// The part ends early where `StepInput::ends` says so. Then its length and that of the settings
/// is the one taken. The step is at most 0.9 of `longest_step`. Momentum and
/// angular momentum are conserved to rounding.
void take_explicit_part(ContactStep& step);

/// Free obstacles where the part has led them. Needs: `take_explicit_part`.
void move_free_obstacles(ContactStep& step);

/// The report of the ties after the part. Their impulses go to `step.tied`.
TieReport finish_explicit_ties(ContactStep& step);

}  // namespace sunder
