// SPDX-License-Identifier: MIT
// The excess of second-order schemes when a lumped vertex is stopped, and how it is taken back.
#pragma once

#include "mechanics/contact/response/contact_bodies.hpp"

namespace sunder {

/// Takes back the impulse that makes contacts bounce, right after a step was adopted. The response
/// of a scheme is beta h A^-1 j. To close a gap by the end of a step, it needs up to twice the
/// impulse that stops a lumped vertex. The velocity of the vertex reverses, at once or over the
/// next steps by the acceleration that the scheme remembers. The coming normal velocity is
///   n . (v + lambda h a),  lambda = (1 - gamma + gamma r)/(1 - r),  r = -alpha_m/(1 - alpha_m).
/// Where it parts the sides, the remembered acceleration is turned into that velocity. An impulse
/// at the lumped masses then stops it, never more than the step's contact gave. Stiff contacts, for
/// which a step is long for the neighbours, have nothing to take back: both are zero there.
/// `contacts`: with the impulses of the step, which change. Momentum is conserved; energy falls.
void take_back_bounce(std::span<ContactPoint> contacts, ContactBodies& bodies,
                      const ContactPass& pass, const ContactSettings& settings);

}  // namespace sunder
