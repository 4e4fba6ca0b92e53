// SPDX-License-Identifier: MIT
// Which format a file has, and the way into it.
#include "topology/io/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <string>
#include <system_error>

#include "topology/io/gzip.hpp"
#include "topology/io/medit.hpp"
#include "topology/io/msh.hpp"
#include "topology/io/region_names.hpp"
#include "topology/io/scan.hpp"
#include "topology/io/vtk.hpp"
#include "topology/io/vtu_read.hpp"

namespace sunder {
namespace {

constexpr std::string_view msh_versions[] = {"4.1", "4.0", "2.2", "1"};
constexpr std::string_view vtk_versions[] = {"4.2", "5.1"};

/// VTK's formats hold all but names; only the legacy one is written as text too.
constexpr FormatTraits vtk_traits(MeshFormat format, std::string_view name,
                                  std::string_view extension,
                                  std::span<const std::string_view> versions) {
  return {.format = format,
          .name = name,
          .extension = extension,
          .binary_extension = {},
          .versions = versions,
          .writes_text = format == MeshFormat::vtk,
          .writes_binary = true,
          .usually_binary = true,
          .holds_cells = {true, true, true, true},
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
     .extension = ".msh",
     .binary_extension = {},
     .versions = msh_versions,
     .writes_binary = true,
     .holds_cells = {true, true, true, true},
     .holds_region_names = true,
     .holds_entities = true,
     .holds_point_ids = true,
     .holds_cell_ids = true,
     .holds_point_data = true,
     .holds_cell_data = true},
    {.format = MeshFormat::medit,
     .name = "MEDIT",
     .extension = ".mesh",
     .binary_extension = ".meshb",
     .versions = {},
     .writes_binary = true,
     .holds_cells = {false, true, true, true},
     .holds_point_regions = true},
    vtk_traits(MeshFormat::vtu, "VTU", ".vtu", {}),
    vtk_traits(MeshFormat::vtk, "VTK", ".vtk", vtk_versions),
};

/// Beginnings of files that are often met and not read, and what to do with them.
struct Stranger {
  std::string_view magic;
  std::string_view name;
  std::string_view remedy;
};
using namespace std::string_view_literals;
constexpr Stranger strangers[] = {
    {"\x89HDF"sv, "an HDF5 file", "convert it: meshio convert FILE NEW.vtu"},
    {"CDF\x01"sv, "a NetCDF (Exodus) file", "convert it: meshio convert FILE NEW.vtu"},
    {"PK\x03\x04"sv, "a zip archive", "unpack it first"},
    {"solid"sv, "an STL surface", "fill it with tetrahedra first"},
    {"ply"sv, "a PLY file", "fill the surface with tetrahedra first"},
    {"OFF"sv, "an OFF surface", "fill it with tetrahedra first"},
};

Finding unknown_content(std::string_view bytes) {
  for (const Stranger& s : strangers) {
    if (bytes.substr(0, s.magic.size()) != s.magic) continue;
    return {.code = "unknown_format",
            .text = fmt::format("this is {}: MSH, MEDIT, VTU and VTK are read", s.name),
            .remedy = std::string(s.remedy)};
  }
  return {.code = "unknown_format",
          .text = fmt::format("the file begins with {}: MSH begins with $MeshFormat, MEDIT with "
                              "MeshVersionFormatted, VTU with <VTKFile, VTK with # vtk DataFile",
                              io::in_quotes(bytes.substr(0, 24))),
          .remedy = "give a tetrahedral mesh in one of these formats"};
}

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

io::Draft read_as(MeshFormat format, std::string_view text) {
  switch (format) {
    case MeshFormat::msh:
      return io::read_msh(text);
    case MeshFormat::medit:
      return io::read_medit(text);
    case MeshFormat::vtu:
      return io::read_vtu(text);
    case MeshFormat::vtk:
      return io::read_vtk(text);
  }
  return {};
}

void note_misleading_name(MeshFormat format, std::string_view name,
                          std::vector<Finding>& findings) {
  const auto by_name = format_of_name(name);
  if (!by_name || *by_name == format) return;
  findings.push_back({.code = "misleading_name",
                      .severity = Severity::note,
                      .text = fmt::format("the name says {}, the content is {}",
                                          traits_of(*by_name).name, traits_of(format).name),
                      .remedy = fmt::format("name it *{}", traits_of(format).extension)});
}

/// The file's bytes, or the system's reason why there are none.
Result<std::string> bytes_of(const std::filesystem::path& path) {
  const auto refused = [&](int error) {
    return Finding{
        .code = "cannot_open",
        .text = fmt::format("the file cannot be read: {}", std::generic_category().message(error)),
        .remedy = "check the name and the permissions",
        .file = path.string()};
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) return refused(errno);
  std::string bytes;
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  // One byte more than the file has, so that the first read already meets its end.
  std::size_t filled = 0;
  bytes.resize(unknown ? 1 << 16 : size + 1);
  while (const std::size_t n = std::fread(&bytes[filled], 1, bytes.size() - filled, file.get())) {
    filled += n;
    if (filled == bytes.size()) bytes.resize(2 * filled);
  }
  if (std::ferror(file.get())) return refused(errno);
  bytes.resize(filled);
  return bytes;
}

Finding empty_file(std::string_view bytes) {
  return {.code = "empty_file",
          .text = fmt::format("the file is empty ({} bytes)", bytes.size()),
          .remedy = "write it again"};
}

/// Takes what a ReadFailure ends into the findings.
template <class Work>
void guarded(std::vector<Finding>& findings, Work work) {
  try {
    work();
  } catch (io::ReadFailure& failure) {
    findings.push_back(std::move(failure.finding));
  }
}

/// Names in the file beside, where the mesh's own format holds none and there is such a file.
void take_names_beside(const std::filesystem::path& path, Result<FileMesh>& result) {
  std::error_code unknown;
  const std::filesystem::path beside = io::names_beside(path);
  for (const auto& names : result->region_name) {
    if (!names.empty()) return;
  }
  if (!std::filesystem::is_regular_file(beside, unknown)) return;
  const Result<std::string> text = bytes_of(beside);
  std::vector<Finding> findings = text.findings;
  if (text) guarded(findings, [&] { io::read_region_names(*text, *result); });
  for (Finding& f : findings) f.file = beside.string();
  if (has_error(findings)) result.value.reset();
  result.findings.insert(result.findings.begin(), findings.begin(), findings.end());
}

}  // namespace

std::span<const FormatTraits> format_traits() { return traits; }

const FormatTraits& traits_of(MeshFormat format) {
  return *std::find_if(std::begin(traits), std::end(traits),
                       [&](const FormatTraits& t) { return t.format == format; });
}

std::optional<MeshFormat> format_of_content(std::string_view bytes) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (bytes.substr(0, 3) == byte_order_mark) bytes.remove_prefix(3);
  if (io::is_binary_medit(bytes)) return MeshFormat::medit;
  io::Scanner s{bytes};
  while (io::peek_word(s).substr(0, 1) == "#") {
    if (io::rest_of_line(s).substr(0, 14) == "# vtk DataFile") return MeshFormat::vtk;
  }
  const std::string_view word = io::peek_word(s);
  if (word.substr(0, 1) == "$") return MeshFormat::msh;
  if (word == "MeshVersionFormatted") return MeshFormat::medit;
  if (word.substr(0, 5) == "<?xml" || word.substr(0, 8) == "<VTKFile") return MeshFormat::vtu;
  return std::nullopt;
}

std::optional<MeshFormat> format_of_name(const std::filesystem::path& name) {
  const std::string extension = lower_extension(name);
  for (const FormatTraits& t : traits) {
    if (extension == t.extension || (!extension.empty() && extension == t.binary_extension)) {
      return t.format;
    }
  }
  return std::nullopt;
}

bool is_binary_name(const std::filesystem::path& name) {
  const std::string extension = lower_extension(name);
  return !extension.empty() && std::ranges::any_of(traits, [&](const FormatTraits& t) {
    return t.binary_extension == extension;
  });
}

Result<FileMesh> read_file_mesh(std::string_view bytes, std::string_view name,
                                const ReadOptions& options) {
  Result<FileMesh> result;
  std::string whole;
  guarded(result.findings, [&] {
    if (io::is_gzip(bytes)) bytes = whole = io::unpacked(bytes);
    if (bytes.substr(0, 3) == "\xef\xbb\xbf") bytes.remove_prefix(3);
    const auto format = format_of_content(bytes);
    if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) {
      result.findings.push_back(empty_file(bytes));
    } else if (!format) {
      result.findings.push_back(unknown_content(bytes));
    } else {
      try {
        result = io::finish(read_as(*format, bytes), options.tetrahedra_only);
      } catch (io::ReadFailure& failure) {
        // Lines mean nothing in raw data; those of VTU are those of its tags.
        const bool has_lines =
            *format == MeshFormat::vtu || bytes.find('\0') == std::string_view::npos;
        if (!has_lines) {
          failure.finding.line = 0;
          failure.finding.text += fmt::format(" (at byte {})", failure.at);
        }
        result.findings.push_back(std::move(failure.finding));
      }
      note_misleading_name(*format, name, result.findings);
    }
  });
  for (Finding& finding : result.findings) finding.file = name;
  return result;
}

Result<FileMesh> read_file_mesh(const std::filesystem::path& path, const ReadOptions& options) {
  Result<FileMesh> result;
  {
    const Result<std::string> bytes = bytes_of(path);
    if (!bytes) {
      result.findings = bytes.findings;
      return result;
    }
    result = read_file_mesh(*bytes, path.string(), options);
  }
  if (result) take_names_beside(path, result);
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

Result<TetMesh> tetrahedra_of(Result<FileMesh>&& file, std::string_view name) {
  Result<TetMesh> result;
  result.findings = std::move(file.findings);
  if (!file) return result;
  const std::string others = lower_cells(*file);
  if (file->tetrahedra.corners.empty()) {
    result.findings.insert(
        result.findings.begin(),
        {.code = "no_tetrahedron",
         .text = fmt::format("the file has {} points but no tetrahedron", file->points.size()),
         .remedy = others.empty() ? "give a volume mesh of tetrahedra"
                                  : "the file holds a surface: fill it with tetrahedra first (a "
                                    "mesher such as sunder-mesh or gmsh -3 does)",
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

}  // namespace

Result<TetMesh> read_mesh(std::string_view bytes, std::string_view name) {
  return tetrahedra_of(read_file_mesh(bytes, name), name);
}

Result<TetMesh> read_mesh(const std::filesystem::path& path) {
  return tetrahedra_of(read_file_mesh(path), path.string());
}

Result<std::vector<double>> read_point_field(const std::filesystem::path& path,
                                             std::string_view field) {
  Result<FileMesh> mesh = read_file_mesh(path);
  Result<std::vector<double>> result;
  result.findings = std::move(mesh.findings);
  if (!mesh) return result;
  const auto refuse = [&](std::string_view code, std::string text, std::string remedy) {
    result.findings.insert(result.findings.begin(), {.code = std::string(code),
                                                     .text = std::move(text),
                                                     .remedy = std::move(remedy),
                                                     .file = path.string()});
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

}  // namespace sunder
