// SPDX-License-Identifier: MIT
// The way of a mesh out into a file.
#include <fmt/format.h>

#include <algorithm>

#include "topology/io/format_traits.hpp"
#include "topology/io/formats.hpp"
#include "topology/io/losses.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/io/regions/region_names.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder {
namespace {

bool holds_names(const FormatTraits& t, std::string_view version) {
  return t.holds_region_names && version != "1";
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

/// Writes the names that the format does not hold into a list next to the file. Empties the list of
/// an earlier mesh there, which would be read with the new one. A note reports it, or an error.
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

std::vector<Finding> in_file(const std::filesystem::path& path, std::vector<Finding> findings) {
  for (Finding& finding : findings) finding.file = path.string();
  return findings;
}

}  // namespace

std::vector<Finding> lost_on_writing(const FileMesh& mesh, const WriteOptions& options) {
  return io::losses_of(io::written_of(mesh, traits_of(options.format.value())), options);
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
  const std::string version = io::version_of(t, chosen);
  const io::FileEncoding how{
      version, chosen.encoding.value_or(is_binary_name(path) ? Encoding::binary : t.encodings[0]),
      chosen.pack};
  std::vector<Finding> findings;
  const bool is_plain = path.extension() != ".gz" && path != "-";
  if (!is_plain && t.format == MeshFormat::tetgen) {
    findings.push_back({.code = "unknown_format",
                        .text =
                            "TetGen's meshes are several files: they are not packed, nor written "
                            "to standard output",
                        .remedy = "name STEM.node, or another format"});
  } else if (auto reason = refused(t, how)) {
    findings.push_back(std::move(*reason));
  } else {
    const io::Written all = io::written_of(mesh, t);
    const FileMesh& written = all.mesh();
    chosen.encoding = how.encoding;
    findings = io::losses_of(all, chosen);
    if (const std::size_t names = name_count(written);
        path == "-" && names > 0 && !holds_names(t, version)) {
      findings.push_back(
          {.code = "names_lost",
           .severity = Severity::warning,
           .count = names,
           .text = fmt::format("{} holds no names of regions, and nothing lies beside "
                               "standard output",
                               t.name),
           .remedy = "write to a file: they are put beside it"});
    }
    if (has_error(findings)) return in_file(path, std::move(findings));
    auto failure = io::write_format(t.format, path, written, how);
    if (failure) findings.insert(findings.begin(), std::move(*failure));
    if (!failure) {
      auto names = path == "-" ? std::nullopt : write_names_beside(path, written, t, version);
      if (names) findings.insert(has_error({*names}) ? findings.begin() : findings.end(), *names);
    }
  }
  return in_file(path, std::move(findings));
}

std::vector<Finding> write_mesh(const std::filesystem::path& path, const TetMesh& mesh) {
  return write_file_mesh(path, file_mesh_of(mesh));
}

}  // namespace sunder
