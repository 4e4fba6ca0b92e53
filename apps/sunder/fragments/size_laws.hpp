// SPDX-License-Identifier: MIT
// Laws of sizes fitted to a sample by maximum likelihood, and how far each is from it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sunder {

enum class SizeLaw {
  /// P(X >= x) = (x / cut)^-p0.
  power,
  /// exp(-p0 (x - cut)).
  exponential,
  /// exp(-(x / p1)^p0), given x >= cut: p0 the modulus, p1 the scale.
  weibull,
  /// ln x normal with mean p0 and standard deviation p1, given x >= cut.
  lognormal,
};
inline constexpr std::array<std::string_view, 4> size_law_names = {"power law", "exponential",
                                                                   "Weibull", "lognormal"};

/// A law that was fitted to the values from `cut` on (0: all of them).
struct FittedLaw {
  SizeLaw law = SizeLaw::power;
  double cut = 0;
  std::array<double, 2> parameters{};
  /// ln of the likelihood over the number of values fitted; larger is better, and comparable
  /// between laws fitted to the same values only.
  double log_likelihood = 0;
  /// Largest difference between the cumulative distributions of law and values (Kolmogorov and
  /// Smirnov).
  double distance = 0;
};

/// Whether a fit above a cut has run away to the limit in which Weibull's law (modulus 0) and the
/// lognormal (deviation without bounds) are power laws.
bool is_power_limit(const FittedLaw& law);

/// Fewest values a law is fitted to: fewer cannot distinguish the laws
/// (docs/explanation/validation_and_limits.md).
inline constexpr std::size_t fewest_for_fit = 50;

/// P(X >= x) under a law, for x >= cut.
double survival(const FittedLaw& law, double x);

/// Fits one law to `values` (ascending, above 0, all >= `cut`) by maximum likelihood: power law and
/// exponential in closed form, the others by a simplex search. `cut` above 0 for the power law.
/// Needs: at least two different values. O(n) evaluations of the law.
FittedLaw fit_law(SizeLaw law, std::span<const double> values, double cut);

/// The power law with the cut for which its distance to the values above is least (Clauset, Shalizi
/// and Newman 2009, section 3.3), among those that leave `fewest_for_fit` of them; nothing where no
/// cut does. `values`: ascending, above 0. At most 400 cuts are tried, spread evenly over the
/// values.
std::optional<FittedLaw> fit_power_tail(std::span<const double> values);

/// Kolmogorov's distance between two samples, each ascending, and the probability that two samples
/// of one distribution are at least as far apart (asymptotic; good from about 10 values each).
struct SampleDistance {
  double distance = 0, probability = 1;
};
SampleDistance sample_distance(std::span<const double> a, std::span<const double> b);

/// Whether law `a` is nearer to the values than `b`, both fitted to them (Vuong 1989): sum of the
/// differences of their log likelihoods over its standard deviation. Above 2 `a` is better, below
/// -2 `b`, between them the sample does not tell.
double vuong(const FittedLaw& a, const FittedLaw& b, std::span<const double> values);

}  // namespace sunder
