// SPDX-License-Identifier: MIT
// Settings of a body: mesh, material, placement, supports, loads, cracks, strengths.
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

#include "mechanics/state/settings/material.hpp"
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

/// Faces, each by three rows of the mesh's points.
struct FaceList {
  std::string file;  ///< the file of the faces, or empty
  std::vector<std::array<std::uint32_t, 3>> points;
};

/// A crack that exists from the start, closed and without load.
struct CutSettings {
  std::variant<CutPlane, FaceList> faces;
  /// If given, only faces with all three vertices inside.
  std::optional<RestBox> box;
  std::optional<RestBall> ball;
};

/// A region of the mesh, by its name or else by its number.
struct RegionName {
  std::string text;
};

/// Strength of one region, in place of the material's.
struct RegionStrength {
  RegionName region;
  std::optional<double> tensile_strength;  ///< Pa
  std::optional<double> toughness;         ///< Pa sqrt(m)
};

/// Weibull's law: P(sigma) = 1 - exp(-(V / V0) (sigma / sigma_0)^m), where sigma_0 is the vertex's
/// tensile strength without the law.
struct WeibullSettings {
  double modulus = 10;             ///< m
  double reference_volume = 1e-3;  ///< V0, m^3
  std::uint32_t seed = 1;
};

/// Strengths in addition to the material's (docs/explanation/cracks.md).
struct StrengthSettings {
  std::vector<RegionStrength> regions;
  /// Strength at each point of the mesh, Pa, in place of those of material and regions; empty:
  /// none.
  std::vector<double> painted;
  /// The point field of the mesh's file from which the reader of a scene file takes `painted`;
  /// empty: none.
  std::string field;
  std::optional<WeibullSettings> weibull;
};

/// A part of a body with vertices that never split.
struct UnbreakablePart {
  std::variant<RegionName, RestBox> where;
};

/// An axis of a mesh's own coordinates.
enum class Axis { x, y, z };

/// A support: it constrains the vertices with rest positions in a box of the body. Along each axis
/// the last of several boxes applies.
struct HeldBox {
  /// Corners of the box in the mesh's own coordinates, m; its surface belongs to it.
  Eigen::Vector3d minimum = Eigen::Vector3d::Zero();
  Eigen::Vector3d maximum = Eigen::Vector3d::Zero();
  /// Velocity of the constrained vertices, m/s; zero: fixed.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  /// Constrained axes of the mesh's own coordinates; empty: all three.
  std::vector<Axis> axes = {};
  /// Time over which the velocity is raised linearly from zero, s; 0: at once.
  double ramp_time = 0;
};

/// External loads on a body: on its surface inside a box, or on the vertices there.
struct LoadBox {
  /// Corners of the box in the mesh's own coordinates, m; its surface belongs to it.
  Eigen::Vector3d minimum = Eigen::Vector3d::Zero();
  Eigen::Vector3d maximum = Eigen::Vector3d::Zero();
  /// Pressure on every boundary face with all three vertices in the box, Pa; positive pushes into
  /// the body. It follows the body's rigid motion.
  double pressure = 0;
  /// Total force, in equal parts on every vertex in the box, N, world. It keeps its direction.
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  /// Time over which both are raised linearly, s; 0 applies them at once.
  double ramp_time = 0;
};

/// One breakable body.
struct BodySettings {
  std::string name;
  TetMesh mesh;
  Material material;
  /// Placement of the mesh's coordinates: x = rotation * X + translation (m).
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
  /// Order of the tetrahedra: 1 with linear displacement, or 2 with quadratic displacement and ten
  /// nodes.
  std::uint32_t order = 1;
  /// True: a rigid body that neither deforms nor breaks, with the inertia of its lumped vertices.
  bool rigid = false;
};

/// Rows of one body of the scene: its tetrahedra and the points of its mesh are consecutive.
struct BodyRows {
  std::size_t first_tetrahedron = 0, end_tetrahedron = 0;
  std::size_t first_point = 0, end_point = 0;
};

}  // namespace sunder
