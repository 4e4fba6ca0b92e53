// SPDX-License-Identifier: MIT
// Meshes by their paths, with the files that lie next to them.
#include <algorithm>
#include <system_error>

#include "topology/io/files/input_file.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/io/regions/named_regions.hpp"
#include "topology/io/regions/region_names.hpp"
#include "topology/io/text/read_bytes.hpp"

namespace sunder {
namespace {

/// Names in the separate file, where the mesh's own format holds none or only words, and there is
/// such a file.
void take_names_beside(const std::filesystem::path& path, MeshFormat format,
                       Result<FileMesh>& result) {
  std::error_code unknown;
  const std::filesystem::path beside = io::names_beside(path, format);
  const bool has_words = traits_of(format).regions_are_words;
  if (name_count(*result) > 0 && !has_words) return;
  if (!std::filesystem::is_regular_file(beside, unknown)) return;
  const Result<std::string> text = io::bytes_beside(path.parent_path(), beside.filename().string());
  std::vector<Finding> findings = text.findings;
  if (text) {
    io::guarded(findings, [&] {
      const io::RegionNames names = io::read_region_names(*text);
      has_words ? io::match_names(*result, names) : void(result->region_name = names);
    });
  }
  for (Finding& f : findings) f.file = beside.string();
  if (has_error(findings)) result.value.reset();
  result.findings.insert(result.findings.begin(), findings.begin(), findings.end());
}

}  // namespace

Result<FileMesh> read_file_mesh(const std::filesystem::path& path, const ReadOptions& options) {
  io::ReadBytes read;
  auto& [result, format] = read;
  {
    const Result<std::string> bytes = io::bytes_of_file(path);
    if (!bytes) {
      result.findings = bytes.findings;
      return result;
    }
    const auto other_file = [&](const std::string& name) {
      return io::bytes_beside(path.parent_path(), name);
    };
    read = io::read_bytes({*bytes, path.filename().string(), other_file}, path, options);
  }
  if (result) take_names_beside(path, *format, result);
  return std::move(result);
}

Result<TetMesh> read_mesh(const std::filesystem::path& path) {
  return io::tetrahedra_of(read_file_mesh(path, {.simplices = true}), path.string());
}

Result<std::vector<double>> read_point_field(const std::filesystem::path& path,
                                             std::string_view field) {
  return io::point_field_of(read_file_mesh(path, {.simplices = true}), path.string(), field);
}

}  // namespace sunder
