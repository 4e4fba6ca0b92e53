// SPDX-License-Identifier: MIT
// The one way from a floating-point number to a whole one: a plain cast of a number beyond the type
// is undefined.
#pragma once

#include <concepts>
#include <limits>

namespace sunder {

/// The whole part of `value` (cut towards 0, as a cast does), kept between the lowest value of the
/// type and `most`. 0 for NaN. O(1).
template <std::integral Whole>
constexpr Whole whole_number(double value, Whole most = std::numeric_limits<Whole>::max()) {
  constexpr Whole least = std::numeric_limits<Whole>::lowest();
  if (value != value) return 0;
  // The largest 64-bit numbers round up as doubles: equal numbers would not fit.
  if (value >= static_cast<double>(most)) return most;
  if (value <= static_cast<double>(least)) return least;
  return static_cast<Whole>(value);
}

/// A number as another type of number: by `whole_number` from real to whole, else as a cast does.
template <class To, class From>
constexpr To number_cast(From value) {
  if constexpr (std::integral<To> && std::floating_point<From>) {
    return whole_number<To>(static_cast<double>(value));
  } else {
    return static_cast<To>(value);
  }
}

}  // namespace sunder
