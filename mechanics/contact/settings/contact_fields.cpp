// SPDX-License-Identifier: MIT
// The rules between keys of an obstacle.
#include "mechanics/contact/settings/contact_fields.hpp"

#include <cmath>

namespace sunder {

void check_together(fields::SettingsCheck& check, const Obstacle& obstacle) {
  if (const auto* plane = std::get_if<Plane>(&obstacle.shape)) {
    const double length = plane->normal.norm();
    // Readers normalise in double: a normal with a larger error was not normalised at all.
    if (length > 0 && std::isfinite(length) && !(std::abs(length - 1) < 1e-9)) {
      check.add("not_a_unit_vector", "plane.normal",
                "has the length " + fields::text_of(length) + "; allowed is 1", "normalise it");
    }
  }
  const auto* solid = std::get_if<Solid>(&obstacle.shape);
  if (solid && !solid->surface) {
    check.add("no_surface", "mesh", "has no surface",
              "name a file with a closed surface of triangles");
  }
  if (obstacle.mass && std::holds_alternative<Plane>(obstacle.shape)) {
    check.add("mass_without_volume", "mass",
              "is given, but a plane has no volume and cannot move freely",
              "leave the mass out, or make the obstacle a sphere, a box or a mesh");
  }
  if (!obstacle.mass && !obstacle.spin.isZero(0)) {
    check.add("spin_without_mass", "spin", "is given, but only obstacles with a mass spin",
              "leave the spin out, or give the obstacle a mass");
  }
}

}  // namespace sunder
