// SPDX-License-Identifier: MIT
#include "apps/sunder/render/picture_scene.hpp"

#include <variant>

#include "apps/render/drawn_surface.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"

namespace sunder {
namespace {

/// How strongly pieces differ in hue: enough to tell them apart, too little to look painted.
constexpr float piece_tint = 0.35f;

render::Surface surface(const PictureBodies& bodies, std::span<const Vec3> positions) {
  render::Surface surface = render::drawn_surface({.positions = positions,
                                                   .corners = bodies.corners,
                                                   .half_faces = bodies.half_faces,
                                                   .face_class = bodies.face_class,
                                                   .component = bodies.component});
  surface.colors.piece_tint = piece_tint;
  return surface;
}

struct AddObstacle {
  render::FrameScene& scene;

  void operator()(const Plane& p) const {
    scene.planes.push_back(
        {.point = (p.normal * p.offset).cast<float>(), .normal = p.normal.cast<float>()});
  }
  void operator()(const Sphere& s) const {
    scene.spheres.push_back(
        {.center = s.center.cast<float>(), .radius = static_cast<float>(s.radius)});
  }
  void operator()(const Box& b) const {
    scene.boxes.push_back({.center = b.center.cast<float>(),
                           .half_extent = b.half_extent.cast<float>(),
                           .rotation = b.orientation.cast<float>()});
  }
  void operator()(const Solid& s) const {
    render::Surface surface;
    for (const Vec3& p : s.surface->points) {
      surface.positions.push_back((s.orientation * p + s.translation).cast<float>());
    }
    surface.triangles = s.surface->triangles;
    surface.colors.skin = render::Box().color;
    scene.surfaces.push_back(std::move(surface));
  }
};

/// `bounds` with their shadows on every plane below them.
void add_shadow(render::Bounds& bounds, std::span<const Obstacle> obstacles, const Vec3& up) {
  const render::Bounds body = bounds;
  for (const Obstacle& obstacle : obstacles) {
    const Plane* plane = std::get_if<Plane>(&obstacle.shape);
    // A wall (its normal across gravity) catches no shadow.
    if (!plane || plane->normal.dot(up) < 0.5) continue;
    for (int i = 0; i < 8; ++i) {
      const auto corner = static_cast<render::Bounds::CornerType>(i);
      const Vec3 x = body.corner(corner).cast<double>();
      const double fall = (plane->normal.dot(x) - plane->offset) / plane->normal.dot(up);
      bounds.extend(Vec3(x - fall * up).cast<float>());
    }
  }
}

}  // namespace

render::FrameScene picture_scene(const PictureBodies& bodies, std::span<const Obstacle> obstacles,
                                 ShownShape show, const render::Bounds& extent) {
  render::FrameScene scene;
  scene.extent = extent;
  if (show != ShownShape::deformed) scene.surfaces.push_back(surface(bodies, bodies.reference));
  if (show != ShownShape::reference) {
    scene.surfaces.push_back(surface(bodies, bodies.deformed));
    if (show == ShownShape::both) {
      scene.surfaces.back().style = render::SurfaceStyle::wireframe;
    }
  }
  for (const Obstacle& obstacle : obstacles) std::visit(AddObstacle{scene}, obstacle.shape);
  return scene;
}

RunView run_view(const PictureBodies& start, std::span<const Obstacle> obstacles,
                 const PictureSettings& settings, const Vec3& gravity,
                 const render::Bounds& later) {
  const Vec3 up = gravity.norm() > 0 ? Vec3(-gravity.normalized()) : Vec3::UnitZ();
  std::vector<Obstacle> still;
  for (const Obstacle& obstacle : obstacles) {
    // Obstacles that fly in are seen when they arrive.
    if (obstacle.velocity.isZero() && !obstacle.mass) still.push_back(obstacle);
  }
  RunView view;
  view.extent = render::scene_bounds(picture_scene(start, still, ShownShape::deformed, {}));
  if (!later.isEmpty()) view.extent.extend(later);
  add_shadow(view.extent, obstacles, up);
  if (settings.camera) {
    const CameraSettings& camera = *settings.camera;
    view.camera = {.eye = camera.eye.cast<float>(),
                   .target = camera.target.cast<float>(),
                   .up = up.cast<float>(),
                   .vertical_fov = static_cast<float>(camera.field_of_view * EIGEN_PI / 180)};
  } else {
    const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
    view.camera = render::frame_bounds(view.extent, {.aspect = aspect, .up = up.cast<float>()});
  }
  return view;
}

}  // namespace sunder
