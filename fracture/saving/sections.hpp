// SPDX-License-Identifier: MIT
// Internal to saving: the sections of a saved state and all their parts, once for writers, readers
// and checks of numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "fracture/saving/archive.hpp"
#include "fracture/saving/member_names.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"

namespace sunder {

/// The leading rows and columns that are in use; the rest is capacity.
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

template <class Archive, class Part>
requires std::is_same_v<std::remove_const_t<Part>, BorderFactor>
void archive_struct(Archive& a, Part& part) {
  auto& [blocks, needed, corner, copies] = part;
  archive_member(a, "blocks", blocks);
  archive(a, needed);
  archive(a, copies);
  archive_used(a, corner, copies);
}

template <class Archive, class Factor>
requires std::is_same_v<std::remove_const_t<Factor>, SystemFactor>
void archive_struct(Archive& a, Factor& own) {
  auto& [factor, border, factored, matrix, touched, compliance, needed, scratch] = own;
  static_cast<void>(scratch);
  archive_member(a, "factor", factor);
  archive_member(a, "border", border);
  archive_member(a, "factored", factored);
  archive_member(a, "matrix", matrix);
  archive(a, touched);
  archive_used(a, compliance, touched.size());
  archive(a, needed);
}

template <class Archive, class Systems>
requires std::is_same_v<std::remove_const_t<Systems>, ComponentSystems>
void archive_struct(Archive& a, Systems& systems) {
  archive_member(a, "present", systems.present);
  archive_member(a, "retired", systems.retired);
  archive(a, systems.local_row);
}

/// Whether a map can be made of the rows: all of them in range, neighbours of each other.
inline bool fit_together(const MapRows& rows, std::span<const TetId> incident) {
  const std::size_t tetrahedra = rows.corners.size(), vertices = rows.point_of_vertex.size();
  if (rows.neighbours.size() != tetrahedra || incident.size() != vertices) return false;
  for (const std::uint32_t point : rows.point_of_vertex) {
    if (point >= rows.points.size()) return false;
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    const bool is_node = rows.point_of_vertex[v] >= rows.first_node_point;
    if (is_node && incident[v].is_none()) continue;
    if (is_node || incident[v].index() >= tetrahedra) return false;
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

inline const DenseMap& dense_of(const VolumeMap& map) { return map.dense(); }
inline const DenseMap& dense_of(const DenseMap& map) { return map; }

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

/// A part of a section and its name in findings.
template <class T>
struct NamedPart {
  std::string_view name;
  T& value;
};
template <class T>
NamedPart(std::string_view, T&) -> NamedPart<T>;

/// A part of the file with its name and length. A reader must consume it exactly.
template <class Archive, class... T>
void section(Archive& a, std::string_view name, NamedPart<T>... parts) {
  if constexpr (is_reader<Archive>) {
    std::array<char, 4> found{};
    std::uint64_t length = 0;
    a.numbers(found.data(), found.size());
    a.count(length);
    a.failed = a.failed || std::string_view(found.data(), found.size()) != name;
    if (a.failed) return;
    StateReader own{a.bytes.substr(0, length)};
    (archive(own, parts.value), ...);
    a.failed = own.failed || !own.bytes.empty();
    a.bytes.remove_prefix(length);
  } else if constexpr (is_told_places<Archive>) {
    a.numbers(name.data(), name.size());
    a.count(std::uint64_t{});
    (archive_member(a, parts.name, parts.value), ...);
  } else {
    StateWriter own;
    (archive(own, parts.value), ...);
    a.numbers(name.data(), name.size());
    a.count(own.bytes.size());
    a.bytes += own.bytes;
  }
}

template <class Archive, class M>
requires std::is_same_v<std::remove_const_t<M>, DenseMap>
void archive_struct(Archive& a, M& map) { archive_map(a, map); }

/// A solid with its surface, which is made again from its points and triangles.
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
  if constexpr (is_told_places<Archive>) {
    if (a.enter("map")) archive_map(a, map);
    a.leave();
  } else {
    archive_map(a, map);
  }
  archive(a, labels);
  archive(a, skin);
  archive_member(a, "strength", strength);
  archive_member(a, "painted", painted);
  archive_member(a, "flaw", flaw);
  archive(a, unbreakable);
  archive(a, waits);
  archive_member(a, "empty_fans", empty_fans);
  archive_member(a, "cracks", cracks);
  archive_member(a, "pieces", pieces);
}

/// All that is saved, section by section.
template <class Archive, class S>
void sections(Archive& a, S& sim) {
  section(a, "SCEN", NamedPart{"scene", sim.scene}, NamedPart{"bodies", sim.bodies});
  auto& [cells, mechanics, obstacles, contact, impact, ladder, display, display_target, cracks,
         fans, fans_before, pieces_before, step, birth_step, loads, script] = *sim.state;
  section(a, "CELL", NamedPart{"cells", cells});
  section(a, "MECH", NamedPart{"mechanics", mechanics});
  section(a, "OBST", NamedPart{"obstacles", obstacles});
  section(a, "CONT", NamedPart{"contact", contact});
  section(a, "IMPA", NamedPart{"impact", impact});
  section(a, "LADD", NamedPart{"ladder", ladder});
  section(a, "DISP", NamedPart{"display", display}, NamedPart{"display_target", display_target});
  section(a, "CRAC", NamedPart{"open_cracks", cracks});
  section(a, "LOAD", NamedPart{"loads", loads});
  section(a, "SCRI", NamedPart{"script", script});
  section(a, "STEP", NamedPart{"fans", fans}, NamedPart{"fans_before", fans_before},
          NamedPart{"pieces_before", pieces_before}, NamedPart{"step", step},
          NamedPart{"birth_step", birth_step});
}

}  // namespace sunder
