// SPDX-License-Identifier: MIT
// Checks of the obstacles that users gave.
#include "mechanics/contact/obstacle.hpp"

#include <cmath>
#include <string>

namespace sunder {
namespace {

bool positive(double value) { return std::isfinite(value) && value > 0; }

bool unit_length(double length) {
  // Readers normalise in double: anything further off than this was not normalised at all.
  return std::abs(length - 1) < 1e-9;
}

struct Complaints {
  std::size_t row = 0;
  std::vector<Finding> findings;

  void add(std::string code, std::string text, std::string remedy) {
    Finding f;
    f.code = std::move(code);
    f.ids = {static_cast<std::int64_t>(row)};
    f.text = "obstacle " + std::to_string(row) + ": " + std::move(text);
    f.remedy = std::move(remedy);
    findings.push_back(std::move(f));
  }
};

void check_shape(const Shape& shape, Complaints& complaints) {
  if (const auto* plane = std::get_if<Plane>(&shape)) {
    if (!unit_length(plane->normal.norm())) {
      complaints.add(
          "bad_normal",
          "the normal has length " + std::to_string(plane->normal.norm()) + ", expected 1",
          "give a normal that is not zero, of length 1");
    }
    if (!std::isfinite(plane->offset)) {
      complaints.add("not_a_number", "the plane's offset is not finite", "give it in metres");
    }
  } else if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    if (!positive(sphere->radius)) {
      complaints.add("bad_radius",
                     "the radius is " + std::to_string(sphere->radius) + " m, expected > 0",
                     "give a positive radius");
    }
    if (!sphere->center.allFinite()) {
      complaints.add("not_a_number", "the centre is not finite", "give it in metres");
    }
  } else if (const auto* box = std::get_if<Box>(&shape)) {
    if (!box->half_extent.allFinite() || box->half_extent.minCoeff() <= 0) {
      complaints.add("bad_extent", "a side of the box is not positive",
                     "give three positive half lengths in metres");
    }
    if (!unit_length(box->orientation.norm())) {
      complaints.add("bad_orientation", "the orientation is not a unit quaternion",
                     "normalise the quaternion");
    }
    if (!box->center.allFinite()) {
      complaints.add("not_a_number", "the centre is not finite", "give it in metres");
    }
  }
}

}  // namespace

std::vector<Finding> check(const Obstacle& obstacle, std::size_t row) {
  Complaints complaints{row, {}};
  check_shape(obstacle.shape, complaints);
  if (!obstacle.velocity.allFinite() || !obstacle.spin.allFinite()) {
    complaints.add("not_a_number", "the velocity or the spin is not finite",
                   "give them in m/s and rad/s");
  }
  if (!(std::isfinite(obstacle.friction) && obstacle.friction >= 0)) {
    complaints.add(
        "bad_friction",
        "the friction coefficient is " + std::to_string(obstacle.friction) + ", expected >= 0",
        "give a coefficient of zero or more");
  }
  if (obstacle.mass && !positive(*obstacle.mass)) {
    complaints.add("bad_mass",
                   "the mass is " + std::to_string(*obstacle.mass) + " kg, expected > 0",
                   "give a positive mass, or none for an obstacle that is driven");
  }
  if (obstacle.mass && !std::holds_alternative<Sphere>(obstacle.shape)) {
    complaints.add("mass_without_sphere", "only spheres can move freely",
                   "remove the mass, or make the obstacle a sphere");
  }
  if (!obstacle.mass && !obstacle.spin.isZero(0)) {
    complaints.add("spin_without_mass", "only free spheres can spin",
                   "remove the spin, or give the sphere a mass");
  }
  return complaints.findings;
}

}  // namespace sunder
