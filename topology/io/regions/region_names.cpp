// SPDX-License-Identifier: MIT
// The list of names next to a mesh: text that a person can write too.
#include "topology/io/regions/region_names.hpp"

#include <fmt/format.h>

#include <iterator>

#include "topology/io/files/output_file.hpp"
#include "topology/io/tetgen/tetgen.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

constexpr std::string_view first_line = "# Sunder region names: dimension, region, \"name\"";

}  // namespace

std::filesystem::path names_beside(const std::filesystem::path& path, MeshFormat format) {
  std::filesystem::path beside = path;
  if (format == MeshFormat::tetgen) (beside = tetgen_stem(path)) += ".node";
  return beside += ".regions";
}

std::optional<Finding> write_region_names(const std::filesystem::path& path, const FileMesh& mesh) {
  std::string text = fmt::format("{}\n", first_line);
  for (std::size_t d = 0; d < mesh.region_name.size(); ++d) {
    for (const auto& [region, name] : mesh.region_name[d]) {
      fmt::format_to(std::back_inserter(text), "{} {} \"{}\"\n", d, region, name);
    }
  }
  return write_file(path, text);
}

std::array<std::map<std::int32_t, std::string>, 4> read_region_names(std::string_view text) {
  std::array<std::map<std::int32_t, std::string>, 4> names;
  Scanner s{text};
  while (!peek_word(s).empty()) {
    const std::size_t at = s.at;
    if (text[at] == '#') {
      rest_of_line(s);
      continue;
    }
    const auto dimension = read_number<std::int64_t>(s, "a dimension (0 to 3)");
    const auto region = read_number<std::int32_t>(s, "a region");
    const std::string_view name = rest_of_line(s);
    if (dimension < 0 || dimension > 3 || name.size() < 2 || name.front() != '"' ||
        name.back() != '"') {
      fail(text, at,
           {.code = "bad_name",
            .text = fmt::format("{} of dimension {} stands where a name in double quotes, of "
                                "dimension 0 to 3, was expected",
                                in_quotes(name), dimension),
            .remedy = "write the line as: 3 7 \"name\""});
    }
    names[static_cast<std::size_t>(dimension)][region] =
        std::string(name.substr(1, name.size() - 2));
  }
  return names;
}

}  // namespace sunder::io
