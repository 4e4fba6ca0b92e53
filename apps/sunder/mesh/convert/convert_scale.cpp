// SPDX-License-Identifier: MIT
#include "apps/sunder/mesh/convert/convert_scale.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>

#include "topology/base/counted.hpp"

namespace sunder {

void add_scale_options(CLI::App& command, ScaleOptions& options) {
  std::map<std::string, LengthUnit> units;
  for (const LengthUnitTraits& unit : length_units) units[std::string(unit.name)] = unit.unit;
  command.add_option("--units", options.units, "Unit of IN: OUT is in metres")
      ->transform(CLI::CheckedTransformer(units).description(""))
      ->type_name("m|cm|mm|um|in|ft");
  command.add_option("--scale", options.scale, "Factor of all coordinates, after --units")
      ->type_name("FACTOR")
      ->check(CLI::PositiveNumber);
}

std::optional<Finding> scale_points(FileMesh& mesh, const ScaleOptions& options) {
  const double metres = metres_of(options.units) * options.scale;
  if (metres == 1) return std::nullopt;
  for (Point& p : mesh.points) {
    for (double& x : p) {
      x *= metres;
      if (std::isfinite(x)) continue;
      return Finding{.code = "out_of_range",
                     .text = fmt::format("a factor of {:.6g} makes a coordinate infinite", metres),
                     .remedy = "take a smaller --scale"};
    }
  }
  const std::size_t count = mesh.points.size();
  return Finding{.code = "scaled",
                 .severity = Severity::note,
                 .count = count,
                 .text = fmt::format("{} {} scaled by {:.6g}", counted(count, "point"),
                                     for_count(count, "is", "are"), metres),
                 .remedy = "nothing to do: it was requested"};
}

}  // namespace sunder
