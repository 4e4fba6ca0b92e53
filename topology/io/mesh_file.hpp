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

/// Encoding of the numbers in a file: digits, raw bytes, or bytes in base64.
enum class Encoding { text, binary, base64 };

/// Reads a mesh file. The content decides the format. Packed files (gzip) are unpacked. Formats:
/// Gmsh MSH 1, 2.x, 4.0, 4.1 (text and binary), MEDIT (text and binary), VTU (text, base64, raw;
/// plain or zlib; both byte orders), legacy VTK 1.0 to 5.1 (text and binary), TetGen, Abaqus,
/// Nastran's bulk data, universal files (UNV). Formats of surfaces have no volume cells: PLY (text,
/// binary of both orders), OFF (text and binary), OBJ, STL (text and binary), VTP. Other contents
/// are left out with a warning (skipped_data; a note with `simplices`). The name decides the format
/// of files that hold only numbers. Names of regions that the format cannot hold are read from
/// `NAME.regions` in the same folder, if that file exists (see write_file_mesh). In the value every
/// tetrahedron has four different rows below the number of points, coordinates are finite, and
/// columns are as long as their lists. Orientation, flatness and gluing are not checked: see
/// build_map. Regions: MSH's physical groups, MEDIT's references (unless all are 0), VTU's cell
/// array `region`, `gmsh:physical`, `medit:ref`, `CellEntityIds` or `cell_tags`, the first that
/// exists. Cells of unknown kinds are left out with a warning (skipped_cells, unsupported_cells; an
/// error if the file has only such volume cells). Cells of order 3 and above are read by their
/// corners (corners_only). Errors, with file and line (byte in raw data): cannot_open, empty_file,
/// bad_gzip, unknown_format, unknown_version, truncated_file, bad_number, number_out_of_range,
/// count_too_big, wrong_count, wrong_section_order, missing_section, unknown_section, bad_name,
/// unsupported_cells, unknown_cell_type, index_out_of_range, repeated_vertex, nan_coordinate,
/// duplicate_id, bad_xml, bad_attribute, missing_array, bad_offsets, bad_base64, bad_zlib,
/// unsupported_compressor. No count is trusted beyond the size of the file. Cost: O(file). The file
/// is held in memory once.
Result<FileMesh> read_file_mesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for a file's bytes already in memory; `name` stands in the findings.
Result<FileMesh> read_file_mesh(std::string_view bytes, std::string_view name,
                                const ReadOptions& options = {});

/// Reduces a mesh that was read whole to the result of reading with `simplices`.
Result<FileMesh> only_simplices(Result<FileMesh>&& mesh, std::string_view name);

/// Reads the tetrahedra of a mesh file and leaves out other cells with a note. Errors: those of
/// read_file_mesh, no_tetrahedron.
Result<TetMesh> read_mesh(const std::filesystem::path& path);
Result<TetMesh> read_mesh(std::string_view bytes, std::string_view name);

/// Reads one number per point of a mesh file, in the order of `read_mesh`: the scalar point data of
/// that name, the last one if there are several. Points without a number (MSH) have NaN. Errors:
/// those of read_file_mesh, no_such_field, not_a_scalar. Cost: that of reading the mesh.
Result<std::vector<double>> read_point_field(const std::filesystem::path& path,
                                             std::string_view field);
Result<std::vector<double>> read_point_field(std::string_view bytes, std::string_view name,
                                             std::string_view field);

struct WriteOptions {
  /// The format; the one of the name's ending if empty.
  std::optional<MeshFormat> format;
  /// One of the format's `versions`; the usual one if empty.
  std::string version;
  /// One of the format's `encodings`; if empty, the one of the name's ending, else the usual one.
  std::optional<Encoding> encoding;
  /// Packs arrays by zlib in formats that allow it.
  bool pack = false;
};

/// Lists as warnings the data that writing `mesh` would leave out or change; empty without a loss.
/// Names of regions are never lost, because they go to a second file. Requires: options with a
/// format, and a version and an encoding of that format.
std::vector<Finding> lost_on_writing(const FileMesh& mesh, const WriteOptions& options);

/// Writes `mesh`. Doubles in text have their shortest form that reads back to the same bits; VTU
/// has raw appended data. Names of regions that the format cannot hold are written to
/// `PATH.regions` with a note, one line each: dimension, region, name in quotes. Requires: columns
/// that are empty or as long as their lists. Each file is complete, or the earlier file stays:
/// files are written under another name and renamed. Errors: unknown_format, unknown_version (also
/// an encoding that the format does not have), cannot_write. The result also has the warnings of
/// lost_on_writing.
std::vector<Finding> write_file_mesh(const std::filesystem::path& path, const FileMesh& mesh,
                                     const WriteOptions& options = {});

/// The same for tetrahedra alone.
std::vector<Finding> write_mesh(const std::filesystem::path& path, const TetMesh& mesh);

}  // namespace sunder
