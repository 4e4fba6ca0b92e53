// SPDX-License-Identifier: MIT
// Kinds of cells with their counts, in words and in JSON.
#include "apps/sunder/mesh/convert/cell_counts.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "topology/base/counted.hpp"

namespace sunder {
namespace {

/// Adds "12 hexahedra" to a list; nothing for a count of 0.
void list(std::string& text, std::size_t count, std::string_view one, std::string_view several) {
  if (count == 0) return;
  text += fmt::format("{}{}", text.empty() ? "" : ", ", counted(count, one, several));
}

void list(std::string& text, std::size_t count, CellKind kind) {
  list(text, count, traits_of(kind).name, traits_of(kind).plural);
}

}  // namespace

std::string counts_text(const std::array<std::size_t, cell_kinds>& counts) {
  std::string text;
  for (const CellKind kind : all_cell_kinds) list(text, counts[index_of(kind)], kind);
  return text;
}

std::string counts_text(const FileMesh& mesh) {
  std::string text;
  list(text, mesh.points.size(), "point", "points");
  for (std::size_t i = cell_kinds; i-- > 0;) {
    list(text, rows_of(mesh, all_cell_kinds[i]).count, all_cell_kinds[i]);
  }
  return text.empty() ? "a mesh without points" : text;
}

nlohmann::ordered_json counts_json(const FileMesh& mesh) {
  nlohmann::ordered_json json{{"points", mesh.points.size()}};
  for (const CellKind kind : all_cell_kinds) {
    const std::size_t n = rows_of(mesh, kind).count;
    if (n > 0 || is_simplex(kind)) json[std::string(traits_of(kind).plural)] = n;
  }
  return json;
}

}  // namespace sunder
