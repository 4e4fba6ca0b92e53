// SPDX-License-Identifier: MIT
// Mesh files in and out: which formats there are, what each can carry, and how to read and write.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "topology/finding.hpp"
#include "topology/tet_mesh.hpp"

namespace sunder {

enum class MeshFormat { msh, medit, vtu };

/// What a format can hold of a TetMesh, beside points and tetrahedra, and what we do with it.
struct FormatTraits {
  MeshFormat format;
  /// As messages name it.
  std::string_view name;
  /// The usual ending of a file's name, with its dot.
  std::string_view extension;
  bool is_read;
  bool is_written;
  bool holds_regions;
  bool holds_region_names;
  bool holds_source_ids;
};

/// Every format, one row each.
std::span<const FormatTraits> format_traits();

/// The row of one format.
const FormatTraits& traits_of(MeshFormat format);

/// The format that `bytes` begin like, whatever the file is called; none when no format does.
std::optional<MeshFormat> format_of_content(std::string_view bytes);

/// The format usual for a name's ending (.msh, .mesh, .vtu; upper case too); none for others.
std::optional<MeshFormat> format_of_name(const std::filesystem::path& name);

/// A mesh read from a file; its content decides the format.
/// Formats: Gmsh MSH 2.x and 4.1 (ASCII), MEDIT .mesh (ASCII), VTU (ASCII, base64, raw; plain or
/// zlib; both byte orders).
/// Leaves in the value: every tetrahedron with four different rows below the number of points, and
/// finite coordinates. Orientation, flatness and gluing are not judged: see build_map.
/// Regions: MSH's physical groups (or, without any, its volume entities when there are several),
/// MEDIT's references (unless all are 0), VTU's cell array `region`, `gmsh:physical`, `medit:ref`,
/// `CellEntityIds` or `cell_tags`, the first that is there.
/// Surface, line and point cells are left out with a note; other volume cells are refused.
/// Errors, with file and line (byte or array in binary data): cannot_open, empty_file,
/// unknown_format, unknown_version, binary_not_read, truncated_file, bad_number,
/// number_out_of_range, count_too_big, wrong_count, wrong_section_order, missing_section,
/// unknown_section, bad_name, unsupported_cells, unknown_cell_type, index_out_of_range,
/// repeated_vertex, nan_coordinate, duplicate_id, no_tetrahedron, bad_xml, bad_attribute,
/// missing_array, bad_offsets, bad_base64, bad_zlib, unsupported_compressor. No count is trusted
/// beyond what the file's bytes can hold. Cost: O(file), the file is held in memory once.
Result<TetMesh> read_mesh(const std::filesystem::path& path);

/// The same for a file's bytes already in memory; `name` stands in the findings.
Result<TetMesh> read_mesh(std::string_view bytes, std::string_view name);

/// What writing `mesh` in `format` would leave out or change: warnings, empty when nothing.
std::vector<Finding> lost_on_writing(const TetMesh& mesh, MeshFormat format);

/// Writes `mesh` in the format that the name's ending says: .msh is MSH 4.1 ASCII with doubles in
/// their shortest exact form, .vtu is VTU with raw appended data.
/// Needs: `region`, `source_point_id` and `source_tetrahedron_id` empty or as long as their rows.
/// Leaves: the whole new file, or what was there before; it is written beside and renamed.
/// Errors: unknown_format, cannot_write; the warnings of lost_on_writing stand beside them.
std::vector<Finding> write_mesh(const std::filesystem::path& path, const TetMesh& mesh);

}  // namespace sunder
