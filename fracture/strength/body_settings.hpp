// SPDX-License-Identifier: MIT
// What a user says about a body: mesh, material, placement, supports, loads, cracks, strengths.
// Plain settings, no state.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mechanics/state/material.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// A box in the mesh's own coordinates, m; its surface belongs to it.
struct RestBox {
  Eigen::Vector3d minimum = Eigen::Vector3d::Zero();
  Eigen::Vector3d maximum = Eigen::Vector3d::Zero();
};

/// A ball in the mesh's own coordinates, m; its surface belongs to it.
struct RestBall {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;
};

/// The plane through `point` (m, mesh's own coordinates) across `normal`, of any length but 0.
struct CutPlane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = {0, 0, 1};
};

/// Faces by three rows of the mesh's points each.
struct FaceList {
  std::string file;  ///< they were read from
  std::vector<std::array<std::uint32_t, 3>> points;
};

/// A crack that is there from the start, closed and without load.
struct CutSettings {
  std::variant<CutPlane, FaceList> faces;
  /// Where given, only faces whose three vertices lie in them.
  std::optional<RestBox> box;
  std::optional<RestBall> ball;
};

/// A region of the mesh: by its name, else by its number.
struct RegionName {
  std::string text;
};

/// Strength of one region, in place of the material's.
struct RegionStrength {
  RegionName region;
  std::optional<double> tensile_strength;  ///< Pa
  std::optional<double> toughness;         ///< Pa sqrt(m)
};

/// Weibull's law: P(sigma) = 1 - exp(-(V / V0) (sigma / sigma_0)^m), sigma_0 being the tensile
/// strength that a vertex has without it.
struct WeibullSettings {
  double modulus = 10;             ///< m
  double reference_volume = 1e-3;  ///< V0, m^3
  std::uint32_t seed = 1;
};

/// Strengths beside that of the material (docs/explanation/cracks.md).
struct StrengthSettings {
  std::vector<RegionStrength> regions;
  /// Pa, one a point of the mesh, in place of those of material and regions; empty: none.
  std::vector<double> painted;
  /// The point field of the mesh's file that a scene file's reader takes `painted` from; empty:
  /// none.
  std::string field;
  std::optional<WeibullSettings> weibull;
};

/// A part of a body whose vertices never split.
struct UnbreakablePart {
  std::variant<RegionName, RestBox> where;
};

/// An axis of a mesh's own coordinates.
enum class Axis { x, y, z };

/// Vertices held by the outside world: those whose rest position lies in a box of the body. What
/// several boxes hold along one axis the last of them holds.
struct HeldBox {
  /// Corners of the box in the mesh's own coordinates, m; its surface belongs to it.
  Eigen::Vector3d minimum = Eigen::Vector3d::Zero();
  Eigen::Vector3d maximum = Eigen::Vector3d::Zero();
  /// Velocity the vertices are moved with, m/s; zero holds them fixed.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  /// Axes, of the mesh's own coordinates, along which the vertices are held; empty: all three.
  std::vector<Axis> axes = {};
  /// Time over which the velocity is raised linearly from zero, s; 0: at once.
  double ramp_time = 0;
};

/// What pushes or pulls a body from outside: on its surface inside a box, or on the vertices there.
struct LoadBox {
  /// Corners of the box in the mesh's own coordinates, m; its surface belongs to it.
  Eigen::Vector3d minimum = Eigen::Vector3d::Zero();
  Eigen::Vector3d maximum = Eigen::Vector3d::Zero();
  /// On every boundary face whose three vertices lie in the box, Pa; positive pushes into the body.
  /// Follows the body's rigid motion.
  double pressure = 0;
  /// In all, in equal parts on every vertex in the box, N, world; keeps its direction.
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  /// Time over which both are raised linearly, s; 0 applies them at once.
  double ramp_time = 0;
};

/// One breakable body.
struct BodySettings {
  std::string name;
  TetMesh mesh;
  Material material;
  /// Where the mesh's coordinates are placed: x = rotation * X + translation (m).
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  /// Velocity of the mass centre, m/s, and spin about it, rad/s, both in the world.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();
  std::vector<HeldBox> held;
  std::vector<LoadBox> loads;
  std::vector<CutSettings> cuts;
  StrengthSettings strength;
  std::vector<UnbreakablePart> unbreakable;
  /// Of its tetrahedra: 1, displacement is linear in each, or 2, quadratic: ten nodes each.
  std::uint32_t order = 1;
  /// Neither deforms nor breaks: a rigid body with the inertia of its lumped vertices.
  bool rigid = false;
};

/// Rows of one body of the scene: its tetrahedra and the points of its mesh are consecutive.
struct BodyRows {
  std::size_t first_tetrahedron = 0, end_tetrahedron = 0;
  std::size_t first_point = 0, end_point = 0;
};

}  // namespace sunder
