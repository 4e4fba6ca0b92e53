// SPDX-License-Identifier: MIT
// The longest explicit step of packed bodies, by a partition of their masses among the elements.
#pragma once

#include "mechanics/contact/waves/wave_bodies.hpp"

namespace sunder {

/// 1/s^2, of an element of first order whose nodes have the inverse masses `inverse` (1/kg): at
/// least the highest eigenvalue of M^-1 K, and at most 1.12 times that. `lane`: its place in the
/// block.
double highest_of_element(const FirstOrderBlock& block, std::size_t lane,
                          const std::array<double, 4>& inverse);

/// s: the longest step h to be taken with all bodies; infinite without any. Elements of first
/// order, but scaled ones, share the mass of each node. With M_e the share of an element, and b its
/// viscosity, (h^2 + 2 h b) K_e <= 4 M_e for each of them gives h^2 K + 2 h C <= 4 M: h is stable.
/// The shares begin as those of `stable_step`, and grow twice with the eigenvalues that they allow.
/// A body allows five sixths of its h, or `stable_step` if that is more or the body is of second
/// order. The shortest step of all bodies is the result. Elements with the masses of the last call
/// keep their eigenvalues. Needs: packed blocks.
double longest_step(WaveBodies& waves);

}  // namespace sunder
