// SPDX-License-Identifier: MIT
// The way from the bytes of a file to a mesh.
#include "topology/io/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "topology/base/counted.hpp"
#include "topology/io/files/gzip.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/io/formats.hpp"
#include "topology/io/tetgen/tetgen.hpp"
#include "topology/io/text/read_bytes.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder {
namespace {

/// Beginnings of common files that are not read, and the remedy for each.
struct Stranger {
  std::string_view magic;
  std::string_view name;
  std::string_view remedy;
};
using namespace std::string_view_literals;
constexpr Stranger strangers[] = {
    {"\x89HDF"sv, "an HDF5 file", "convert it: meshio convert FILE NEW.vtu"},
    {"CDF\x01"sv, "a NetCDF (Exodus) file", "convert it: meshio convert FILE NEW.vtu"},
    {"OVMB"sv, "a binary OpenVolumeMesh file", "write it as text, with the ending .ovm"},
    {"PK\x03\x04"sv, "a zip archive", "unpack it first"},
};

Finding unknown_content(std::string_view bytes, const std::filesystem::path& name) {
  const std::filesystem::path ending = name.extension();
  if (io::is_numbers(bytes) && (ending == ".poly" || ending == ".smesh")) {
    return {.code = "unknown_format",
            .text = "this is what TetGen fills with tetrahedra, not a mesh of them",
            .remedy = "run tetgen -p on it, and give the .node file that it writes"};
  }
  for (const Stranger& s : strangers) {
    if (bytes.substr(0, s.magic.size()) != s.magic) continue;
    return {.code = "unknown_format",
            .text = fmt::format("this is {}, which is not read", s.name),
            .remedy = std::string(s.remedy)};
  }
  // Its bytes are not shown: whoever names files to a program learns nothing of those that are no
  // meshes.
  return {.code = "unknown_format",
          .text =
              "the file begins like none that is read: MSH begins with $MeshFormat, MEDIT with "
              "MeshVersionFormatted, VTU with <VTKFile, VTK with # vtk DataFile, Abaqus with *, "
              "OpenVolumeMesh with OVM, PLY with ply, OFF with OFF, STL with solid, OBJ with v",
          .remedy = "give a tetrahedral mesh in one of these formats"};
}

void note_misleading_name(MeshFormat format, const std::filesystem::path& name,
                          std::vector<Finding>& findings) {
  const auto by_name = format_of_name(name);
  if (!by_name || *by_name == format) return;
  findings.push_back({.code = "misleading_name",
                      .severity = Severity::note,
                      .text = fmt::format("the name says {}, the content is {}",
                                          traits_of(*by_name).name, traits_of(format).name),
                      .remedy = fmt::format("name it *{}", traits_of(format).extensions[0])});
}

/// Files of numbers alone, and binary STL of a wrong size, are known by their names.
std::optional<MeshFormat> format_without_mark(std::string_view bytes,
                                              const std::filesystem::path& name) {
  const auto by_name = format_of_name(name);
  const bool is_raw = bytes.find('\0') != std::string_view::npos;
  if (by_name == MeshFormat::stl && is_raw) return by_name;
  const bool is_of_numbers = by_name == MeshFormat::tetgen || by_name == MeshFormat::off;
  return is_of_numbers && io::is_numbers(bytes) ? by_name : std::nullopt;
}

Finding empty_file(std::string_view bytes) {
  return {.code = "empty_file",
          .text = fmt::format("the file is empty ({} bytes)", bytes.size()),
          .remedy = "write it again"};
}

}  // namespace

namespace io {

ReadBytes read_bytes(FileSource source, const std::filesystem::path& path,
                     const ReadOptions& options) {
  ReadBytes read;
  Result<FileMesh>& result = read.mesh;  // clang 14 captures no structured bindings
  std::optional<MeshFormat>& format = read.format;
  std::string whole;
  guarded(result.findings, [&] {
    if (is_gzip(source.text)) source.text = whole = unpacked(source.text);
    if (source.text.starts_with(byte_order_mark)) source.text.remove_prefix(3);
    format = format_of_content(source.text);
    if (!format) format = format_without_mark(source.text, path);
    if (source.text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
      result.findings.push_back(empty_file(source.text));
    } else if (!format) {
      result.findings.push_back(unknown_content(source.text, path));
    } else {
      result = read_format(*format, source, options);
      note_misleading_name(*format, path, result.findings);
    }
  });
  for (Finding& finding : result.findings) {
    finding.file =
        finding.file.empty() ? path.string() : (path.parent_path() / finding.file).string();
  }
  return read;
}

}  // namespace io

Result<FileMesh> read_file_mesh(std::string_view bytes, std::string_view name,
                                const ReadOptions& options) {
  const auto no_file = [](const std::string& other) -> Result<std::string> {
    return Finding{.code = "missing_file",
                   .text = fmt::format("{} is needed beside it, but only bytes were given",
                                       io::in_quotes(other)),
                   .remedy = "read the mesh from its folder"};
  };
  return io::read_bytes({bytes, std::string(name), no_file}, name, options).mesh;
}

Result<FileMesh> only_simplices(Result<FileMesh>&& mesh, std::string_view name) {
  if (!mesh) return std::move(mesh);
  io::Draft draft;
  draft.mesh = std::move(*mesh);
  draft.findings = std::move(mesh.findings);
  // A body without its polyhedra is not the body.
  for (Finding& finding : draft.findings) {
    if (finding.code == "unsupported_cells") finding.severity = Severity::error;
  }
  Result<FileMesh> result = io::finish(std::move(draft), {.simplices = true});
  for (Finding& finding : result.findings) {
    if (finding.file.empty()) finding.file = std::string(name);
  }
  return result;
}

namespace {

/// "108 triangles, 12 edges" of the cells below dimension 3; empty where there are none.
std::string lower_cells(const FileMesh& mesh) {
  constexpr std::string_view names[] = {"vertices", "edges", "triangles"};
  std::string text;
  for_each_cell_list(mesh, [&](const auto& cells, int dimension) {
    if (dimension == 3 || cells.corners.empty()) return;
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : ", ", cells.corners.size(), names[dimension]);
  });
  return text;
}

}  // namespace

Result<TetMesh> io::tetrahedra_of(Result<FileMesh>&& file, std::string_view name) {
  Result<TetMesh> result;
  result.findings = std::move(file.findings);
  if (!file) return result;
  const std::string others = lower_cells(*file);
  if (file->tetrahedra.corners.empty()) {
    result.findings.insert(
        result.findings.begin(),
        {.code = "no_tetrahedron",
         .text = fmt::format("the file has {} but no tetrahedron",
                             counted(file->points.size(), "point")),
         .remedy = "give a volume mesh of tetrahedra. TetGen (Debian: tetgen) fills a closed "
                   "surface: sunder convert FILE surface.off && tetgen -pq surface.off writes "
                   "surface.1.ele, a mesh for sunder",
         .file = std::string(name)});
  }
  if (!others.empty()) {
    const auto first_note = std::ranges::find(result.findings, Severity::note, &Finding::severity);
    result.findings.insert(first_note,
                           {.code = "skipped_cells",
                            .severity = Severity::note,
                            .count = cell_count(*file) - file->tetrahedra.corners.size(),
                            .text = fmt::format("{} are left out", others),
                            .remedy = "nothing to do: only tetrahedra are used",
                            .file = std::string(name)});
  }
  if (!has_error(result.findings)) {
    result.value = tet_mesh_of(std::move(*file));
  }
  return result;
}

Result<TetMesh> read_mesh(std::string_view bytes, std::string_view name) {
  return io::tetrahedra_of(read_file_mesh(bytes, name, {.simplices = true}), name);
}

Result<std::vector<double>> io::point_field_of(Result<FileMesh>&& mesh, std::string_view name,
                                               std::string_view field) {
  Result<std::vector<double>> result;
  result.findings = std::move(mesh.findings);
  if (!mesh) return result;
  const auto refuse = [&](std::string_view code, std::string text, std::string remedy) {
    result.findings.insert(result.findings.begin(), {.code = std::string(code),
                                                     .text = std::move(text),
                                                     .remedy = std::move(remedy),
                                                     .file = std::string(name)});
    return std::move(result);
  };
  DataColumn* column = nullptr;
  std::string known;
  for (DataColumn& c : mesh->point_data) {
    if (c.name == field) column = &c;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", c.name);
  }
  if (column == nullptr) {
    return refuse("no_such_field",
                  fmt::format("the file has no point field {}", io::in_quotes(field)),
                  known.empty() ? "it has no point fields at all: paint one"
                                : fmt::format("it has {}", known));
  }
  if (column->components != 1) {
    return refuse("not_a_scalar",
                  fmt::format("the point field {} has {} components", io::in_quotes(field),
                              column->components),
                  "name a field with one number a point");
  }
  result.value = std::visit(
      [](const auto& values) { return std::vector<double>(values.begin(), values.end()); },
      column->values);
  return result;
}

Result<std::vector<double>> read_point_field(std::string_view bytes, std::string_view name,
                                             std::string_view field) {
  return io::point_field_of(read_file_mesh(bytes, name, {.simplices = true}), name, field);
}

}  // namespace sunder
