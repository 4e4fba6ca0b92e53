// SPDX-License-Identifier: MIT
// Sections of a saved state.
#include "fracture/saving/saved_state.hpp"

#include <fmt/format.h>

#include <iterator>

#include "fracture/saving/archive.hpp"
#include "fracture/saving/sections.hpp"
#include "topology/base/fnv1a.hpp"
#include "topology/kernel/edge_nodes.hpp"

namespace sunder {

namespace {

constexpr std::string_view magic = "SunderSt";

/// Whether labels and anchors name rows that are there, and chains only lead back.
bool fits_together(const CrackLabels& c, std::size_t vertices, std::size_t tetrahedra) {
  const bool sized = c.cracks == 0
                         ? c.last_label.empty() && c.of_face.empty()
                         : c.last_label.size() == tetrahedra && c.of_face.size() == 4 * tetrahedra;
  if (!sized || c.last_anchor.size() != c.cracks) return false;
  const auto is_crack = [&](CrackId k) { return k.index() < c.cracks; };
  for (std::size_t row = 0; row < c.labels.size(); ++row) {
    const CrackLabel& label = c.labels[row];
    if (!is_crack(label.crack) || label.before > row) return false;
    if (label.tetrahedron.index() >= tetrahedra) return false;
  }
  for (std::size_t row = 0; row < c.anchors.size(); ++row) {
    const CrackAnchor& anchor = c.anchors[row];
    if (!is_crack(anchor.crack) || anchor.before > row) return false;
    if (anchor.vertex.index() >= vertices) return false;
    if (!anchor.copy.is_none() && anchor.copy.index() >= vertices) return false;
  }
  return std::ranges::all_of(c.last_label, [&](auto row) { return row <= c.labels.size(); }) &&
         std::ranges::all_of(c.last_anchor, [&](auto row) { return row <= c.anchors.size(); }) &&
         std::ranges::all_of(c.of_face, [&](CrackId k) { return k.is_none() || is_crack(k); });
}

/// Whether ties name faces that the map has apart and the pieces have sewn, and nodes that their
/// tetrahedra have, `nodes` each.
bool fits_together(const std::vector<Tie>& ties, const Cells& cells, std::uint8_t nodes) {
  if (!cells.pieces) return ties.empty();
  const std::size_t faces = 4 * cells.map.tetrahedra();
  return cells.pieces->map.tetrahedra() == cells.map.tetrahedra() &&
         cells.pieces->labels.of_tetrahedron == cells.labels.of_tetrahedron &&
         std::ranges::all_of(ties, [&](const Tie& tie) {
           const auto is_place = [&](std::uint8_t place) { return place < nodes; };
           return tie.face.index() < faces && tie.opposite.index() < faces &&
                  cells.map.neighbour(tie.face).is_none() &&
                  cells.pieces->map.neighbour(tie.face) == tie.opposite &&
                  std::ranges::all_of(tie.corner, is_place) &&
                  std::ranges::all_of(tie.opposite_corner, is_place);
         });
}

/// Whether tetrahedra of second order name nodes of the map, one for each edge.
bool fits_together(const ElementColumns& e, const VolumeMap& map) {
  if (e.edge_nodes.empty()) return e.corner_stress.empty();
  return e.edge_nodes.size() == map.tetrahedra() && e.corner_stress.size() == map.tetrahedra() &&
         check(e.edge_nodes, map).empty();
}

/// Whether the meshes of the scene's bodies name points that they have.
bool fits_together(const Scene& scene) {
  return std::ranges::all_of(scene.bodies, [](const BodySettings& body) {
    const std::size_t points = body.mesh.points.size();
    return std::ranges::all_of(body.mesh.tetrahedra, [&](const auto& t) {
      return std::ranges::all_of(t, [&](std::uint32_t corner) { return corner < points; });
    });
  });
}

/// Whether columns are as long as each other, as far as a step relies on it without a look.
bool fits_together(const SimulationState& s) {
  const std::size_t vertices = s.cells.map.vertices(), tetrahedra = s.cells.map.tetrahedra();
  const std::size_t components = s.mechanics.components.size();
  const VertexColumns& v = s.mechanics.vertices;
  const ElementColumns& e = s.mechanics.elements;
  for (const std::size_t rows :
       {v.rest_position.size(), v.position.size(), v.velocity.size(), v.mass.size(),
        v.component.size(), v.displacement.size(), v.displacement_rate.size(),
        v.displacement_acceleration.size(), v.support.size(), s.cells.strength.size(),
        s.cells.labels.of_vertex.size()}) {
    if (rows != vertices) return false;
  }
  for (const std::size_t rows :
       {e.shape_gradient.size(), e.rest_volume.size(), e.mass.size(), e.material.size(),
        e.component.size(), e.stress.size(), s.cells.labels.of_tetrahedron.size()}) {
    if (rows != tetrahedra) return false;
  }
  const RubbleState& rubble = s.ladder.rubble;
  if (!rubble.apart.empty() && rubble.apart.size() != components) return false;
  if (!rubble.ball_apart.empty() && rubble.ball_apart.size() != s.obstacles.size()) return false;
  return s.display.size() == components && s.display_target.size() == components &&
         s.cells.labels.size.size() == components && s.cells.skin.size() == 4 * tetrahedra &&
         fits_together(s.cells.cracks, vertices, tetrahedra) && fits_together(e, s.cells.map) &&
         fits_together(s.contact.ties, s.cells, e.edge_nodes.empty() ? 4 : 10);
}

std::uint64_t checksum(std::string_view bytes) {
  Fnv1a sum;
  sum.add(bytes);
  return sum.value;
}

Finding damaged(std::string text) {
  return {.code = "damaged",
          .text = std::move(text),
          .remedy = "take another copy of it, or run the simulation from its start"};
}

}  // namespace

std::string saved_state(const Simulation& simulation) {
  StateWriter writer;
  writer.bytes = magic;
  archive(writer, saved_state_format);
  sections(writer, simulation);
  const std::uint64_t sum = checksum(writer.bytes);
  archive(writer, sum);
  return std::move(writer.bytes);
}

Result<Simulation> restore(std::string_view bytes) {
  if (!bytes.starts_with(magic)) {
    return Finding{.code = "not_a_saved_state",
                   .text = "it does not begin as a saved state does",
                   .remedy = "give a file that `save` has written"};
  }
  constexpr std::size_t trailer = sizeof(std::uint64_t);
  StateReader reader{bytes.substr(magic.size())};
  std::uint32_t format = 0;
  archive(reader, format);
  if (reader.failed) return damaged("it ends after its first bytes");
  if (format != saved_state_format) {
    return Finding{
        .code = "other_version",
        .text = fmt::format("its format is {}; this version reads {}", format, saved_state_format),
        .remedy = "load it with the version that saved it"};
  }
  if (reader.bytes.size() < trailer) return damaged("it ends after its first bytes");
  StateReader end{bytes.substr(bytes.size() - trailer)};
  std::uint64_t sum = 0;
  archive(end, sum);
  if (sum != checksum(bytes.substr(0, bytes.size() - trailer))) {
    return damaged("its checksum is not that of its bytes: some are missing or changed");
  }
  reader.bytes.remove_suffix(trailer);
  Simulation sim;
  sim.state = Owned(
      std::make_unique<SimulationState>(SimulationState{.cells = {.map = VolumeMap(MapRows{})}}));
  sim.scratch = Owned(std::make_unique<SimulationScratch>());
  sections(reader, sim);
  if (reader.failed || !reader.bytes.empty() || !fits_together(*sim.state) ||
      !fits_together(sim.scene)) {
    return damaged("its sections do not fit together");
  }
  sim.state->cells.map.set_kernel(sim.scene.topology.kernel);
  return sim;
}

}  // namespace sunder
