// SPDX-License-Identifier: MIT
// The table that `sunder convert --formats` prints.
#include "apps/sunder/mesh/formats_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <bit>
#include <string_view>

#include "apps/scene/words.hpp"
#include "topology/io/format_traits.hpp"

namespace sunder {
namespace {

std::string plurals_of(KindSet set) {
  std::string text;
  for (const CellKind kind : all_cell_kinds) {
    if (!contains(set, kind)) continue;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", traits_of(kind).plural);
  }
  return text;
}

std::string cells_of(const FormatTraits& t) {
  constexpr int few = 5;
  const KindSet missing = all_kinds & ~t.cells;
  return std::popcount(missing) <= few ? "all but " + plurals_of(missing) : plurals_of(t.cells);
}

std::string ways_of(const FormatTraits& t) {
  constexpr std::string_view encoding_words[] = {"text", "binary", "base64"};
  std::string written = fmt::format("{}", fmt::join(t.versions, ", "));
  for (const Encoding e : t.encodings) {
    written += written.empty() ? "" : e == t.encodings[0] ? "; " : ", ";
    written += encoding_words[static_cast<std::size_t>(e)];
  }
  return t.packs ? written + ", zlib" : written;
}

}  // namespace

std::string formats_table() {
  std::string table =
      "| format | ending | written as | cells | regions | their names | entities | regions of "
      "points | numbers of points | of cells | data of points | of cells | types of numbers |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const FormatTraits& t : format_traits()) {
    const std::string cells[] = {
        std::string(t.name),
        fmt::format("{}", fmt::join(t.extensions, ", ")),
        ways_of(t),
        cells_of(t),
        std::string(yes_or_no(t.holds_regions)),
        std::string(t.regions_are_words ? "words" : yes_or_no(t.holds_region_names)),
        std::string(yes_or_no(t.holds_entities)),
        std::string(yes_or_no(t.holds_point_regions)),
        std::string(yes_or_no(t.holds_point_ids)),
        std::string(t.cell_ids_from == 1 ? "of elements" : yes_or_no(t.holds_cell_ids)),
        std::string(yes_or_no(t.holds_point_data)),
        std::string(t.cell_data_from == 3 ? "of tetrahedra" : yes_or_no(t.holds_cell_data)),
        std::string(yes_or_no(t.holds_number_types))};
    table += fmt::format("| {} |\n", fmt::join(cells, " | "));
  }
  return table;
}

std::optional<MeshFormat> format_called(const std::string& word) {
  return format_of_name("mesh." + word);
}

std::string known_format(const std::string& word) {
  if (format_called(word)) return {};
  std::string words;
  for (const FormatTraits& t : format_traits()) {
    words += fmt::format("{}{}", words.empty() ? "" : ", ", t.extensions[0].substr(1));
  }
  return fmt::format("{} is no format: give one of {}", word, words);
}

}  // namespace sunder
