// SPDX-License-Identifier: MIT
// Drawn strengths, the sawtooth, and formulas for the size of fragments.
#include "tests/experiments/chain/loads.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace sunder::chain {

std::vector<double> strengths_of(const RingStrengths& strengths, int cells) {
  // Not a distribution of the library's: those differ from one to the next.
  std::mt19937 random(strengths.seed);
  std::vector<double> drawn;
  for (int k = 0; k < strengths.places; ++k) {
    drawn.push_back(strengths.least * (1 + strengths.spread * random() / 4294967296.0));
  }
  std::vector<double> seen;
  for (int k = 0; k < cells; ++k) {
    // In whole numbers, so that a place that a section lies on is met to the bit.
    const auto at = static_cast<long long>(k) * strengths.places;
    const auto low = static_cast<std::size_t>(at / cells);
    const double share = double(at % cells) / cells;
    seen.push_back((1 - share) * drawn[low] + share * drawn[(low + 1) % drawn.size()]);
  }
  return seen;
}

double Pulse::stress(double x) const {
  const double behind = front - x;
  if (behind <= 0 || behind >= length) return 0;
  return peak * std::min(behind / ramp, (length - behind) / (length - ramp));
}

double Pulse::integral(double x) const {
  const double behind = std::clamp(front - x, 0.0, length);
  if (behind <= ramp) return peak * behind * behind / (2 * ramp);
  const double left = length - behind, fall = length - ramp;
  return peak * (ramp / 2 + (fall - left * left / fall) / 2);
}

namespace {

/// s0 and e of the formulas.
struct Numbers {
  double size, rate;
};

Numbers numbers_of(const RingLaw& law) {
  const double E = law.young_modulus, sigma = law.strength, c = std::sqrt(E / law.density);
  return {E * law.fracture_energy / (sigma * sigma),
          law.rate * E * E * law.fracture_energy / (c * sigma * sigma * sigma)};
}

}  // namespace

double zhou_size(const RingLaw& law) {
  const Numbers n = numbers_of(law);
  return n.size * 4.5 / (1 + 4.5 * std::pow(n.rate, 2.0 / 3));
}

double glenn_size(const RingLaw& law) {
  const Numbers n = numbers_of(law);
  return n.size * 4 / n.rate * std::sinh(std::asinh(1.5 * n.rate) / 3);
}

}  // namespace sunder::chain
