// SPDX-License-Identifier: MIT
// Units of length of mesh files.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace sunder {

enum class LengthUnit { m, cm, mm, um, inch, foot };

struct LengthUnitTraits {
  LengthUnit unit;
  std::string_view name;
  double metres;
};

inline constexpr std::array<LengthUnitTraits, 6> length_units = {
    {{LengthUnit::m, "m", 1},
     {LengthUnit::cm, "cm", 1e-2},
     {LengthUnit::mm, "mm", 1e-3},
     {LengthUnit::um, "um", 1e-6},
     {LengthUnit::inch, "in", 0.0254},
     {LengthUnit::foot, "ft", 0.3048}}};

/// Metres of one unit.
constexpr double metres_of(LengthUnit unit) {
  for (const LengthUnitTraits& traits : length_units) {
    if (traits.unit == unit) return traits.metres;
  }
  return 1;
}

/// The unit of a name; none where no unit has it.
constexpr std::optional<LengthUnit> length_unit_called(std::string_view name) {
  for (const LengthUnitTraits& traits : length_units) {
    if (traits.name == name) return traits.unit;
  }
  return std::nullopt;
}

}  // namespace sunder
