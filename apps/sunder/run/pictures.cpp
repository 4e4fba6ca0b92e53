// SPDX-License-Identifier: MIT
// From the state of a run to what a picture shows: surfaces, obstacles, ground, camera.
#include "apps/sunder/run/pictures.hpp"

#include <span>
#include <variant>

#include "apps/output/smooth_cracks.hpp"
#include "apps/render/camera.hpp"
#include "apps/render/drawn_surface.hpp"
#include "apps/render/renderer.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"

namespace sunder {
namespace {

/// What stays the same in all pictures of a run.
struct RunView {
  render::Camera camera;
  /// The bodies as they start, what is static, and the ground below.
  render::Bounds extent;
};

/// How strongly pieces differ in hue: enough to tell them apart, too little to look painted.
constexpr float piece_tint = 0.35f;

/// Moves of points at rest for drawing; zero where cracks are drawn as they are.
std::vector<Vec3> drawn_moves(const SimulationState& state, CrackSurface cracks) {
  if (cracks == CrackSurface::smooth) return smooth_crack_moves(state.cells);
  return std::vector<Vec3>(state.cells.map.points().size(), Vec3::Zero());
}

/// |V| positions of the drawn rigid references. `moves`: row = point.
std::vector<Vec3> reference_positions(const SimulationState& state, std::span<const Vec3> moves) {
  const MechanicsState& mechanics = state.mechanics;
  const VertexColumns& v = mechanics.vertices;
  std::vector<Vec3> positions(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::size_t piece = v.component[i].index();
    const Pose& drawn = state.display[piece];
    const Vec3& rest_centre = mechanics.components[piece].rest_centre;
    const Vec3 rest = v.rest_position[i] + moves[state.cells.map.point_of_vertex(VertexId{i})];
    positions[i] = drawn.orientation * (rest - rest_centre) + drawn.centre;
  }
  return positions;
}

/// |V| positions of the deformed mesh, its moves turned with the pieces.
std::vector<Vec3> deformed_positions(const SimulationState& state, std::span<const Vec3> moves) {
  const MechanicsState& mechanics = state.mechanics;
  std::vector<Vec3> positions = mechanics.vertices.position;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Component& piece = mechanics.components[mechanics.vertices.component[i].index()];
    positions[i] += piece.orientation * moves[state.cells.map.point_of_vertex(VertexId{i})];
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

render::Surface surface(const SimulationState& state, const BoundaryColumns& boundary,
                        std::span<const Vec3> positions) {
  render::Surface surface = render::drawn_surface({.positions = positions,
                                                   .corners = state.cells.map.corners(),
                                                   .half_faces = boundary.half_faces,
                                                   .face_class = boundary.face_class,
                                                   .component = state.cells.labels.of_tetrahedron});
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

/// Skin and crack faces of the shape asked for, obstacles, ground. `extent`: what all pictures of a
/// run share.
render::FrameScene picture_scene(const SimulationState& state, const OutputSettings& output,
                                 const render::Bounds& extent) {
  render::FrameScene scene;
  scene.extent = extent;
  const ShownShape show = output.pictures.show;
  const std::vector<Vec3> moves = drawn_moves(state, output.crack_surface);
  const BoundaryColumns boundary = boundary_columns(state.cells);
  if (show != ShownShape::deformed) {
    scene.surfaces.push_back(surface(state, boundary, reference_positions(state, moves)));
  }
  if (show != ShownShape::reference) {
    scene.surfaces.push_back(surface(state, boundary, deformed_positions(state, moves)));
    if (show == ShownShape::both) {
      scene.surfaces.back().style = render::SurfaceStyle::wireframe;
    }
  }
  for (const Obstacle& obstacle : state.obstacles) std::visit(AddObstacle{scene}, obstacle.shape);
  return scene;
}

/// The camera asked for, or one that sees the whole extent.
RunView run_view(const SimulationState& start, const PictureSettings& settings,
                 const Vec3& gravity) {
  const Vec3 up = gravity.norm() > 0 ? Vec3(-gravity.normalized()) : Vec3::UnitZ();
  render::FrameScene still = picture_scene(start, {.pictures = {.show = ShownShape::deformed}}, {});
  still.spheres.clear();
  still.boxes.clear();
  for (const Obstacle& obstacle : start.obstacles) {
    // What flies in is seen when it arrives.
    if (obstacle.velocity.isZero() && !obstacle.mass) {
      std::visit(AddObstacle{still}, obstacle.shape);
    }
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

}  // namespace

struct Pictures::Parts {
  OutputSettings output;
  render::Renderer renderer;
  RunView view;
};

Pictures::Pictures(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Pictures::Pictures(Pictures&&) noexcept = default;
Pictures& Pictures::operator=(Pictures&&) noexcept = default;
Pictures::~Pictures() = default;

Result<Pictures> Pictures::open(const Simulation& start, const OutputSettings& output) {
  Result<Pictures> result;
  Result<render::Renderer> renderer = render::Renderer::offscreen();
  result.findings = std::move(renderer.findings);
  if (!renderer) return result;
  result.value = Pictures(std::make_unique<Parts>(
      Parts{output, std::move(*renderer),
            run_view(*start.state, output.pictures, start.scene.gravity.acceleration)}));
  return result;
}

std::vector<Finding> Pictures::draw(const std::filesystem::path& path, const Simulation& now) {
  const PictureSettings& settings = parts_->output.pictures;
  const render::FrameScene scene = picture_scene(*now.state, parts_->output, parts_->view.extent);
  Result<render::Image> image =
      parts_->renderer.render(scene, parts_->view.camera, static_cast<int>(settings.width),
                              static_cast<int>(settings.height));
  std::vector<Finding> findings = std::move(image.findings);
  if (!image) return findings;
  for (Finding& f : render::write_png(path, *image)) findings.push_back(std::move(f));
  return findings;
}

}  // namespace sunder
