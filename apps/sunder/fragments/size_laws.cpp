// SPDX-License-Identifier: MIT
// Likelihoods, their maxima, and Kolmogorov's distances.
#include "apps/sunder/fragments/size_laws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "topology/base/assert.hpp"

namespace sunder {
namespace {

/// ln of the upper tail of the standard normal distribution; far out by its asymptotic series.
double log_normal_tail(double z) {
  if (z < 25) return std::log(0.5 * std::erfc(z / std::numbers::sqrt2));
  const double square = z * z;
  return -0.5 * square - std::log(z * std::sqrt(2 * std::numbers::pi)) +
         std::log1p(-1 / square + 3 / (square * square));
}

/// ln P(X >= x), not yet given X >= cut.
double log_tail(const FittedLaw& f, double x) {
  const auto [p, q] = f.parameters;
  switch (f.law) {
    case SizeLaw::power:
      return -p * std::log(x / f.cut);
    case SizeLaw::exponential:
      return -p * (x - f.cut);
    case SizeLaw::weibull:
      return -std::pow(x / q, p);
    case SizeLaw::lognormal:
      return x > 0 ? log_normal_tail((std::log(x) - p) / q) : 0;
  }
  return 0;
}

/// ln of the density at x, given X >= cut.
double log_density(const FittedLaw& f, double x) {
  const auto [p, q] = f.parameters;
  switch (f.law) {
    case SizeLaw::power:
      return std::log(p / f.cut) - (p + 1) * std::log(x / f.cut);
    case SizeLaw::exponential:
      return std::log(p) - p * (x - f.cut);
    case SizeLaw::weibull:
      return std::log(p / q) + (p - 1) * std::log(x / q) - std::pow(x / q, p) - log_tail(f, f.cut);
    case SizeLaw::lognormal: {
      const double z = (std::log(x) - p) / q;
      return -0.5 * z * z - std::log(x * q * std::sqrt(2 * std::numbers::pi)) - log_tail(f, f.cut);
    }
  }
  return 0;
}

double mean_log_likelihood(const FittedLaw& f, std::span<const double> values) {
  double sum = 0;
  for (const double x : values) sum += log_density(f, x);
  return sum / static_cast<double>(values.size());
}

/// Equal values are one step of the sample's distribution.
double distance_to(const FittedLaw& f, std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  double worst = 0;
  for (std::size_t i = 0; i < values.size();) {
    std::size_t end = i;
    while (end < values.size() && values[end] == values[i]) ++end;
    const double below = 1 - survival(f, values[i]);
    worst = std::max({worst, std::abs(below - static_cast<double>(i) / n),
                      std::abs(below - static_cast<double>(end) / n)});
    i = end;
  }
  return worst;
}

struct Moments {
  double mean = 0, deviation = 0;
};

Moments log_moments(std::span<const double> values) {
  Moments m;
  const auto n = static_cast<double>(values.size());
  for (const double x : values) m.mean += std::log(x) / n;
  for (const double x : values) m.deviation += std::pow(std::log(x) - m.mean, 2) / n;
  m.deviation = std::sqrt(m.deviation);
  return m;
}

/// A point of the search: the law's parameters as numbers of any size and sign.
struct Corner {
  std::array<double, 2> at{};
  double value = 0;
};

/// Both parameters of Weibull's law are positive, and so is the second of the lognormal.
std::array<double, 2> parameters_at(SizeLaw law, const std::array<double, 2>& at) {
  if (law == SizeLaw::weibull) return {std::exp(at[0]), std::exp(at[1])};
  return {at[0], std::exp(at[1])};
}

/// Maximises the likelihood by Nelder and Mead's simplex from the parameters in `f` on.
void climb(FittedLaw& f, std::span<const double> values) {
  const auto corner = [&](const std::array<double, 2>& at) {
    f.parameters = parameters_at(f.law, at);
    const double value = mean_log_likelihood(f, values);
    return Corner{at, std::isfinite(value) ? value : -1e300};
  };
  const double first = f.law == SizeLaw::weibull ? std::log(f.parameters[0]) : f.parameters[0];
  const double second = std::log(f.parameters[1]);
  std::array<Corner, 3> simplex = {corner({first, second}), corner({first + 0.3, second}),
                                   corner({first, second + 0.3})};
  for (int i = 0; i < 400; ++i) {
    std::ranges::sort(simplex, std::greater<>(), &Corner::value);
    const auto& [best, middle, worst] = simplex;
    if (best.value - worst.value < 1e-13) break;
    const auto along = [&](double t) {
      std::array<double, 2> at{};
      for (std::size_t k = 0; k < 2; ++k) {
        const double centre = (best.at[k] + middle.at[k]) / 2;
        at[k] = centre + t * (centre - worst.at[k]);
      }
      return corner(at);
    };
    Corner next = along(1);
    if (next.value > best.value) {
      if (const Corner further = along(2); further.value > next.value) next = further;
    } else if (next.value <= middle.value) {
      next = along(next.value > worst.value ? 0.5 : -0.5);
    }
    if (next.value > worst.value) {
      simplex[2] = next;
    } else {
      for (std::size_t c : {1U, 2U}) {
        simplex[c] =
            corner({(best.at[0] + simplex[c].at[0]) / 2, (best.at[1] + simplex[c].at[1]) / 2});
      }
    }
  }
  f.parameters = parameters_at(f.law, simplex[0].at);
}

/// Kolmogorov's limit: P(sqrt(n) D >= t).
double kolmogorov_tail(double t) {
  if (t < 0.2) return 1;
  double sum = 0;
  for (int k = 1; k <= 100; ++k) {
    sum += (k % 2 == 1 ? 2 : -2) * std::exp(-2.0 * k * k * t * t);
  }
  return std::clamp(sum, 0.0, 1.0);
}

}  // namespace

bool is_power_limit(const FittedLaw& law) {
  const auto [p, q] = law.parameters;
  // Over a factor of 1e6 in x the slope of ln P(X >= x) then changes by less than a half, or by
  // less than 14 / q^2.
  return (law.law == SizeLaw::weibull && p < 0.03) || (law.law == SizeLaw::lognormal && q > 20);
}

double survival(const FittedLaw& law, double x) {
  return std::exp(log_tail(law, x) - log_tail(law, law.cut));
}

FittedLaw fit_law(SizeLaw law, std::span<const double> values, double cut) {
  SUNDER_ASSERT(values.size() > 1 && values.front() < values.back(), "one value has no law");
  FittedLaw f{law, cut};
  const auto n = static_cast<double>(values.size());
  double sum = 0;
  if (law == SizeLaw::power) {
    for (const double x : values) sum += std::log(x / cut);
    f.parameters[0] = n / sum;
  } else if (law == SizeLaw::exponential) {
    for (const double x : values) sum += x - cut;
    f.parameters[0] = n / sum;
  } else {
    const Moments m = log_moments(values);
    f.parameters = {m.mean, m.deviation};
    // ln of a Weibull variable has the deviation pi / sqrt(6) / modulus and lies 0.577 / modulus
    // below the scale's.
    if (law == SizeLaw::weibull) {
      const double modulus = 1.2825 / m.deviation;
      f.parameters = {modulus, std::exp(m.mean + 0.5772 / modulus)};
    }
    if (law == SizeLaw::weibull || cut > 0) climb(f, values);
  }
  f.log_likelihood = mean_log_likelihood(f, values);
  f.distance = distance_to(f, values);
  return f;
}

std::optional<FittedLaw> fit_power_tail(std::span<const double> values) {
  std::vector<std::size_t> firsts;
  for (std::size_t i = 0; i + fewest_for_fit <= values.size(); ++i) {
    const bool fresh = i == 0 || values[i] != values[i - 1];
    if (fresh && values[i] < values.back()) firsts.push_back(i);
  }
  constexpr std::size_t most = 400;
  const std::size_t stride = (firsts.size() + most - 1) / most;
  std::optional<FittedLaw> best;
  for (std::size_t k = 0; k < firsts.size(); k += stride) {
    const FittedLaw f = fit_law(SizeLaw::power, values.subspan(firsts[k]), values[firsts[k]]);
    if (!best || f.distance < best->distance) best = f;
  }
  return best;
}

SampleDistance sample_distance(std::span<const double> a, std::span<const double> b) {
  if (a.empty() || b.empty()) return {};
  const auto n = static_cast<double>(a.size()), m = static_cast<double>(b.size());
  SampleDistance result;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double x = std::min(a[i], b[j]);
    while (i < a.size() && a[i] == x) ++i;
    while (j < b.size() && b[j] == x) ++j;
    result.distance = std::max(result.distance,
                               std::abs(static_cast<double>(i) / n - static_cast<double>(j) / m));
  }
  const double root = std::sqrt(n * m / (n + m));
  result.probability = kolmogorov_tail((root + 0.12 + 0.11 / root) * result.distance);
  return result;
}

double vuong(const FittedLaw& a, const FittedLaw& b, std::span<const double> values) {
  double sum = 0, squares = 0;
  for (const double x : values) {
    const double difference = log_density(a, x) - log_density(b, x);
    sum += difference;
    squares += difference * difference;
  }
  const auto n = static_cast<double>(values.size());
  const double variance = squares - sum * sum / n;
  return variance > 0 ? sum / std::sqrt(variance) : 0;
}

}  // namespace sunder
