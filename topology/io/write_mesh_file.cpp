// SPDX-License-Identifier: MIT
// What a format cannot hold of a mesh, and the way out into a file.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "topology/io/abaqus/abaqus.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/io/formats.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/io/msh/msh.hpp"
#include "topology/io/region_names.hpp"
#include "topology/io/scan.hpp"
#include "topology/io/surface/ply.hpp"
#include "topology/io/surface/stl.hpp"
#include "topology/io/vtk/vtk_cells.hpp"
#include "topology/mesh/boundary_surface.hpp"

namespace sunder {
namespace {

constexpr std::string_view cell_names[] = {"vertices", "edges", "triangles", "tetrahedra"};

/// Collects what is lost, each kind once.
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

void lose_cells(Losses& losses, const FileMesh& mesh) {
  for_each_cell_list(mesh, [&](const auto& cells, int d) {
    const std::size_t n = cells.corners.size();
    if (n == 0 || losses.to.holds_cells[static_cast<std::size_t>(d)]) return;
    lose(losses, "cells_lost", n, fmt::format("{} holds no {}", losses.to.name, cell_names[d]));
  });
}

void lose_labels(Losses& losses, const FileMesh& mesh) {
  std::size_t regions = 0, entities = 0;
  for_each_cell_list(mesh, [&](const auto& cells, int d) {
    if (!losses.to.holds_cells[static_cast<std::size_t>(d)]) return;
    regions += cells.region.size();
    // Where no region is given, the entity is written in its place.
    if (!cells.region.empty() || label_of(cells).empty()) entities += cells.entity.size();
  });
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
io::HeldNumbers ply_holds(const FileMesh& mesh) {
  io::HeldNumbers held{io::ply_type(mesh.source_point_id).has_value(), true};
  for_each_cell_list(mesh, [&](const auto& cells, int) {
    held.cells = held.cells && io::ply_type(cells.source_id).has_value();
  });
  return held;
}

void lose_ids(Losses& losses, const FileMesh& mesh, std::string_view version) {
  std::size_t cells = 0, below = 0;
  for_each_cell_list(mesh, [&](const auto& list, int d) {
    (d < losses.to.cell_ids_from ? below : cells) += list.source_id.size();
  });
  const std::size_t points = mesh.source_point_id.size();
  const bool is_msh = losses.to.format == MeshFormat::msh;
  const bool is_abaqus = losses.to.format == MeshFormat::abaqus;
  const io::HeldNumbers own = is_msh      ? io::msh_holds(mesh, version == "4.1" ? 41 : 22)
                              : is_abaqus ? io::abaqus_holds(mesh)
                              : losses.to.format == MeshFormat::ply ? ply_holds(mesh)
                                                                    : io::HeldNumbers{true, true};
  const bool keeps_points = losses.to.holds_point_ids && own.points;
  const bool keeps_cells = losses.to.holds_cell_ids && own.cells;
  const std::size_t lost = (keeps_points ? 0 : points) + (keeps_cells ? 0 : cells) +
                           (losses.to.holds_cell_ids ? below : 0);
  if (lost == 0) return;
  lose(losses, "source_ids_lost", lost,
       is_msh
           ? "points and elements are numbered anew: MSH needs positive numbers, each once (below "
             "2^31 before version 4.1)"
       : is_abaqus && keeps_points && keeps_cells ? "Abaqus does not hold numbers of vertices"
       : is_abaqus
           ? "points or elements are numbered anew: Abaqus needs positive numbers, each once"
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
    const auto type = is_ply ? io::ply_type(column) : column.type;
    if (is_held && !none && type) {
      typed += column.type != (losses.to.holds_number_types ? *type : NumberType::float64);
      return;
    }
    ++lost;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", column.name);
  };
  for (const DataColumn& column : mesh.point_data) judge(column, losses.to.holds_point_data);
  for_each_cell_list(mesh, [&](const auto& cells, int d) {
    const bool is_held = losses.to.holds_cell_data && d >= losses.to.cell_data_from;
    for (const DataColumn& column : cells.data) judge(column, is_held);
  });
  if (losses.to.format == MeshFormat::vtk || losses.to.format == MeshFormat::vtu) {
    const std::vector<std::string> clashes = io::vtk_clashes(mesh);
    if (!clashes.empty()) {
      lose(losses, "data_lost", clashes.size(),
           fmt::format("{} has one array of a name: further ones are lost ({})", losses.to.name,
                       fmt::join(clashes, ", ")));
    }
  }
  if (lost > 0) {
    lose(losses, "data_lost", lost,
         fmt::format("{} does not hold the data {}", losses.to.name, names));
  }
  if (typed > 0) {
    lose(losses, "number_types_lost", typed,
         fmt::format("{} columns become {}", typed,
                     is_ply ? "integers of 32 bits" : "double-precision numbers"));
  }
}

/// In MSH 4 each entity belongs to one group, and regions below 1 are read by few.
void lose_in_msh(Losses& losses, const FileMesh& mesh, std::string_view version) {
  bool below = false;
  std::size_t split = 0;
  for_each_cell_list(mesh, [&](const auto& cells, int) {
    // 0 is no group, which an entity of its own number can say.
    const std::int32_t lowest = cells.entity.empty() ? 1 : 0;
    below = below || std::ranges::any_of(cells.region, [&](std::int32_t r) { return r < lowest; });
    std::map<std::int32_t, std::int32_t> group;
    for (std::size_t i = 0; i < cells.entity.size() && !cells.region.empty(); ++i) {
      if (group.emplace(cells.entity[i], cells.region[i]).first->second == cells.region[i]) {
        continue;
      }
      split += cells.entity.size();
      break;
    }
  });
  if (below) {
    losses.findings.push_back({.code = "region_not_positive",
                               .severity = Severity::warning,
                               .text = "a region is 0 or less: Sunder reads it back, but Gmsh and "
                                       "others expect physical groups from 1 up",
                               .remedy = "number the regions from 1 up"});
  }
  if (split > 0 && version[0] == '4') {
    lose(losses, "entities_lost", split,
         "entities with cells of several regions give way to the regions: each belongs to one "
         "group in MSH 4");
  }
}

/// What formats of surfaces leave out of a mesh with tetrahedra.
void lose_inside(Losses& losses, const FileMesh& mesh, const BoundarySurface& surface) {
  const std::string_view name = losses.to.name;
  lose(losses, "cells_lost", mesh.tetrahedra.corners.size(),
       fmt::format("{} holds no tetrahedra: their boundary of {} triangles is written", name,
                   surface.mesh.triangles.corners.size()));
  for (std::size_t d = 0; d < 3; ++d) {
    if (surface.lost_cells[d] == 0 || !losses.to.holds_cells[d]) continue;
    lose(losses, "cells_lost", surface.lost_cells[d],
         fmt::format("{} {} are not on the boundary of the tetrahedra", surface.lost_cells[d],
                     cell_names[d]));
  }
  if (surface.lost_points == 0) return;
  lose(losses, "points_lost", surface.lost_points,
       fmt::format("{} points that the boundary does not use are dropped", surface.lost_points));
}

/// STL has corners of triangles and no points.
void lose_in_stl(Losses& losses, const FileMesh& mesh, bool is_binary) {
  const io::StlPoints points = io::stl_points(mesh, is_binary);
  if (points.unused + points.merged > 0 || points.is_reordered) {
    lose(losses, "points_renumbered", mesh.points.size(),
         fmt::format("points come back in the order in which triangles use them: {} that none uses "
                     "are dropped, {} become one with another at the same place",
                     points.unused, points.merged));
  }
  if (points.rounded == 0) return;
  lose(losses, "coordinates_rounded", points.rounded,
       fmt::format("{} points have coordinates that are no floats: they change by up to {:.2g} of "
                   "their size",
                   points.rounded, points.largest_change));
  losses.findings.back().remedy = "write text (--text), which keeps every digit";
}

bool holds_names(const FormatTraits& t, std::string_view version) {
  return t.holds_region_names && version != "1";
}

std::string version_of(const FormatTraits& t, const WriteOptions& options) {
  if (!options.version.empty() || t.versions.empty()) return options.version;
  return std::string(t.versions.front());
}

constexpr std::string_view encoding_words[] = {"text", "binary data", "base64"};

std::string_view word_of(Encoding encoding) {
  return encoding_words[static_cast<std::size_t>(encoding)];
}

/// The reason why a format cannot be written so, if there is one.
std::optional<Finding> refused(const FormatTraits& t, const io::FileEncoding& how) {
  const auto has = [](const auto& list, const auto& item) {
    return std::ranges::find(list, item) != list.end();
  };
  if (!how.version.empty() && !has(t.versions, how.version)) {
    return Finding{.code = "unknown_version",
                   .text = fmt::format("{} is not written in version {}", t.name, how.version),
                   .remedy = t.versions.empty()
                                 ? std::string("give no version")
                                 : fmt::format("give one of {}", fmt::join(t.versions, ", "))};
  }
  const bool is_msh_1 = t.format == MeshFormat::msh && how.version == "1";
  if (!has(t.encodings, how.encoding) || (is_msh_1 && how.encoding != Encoding::text)) {
    std::string words;
    for (const Encoding e : t.encodings) {
      if (is_msh_1 && e != Encoding::text) continue;
      words += fmt::format("{}{}", words.empty() ? "" : " or ", word_of(e));
    }
    return Finding{
        .code = "unknown_version",
        .text = fmt::format("{}{}{} is not written as {}", t.name, how.version.empty() ? "" : " ",
                            how.version, word_of(how.encoding)),
        .remedy = fmt::format("ask for {}", words)};
  }
  if (!how.pack || (t.packs && how.encoding != Encoding::text)) return std::nullopt;
  return Finding{
      .code = "unknown_version",
      .text = fmt::format("{} as {} is not packed by zlib", t.name, word_of(how.encoding)),
      .remedy = "leave out --zlib: only binary data and base64 of VTU know it"};
}

/// The boundary of a mesh with tetrahedra, for formats that hold none.
std::optional<BoundarySurface> surface_for(const FileMesh& mesh, const FormatTraits& t) {
  if (t.holds_cells[3] || mesh.tetrahedra.corners.empty()) return std::nullopt;
  return boundary_surface(mesh);
}

std::vector<Finding> losses_of(const FileMesh& mesh, const std::optional<BoundarySurface>& surface,
                               const WriteOptions& options) {
  const FormatTraits& t = traits_of(options.format.value());
  Losses losses{t, {}};
  const std::string version = version_of(t, options);
  const bool is_binary = options.encoding.value_or(t.encodings[0]) == Encoding::binary;
  if (t.format == MeshFormat::stl && is_binary) {
    losses.to.name = "binary STL";
    losses.to.holds_regions = false;
  }
  if (surface) {
    lose_inside(losses, mesh, *surface);
  } else {
    lose_cells(losses, mesh);
  }
  const FileMesh& written = surface ? surface->mesh : mesh;
  lose_labels(losses, written);
  // Points of a surface are numbered after those of the body: that is no number of the user's.
  if (!surface || !mesh.source_point_id.empty()) lose_ids(losses, written, version);
  lose_data(losses, written, version);
  if (t.format == MeshFormat::msh) lose_in_msh(losses, mesh, version);
  if (t.format == MeshFormat::stl) {
    lose_in_stl(losses, written, is_binary);
  }
  return std::move(losses.findings);
}

/// Writes names that the format does not hold beside the file, and empties the list of an earlier
/// mesh there, which would be read with the new one. A note tells so; an error where it fails.
std::optional<Finding> write_names_beside(const std::filesystem::path& path, const FileMesh& mesh,
                                          const FormatTraits& t, std::string_view version) {
  const std::filesystem::path beside = io::names_beside(path, t.format);
  std::error_code unknown;
  const std::size_t names = name_count(mesh);
  const bool is_stale = names == 0 && std::filesystem::is_regular_file(beside, unknown);
  if (!is_stale && (names == 0 || holds_names(t, version))) return std::nullopt;
  if (auto error = io::write_region_names(beside, mesh)) return error;
  if (is_stale) {
    return Finding{.code = "names_cleared",
                   .severity = Severity::note,
                   .text = fmt::format("the mesh has no names of regions: those of an earlier one "
                                       "are taken out of {}",
                                       beside.string()),
                   .remedy = "nothing to do: they would have been read with it"};
  }
  return Finding{
      .code = "names_beside",
      .severity = Severity::note,
      .count = names,
      .text = fmt::format("{} {} in {}", t.name,
                          t.regions_are_words ? "has words for regions: their numbers and names are"
                                              : "holds no names of regions: they are",
                          beside.string()),
      .remedy = "keep that file beside the mesh: it is read with it"};
}

}  // namespace

std::vector<Finding> lost_on_writing(const FileMesh& mesh, const WriteOptions& options) {
  return losses_of(mesh, surface_for(mesh, traits_of(options.format.value())), options);
}

std::vector<Finding> write_file_mesh(const std::filesystem::path& path, const FileMesh& mesh,
                                     const WriteOptions& options) {
  WriteOptions chosen = options;
  if (!chosen.format) chosen.format = format_of_name(path);
  if (!chosen.format) {
    std::string endings;
    for (const FormatTraits& t : format_traits()) {
      endings += fmt::format("{}{}", endings.empty() ? "" : ", ", t.extensions[0]);
    }
    return {{.code = "unknown_format",
             .text = fmt::format("the ending {} names no format that is written",
                                 io::in_quotes(path.extension().string())),
             .remedy = fmt::format("end the name with one of {}", endings),
             .file = path.string()}};
  }
  const FormatTraits& t = traits_of(*chosen.format);
  const std::string version = version_of(t, chosen);
  const io::FileEncoding how{
      version, chosen.encoding.value_or(is_binary_name(path) ? Encoding::binary : t.encodings[0]),
      chosen.pack};
  std::vector<Finding> findings;
  const bool is_plain = path.extension() != ".gz" && path != "-";
  if (!is_plain && t.format == MeshFormat::tetgen) {
    findings.push_back({.code = "unknown_format",
                        .text = "TetGen's meshes are several files: they are not packed, nor written "
                                "to standard output",
                        .remedy = "name STEM.node, or another format"});
  } else if (auto reason = refused(t, how)) {
    findings.push_back(std::move(*reason));
  } else {
    const std::optional<BoundarySurface> surface = surface_for(mesh, t);
    const FileMesh& written = surface ? surface->mesh : mesh;
    chosen.encoding = how.encoding;
    findings = losses_of(mesh, surface, chosen);
    if (const std::size_t names = name_count(written);
        path == "-" && names > 0 && !holds_names(t, version)) {
      findings.push_back({.code = "names_lost",
                          .severity = Severity::warning,
                          .count = names,
                          .text = fmt::format("{} holds no names of regions, and nothing lies beside "
                                              "standard output",
                                              t.name),
                          .remedy = "write to a file: they are put beside it"});
    }
    auto failure = io::write_format(t.format, path, written, how);
    if (failure) findings.insert(findings.begin(), std::move(*failure));
    if (!failure) {
      auto names = path == "-" ? std::nullopt : write_names_beside(path, written, t, version);
      if (names) findings.insert(has_error({*names}) ? findings.begin() : findings.end(), *names);
    }
  }
  for (Finding& finding : findings) finding.file = path.string();
  return findings;
}

std::vector<Finding> write_mesh(const std::filesystem::path& path, const TetMesh& mesh) {
  return write_file_mesh(path, file_mesh_of(mesh));
}

}  // namespace sunder
