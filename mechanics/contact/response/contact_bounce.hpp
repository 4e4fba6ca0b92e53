// SPDX-License-Identifier: MIT
// What second-order schemes overdo when a lumped vertex is stopped, and how it is taken back.
#pragma once

#include "mechanics/contact/response/contact_bodies.hpp"

namespace sunder {

/// Takes back what sends contacts off the other side, right after a step was adopted.
/// A gap closed by the end of a step needs, from a scheme whose response in the step is
/// beta h A^-1 j, up to twice the impulse that stops a lumped vertex: its velocity reverses, at
/// once or over the next steps by the acceleration that the scheme remembers. Where the normal
/// velocity that is to come,
///   n . (v + lambda h a),  lambda = (1 - gamma + gamma r)/(1 - r),  r = -alpha_m/(1 - alpha_m),
/// parts the sides, the remembered acceleration is turned into that velocity and an impulse at the
/// lumped masses stops it, never more than the step's contact gave. Stiff contacts, where a step is
/// long for the neighbours, have nothing to take back: there both are zero.
/// `contacts`: with the impulses of the step, which change. Momentum is conserved; energy falls.
void take_back_bounce(std::span<ContactPoint> contacts, ContactBodies& bodies,
                      const ContactPass& pass, const ContactSettings& settings);

}  // namespace sunder
