// SPDX-License-Identifier: MIT
// Mesh files in and out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"
#include "topology/io/read_options.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder {

enum class MeshFormat {
  msh,
  medit,
  vtu,
  vtk,
  tetgen,
  abaqus,
  nastran,
  unv,
  ovm,
  ply,
  off,
  obj,
  stl,
  vtp
};

/// How numbers stand in a file: as digits, as raw bytes, or as bytes written in base64.
enum class Encoding { text, binary, base64 };

/// All that a mesh file holds; its content decides the format. Packed files (gzip) are unpacked.
/// Formats: Gmsh MSH 1, 2.x, 4.0, 4.1 (text and binary), MEDIT (text and binary), VTU (text,
/// base64, raw; plain or zlib; both byte orders), legacy VTK 1.0 to 5.1 (text and binary), TetGen,
/// Abaqus, Nastran's bulk data, universal files (UNV); of surfaces, which have no volume cells, PLY
/// (text, binary of both orders), OFF (text and binary), OBJ, STL (text and binary), VTP. What else
/// stands in a file is left out with a warning (skipped_data; a note with `simplices`). Files of
/// numbers alone are known by their names. Names of regions that the format cannot hold are taken
/// from `NAME.regions` beside it, if that is there (see write_file_mesh). Leaves in the value:
/// every tetrahedron with four different rows below the number of points, finite coordinates,
/// columns as long as what they belong to. Orientation, flatness and gluing are not judged: see
/// build_map. Regions: MSH's physical groups, MEDIT's references (unless all are 0), VTU's cell
/// array `region`, `gmsh:physical`, `medit:ref`, `CellEntityIds` or `cell_tags`, the first that is
/// there. Cells of no kind of ours are left out with a warning (skipped_cells, unsupported_cells;
/// volume cells: an error where nothing else is there), those of order 3 and above read by their
/// corners (corners_only). Errors, with file and line (byte in raw data): cannot_open, empty_file,
/// bad_gzip, unknown_format, unknown_version, truncated_file, bad_number, number_out_of_range,
/// count_too_big, wrong_count, wrong_section_order, missing_section, unknown_section, bad_name,
/// unsupported_cells, unknown_cell_type, index_out_of_range, repeated_vertex, nan_coordinate,
/// duplicate_id, bad_xml, bad_attribute, missing_array, bad_offsets, bad_base64, bad_zlib,
/// unsupported_compressor. No count is trusted beyond what the file's bytes can hold. Cost:
/// O(file), the file is held in memory once.
Result<FileMesh> read_file_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for a file's bytes already in memory; `name` stands in the findings.
Result<FileMesh> read_file_mesh(std::string_view bytes, std::string_view name,
                                const ReadOptions& options = {});

/// Makes of a mesh that was read whole what reading `simplices` alone would have given.
Result<FileMesh> only_simplices(Result<FileMesh>&& mesh, std::string_view name);

/// The tetrahedra of a mesh file, to compute with: what read_file_mesh gives, other cells left out
/// with a note. Errors: also no_tetrahedron.
Result<TetMesh> read_mesh(const std::filesystem::path& path);
Result<TetMesh> read_mesh(std::string_view bytes, std::string_view name);

/// One number for each point of a mesh file, in the order of `read_mesh`: the scalar point data of
/// that name (of several the last), not-a-number where the file has none for a point (MSH).
/// Errors: those of read_file_mesh, no_such_field, not_a_scalar. Cost: that of reading the mesh.
Result<std::vector<double>> read_point_field(const std::filesystem::path& path,
                                             std::string_view field);
Result<std::vector<double>> read_point_field(std::string_view bytes, std::string_view name,
                                             std::string_view field);

struct WriteOptions {
  /// The format that the name's ending says, if none is given.
  std::optional<MeshFormat> format;
  /// One of the format's `versions`; the usual one if empty.
  std::string version;
  /// One of the format's `encodings`; if not given what the name's ending says, else the usual.
  std::optional<Encoding> encoding;
  /// Arrays are packed by zlib, in formats that know it.
  bool pack = false;
};

/// What writing `mesh` would leave out or change: warnings, empty when nothing. Names of regions
/// are not lost: they go to a file beside.
/// Needs: the options name a format, a version and an encoding that it has.
std::vector<Finding> lost_on_writing(const FileMesh& mesh, const WriteOptions& options);

/// Writes `mesh`. Doubles in text have their shortest form that reads back to the same bits; VTU
/// has raw appended data. Names of regions that the format cannot hold are written to
/// `PATH.regions` with a note, one line each: dimension, region, name in quotes. Needs: columns
/// empty or as long as what they belong to. Leaves: each file whole, or what was there before; they
/// are written beside and renamed. Errors: unknown_format, unknown_version (also an encoding that
/// the format does not have), cannot_write; the warnings of lost_on_writing stand beside them.
std::vector<Finding> write_file_mesh(const std::filesystem::path& path, const FileMesh& mesh,
                                     const WriteOptions& options = {});

/// The same for tetrahedra alone.
std::vector<Finding> write_mesh(const std::filesystem::path& path, const TetMesh& mesh);

}  // namespace sunder
