// SPDX-License-Identifier: MIT
// The table of formats: the contents of each, how it is recognized, which code reads it.
#include "topology/io/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "topology/io/abaqus/abaqus.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/io/medit/medit.hpp"
#include "topology/io/msh/msh.hpp"
#include "topology/io/nastran/nastran.hpp"
#include "topology/io/ovm/ovm.hpp"
#include "topology/io/surface/obj.hpp"
#include "topology/io/surface/off.hpp"
#include "topology/io/surface/ply.hpp"
#include "topology/io/surface/stl.hpp"
#include "topology/io/tetgen/tetgen.hpp"
#include "topology/io/text/scan.hpp"
#include "topology/io/unv/unv.hpp"
#include "topology/io/vtk/vtk.hpp"
#include "topology/io/vtu/vtu_read.hpp"

namespace sunder {
namespace {

constexpr std::string_view msh_names[] = {".msh"};
constexpr std::string_view msh_versions[] = {"4.1", "4.0", "2.2", "1"};
constexpr std::string_view medit_names[] = {".mesh", ".meshb"};
constexpr std::string_view vtu_names[] = {".vtu"};
constexpr std::string_view vtk_names[] = {".vtk"};
constexpr std::string_view tetgen_names[] = {".node", ".ele", ".face", ".edge"};
constexpr std::string_view abaqus_names[] = {".inp"};
constexpr std::string_view nastran_names[] = {".bdf", ".nas"};
constexpr std::string_view unv_names[] = {".unv"};
constexpr std::string_view ovm_names[] = {".ovm"};
constexpr std::string_view vtk_versions[] = {"4.2", "5.1"};
constexpr std::string_view off_names[] = {".off"};
constexpr std::string_view ply_names[] = {".ply"};
constexpr std::string_view obj_names[] = {".obj"};
constexpr std::string_view stl_names[] = {".stl"};
constexpr std::string_view vtp_names[] = {".vtp"};
constexpr Encoding text_only[] = {Encoding::text};
constexpr Encoding text_first[] = {Encoding::text, Encoding::binary};
constexpr Encoding binary_first[] = {Encoding::binary, Encoding::text};
constexpr Encoding vtu_encodings[] = {Encoding::binary, Encoding::base64, Encoding::text};

constexpr KindSet curved_simplices =
    kind_set({CellKind::edge, CellKind::edge3, CellKind::triangle, CellKind::triangle6,
              CellKind::tetrahedron, CellKind::tetrahedron10});
constexpr KindSet vtk_kinds = all_kinds & ~kind_set({CellKind::pyramid14});
constexpr KindSet faces = kind_set({CellKind::triangle, CellKind::quad4, CellKind::polygon});

/// VTK's formats hold all but names.
constexpr FormatTraits vtk_traits(MeshFormat format, std::string_view name,
                                  std::span<const std::string_view> extensions,
                                  std::span<const Encoding> encodings, KindSet cells) {
  return {
      .format = format,
      .name = name,
      .extensions = extensions,
      .encodings = encodings,
      .packs = format != MeshFormat::vtk,
      .versions = format == MeshFormat::vtk ? vtk_versions : std::span<const std::string_view>{},
      .cells = cells,
      .holds_entities = true,
      .holds_point_regions = true,
      .holds_point_ids = true,
      .holds_cell_ids = true,
      .holds_point_data = true,
      .holds_cell_data = true,
      .holds_number_types = true};
}

constexpr FormatTraits traits[] = {
    {.format = MeshFormat::msh,
     .name = "Gmsh MSH",
     .extensions = msh_names,
     .encodings = text_first,
     .versions = msh_versions,
     .cells = all_kinds & ~kind_set({CellKind::polygon, CellKind::triangle7}),
     .holds_region_names = true,
     .holds_entities = true,
     .holds_point_ids = true,
     .holds_cell_ids = true,
     .holds_point_data = true,
     .holds_cell_data = true},
    {.format = MeshFormat::medit,
     .name = "MEDIT",
     .extensions = medit_names,
     .binary_extension = ".meshb",
     .encodings = text_first,
     .cells =
         curved_simplices |
         kind_set({CellKind::quad4, CellKind::quad9, CellKind::hexahedron8, CellKind::hexahedron27,
                   CellKind::prism6, CellKind::prism18, CellKind::pyramid5, CellKind::pyramid14}),
     .holds_point_regions = true},
    vtk_traits(MeshFormat::vtu, "VTU", vtu_names, vtu_encodings, vtk_kinds),
    vtk_traits(MeshFormat::vtk, "VTK", vtk_names, binary_first, vtk_kinds),
    {.format = MeshFormat::tetgen,
     .name = "TetGen",
     .extensions = tetgen_names,
     .encodings = text_only,
     .cells = curved_simplices,
     .holds_point_regions = true,
     .holds_point_data = true,
     .holds_cell_data = true,
     .cell_data_from = 3},
    {.format = MeshFormat::abaqus,
     .name = "Abaqus",
     .extensions = abaqus_names,
     .encodings = text_only,
     .cells = all_kinds & ~kind_set({CellKind::polygon, CellKind::triangle7, CellKind::pyramid13,
                                     CellKind::pyramid14}),
     .regions_are_words = true,
     .holds_point_ids = true,
     .holds_cell_ids = true,
     .cell_ids_from = 1},
    {.format = MeshFormat::nastran,
     .name = "Nastran",
     .extensions = nastran_names,
     .encodings = text_only,
     .cells = io::nastran_cells,
     .holds_point_ids = true,
     .holds_cell_ids = true,
     .cell_ids_from = 1},
    {.format = MeshFormat::unv,
     .name = "UNV",
     .extensions = unv_names,
     .encodings = text_only,
     .cells = io::unv_cells,
     .holds_region_names = true,
     .holds_point_ids = true,
     .holds_cell_ids = true,
     .cell_ids_from = 1},
    {.format = MeshFormat::ovm,
     .name = "OpenVolumeMesh",
     .extensions = ovm_names,
     .encodings = text_only,
     .cells = faces | kind_set({CellKind::edge, CellKind::tetrahedron, CellKind::hexahedron8,
                                CellKind::prism6, CellKind::pyramid5}),
     .holds_entities = true,
     .holds_point_regions = true,
     .holds_point_ids = true,
     .holds_cell_ids = true,
     .holds_point_data = true,
     .holds_cell_data = true},
    {.format = MeshFormat::ply,
     .name = "PLY",
     .extensions = ply_names,
     .encodings = binary_first,
     .cells = faces | kind_set({CellKind::edge}),
     .holds_entities = true,
     .holds_point_regions = true,
     .holds_point_ids = true,
     .holds_cell_ids = true,
     .holds_point_data = true,
     .holds_cell_data = true,
     .holds_number_types = true},
    {.format = MeshFormat::off,
     .name = "OFF",
     .extensions = off_names,
     .encodings = text_only,
     .cells = faces,
     .holds_regions = false},
    {.format = MeshFormat::obj,
     .name = "OBJ",
     .extensions = obj_names,
     .encodings = text_only,
     .cells = faces | kind_set({CellKind::vertex, CellKind::edge}),
     .regions_are_words = true},
    {.format = MeshFormat::stl,
     .name = "STL",
     .extensions = stl_names,
     .encodings = binary_first,
     .cells = kind_set({CellKind::triangle}),
     .regions_are_words = true},
    vtk_traits(MeshFormat::vtp, "VTP", vtp_names, vtu_encodings,
               faces | kind_set({CellKind::vertex, CellKind::edge})),
};

using io::FileSource;

/// In the order of `traits`.
constexpr io::FormatCode codes[] = {
    {&io::is_msh, [](const FileSource& source) { return io::read_msh(source.text); }},
    {&io::is_medit, [](const FileSource& source) { return io::read_medit(source.text); }},
    {&io::is_vtu, [](const FileSource& source) { return io::read_vtu(source.text); }},
    {&io::is_vtk, [](const FileSource& source) { return io::read_vtk(source.text); }},
    {&io::is_tetgen, &io::read_tetgen},
    {&io::is_abaqus, &io::read_abaqus},
    {&io::is_nastran, &io::read_nastran},
    {&io::is_unv, [](const FileSource& source) { return io::read_unv(source.text); }},
    {&io::is_ovm, [](const FileSource& source) { return io::read_ovm(source.text); }},
    {&io::is_ply, [](const FileSource& source) { return io::read_ply(source.text); }},
    {&io::is_off, [](const FileSource& source) { return io::read_off(source.text); }},
    {&io::is_obj, [](const FileSource& source) { return io::read_obj(source.text); }},
    {&io::is_stl, [](const FileSource& source) { return io::read_stl(source.text); }},
    {&io::is_vtp, [](const FileSource& source) { return io::read_vtu(source.text); }},
};
static_assert(std::size(codes) == std::size(traits));

std::string lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

/// The ending in lower case, that before .gz.
std::string lower_extension(const std::filesystem::path& name) {
  const std::string extension = lower(name.extension().string());
  return extension == ".gz" ? lower(name.stem().extension().string()) : extension;
}

}  // namespace

std::span<const FormatTraits> format_traits() { return traits; }

const FormatTraits& traits_of(MeshFormat format) {
  return *std::ranges::find(traits, format, &FormatTraits::format);
}

const io::FormatCode& io::code_of(MeshFormat format) {
  return codes[&traits_of(format) - std::begin(traits)];
}

std::optional<MeshFormat> format_of_content(std::string_view bytes) {
  if (bytes.starts_with(io::byte_order_mark)) bytes.remove_prefix(io::byte_order_mark.size());
  for (const FormatTraits& t : traits) {
    if (io::code_of(t.format).is_like(bytes)) return t.format;
  }
  return std::nullopt;
}

std::optional<MeshFormat> format_of_name(const std::filesystem::path& name) {
  const std::string extension = lower_extension(name);
  for (const FormatTraits& t : traits) {
    if (std::ranges::find(t.extensions, extension) != t.extensions.end()) return t.format;
  }
  return std::nullopt;
}

bool is_binary_name(const std::filesystem::path& name) {
  const std::string extension = lower_extension(name);
  return !extension.empty() &&
         std::ranges::find(traits, extension, &FormatTraits::binary_extension) != std::end(traits);
}

std::optional<std::string> io::other_text(const FileSource& source, const std::string& name) {
  Result<std::string> bytes = source.other_file(name);
  if (!bytes) {
    Finding& reason = bytes.findings.at(0);
    if (reason.code == "missing_file") return std::nullopt;
    reason.file = name;
    throw ReadFailure{std::move(reason)};
  }
  if (bytes->starts_with(byte_order_mark)) bytes->erase(0, byte_order_mark.size());
  return std::move(*bytes);
}

void io::in_file(Draft& draft, const std::string& name, std::string_view text,
                 const std::function<void()>& work) {
  const std::string_view text_before = std::exchange(draft.text, text);
  const std::string file_before = std::exchange(draft.file, name);
  try {
    work();
  } catch (ReadFailure& failure) {
    if (failure.finding.file.empty()) failure.finding.file = name;
    throw;
  }
  draft.text = text_before;
  draft.file = file_before;
}

Result<FileMesh> io::read_format(MeshFormat format, const FileSource& source,
                                 const ReadOptions& options) {
  try {
    return finish(code_of(format).read(source), options);
  } catch (ReadFailure& failure) {
    // Lines mean nothing in raw data; those of VTU are those of its tags.
    const bool has_lines = format == MeshFormat::vtu || format == MeshFormat::vtp ||
                           !failure.finding.file.empty() ||
                           source.text.find('\0') == std::string_view::npos;
    if (!has_lines) {
      failure.finding.line = 0;
      failure.finding.text += fmt::format(" (at byte {})", failure.at);
    }
    return std::move(failure.finding);
  }
}

}  // namespace sunder
