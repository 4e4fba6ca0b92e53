// SPDX-License-Identifier: MIT
// Which format a file has, and the way into and out of it.
#include "topology/io/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <string>
#include <system_error>

#include "topology/io/medit.hpp"
#include "topology/io/msh.hpp"
#include "topology/io/scan.hpp"
#include "topology/io/vtu.hpp"
#include "topology/io/vtu_read.hpp"

namespace sunder {
namespace {

constexpr FormatTraits traits[] = {
    {.format = MeshFormat::msh,
     .name = "Gmsh MSH",
     .extension = ".msh",
     .is_read = true,
     .is_written = true,
     .holds_regions = true,
     .holds_region_names = true,
     .holds_source_ids = true},
    {.format = MeshFormat::medit,
     .name = "MEDIT",
     .extension = ".mesh",
     .is_read = true,
     .is_written = false,
     .holds_regions = true,
     .holds_region_names = false,
     .holds_source_ids = false},
    {.format = MeshFormat::vtu,
     .name = "VTU",
     .extension = ".vtu",
     .is_read = true,
     .is_written = true,
     .holds_regions = true,
     .holds_region_names = false,
     .holds_source_ids = true},
};

/// Beginnings of files that are often met and not read, and what to do with them.
struct Stranger {
  std::string_view magic;
  std::string_view name;
  std::string_view remedy;
};
using namespace std::string_view_literals;
constexpr Stranger strangers[] = {
    {"# vtk DataFile"sv, "a legacy VTK file", "save it as .vtu"},
    {"\x89HDF"sv, "an HDF5 file", "convert it: meshio convert FILE NEW.vtu"},
    {"CDF\x01"sv, "a NetCDF (Exodus) file", "convert it: meshio convert FILE NEW.vtu"},
    {"\x1f\x8b"sv, "a gzip archive", "unpack it first"},
    {"PK\x03\x04"sv, "a zip archive", "unpack it first"},
    {"\x01\0\0\0"sv, "a binary MEDIT file (.meshb)", "save it as .mesh (ASCII)"},
    {"solid"sv, "an STL surface", "fill it with tetrahedra first"},
    {"ply"sv, "a PLY file", "fill the surface with tetrahedra first"},
    {"OFF"sv, "an OFF surface", "fill it with tetrahedra first"},
};

Finding unknown_content(std::string_view bytes) {
  for (const Stranger& s : strangers) {
    if (bytes.substr(0, s.magic.size()) != s.magic) continue;
    return {.code = "unknown_format",
            .text = fmt::format("this is {}: MSH, MEDIT and VTU are read", s.name),
            .remedy = std::string(s.remedy)};
  }
  return {.code = "unknown_format",
          .text = fmt::format("the file begins with {}: MSH begins with $MeshFormat, MEDIT with "
                              "MeshVersionFormatted, VTU with <VTKFile",
                              io::in_quotes(bytes.substr(0, 24))),
          .remedy = "give a tetrahedral mesh in one of these formats"};
}

std::string lower_extension(const std::filesystem::path& name) {
  std::string extension = name.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

io::Draft read_as(MeshFormat format, std::string_view text) {
  switch (format) {
    case MeshFormat::msh:
      return io::read_msh(text);
    case MeshFormat::medit:
      return io::read_medit(text);
    case MeshFormat::vtu:
      return io::read_vtu(text);
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

}  // namespace

std::span<const FormatTraits> format_traits() { return traits; }

const FormatTraits& traits_of(MeshFormat format) {
  return *std::find_if(std::begin(traits), std::end(traits),
                       [&](const FormatTraits& t) { return t.format == format; });
}

std::optional<MeshFormat> format_of_content(std::string_view bytes) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (bytes.substr(0, 3) == byte_order_mark) bytes.remove_prefix(3);
  io::Scanner s{bytes};
  while (io::peek_word(s).substr(0, 1) == "#") {
    if (io::rest_of_line(s).substr(0, 14) == "# vtk DataFile") return std::nullopt;
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
    if (t.extension == extension) return t.format;
  }
  return std::nullopt;
}

Result<TetMesh> read_mesh(std::string_view bytes, std::string_view name) {
  Result<TetMesh> result;
  const auto format = format_of_content(bytes);
  if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    result.findings.push_back({.code = "empty_file",
                               .text = fmt::format("the file is empty ({} bytes)", bytes.size()),
                               .remedy = "write it again"});
  } else if (!format) {
    result.findings.push_back(unknown_content(bytes));
  } else {
    if (bytes.substr(0, 3) == "\xef\xbb\xbf") bytes.remove_prefix(3);
    try {
      result = io::finish(read_as(*format, bytes));
    } catch (io::ReadFailure& failure) {
      result.findings.push_back(std::move(failure.finding));
    }
    note_misleading_name(*format, name, result.findings);
  }
  for (Finding& finding : result.findings) finding.file = name;
  return result;
}

Result<TetMesh> read_mesh(const std::filesystem::path& path) {
  const Result<std::string> bytes = bytes_of(path);
  if (bytes) return read_mesh(*bytes, path.string());
  Result<TetMesh> refused;
  refused.findings = bytes.findings;
  return refused;
}

std::vector<Finding> lost_on_writing(const TetMesh& mesh, MeshFormat format) {
  const FormatTraits& t = traits_of(format);
  std::vector<Finding> lost;
  const auto lose = [&](std::string code, std::size_t count, std::string text) {
    lost.push_back({.code = std::move(code),
                    .severity = Severity::warning,
                    .count = count,
                    .text = std::move(text),
                    .remedy = fmt::format("write another format than {} to keep them", t.name)});
  };
  if (!t.holds_regions && !mesh.region.empty()) {
    lose("regions_lost", mesh.region.size(), fmt::format("{} holds no regions", t.name));
  }
  if (!t.holds_region_names && !mesh.region_name.empty()) {
    lose("region_names_lost", mesh.region_name.size(),
         fmt::format("{} holds no names of regions", t.name));
  }
  const std::size_t ids = mesh.source_point_id.size() + mesh.source_tetrahedron_id.size();
  const bool writable =
      format != MeshFormat::msh || (io::are_msh_numbers(mesh.source_point_id) &&
                                    io::are_msh_numbers(mesh.source_tetrahedron_id));
  if (ids > 0 && (!t.holds_source_ids || !writable)) {
    lose("source_ids_lost", ids,
         fmt::format("{} cannot hold these source numbers: rows are counted from 1", t.name));
  }
  const auto odd = std::count_if(mesh.region.begin(), mesh.region.end(),
                                 [](std::int32_t region) { return region < 1; });
  if (format == MeshFormat::msh && odd > 0) {
    lost.push_back({.code = "region_not_positive",
                    .severity = Severity::warning,
                    .count = static_cast<std::size_t>(odd),
                    .text =
                        "regions below 1 are written as they are; Gmsh takes 0 for no group and "
                        "a negative number for a reversed one",
                    .remedy = "number the regions from 1 up"});
  }
  return lost;
}

std::vector<Finding> write_mesh(const std::filesystem::path& path, const TetMesh& mesh) {
  const auto format = format_of_name(path);
  if (!format || !traits_of(*format).is_written) {
    return {{.code = "unknown_format",
             .text = fmt::format("files ending in '{}' are not written: .msh and .vtu are",
                                 path.extension().string()),
             .remedy = "name the file *.msh or *.vtu",
             .file = path.string()}};
  }
  std::vector<Finding> findings = lost_on_writing(mesh, *format);
  std::vector<Finding> failures =
      *format == MeshFormat::msh ? io::write_msh(path, mesh) : write_vtu(path, mesh);
  findings.insert(findings.end(), failures.begin(), failures.end());
  return findings;
}

}  // namespace sunder
