// SPDX-License-Identifier: MIT
// The contents of a mesh that a format cannot hold, counted and reported.
#include "topology/io/losses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "topology/base/counted.hpp"
#include "topology/io/abaqus/abaqus.hpp"
#include "topology/io/fitted_cells.hpp"
#include "topology/io/msh/msh.hpp"
#include "topology/io/msh/msh_entities.hpp"
#include "topology/io/nastran/nastran.hpp"
#include "topology/io/surface/ply.hpp"
#include "topology/io/surface/stl.hpp"
#include "topology/io/unv/unv.hpp"
#include "topology/io/vtk/vtk_cells.hpp"
#include "topology/mesh/kinds/move_cells.hpp"

namespace sunder::io {
namespace {

/// Collects losses, each kind once.
struct Losses {
  /// As far as the encoding holds it.
  FormatTraits to;
  std::vector<Finding> findings;
};

void lose(Losses& losses, std::string_view code, std::size_t count, std::string text) {
  losses.findings.push_back(
      {.code = std::string(code),
       .severity = Severity::warning,
       .count = count,
       .text = std::move(text),
       .remedy = fmt::format("write another format than {} to keep them", losses.to.name)});
}

/// "an edge", "a hexahedron".
std::string with_article(CellKind kind) {
  const std::string_view name = traits_of(kind).name;
  const bool has_vowel = std::string_view("aeiou8").find(name.front()) != std::string_view::npos;
  return fmt::format("{} {}", has_vowel ? "an" : "a", name);
}

/// Kinds of cells that the format does not hold: of the same shape one with fewer nodes is written,
/// where it has that.
void lose_cells(Losses& losses, const FileMesh& mesh, const FormatTraits& t) {
  const KindSet held = kinds_held(mesh, t);
  for (const CellKind kind : all_cell_kinds) {
    const std::size_t n = rows_of(mesh, kind).count;
    if (n == 0 || contains(held, kind)) continue;
    const CellKindTraits& own = traits_of(kind);
    const CellKind lower = held_kind(held, kind);
    const bool mixes = t.format == MeshFormat::tetgen && contains(t.cells, kind);
    if (lower == kind) {
      lose(losses, "cells_lost", n, fmt::format("{} holds no {}", losses.to.name, own.plural));
      if (own.dimension > 1) {
        losses.findings.back().remedy += ", or write their simplices with --split";
      }
    } else {
      lose(losses, "nodes_lost", n,
           fmt::format("{} {}: {}, {} other nodes stay as points", losses.to.name,
                       mixes ? "has cells of one order" : fmt::format("holds no {}", own.plural),
                       n == 1 ? fmt::format("one is written as {}", with_article(lower))
                              : fmt::format("{} are written as {}", n, traits_of(lower).plural),
                       for_count(n, "its", "their")));
    }
  }
}

/// Of cells of second order those are counted that are written by corners that repeat.
void lose_collapsed(Losses& losses, const Written& written, const FormatTraits& t) {
  FileMesh linear = written.whole();
  make_linear(linear);
  const std::size_t n = collapsed_cells(linear, t);
  if (n == 0) return;
  lose(losses, "cells_lost", n,
       fmt::format("{} holds no volume cells that repeat a corner", losses.to.name));
}

void lose_labels(Losses& losses, const FileMesh& mesh) {
  std::size_t regions = 0, entities = 0;
  for (const CellKind kind : all_cell_kinds) {
    const CellColumns& cells = columns_of(mesh, kind);
    regions += cells.region.size();
    // Where no region is given, the entity is written in its place.
    if (!cells.region.empty() || label_of(cells).empty()) entities += cells.entity.size();
  }
  const std::string_view name = losses.to.name;
  if (regions > 0 && !losses.to.holds_regions) {
    lose(losses, "regions_lost", regions, fmt::format("{} holds no regions", name));
  }
  if (entities > 0 && !losses.to.holds_entities) {
    lose(losses, "entities_lost", entities, fmt::format("{} holds no entities", name));
  }
  if (!mesh.point_region.empty() && !losses.to.holds_point_regions) {
    lose(losses, "point_regions_lost", mesh.point_region.size(),
         fmt::format("{} holds no regions of points", name));
  }
}

/// Which of a mesh's own numbers fit into 32 bits: PLY has no wider integers.
HeldNumbers ply_holds(const FileMesh& mesh) {
  HeldNumbers held{ply_type(mesh.source_point_id).has_value(), true};
  for (const CellKind kind : all_cell_kinds) {
    held.cells = held.cells && ply_type(columns_of(mesh, kind).source_id).has_value();
  }
  return held;
}

void lose_ids(Losses& losses, const FileMesh& mesh, std::string_view version) {
  std::size_t cells = 0, below = 0;
  for (const CellKind kind : all_cell_kinds) {
    const bool is_below = traits_of(kind).dimension < losses.to.cell_ids_from;
    (is_below ? below : cells) += columns_of(mesh, kind).source_id.size();
  }
  const std::size_t points = mesh.source_point_id.size();
  const bool is_msh = losses.to.format == MeshFormat::msh;
  const bool is_abaqus = losses.to.format == MeshFormat::abaqus;
  const bool is_nastran = losses.to.format == MeshFormat::nastran;
  const bool is_unv = losses.to.format == MeshFormat::unv;
  const HeldNumbers own = is_msh       ? msh_holds(mesh, version == "4.1" ? 41 : 22)
                          : is_abaqus  ? abaqus_holds(mesh)
                          : is_nastran ? nastran_holds(mesh)
                          : is_unv     ? unv_holds(mesh)
                          : losses.to.format == MeshFormat::ply ? ply_holds(mesh)
                                                                : HeldNumbers{true, true};
  const bool keeps_points = losses.to.holds_point_ids && own.points;
  const bool keeps_cells = losses.to.holds_cell_ids && own.cells;
  const std::size_t lost = (keeps_points ? 0 : points) + (keeps_cells ? 0 : cells) +
                           (losses.to.holds_cell_ids ? below : 0);
  if (lost == 0) return;
  lose(losses, "source_ids_lost", lost,
       is_msh
           ? "points and elements are numbered anew: MSH needs positive numbers, each once (below "
             "2^31 before version 4.1)"
       : losses.to.cell_ids_from == 1 && keeps_points && keeps_cells
           ? fmt::format("{} does not hold numbers of vertices", losses.to.name)
       : losses.to.cell_ids_from == 1
           ? fmt::format(
                 "points or elements are numbered anew: {} needs positive numbers{}, each once",
                 losses.to.name,
                 is_nastran ? " below 100 000 000"
                 : is_unv   ? " below 1 000 000 000"
                            : "")
           : fmt::format("{} does not hold numbers of {}", losses.to.name,
                         keeps_points  ? "cells"
                         : keeps_cells ? "points"
                                       : "points and cells"));
}

void lose_data(Losses& losses, const FileMesh& mesh, std::string_view version) {
  const bool none = losses.to.format == MeshFormat::msh && version == "1";
  std::size_t typed = 0, lost = 0;
  std::string names;
  const bool is_ply = losses.to.format == MeshFormat::ply;
  const auto judge = [&](const DataColumn& column, bool is_held) {
    const auto type = is_ply ? ply_type(column) : column.type;
    if (is_held && !none && type) {
      typed += column.type != (losses.to.holds_number_types ? *type : NumberType::float64);
      return;
    }
    ++lost;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", column.name);
  };
  for (const DataColumn& column : mesh.point_data) judge(column, losses.to.holds_point_data);
  for (const CellKind kind : all_cell_kinds) {
    const bool is_held =
        losses.to.holds_cell_data && traits_of(kind).dimension >= losses.to.cell_data_from;
    for (const DataColumn& column : columns_of(mesh, kind).data) judge(column, is_held);
  }
  const bool is_vtk = losses.to.format == MeshFormat::vtk || losses.to.format == MeshFormat::vtu ||
                      losses.to.format == MeshFormat::vtp;
  if (is_vtk) {
    const std::vector<std::string> clashes = vtk_clashes(mesh);
    if (!clashes.empty()) {
      lose(losses, "data_lost", clashes.size(),
           fmt::format("{} has one array of a name: further ones are lost ({})", losses.to.name,
                       fmt::join(clashes, ", ")));
    }
    const std::vector<std::string> filled = vtk_fillings(mesh);
    if (!filled.empty()) {
      lose(losses, "data_filled", filled.size(),
           fmt::format("{} has one array for cells of all kinds: those without {} get 0",
                       losses.to.name, fmt::join(filled, ", ")));
      losses.findings.back().remedy =
          "give all kinds of cells these numbers, or read the zeros as none";
    }
  }
  if (lost > 0) {
    lose(losses, "data_lost", lost,
         fmt::format("{} does not hold the data {}", losses.to.name, names));
  }
  if (typed > 0) {
    lose(losses, "number_types_lost", typed,
         fmt::format("{} {}", counted(typed, "column becomes", "columns become"),
                     is_ply ? "integers of 32 bits" : "double-precision numbers"));
  }
}

/// In MSH 4 each entity belongs to one group, and regions below 1 are read by few.
void lose_in_msh(Losses& losses, const FileMesh& mesh, std::string_view version) {
  bool below = false;
  for (const CellKind kind : all_cell_kinds) {
    const CellColumns& cells = columns_of(mesh, kind);
    // 0 is no group, which an entity of its own number can say.
    const std::int32_t lowest = cells.entity.empty() ? 1 : 0;
    below = below || std::ranges::any_of(cells.region, [&](std::int32_t r) { return r < lowest; });
  }
  if (below) {
    losses.findings.push_back({.code = "region_not_positive",
                               .severity = Severity::warning,
                               .text = "a region is 0 or less: Sunder reads it back, but Gmsh and "
                                       "others expect physical groups from 1 up",
                               .remedy = "number the regions from 1 up"});
  }
  const std::size_t split = version[0] == '4' ? msh_entities(mesh, 41).lost : 0;
  if (split > 0) {
    lose(losses, "entities_lost", split,
         "entities with cells of several regions give way to the regions: each belongs to one "
         "group in MSH 4");
  }
}

/// The parts of a mesh with volume cells that formats of surfaces leave out.
void lose_inside(Losses& losses, const FileMesh& mesh, const BoundarySurface& surface) {
  const std::string_view name = losses.to.name;
  std::size_t volumes = 0, curved = 0;
  std::string plurals;
  for (const CellKind kind : all_cell_kinds) {
    const std::size_t n = rows_of(mesh, kind).count;
    if (n == 0) continue;
    if (linear_kind(kind) != kind) curved += n;
    if (traits_of(kind).dimension < 3) continue;
    volumes += n;
    plurals += fmt::format("{}{}", plurals.empty() ? "" : ", ", traits_of(kind).plural);
  }
  const std::size_t triangles = rows_of(surface.mesh, CellKind::triangle).count;
  const std::size_t quads = rows_of(surface.mesh, CellKind::quad4).count;
  lose(losses, "cells_lost", volumes,
       fmt::format("{} holds no {}: their boundary of {}{} is written", name, plurals,
                   counted(triangles, "triangle"),
                   quads == 0 ? "" : " and " + counted(quads, "quadrilateral")));
  for (const CellKind kind : all_cell_kinds) {
    const std::size_t lost = surface.lost_cells[index_of(kind)];
    if (lost == 0 || !contains(losses.to.cells, kind)) continue;
    lose(losses, "cells_lost", lost,
         fmt::format("{} {} not on the boundary of the volume cells",
                     counted(lost, traits_of(kind).name, traits_of(kind).plural),
                     for_count(lost, "is", "are")));
  }
  if (curved > 0) {
    lose(losses, "nodes_lost", curved,
         fmt::format("{} taken by the corners",
                     counted(curved, "cell of second order is", "cells of second order are")));
  }
  if (surface.lost_points == 0) return;
  lose(losses, "points_lost", surface.lost_points,
       fmt::format("{} that the boundary does not use {} dropped",
                   counted(surface.lost_points, "point"),
                   for_count(surface.lost_points, "is", "are")));
}

/// STL has corners of triangles and no points.
void lose_in_stl(Losses& losses, const FileMesh& mesh, bool is_binary) {
  const StlPoints points = stl_points(mesh, is_binary);
  if (points.unused + points.merged > 0 || points.is_reordered) {
    lose(losses, "points_renumbered", mesh.points.size(),
         fmt::format("points come back in the order in which triangles use them{}{}",
                     points.unused == 0
                         ? ""
                         : fmt::format("; {} that none uses {} dropped", points.unused,
                                       for_count(points.unused, "is", "are")),
                     points.merged == 0
                         ? ""
                         : fmt::format("; {} {} one with another at the same place", points.merged,
                                       for_count(points.merged, "becomes", "become"))));
  }
  if (points.rounded == 0) return;
  lose(losses, "coordinates_rounded", points.rounded,
       fmt::format("{} coordinates that are no floats: they change by up to {:.2g} of their size",
                   counted(points.rounded, "point has", "points have"), points.largest_change));
  losses.findings.back().remedy = "write text (--text), which keeps every digit";
}

/// A file without a cell says nothing of a mesh that has some; one without a point says nothing,
/// and would replace one that does.
std::optional<Finding> nothing_left(const Written& written, const FormatTraits& t) {
  if (written.mesh().points.empty()) {
    return Finding{.code = "nothing_left",
                   .text = "the mesh has no points: an empty file would be written",
                   .remedy = "look at the file that it was read from"};
  }
  if (cell_count(written.original) == 0 || cell_count(written.mesh()) > 0) return std::nullopt;
  return Finding{.code = "nothing_left",
                 .count = cell_count(written.original),
                 .text = fmt::format("{} holds none of the mesh's cells ({})", t.name,
                                     cell_count(written.original)),
                 .remedy = "write another format, or the simplices of the cells with --split"};
}

}  // namespace

Written written_of(const FileMesh& mesh, const FormatTraits& t) {
  Written written{mesh, {}, {}};
  const bool is_of_surfaces = !contains(t.cells, CellKind::tetrahedron);
  if (is_of_surfaces && has_volume_cells(mesh)) written.surface = boundary_surface(mesh);
  written.fitted = fitted_cells(written.whole(), t);
  return written;
}

std::string version_of(const FormatTraits& t, const WriteOptions& options) {
  if (!options.version.empty() || t.versions.empty()) return options.version;
  return std::string(t.versions.front());
}

std::vector<Finding> losses_of(const Written& written, const WriteOptions& options) {
  const FormatTraits& t = traits_of(options.format.value());
  Losses losses{t, {}};
  const std::string version = version_of(t, options);
  const bool is_binary = options.encoding.value_or(t.encodings[0]) == Encoding::binary;
  if (t.format == MeshFormat::stl && is_binary) {
    losses.to.name = "binary STL";
    losses.to.holds_regions = false;
  }
  if (auto nothing = nothing_left(written, t)) losses.findings.push_back(std::move(*nothing));
  if (written.surface) lose_inside(losses, written.original, *written.surface);
  lose_cells(losses, written.whole(), t);
  if (t.format == MeshFormat::ovm) lose_collapsed(losses, written, t);
  const FileMesh& mesh = written.mesh();
  lose_labels(losses, mesh);
  // Points of a surface are numbered after those of the body: that is no number of the user's.
  if (!written.surface || !written.original.source_point_id.empty()) {
    lose_ids(losses, mesh, version);
  }
  lose_data(losses, mesh, version);
  if (t.format == MeshFormat::msh) lose_in_msh(losses, mesh, version);
  if (t.format == MeshFormat::stl) lose_in_stl(losses, mesh, is_binary);
  const auto add = [&losses](std::vector<Finding> more) {
    std::ranges::move(more, std::back_inserter(losses.findings));
  };
  if (t.format == MeshFormat::nastran) add(lost_in_nastran(mesh));
  if (t.format == MeshFormat::unv) add(lost_in_unv(mesh));
  return std::move(losses.findings);
}

}  // namespace sunder::io
