// SPDX-License-Identifier: MIT
// One key of a settings object: name, unit, meaning, range. Settings and their keys are described
// once, in files named *_fields.hpp. Code that reads, checks or documents settings visits those
// descriptions.
#pragma once

#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace sunder::fields {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// No setting is larger in size, so that squares and products of several stay finite.
inline constexpr double most_number = 1e30;
/// Nor smaller, where it cannot be below 0: quotients by its square stay finite. 0 itself is
/// another matter.
inline constexpr double least_number = 1e-30;

/// Numbers that are allowed, all of them within `most_number`; each element of a vector is held to
/// it.
struct Range {
  double low = -infinity;
  double high = infinity;
  bool without_low = false;    ///< `low` itself is not allowed
  bool with_infinity = false;  ///< infinity is allowed too, besides the finite numbers
};
constexpr Range at_least(double low) { return {.low = low}; }
constexpr Range above(double low) { return {.low = low, .without_low = true}; }
constexpr Range between(double low, double high) { return {.low = low, .high = high}; }

/// One key of an object. Without `required` the member's value in a default-constructed struct is
/// the default.
struct Key {
  std::string_view name;
  /// Empty if it has none.
  std::string_view unit;
  /// Its meaning, for the schema.
  std::string_view text;
  Range range = {};
  bool required = false;
  /// Added to the remedy when the value is refused.
  std::string_view remedy = {};
  /// Left out, a scene file's `accuracy` chooses it (fracture/scene/choose_settings.hpp).
  bool chosen = false;
};

/// The values of an enum and their names in scene files.
template <class E>
using Names = std::vector<std::pair<E, std::string_view>>;

}  // namespace sunder::fields
