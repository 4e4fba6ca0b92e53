// SPDX-License-Identifier: MIT
// Nastran's bulk data read: points, then elements, which may stand before their points.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "topology/io/abaqus/abaqus_lines.hpp"
#include "topology/io/nastran/nastran.hpp"
#include "topology/io/nastran/nastran_cards.hpp"
#include "topology/io/nastran/nastran_reader.hpp"
#include "topology/io/text/number_index.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

/// The property that the comment in our own files names.
std::int32_t property_without_region(std::string_view text) {
  const std::size_t at = text.substr(0, 200).find(no_region_mark);
  if (at == std::string_view::npos) return 0;
  const std::string_view number = first_word(text.substr(at + no_region_mark.size()));
  std::int32_t property = 0;
  std::from_chars(number.data(), number.data() + number.size(), property);
  return property;
}

/// Calls `work(text, card)` for every card of every file.
template <class Work>
void for_each_card(NastranReader& r, Work work) {
  Card card;
  for (const Part& part : r.parts) {
    const NastranText& file = r.files[part.file];
    in_file(r.draft, file.name, file.text, [&] {
      CardLines lines{file.text, part.begin, part.end};
      while (next_card(lines, card)) work(file.text, card);
    });
  }
}

/// A coordinate system of a point, or of GRDSET: only the basic one is read.
void expect_basic_system(std::string_view text, const Card& card, std::size_t field) {
  if (field_of(card, field).empty()) return;
  const std::int64_t system = card_integer(text, card, field, "the number of a coordinate system");
  if (system == 0) return;
  fail(text, card.at,
       {.code = "unsupported_keyword",
        .text =
            fmt::format("{} is given in the coordinate system {}: only the basic system 0 is read",
                        card.name == "GRID" ? "a point" : "GRDSET", system),
        .remedy =
            "write the points in the basic system (in most programs an option of the export)"});
}

/// Fields from `first` on that say something, but not to the mesh: constraints of points, angles
/// and offsets of shells, orientations of beams.
void skip_fields(NastranReader& r, const Card& card, std::size_t first) {
  const auto is_set = [](std::string_view field) {
    return field.find_first_not_of("+-0. ") != std::string_view::npos;
  };
  for (std::size_t i = first; i < card.fields.size(); ++i) {
    if (is_set(card.fields[i]))
      return add_skipped(r.draft, "further fields of cards", card.name, card.at);
  }
}

void read_point(NastranReader& r, std::string_view text, const Card& card) {
  FileMesh& mesh = r.draft.mesh;
  mesh.source_point_id.push_back(card_integer(text, card, 0, "the number of a point"));
  expect_basic_system(text, card, 1);
  Point point;
  for (std::size_t k = 0; k < 3; ++k) point[k] = card_real(text, card, 2 + k, "a coordinate");
  add_point(r.draft, point, card.at);
  skip_fields(r, card, 5);
}

void read_points(NastranReader& r) {
  for_each_card(r, [&](std::string_view text, const Card& card) {
    if (card.name == "GRID") return read_point(r, text, card);
    if (card.name == "GRDSET") {
      skip_fields(r, card, 5);
      return expect_basic_system(text, card, 1);
    }
    if (card.name == "BEGIN") return;
    const bool is_known = nastran_type(card.name) != nullptr || is_other_element(card.name);
    if (!is_known) add_skipped(r.draft, "cards", card.name, card.at);
  });
  const std::vector<std::int64_t>& numbers = r.draft.mesh.source_point_id;
  if (numbers.empty()) {
    fail(r.source.text, r.source.text.size(),
         {.code = "missing_section",
          .text = "the file ends without points (GRID)",
          .remedy = "give a file with GRID and elements, or include theirs"});
  }
  std::array<std::int64_t, 2> twice;
  if (index_numbers(r.rows, numbers, twice)) return;
  std::int64_t row = -1;
  for_each_card(r, [&](std::string_view text, const Card& card) {
    if (card.name != "GRID" || ++row != twice[1]) return;
    fail(text, card.at,
         {.code = "duplicate_id",
          .ids = {twice[0], twice[1]},
          .text = fmt::format("the points in rows {} and {} have the same number {}", twice[0],
                              twice[1], numbers[static_cast<std::size_t>(row)]),
          .remedy = "give every point its own number"});
  });
}

/// How many nodes an element has: all up to the last one that is not blank, as far as its card has
/// nodes; the corners where others between them are blank.
std::size_t nodes_of_card(NastranReader& r, std::string_view text, const Card& card,
                          const NastranType& type) {
  const std::size_t corners = traits_of(type.linear).nodes;
  std::size_t nodes = 0, given = 0;
  for (std::size_t k = 0; k < type.most_nodes; ++k) {
    // 0 means the same as blank.
    const std::string_view field = field_of(card, type.first_node + k);
    if (field.empty() || field == "0") continue;
    nodes = k + 1;
    ++given;
  }
  if (nodes <= corners) {
    if (given == corners) return corners;
    fail(text, card.at,
         {.code = "wrong_count",
          .text =
              fmt::format("a card {} has {} of its {} nodes", in_quotes(card.name), given, corners),
          .remedy = "complete the card, or delete it"});
  }
  if (given == nodes && nodes == traits_of(nastran_kind(type.linear, nodes)).nodes) return nodes;
  add_curved_cells(r.draft, fmt::format("{} without some midpoints", traits_of(type.linear).plural),
                   1, card.at);
  return corners;
}

std::int32_t property_of(std::string_view text, const Card& card, const NastranType& type) {
  if (type.first_node < 2 || field_of(card, 1).empty()) return 0;
  const std::int64_t property = card_integer(text, card, 1, "the number of a property");
  if (property >= 0 && property <= std::numeric_limits<std::int32_t>::max()) {
    return static_cast<std::int32_t>(property);
  }
  fail(text, card.at,
       {.code = "number_out_of_range",
        .text = fmt::format("property {} is none from 0 to 2147483647", property),
        .remedy = "number the properties from 1 on"});
}

void read_element(NastranReader& r, std::string_view text, const Card& card,
                  const NastranType& type) {
  const std::int64_t number = card_integer(text, card, 0, "the number of an element");
  const std::size_t nodes = nodes_of_card(r, text, card, type);
  const CellKind kind = nastran_kind(type.linear, nodes);
  const std::span<const std::uint8_t> order = nastran_order(kind);
  FileCell& cell = r.draft.cell;
  cell.begin(nodes, card.at);
  for (std::size_t k = 0; k < nodes; ++k) {
    const std::size_t place = order.empty() ? k : order[k];
    cell.numbers[place] = card_integer(text, card, type.first_node + k, "the number of a point");
    cell.rows[place] = row_of(r.rows, cell.numbers[place]);
  }
  add_cell(r.draft, kind, cell);
  CellColumns& columns = columns_of(r.draft.mesh, kind);
  columns.source_id.push_back(number);
  const std::int32_t property = property_of(text, card, type);
  columns.region.push_back(property == r.no_region ? 0 : property);
  skip_fields(r, card, type.first_node + type.most_nodes);
}

void read_elements(NastranReader& r) {
  for_each_card(r, [&](std::string_view text, const Card& card) {
    if (const NastranType* const type = nastran_type(card.name)) {
      read_element(r, text, card, *type);
    } else if (is_other_element(card.name)) {
      add_other_cells(r.draft, "elements " + card.name, 1, 1, card.at);
    }
  });
  for (const CellKind kind : all_cell_kinds) {
    std::vector<std::int32_t>& region = columns_of(r.draft.mesh, kind).region;
    if (std::ranges::all_of(region, [](auto property) { return property == 0; })) region.clear();
  }
}

}  // namespace

Draft read_nastran(const FileSource& source) {
  NastranReader r{.source = source, .draft = {.text = source.text}};
  r.files.push_back({"", source.text});
  r.no_region = property_without_region(source.text);
  find_bulk_data(r);
  read_points(r);
  read_elements(r);
  return std::move(r.draft);
}

}  // namespace sunder::io
