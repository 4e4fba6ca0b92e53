// SPDX-License-Identifier: MIT
// The content of one picture, as plain data: surfaces, planes, spheres, boxes, light, background.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "apps/render/color.hpp"
#include "topology/base/finding.hpp"

namespace sunder::render {

/// Where a face comes from: the skin the body was born with, or a crack.
enum class FaceClass : std::uint8_t { skin, crack };

/// How a surface is drawn. Wires cast no shadow and show through faces faintly (figure 1).
enum class SurfaceStyle : std::uint8_t { filled, filled_with_edges, wireframe };

/// How a surface is colored.
struct SurfaceColors {
  Color skin = {0.86f, 0.84f, 0.80f};
  Color crack = {0.87f, 0.43f, 0.20f};
  /// Of the line at which a crack comes to the skin: a closed crack shows by it alone.
  Color crack_line = {0.25f, 0.12f, 0.07f};
  Color wire = {0.10f, 0.32f, 0.66f};
  /// How strongly pieces differ in hue: 0 not at all, 1 most.
  float piece_tint = 0;
};

/// Triangles of one or more bodies.
struct Surface {
  /// m.
  std::vector<Eigen::Vector3f> positions;
  /// Rows of `positions`, counterclockwise seen from outside.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Unit normal at each corner of each triangle; empty draws flat faces.
  std::vector<std::array<Eigen::Vector3f, 3>> corner_normals;
  /// Class of each triangle; empty means skin.
  std::vector<FaceClass> face_class;
  /// Piece each triangle belongs to; empty means one piece.
  std::vector<std::uint32_t> piece;
  SurfaceStyle style = SurfaceStyle::filled;
  SurfaceColors colors;
};

/// A floor or wall, seen from the side its normal points to, fading out far from the scene.
struct Plane {
  /// Any point of the plane, m.
  Eigen::Vector3f point = Eigen::Vector3f::Zero();
  /// Need not be of unit length.
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  Color color = {0.82f, 0.83f, 0.85f};
  /// Strength of the grid in [0, 1]; 0 draws none.
  float grid = 0.30f;
};

struct Sphere {
  /// m.
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  float radius = 1;
  Color color = {0.36f, 0.43f, 0.52f};
};

struct Box {
  /// m.
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  Eigen::Vector3f half_extent = Eigen::Vector3f::Ones();
  Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
  Color color = {0.36f, 0.43f, 0.52f};
};

/// A distant key light with soft shadows, light from the sky and from below, a fill at the camera.
struct Lighting {
  /// Towards the key light; need not be of unit length.
  Eigen::Vector3f to_key = {-0.34f, -0.62f, 0.92f};
  Color key = {1.0f, 0.97f, 0.92f};
  float key_strength = 0.80f;
  /// Half the angle the key light fills in the sky, rad: how fast shadows blur with distance.
  float key_angle = 0.07f;
  /// Direction of the sky.
  Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  Color sky = {0.92f, 0.95f, 1.0f};
  Color below = {0.90f, 0.84f, 0.78f};
  float ambient_strength = 0.42f;
  float fill_strength = 0.20f;
  /// How dark corners and creases get, in [0, 1].
  float occlusion = 1;
};

/// A vertical gradient.
struct Background {
  Color top = {0.62f, 0.70f, 0.79f};
  Color bottom = {0.90f, 0.92f, 0.94f};
};

/// A box with sides along the axes, m; empty (`lower > upper`) until something is put in.
using Bounds = Eigen::AlignedBox3f;

struct FrameScene {
  std::vector<Surface> surfaces;
  std::vector<Plane> planes;
  std::vector<Sphere> spheres;
  std::vector<Box> boxes;
  Lighting light;
  Background background;
  /// Sets the grid's spacing, where planes fade and how far occlusion reaches. If it is empty, the
  /// scene's own bounds do. Frames of a film need the same one, or the ground changes under them.
  Bounds extent;
};

/// True when the triangle's rows exist and its three points are finite.
bool is_drawable(const Surface& surface, const std::array<std::uint32_t, 3>& triangle);

/// The bounds of everything finite in the scene: surfaces, spheres, boxes; not planes.
/// Coordinates that are not finite, and points no triangle uses, are left out.
/// O(triangles).
Bounds scene_bounds(const FrameScene& scene);

/// The faults of a scene. Errors (nothing can be drawn): `index_out_of_range`,
/// `length_mismatch`, `degenerate_shape`. Warnings (left out of the picture): `not_finite`.
/// Ids are rows of triangles, spheres, boxes or planes. O(triangles).
std::vector<Finding> check(const FrameScene& scene);

}  // namespace sunder::render
