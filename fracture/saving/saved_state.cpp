// SPDX-License-Identifier: MIT
// Sections of a saved state.
#include "fracture/saving/saved_state.hpp"

#include <fmt/format.h>

#include <iterator>

#include "fracture/saving/archive.hpp"
#include "fracture/saving/member_counts.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"

namespace sunder {

namespace {
constexpr std::string_view magic = "SunderSt";

/// The leading rows and columns that are in use; what lies beyond is capacity.
template <class Archive, class Matrix>
void archive_used(Archive& a, Matrix& matrix, std::size_t blocks) {
  if constexpr (is_reader<Archive>) {
    archive(a, matrix);
    a.failed = a.failed || matrix.rows() != static_cast<Eigen::Index>(3 * blocks) ||
               matrix.cols() != matrix.rows();
  } else {
    const auto used = static_cast<Eigen::Index>(3 * blocks);
    const Eigen::MatrixXd block = matrix.topLeftCorner(used, used);
    archive(a, block);
  }
}

}  // namespace

template <class Archive, class Part>
requires std::is_same_v<std::remove_const_t<Part>, BorderFactor>
void archive_struct(Archive& a, Part& part) {
  auto& [blocks, needed, corner, copies] = part;
  archive(a, blocks);
  archive(a, needed);
  archive(a, copies);
  archive_used(a, corner, copies);
}

template <class Archive, class Factor>
requires std::is_same_v<std::remove_const_t<Factor>, SystemFactor>
void archive_struct(Archive& a, Factor& own) {
  auto& [factor, border, factored, matrix, touched, compliance, needed, scratch] = own;
  static_cast<void>(scratch);
  archive(a, factor);
  archive(a, border);
  archive(a, factored);
  archive(a, matrix);
  archive(a, touched);
  archive_used(a, compliance, touched.size());
  archive(a, needed);
}

template <class Archive, class Systems>
requires std::is_same_v<std::remove_const_t<Systems>, ComponentSystems>
void archive_struct(Archive& a, Systems& systems) {
  archive(a, systems.present);
  archive(a, systems.retired);
  archive(a, systems.local_row);
}

namespace {

/// Whether a map can be made of the rows: all of them in range, neighbours of each other.
bool fit_together(const MapRows& rows, std::span<const TetId> incident) {
  const std::size_t tetrahedra = rows.corners.size(), vertices = rows.point_of_vertex.size();
  if (rows.neighbours.size() != tetrahedra || incident.size() != vertices) return false;
  for (const std::uint32_t point : rows.point_of_vertex) {
    if (point >= rows.points.size()) return false;
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    if (incident[v].index() >= tetrahedra) return false;
    const auto& corners = rows.corners[incident[v].index()];
    if (std::ranges::find(corners, VertexId{v}) == corners.end()) return false;
  }
  for (std::size_t t = 0; t < tetrahedra; ++t) {
    for (std::size_t place = 0; place < 4; ++place) {
      if (rows.corners[t][place].index() >= vertices) return false;
      const HalfFaceId across = rows.neighbours[t][place];
      if (across.is_none()) continue;
      if (across.index() >= 4 * tetrahedra) return false;
      if (rows.neighbours[across.index() / 4][across.index() % 4].index() != 4 * t + place) {
        return false;
      }
    }
  }
  return true;
}

const DenseMap& dense_of(const VolumeMap& map) { return map.dense(); }
const DenseMap& dense_of(const DenseMap& map) { return map; }

template <class Archive, class Map>
void archive_map(Archive& a, Map& map) {
  MapRows rows;
  std::vector<TetId> incident;
  if constexpr (!is_reader<Archive>) {
    const DenseMap& dense = dense_of(map);
    rows = dense.rows();
    incident.assign(dense.incident_tetrahedra().begin(), dense.incident_tetrahedra().end());
  }
  archive(a, rows);
  archive(a, incident);
  if constexpr (is_reader<Archive>) {
    a.failed = a.failed || !fit_together(rows, incident);
    if (!a.failed) map = Map(std::move(rows), std::move(incident));
  }
}

/// A part of the file with its name and length. A reader must take just what is there.
template <class Archive, class... Parts>
void section(Archive& a, std::string_view name, Parts&... parts) {
  if constexpr (is_reader<Archive>) {
    std::array<char, 4> found{};
    std::uint64_t length = 0;
    a.numbers(found.data(), found.size());
    a.count(length);
    a.failed = a.failed || std::string_view(found.data(), found.size()) != name;
    if (a.failed) return;
    StateReader own{a.bytes.substr(0, length)};
    (archive(own, parts), ...);
    a.failed = own.failed || !own.bytes.empty();
    a.bytes.remove_prefix(length);
  } else {
    StateWriter own;
    (archive(own, parts), ...);
    a.numbers(name.data(), name.size());
    a.count(own.bytes.size());
    a.bytes += own.bytes;
  }
}

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

/// Whether ties name faces that the map has apart and the pieces have sewn.
bool fits_together(const std::vector<Tie>& ties, const Cells& cells) {
  if (!cells.pieces) return ties.empty();
  const std::size_t faces = 4 * cells.map.tetrahedra();
  return cells.pieces->map.tetrahedra() == cells.map.tetrahedra() &&
         cells.pieces->labels.of_tetrahedron == cells.labels.of_tetrahedron &&
         std::ranges::all_of(ties, [&](const Tie& tie) {
           const auto is_place = [](std::uint8_t place) { return place < 4; };
           return tie.face.index() < faces && tie.opposite.index() < faces &&
                  cells.map.neighbour(tie.face).is_none() &&
                  cells.pieces->map.neighbour(tie.face) == tie.opposite &&
                  std::ranges::all_of(tie.corner, is_place) &&
                  std::ranges::all_of(tie.opposite_corner, is_place);
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
  return s.display.size() == components && s.display_target.size() == components &&
         s.cells.labels.size.size() == components && s.cells.skin.size() == 4 * tetrahedra &&
         fits_together(s.cells.cracks, vertices, tetrahedra) &&
         fits_together(s.contact.ties, s.cells);
}

}  // namespace

template <class Archive, class M>
requires std::is_same_v<std::remove_const_t<M>, DenseMap>
void archive_struct(Archive& a, M& map) { archive_map(a, map); }

/// A solid with its surface: that is made anew of its points and triangles.
template <class Archive, class S>
requires std::is_same_v<std::remove_const_t<S>, Solid>
void archive_struct(Archive& a, S& solid) {
  TriangleSurface triangles;
  std::string file;
  bool has = static_cast<bool>(solid.surface);
  archive(a, has);
  if (has) {
    if constexpr (!is_reader<Archive>) {
      triangles = {solid.surface->points, solid.surface->triangles};
      file = solid.surface->file;
    }
    archive(a, triangles.points);
    archive(a, triangles.triangles);
    archive(a, file);
    if constexpr (is_reader<Archive>) {
      Result<SolidSurface> made = make_solid_surface(std::move(triangles), std::move(file));
      a.failed = a.failed || !made;
      if (made) solid.surface = std::make_shared<const SolidSurface>(std::move(*made));
    }
  }
  archive(a, solid.translation);
  archive(a, solid.orientation);
}

template <class Archive, class C>
requires std::is_same_v<std::remove_const_t<C>, Cells>
void archive_struct(Archive& a, C& cells) {
  auto& [map, labels, skin, strength, painted, flaw, unbreakable, waits, empty_fans, cracks,
         pieces] = cells;
  archive_map(a, map);
  const auto all = [&](auto&... member) { (archive(a, member), ...); };
  all(labels, skin, strength, painted, flaw, unbreakable, waits, empty_fans, cracks, pieces);
}

namespace {

/// All that is saved, section by section.
template <class Archive, class S>
void sections(Archive& a, S& sim) {
  section(a, "SCEN", sim.scene, sim.bodies);
  auto& [cells, mechanics, obstacles, contact, impact, ladder, display, display_target, cracks,
         fans, fans_before, pieces_before, step, birth_step, loads, script] = *sim.state;
  section(a, "CELL", cells);
  section(a, "MECH", mechanics);
  section(a, "OBST", obstacles);
  section(a, "CONT", contact);
  section(a, "IMPA", impact);
  section(a, "LADD", ladder);
  section(a, "DISP", display, display_target);
  section(a, "CRAC", cracks);
  section(a, "LOAD", loads);
  section(a, "SCRI", script);
  section(a, "STEP", fans, fans_before, pieces_before, step, birth_step);
}

std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  }
  return hash;
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
  if (reader.failed || !reader.bytes.empty() || !fits_together(*sim.state)) {
    return damaged("its sections do not fit together");
  }
  sim.state->cells.map.set_kernel(sim.scene.topology.kernel);
  return sim;
}

}  // namespace sunder
