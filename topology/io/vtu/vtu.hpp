// SPDX-License-Identifier: MIT
// VTU frames with columns of data, and the PVD list that gives each frame its time (VTK XML).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// A column of data of a mesh: `components` numbers per row, row after row. The numbers are not
/// copied and must live until the file is written.
struct NamedColumn {
  std::string_view name;
  std::variant<std::span<const double>, std::span<const float>, std::span<const std::int32_t>,
               std::span<const std::uint32_t>, std::span<const std::int64_t>,
               std::span<const std::uint8_t>>
      values;
  /// 1 for a scalar, 3 for a vector, 9 for a tensor (row by row).
  std::size_t components = 1;
};

/// A column of 3-vectors, three doubles per row without gaps (Point, Eigen::Vector3d).
template <class Vector3>
requires(sizeof(Vector3) == 3 * sizeof(double)) NamedColumn
    vector_column(std::string_view name, const std::vector<Vector3>& rows) {
  return {name, std::span(reinterpret_cast<const double*>(rows.data()), 3 * rows.size()), 3};
}

/// Writes `mesh` with its columns as one VTU file: version 1.0, raw appended data, 64-bit headers.
/// `point_data`: one row per point. `cell_data`: one row per tetrahedron. The mesh's own region and
/// source ids become the arrays `region`, `source_tetrahedron_id` and `source_point_id`, unless a
/// column of that name is given. Requires: at most 2^29 - 1 tetrahedra (offsets are 32-bit). After
/// an error an older file stays as it was. Errors: cannot_write; bad_column, for a column of the
/// wrong length. Cost: one pass of the system's `write` over the columns, and 5 bytes of memory per
/// tetrahedron.
std::vector<Finding> write_vtu(const std::filesystem::path& path, const TetMesh& mesh,
                               std::span<const NamedColumn> point_data = {},
                               std::span<const NamedColumn> cell_data = {});

/// One frame of a series.
struct PvdFrame {
  /// Time of the frame, s.
  double time;
  /// The frame's file, relative to the PVD file.
  std::string file;
};

/// Writes the PVD list of `frames`, in their order; viewers open it as one animation. After an
/// error an older file stays as it was. Errors: cannot_write.
std::vector<Finding> write_pvd(const std::filesystem::path& path, std::span<const PvdFrame> frames);

}  // namespace sunder
