// SPDX-License-Identifier: MIT
// Rigid bodies of the rubble solver, and the settings of their steps.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "mechanics/contact/shapes/manifold.hpp"
#include "mechanics/state/impulse.hpp"

namespace sunder {

/// A rigid body, or a driven body (`mass` 0).
struct RubbleBody {
  double mass = 0;              ///< kg; 0: driven, at `velocity`
  Mat3 inertia = Mat3::Zero();  ///< kg m^2, about `centre`, in the body's own axes
  Vec3 centre = Vec3::Zero();   ///< m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< its own axes to the world's
  Vec3 momentum = Vec3::Zero();                                     ///< kg m/s
  Vec3 angular_momentum = Vec3::Zero();  ///< kg m^2/s, about `centre`, world
  Vec3 velocity = Vec3::Zero();          ///< m/s, of driven bodies
  double friction = 0.5;                 ///< Coulomb's coefficient; two bodies have the mean
  double radius = 0;                     ///< m, of the farthest point of its shapes from `centre`
  double still = 0;                      ///< s, for which it has lain still
  bool asleep = false;
  bool in_ledger = true;  ///< whether the report's energies count it
};

/// A convex part of a body, in its own axes about its centre.
struct RubbleShape {
  enum class Kind : std::uint8_t { tetrahedron, box, solid, ball, half_space };
  Kind kind = Kind::tetrahedron;
  std::uint32_t body = 0;
  /// Identifies the shape from tick to tick, ascending with the row.
  std::uint64_t key = 0;
  /// Of a tetrahedron, m; the first is the centre of a ball.
  std::array<Vec3, 4> corner = {Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};
  std::uint32_t outer_faces = 15;      ///< of a tetrahedron: bits of those outside of the body
  Vec3 half_extent{0, 0, 0};           ///< of a box, m
  const ConvexSolid* solid = nullptr;  ///< of a solid; the caller keeps it
  double radius = 0;                   ///< of a ball, m
  Vec3 normal{0, 0, 1};                ///< of a half-space, out of the solid, through the centre
};

/// Two faces that were one, of tetrahedra of two bodies: their corners are in contact, without any
/// search, until they have parted or slid by `reach`.
struct RubblePartner {
  std::uint32_t shape_a = 0, shape_b = 0;              ///< rows
  std::array<std::uint8_t, 3> corner_a{}, corner_b{};  ///< of the shapes; k meets k
  std::array<std::uint32_t, 3> point{};  ///< corner names; faces with a common corner share it
  double reach = 0;                      ///< m
};

/// The memory of contact points from tick to tick.
struct RubbleMemory {
  struct Point {
    std::uint64_t a = 0, b = 0;  ///< keys of shapes
    Vec3 at{0, 0, 0};            ///< m, in the axes of the first one's body
    double force = 0;            ///< N, along the normal, in the last sub-step
    Vec3 friction{0, 0, 0};      ///< N, its share of the patch's on A
    double twist = 0;            ///< N m, likewise
  };
  std::vector<Point> points;  ///< sorted by keys
};

/// How a tick is taken.
struct RubbleSettings {
  double length = 1.0 / 240;  ///< s
  /// At least. Towers of more than ten bodies take twice as many, of more than twenty four times,
  /// and so on to 32 times.
  int sub_steps = 4;
  Vec3 gravity{0, 0, 0};      ///< m/s^2
  double slop = 1e-5;         ///< m, overlap that is left alone
  double still_speed = 1e-4;  ///< m/s, below which a point of the surface is still
  double sleep_after = 0.1;   ///< s, until a body still among still bodies sleeps; 0: never
  unsigned threads = 1;
};

/// The blows on a body in a tick.
struct RubbleBlow {
  double speed = 0;   ///< m/s, at which the fastest point meets another body
  double energy = 0;  ///< J, sum of the kinetic energies that its points must lose to stop
};

/// The result of a tick.
struct RubbleReport {
  std::uint32_t awake = 0, asleep = 0;      ///< bodies with a mass, at the end
  std::uint32_t sub_steps = 0, layers = 0;  ///< taken; bodies upon each other, at most
  std::uint32_t pairs = 0;                  ///< of shapes with overlapping boxes
  std::uint32_t manifolds = 0, points = 0;  ///< of those that push
  double deepest = 0;                       ///< m, overlap where patches were found
  double gravity_work = 0;                  ///< J, sum m g . dx
  double contact_work = 0;  ///< J, each impulse times the mean velocity of its place
  double numerical =
      0;  ///< J, taken by the scheme: weight on bodies in contact falls a sub-step late
  double sleep_energy = 0;            ///< J, of bodies that fell asleep
  Impulse gravity = Impulse::Zero();  ///< of weight, about the origin
  Impulse contact = Impulse::Zero();  ///< of all contact: by driven and sleeping bodies
  Impulse sleep = Impulse::Zero();    ///< momenta of bodies that fell asleep
  /// Impulse of contact on bodies without `in_ledger`. Row = body. Empty if nothing moved.
  std::vector<Impulse> given;
  std::vector<RubbleBlow> blow;                      ///< row = body; empty if nothing moved
  double narrow_ms = 0, broad_ms = 0, solve_ms = 0;  ///< wall time
};

}  // namespace sunder
