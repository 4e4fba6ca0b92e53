// SPDX-License-Identifier: MIT
// From the state of a run to a picture.
#include "apps/sunder/run/pictures.hpp"

#include <span>

#include "apps/output/smooth_cracks.hpp"
#include "apps/render/headless_context.hpp"
#include "apps/render/renderer.hpp"
#include "apps/sunder/render/picture_scene.hpp"
#include "fracture/simulation/simulation_state.hpp"

namespace sunder {
namespace {

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

PictureBodies bodies_of(const SimulationState& state, CrackSurface cracks) {
  const std::vector<Vec3> moves = drawn_moves(state, cracks);
  PictureBodies bodies;
  bodies.reference = reference_positions(state, moves);
  bodies.deformed = deformed_positions(state, moves);
  bodies.corners = state.cells.map.corners();
  bodies.component = state.cells.labels.of_tetrahedron;
  for (std::size_t f = 0; f < 4 * state.cells.map.tetrahedra(); ++f) {
    const HalfFaceId face{f};
    if (!state.cells.map.neighbour(face).is_none()) continue;
    bodies.half_faces.push_back(face);
    bodies.face_class.push_back(is_crack_face(state.cells, face) ? render::FaceClass::crack
                                                                 : render::FaceClass::skin);
  }
  return bodies;
}

}  // namespace

std::optional<Finding> cannot_draw() {
  Result<render::HeadlessContext> context = render::HeadlessContext::create();
  if (context) return std::nullopt;
  return std::move(context.findings.front());
}

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
            run_view(bodies_of(*start.state, CrackSurface::mesh), start.state->obstacles,
                     output.pictures, start.scene.gravity.acceleration)}));
  return result;
}

std::vector<Finding> Pictures::draw(const std::filesystem::path& path, const Simulation& now) {
  const PictureSettings& settings = parts_->output.pictures;
  const render::FrameScene scene =
      picture_scene(bodies_of(*now.state, parts_->output.crack_surface), now.state->obstacles,
                    settings.show, parts_->view.extent);
  Result<render::Image> image =
      parts_->renderer.render(scene, parts_->view.camera, static_cast<int>(settings.width),
                              static_cast<int>(settings.height));
  std::vector<Finding> findings = std::move(image.findings);
  if (!image) return findings;
  for (Finding& f : render::write_png(path, *image)) findings.push_back(std::move(f));
  return findings;
}

}  // namespace sunder
