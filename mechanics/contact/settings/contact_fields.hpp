// SPDX-License-Identifier: MIT
// Every key of obstacles and of the settings of contact and impacts: name, unit, meaning and range,
// said once; and the rules between keys of an obstacle.
#pragma once

#include "mechanics/contact/settings/contact_settings.hpp"
#include "mechanics/contact/settings/impact_settings.hpp"
#include "mechanics/contact/shapes/obstacle.hpp"
#include "mechanics/state/settings/check_settings.hpp"

namespace sunder {

/// not_a_unit_vector, mass_without_volume, spin_without_mass, no_surface.
void check_together(fields::SettingsCheck& check, const Obstacle& obstacle);

namespace fields {

inline const Names<ContactMethod>& names_of(ContactMethod) {
  static const Names<ContactMethod> names = {{ContactMethod::impulses, "impulses"},
                                             {ContactMethod::penalty, "penalty"}};
  return names;
}

template <class V>
void describe(V& v, Plane& p) {
  v.direction(Key{"normal", "", "Normal out of the solid half-space; any length but 0"}, p.normal);
  v.field(Key{"offset", "m", "Distance from the origin along the normal"}, p.offset);
}

template <class V>
void describe(V& v, Sphere& s) {
  v.field(Key{"center", "m", "Centre"}, s.center);
  v.field(Key{"radius", "m", "Radius", above(0)}, s.radius);
}

template <class V>
void describe(V& v, Box& b) {
  v.field(Key{"center", "m", "Centre"}, b.center);
  v.field(Key{"rotation", "", "Rotation of the box about its centre"}, b.orientation);
  v.field(Key{"half_extent", "m", "Half the length of each side", above(0)}, b.half_extent);
}

template <class V>
void describe(V& v, Solid& s) {
  v.field(
      Key{"file",
          "",
          "Closed surface of triangles, relative to the scene file: STL, OBJ, OFF, PLY or another "
          "format of `sunder convert --formats`; of a file with tetrahedra, their surface",
          {},
          true},
      s.surface);
  v.field(Key{"translation", "m", "Translation of the surface, after the rotation"}, s.translation);
  v.field(Key{"rotation", "", "Rotation of the surface about its origin, before the translation"},
          s.orientation);
}

template <class V>
void describe(V& v, Obstacle& o) {
  v.alternative(Key{"plane", "", "A half-space: ground, wall"}, Plane{}, o.shape);
  v.alternative(Key{"sphere", "", "A ball"}, Sphere{}, o.shape);
  v.alternative(Key{"box", "", "A box"}, Box{}, o.shape);
  v.alternative(Key{"mesh", "", "A solid bounded by a closed surface"}, Solid{}, o.shape);
  v.field(Key{"velocity", "m/s", "Velocity; constant unless there is a mass"}, o.velocity);
  v.field(Key{"spin", "rad/s", "Angular velocity; needs a mass"}, o.spin);
  v.field(
      Key{"friction", "", "Coulomb's coefficient; two surfaces in contact have the mean of theirs",
          at_least(0)},
      o.friction);
  v.field(Key{"mass", "kg", "Makes a ball, box or mesh a free rigid body that falls and recoils",
              above(0)},
          o.mass);
}

template <class V>
void describe(V& v, ContactSettings& c) {
  v.field(Key{"method", "",
              "impulses: unilateral contact solved with the response of the bodies, the default; "
              "penalty: the paper's, springs on overlaps at the start of a step, without impact "
              "windows (docs/explanation/paper.md)"},
          c.method);
  v.field(Key{"penalty_stiffness", "N/m",
              "penalty: stiffness of the spring between one vertex and one obstacle or ball of a "
              "tetrahedron; stable up to about 4 m / h^2 for a vertex of mass m at a step h",
              above(0)},
          c.penalty_stiffness);
  v.field(Key{"penalty_damping", "N s/m",
              "penalty: constant of the damper parallel to the spring; it never pulls, and brakes "
              "slip by Coulomb's friction at most. 0, the paper's value, gives no friction",
              at_least(0)},
          c.penalty_damping);
  v.field(Key{"friction", "", "Coulomb's coefficient of the bodies' surface", at_least(0)},
          c.friction);
  v.field(
      Key{"compliance", "m/N", "impulses: compliance of one contact point; 0: hard", at_least(0)},
      c.compliance);
  v.field(
      Key{"push_out_speed", "m/s",
          "impulses: largest speed at which contacts that start with an overlap are pushed apart",
          at_least(0), false, "", true},
      c.push_out_speed);
  v.field(Key{"allowed_penetration", "m", "impulses: penetration that is not corrected",
              at_least(0), false, "", true},
          c.allowed_penetration);
  v.field(Key{"between_pieces", "",
              "Whether pieces collide with each other; they always collide with obstacles"},
          c.between_pieces);
  v.field(
      Key{"ball_share",
          "",
          "penalty: radius of the ball that represents a tetrahedron between pieces, as a share "
          "of its bounding ball's; 1 is the paper's value",
          {.low = 0, .high = 1, .without_low = true}},
      c.ball_share);
  v.field(Key{"max_iterations", "", "impulses: iterations of projected Gauss-Seidel per pass",
              between(1, 1e6), false, "", true},
          c.max_iterations);
  v.field(Key{"tolerance", "",
              "impulses: largest constraint violation of an end-of-step gap, relative to the "
              "deepest overlap "
              "that the step would have had without contact",
              above(0), false, "", true},
          c.tolerance);
  v.field(
      Key{"max_passes", "",
          "impulses: number of predictions of a step with the impulses found; at most 3, except "
          "for floating_frame and modal with rigid isolated tetrahedra",
          between(1, 100), false, "", true},
      c.max_passes);
  v.field(
      Key{"max_contacts_per_pair", "",
          "Contacts between two bodies per pass; of more, a set that spans the same patch is kept",
          between(2, 100000), false, "", true},
      c.max_contacts_per_pair);
}

template <class V>
void describe(V& v, ImpactSettings& i) {
  v.field(Key{"window", "",
              "Whether struck pieces are sub-stepped while the waves run; without it the time step "
              "decides the cracks of an impact"},
          i.window);
  v.field(
      Key{"negligible", "",
          "Share of the tensile strength below which the stress rho c v of an impact is ignored",
          Range{.low = 0, .high = 1, .without_low = true}, false, "", true},
      i.negligible);
  v.field(Key{"by_energy", "", "Sub-step only impacts with enough energy to break the body"},
          i.by_energy);
  v.field(
      Key{"at_once", "",
          "Most explicit sub-steps between two looks at windows, and at contacts with obstacles "
          "and crack faces; cracks are looked for in each",
          between(1, 1024)},
      i.at_once);
  v.field(Key{"max_sub_steps", "",
              "Sub-steps allowed per step; the remainder is then taken at once, with a warning",
              between(1, 1e6)},
          i.max_sub_steps);
}

}  // namespace fields
}  // namespace sunder
