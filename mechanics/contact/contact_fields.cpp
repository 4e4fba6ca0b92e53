// SPDX-License-Identifier: MIT
// The rules between keys of an obstacle.
#include "mechanics/contact/contact_fields.hpp"

#include <cmath>

namespace sunder {

void check_together(fields::SettingsCheck& check, const Obstacle& obstacle) {
  if (const auto* plane = std::get_if<Plane>(&obstacle.shape)) {
    const double length = plane->normal.norm();
    // Readers normalise in double: what is further off than this was not normalised at all.
    if (length > 0 && std::isfinite(length) && !(std::abs(length - 1) < 1e-9)) {
      check.add("not_a_unit_vector", "plane.normal",
                "has the length " + fields::text_of(length) + "; allowed is 1", "normalise it");
    }
  }
  const bool is_sphere = std::holds_alternative<Sphere>(obstacle.shape);
  if (obstacle.mass && !is_sphere) {
    check.add("mass_without_sphere", "mass", "is given, but only spheres can move freely",
              "leave the mass out, or make the obstacle a sphere");
  }
  if (!obstacle.mass && !obstacle.spin.isZero(0)) {
    check.add("spin_without_mass", "spin", "is given, but only free spheres spin",
              "leave the spin out, or give the sphere a mass");
  }
}

}  // namespace sunder
