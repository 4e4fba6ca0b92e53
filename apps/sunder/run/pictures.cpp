// SPDX-License-Identifier: MIT
// Scenes for the renderer.
#include "apps/sunder/run/pictures.hpp"

#include <variant>

#include "apps/render/drawn_surface.hpp"

namespace sunder {
namespace {

/// How strongly pieces differ in hue: enough to tell them apart, too little to look painted.
constexpr float piece_tint = 0.35f;

/// |V| positions of the drawn rigid references.
std::vector<Vec3> reference_positions(const PictureSource& source) {
  const MechanicsState& mechanics = source.state.mechanics;
  const VertexColumns& v = mechanics.vertices;
  std::vector<Vec3> positions(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::size_t piece = v.component[i].index();
    const Pose& drawn = source.state.display[piece];
    const Vec3& rest_centre = mechanics.components[piece].rest_centre;
    positions[i] = drawn.orientation * (v.rest_position[i] - rest_centre) + drawn.centre;
  }
  return positions;
}

struct BoundaryColumns {
  std::vector<HalfFaceId> half_faces;
  std::vector<render::FaceClass> face_class;
};

BoundaryColumns boundary_columns(const Cells& cells) {
  BoundaryColumns columns;
  for (std::size_t f = 0; f < 4 * cells.map.tetrahedra(); ++f) {
    const HalfFaceId face{f};
    if (!cells.map.neighbour(face).is_none()) continue;
    columns.half_faces.push_back(face);
    columns.face_class.push_back(is_crack_face(cells, face) ? render::FaceClass::crack
                                                            : render::FaceClass::skin);
  }
  return columns;
}

render::Surface surface(const PictureSource& source, const BoundaryColumns& boundary,
                        std::span<const Vec3> positions) {
  render::Surface surface =
      render::drawn_surface({.positions = positions,
                             .corners = source.state.cells.map.corners(),
                             .half_faces = boundary.half_faces,
                             .face_class = boundary.face_class,
                             .component = source.state.cells.labels.of_tetrahedron});
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

render::FrameScene picture_scene(const PictureSource& source, ShownShape show,
                                 const render::Bounds& extent) {
  render::FrameScene scene;
  scene.extent = extent;
  const BoundaryColumns boundary = boundary_columns(source.state.cells);
  if (show != ShownShape::deformed) {
    scene.surfaces.push_back(surface(source, boundary, reference_positions(source)));
  }
  if (show != ShownShape::reference) {
    scene.surfaces.push_back(surface(source, boundary, source.state.mechanics.vertices.position));
    if (show == ShownShape::both) {
      scene.surfaces.back().style = render::SurfaceStyle::wireframe;
    }
  }
  for (const Obstacle& obstacle : source.obstacles) std::visit(AddObstacle{scene}, obstacle.shape);
  return scene;
}

RunView run_view(const PictureSource& start, const PictureSettings& settings, const Vec3& gravity) {
  const Vec3 up = gravity.norm() > 0 ? Vec3(-gravity.normalized()) : Vec3::UnitZ();
  render::FrameScene still = picture_scene(start, ShownShape::deformed, {});
  still.spheres.clear();
  still.boxes.clear();
  for (const Obstacle& obstacle : start.obstacles) {
    // What flies in is seen when it arrives.
    if (obstacle.velocity.isZero() && !obstacle.mass)
      std::visit(AddObstacle{still}, obstacle.shape);
  }
  RunView view;
  view.extent = render::scene_bounds(still);
  add_shadow(view.extent, start.obstacles, up);
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
