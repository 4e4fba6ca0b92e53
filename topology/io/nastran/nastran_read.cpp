// SPDX-License-Identifier: MIT
// Nastran's bulk data read: the parts of the files that hold it, points, then elements, which may
// stand before their points.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <deque>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "topology/io/abaqus/abaqus_lines.hpp"
#include "topology/io/nastran/nastran.hpp"
#include "topology/io/nastran/nastran_cards.hpp"
#include "topology/io/nastran/nastran_reader.hpp"
#include "topology/io/text/number_index.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

constexpr int deepest_include = 8;

/// The mesh's file or one that is included.
struct NastranText {
  /// Empty for the mesh's file.
  std::string name;
  std::string_view text;
};

/// Bytes of a file that hold cards and nothing else.
struct Part {
  std::uint32_t file;
  std::size_t begin, end;
};

struct NastranReader {
  const FileSource& source;
  Draft draft;
  std::deque<NastranText> files;
  std::deque<std::string> included;
  std::vector<Part> parts;
  bool is_ended = false;
  NumberIndex rows;
  /// Cards that are passed over.
  std::set<std::string> others;
  /// The property that stands for no region, in files of ours; else 0.
  std::int32_t no_region = 0;
};

[[noreturn]] void fail_include(std::string_view text, std::size_t at, std::string_view code,
                               std::string words, std::string_view remedy) {
  fail(text, at,
       {.code = std::string(code), .text = std::move(words), .remedy = std::string(remedy)});
}

void find_parts(NastranReader& r, std::uint32_t file, std::size_t begin, int depth);

/// INCLUDE 'name': its bulk data stand in place of the line. Gives where the next line begins.
std::size_t include(NastranReader& r, std::uint32_t file, std::size_t at, int depth) {
  const std::string_view text = r.files[file].text;
  const std::size_t end = std::min(text.find('\n', at), text.size());
  std::string_view name = trimmed(trimmed(text.substr(at, end - at)).substr(7));
  const char quote = name.empty() ? ' ' : name.front();
  if (quote == '\'' || quote == '"') {
    name = name.substr(1, std::min(name.find(quote, 1), name.size()) - 1);
  }
  if (name.empty()) {
    fail_include(text, at, "bad_keyword", "INCLUDE names no file",
                 "name it in quotes, in the same line");
  }
  const std::string path = std::filesystem::path(name).lexically_normal().string();
  const bool is_known =
      path == r.source.name ||
      std::ranges::any_of(r.files, [&](const NastranText& f) { return f.name == path; });
  if (is_known || depth >= deepest_include) {
    fail_include(text, at, "include_cycle",
                 fmt::format("{} is included {}", in_quotes(path),
                             is_known ? "a second time" : "too deeply"),
                 "include every file once");
  }
  std::optional<std::string> other = other_text(r.source, path);
  if (!other) {
    fail_include(text, at, "missing_file",
                 fmt::format("{} is not there, which this file includes", in_quotes(path)),
                 "put it beside the mesh");
  }
  r.included.push_back(std::move(*other));
  r.files.push_back({path, r.included.back()});
  in_file(r.draft, path, r.included.back(),
          [&] { find_parts(r, static_cast<std::uint32_t>(r.files.size() - 1), 0, depth + 1); });
  return end + 1;
}

/// The cards of a file from byte `begin` on, up to ENDDATA.
void find_parts(NastranReader& r, std::uint32_t file, std::size_t begin, int depth) {
  const std::string_view text = r.files[file].text;
  const auto add = [&](std::size_t end) {
    if (end > begin) r.parts.push_back({file, begin, end});
  };
  std::size_t next = begin;
  while (next < text.size() && !r.is_ended) {
    const std::size_t at = next;
    next = std::min(text.find('\n', at), text.size() - 1) + 1;
    const char first = text[std::min(text.find_first_not_of(" \t", at), text.size() - 1)];
    if (first != 'I' && first != 'i' && first != 'E' && first != 'e') continue;
    const std::string word = card_word(card_line(text, at));
    if (word == "INCLUDE") {
      add(at);
      begin = next = include(r, file, at, depth);
    } else if (word == "ENDDATA") {
      add(at);
      begin = text.size();
      r.is_ended = true;
    }
  }
  add(text.size());
}

/// Where bulk data begin: behind BEGIN BULK, or at once.
std::size_t begin_of_bulk(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view line = card_line(text, at);
    const std::size_t next = std::min(text.find('\n', at), text.size() - 1) + 1;
    if (card_word(line) == "BEGIN") return next;
    at = next;
  }
  return 0;
}

/// What the comment in files of ours says.
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

void read_point(NastranReader& r, std::string_view text, const Card& card) {
  FileMesh& mesh = r.draft.mesh;
  mesh.source_point_id.push_back(card_integer(text, card, 0, "the number of a point"));
  expect_basic_system(text, card, 1);
  Point point;
  for (std::size_t k = 0; k < 3; ++k) point[k] = card_real(text, card, 2 + k, "a coordinate");
  add_point(r.draft, point, card.at);
}

void read_points(NastranReader& r) {
  for_each_card(r, [&](std::string_view text, const Card& card) {
    if (card.name == "GRID") return read_point(r, text, card);
    if (card.name == "GRDSET") return expect_basic_system(text, card, 1);
    if (card.name == "BEGIN") return;
    const bool is_known = nastran_type(card.name) != nullptr || is_other_element(card.name);
    constexpr std::size_t most = 12, longest = 40;
    if (!is_known && r.others.size() < most) r.others.insert(card.name.substr(0, longest));
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
  add_curved_cells(r.draft,
                   fmt::format("{} without some of their midpoints", traits_of(type.linear).plural),
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

bool is_nastran(std::string_view text) {
  constexpr std::string_view before_bulk[] = {"SOL",    "CEND", "ID",    "NASTRAN", "TIME",
                                              "ASSIGN", "INIT", "TITLE", "ECHO",    "DIAG"};
  for (std::size_t at = 0; at < text.size();) {
    const std::string word = card_word(card_line(text, at));
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
    if (word.empty()) continue;
    if (word == "BEGIN") return true;
    if (std::ranges::find(before_bulk, word) != std::end(before_bulk)) {
      return begin_of_bulk(text) > 0;
    }
    return is_bulk_card(word);
  }
  return false;
}

Draft read_nastran(const FileSource& source) {
  NastranReader r{.source = source, .draft = {.text = source.text}};
  r.files.push_back({"", source.text});
  r.no_region = property_without_region(source.text);
  find_parts(r, 0, begin_of_bulk(source.text), 0);
  read_points(r);
  read_elements(r);
  note_passed_over(r.draft, r.others);
  return std::move(r.draft);
}

}  // namespace sunder::io
