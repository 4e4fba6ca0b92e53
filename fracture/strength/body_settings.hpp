// SPDX-License-Identifier: MIT
// What a user says about a body's cracks and strengths at the start. Plain settings, no state.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

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

/// Strengths beside that of the material (docs/strength.md).
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

}  // namespace sunder
