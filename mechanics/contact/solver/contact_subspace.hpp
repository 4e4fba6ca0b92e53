// SPDX-License-Identifier: MIT
// All contacts that press or stick at once: the equations that sweeps converge to, solved directly.
#pragma once

#include "mechanics/contact/solver/row_response.hpp"

namespace sunder {

/// Minimises the same energy as the sweeps, over the directions that their last impulses leave
/// free: normal parts off their bounds, friction inside its disk [Silcowitz, Niebe, Erleben 2010:
/// subspace minimization]. Sweeps need as many rounds as bodies are stiffer than free: h^2 / m over
/// the give of a contact, 10^4 for a metre of concrete at 10 ms. Here the rigid motions of all
/// bodies are solved for at once, by
///   (D + G W G^T)^-1 = D^-1 - D^-1 G (W^-1 + G^T D^-1 G)^-1 G^T D^-1,
/// D the contacts' own elastic blocks, W the bodies' inverse masses. This is the preconditioner of
/// conjugate gradients on the elastic part. The impulses keep their bounds, and the energy never
/// rises.
/// Where bounds stop it early and `again` is true, it tries without the rows that do.
/// Gives the number of products with the response, at most `most`. Needs: responses set, bodies
/// with the motion of the impulses.
int solve_subspace(const RowSolve& solve, int most, bool again);

}  // namespace sunder
