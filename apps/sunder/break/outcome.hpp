// SPDX-License-Identifier: MIT
// The outcome of a run in one sentence.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace sunder {

/// A piece of this share of the mass or more is large (as in docs/lab/ensembles.md).
inline constexpr double large_share = 0.01;

/// "12 pieces, 4 large ones with 93 % of the mass, largest 41 %". `masses`: kg, of all pieces, > 0,
/// at least one. `cracks`: their number, for the words of a body in one piece.
std::string outcome_sentence(std::span<const double> masses, std::size_t cracks);

}  // namespace sunder
