// SPDX-License-Identifier: MIT
// Sets of Abaqus' input: those of elements become regions, those of nodes vertices.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "topology/base/counted.hpp"
#include "topology/io/abaqus/abaqus_reader.hpp"
#include "topology/io/text/scan.hpp"
#include "topology/io/usual_entities.hpp"

namespace sunder::io {
namespace {

constexpr int deepest_set = 32;

/// Members of sets, one after the other.
struct Walk {
  AbaqusReader& r;
  const AbaqusSets& sets;
  const NumberIndex& rows;
  /// The file's own numbers, by row.
  const std::vector<std::int64_t>& numbers;
  std::int64_t lowest = 0, highest = -1;
  /// Rows of the first element of each kind; 0 for nodes.
  std::array<std::size_t, cell_kinds> first_row{};
  /// How many more members all sets together may name.
  std::size_t left = 0;
  std::size_t unknown = 0;
};

Walk new_walk(AbaqusReader& r, const AbaqusSets& sets, const NumberIndex& rows,
              const std::vector<std::int64_t>& numbers) {
  Walk w{r, sets, rows, numbers};
  if (!numbers.empty()) {
    const auto [low, high] = std::ranges::minmax(numbers);
    w.lowest = low;
    w.highest = high;
  }
  w.left = r.bytes + numbers.size();
  return w;
}

void count_members(Walk& w, std::size_t n, std::string_view text, std::size_t at) {
  if (n <= w.left) {
    w.left -= n;
    return;
  }
  fail(text, at,
       {.code = "count_too_big",
        .text = "the sets name more members than the file has bytes",
        .remedy = "leave out sets that only repeat others"});
}

/// Rows of the numbers from a field's to the next one's, by the step behind.
template <class Visit>
void walk_range(Walk& w, DataLines& lines, Visit& visit) {
  constexpr std::string_view what = "a number";
  const std::size_t at = lines.at;
  const std::int64_t from = integer_of(lines, next_field(lines), what);
  const std::int64_t to = integer_of(lines, next_field(lines), what);
  const std::string_view field = next_field(lines);
  const std::int64_t step = field.empty() ? 1 : integer_of(lines, field, what);
  if (step <= 0) {
    fail(lines.text, at,
         {.code = "bad_number",
          .text = fmt::format("{} is the step of a range: 1 or more was expected", step),
          .remedy = "correct the step"});
  }
  const std::int64_t start =
      from + (std::max<std::int64_t>(w.lowest - from, 0) + step - 1) / step * step;
  const std::int64_t end = std::min(to, w.highest);
  if (start > end) return;
  const auto steps = static_cast<std::size_t>((end - start) / step) + 1;
  count_members(w, std::min(steps, w.numbers.size()), lines.text, at);
  if (steps <= w.numbers.size()) {
    for (std::int64_t number = start; number <= end; number += step) {
      const std::int64_t row = row_of(w.rows, number);
      if (row >= 0) visit(static_cast<std::size_t>(row));
    }
    return;
  }
  for (std::size_t row = 0; row < w.numbers.size(); ++row) {
    const std::int64_t number = w.numbers[row];
    if (number >= start && number <= end && (number - start) % step == 0) visit(row);
  }
}

template <class Visit>
void walk_set(Walk& w, std::int32_t set, std::size_t behind, int depth, Visit& visit);

bool is_number(std::string_view field) {
  const char c = field.front();
  return (c >= '0' && c <= '9') || c == '-' || c == '+';
}

/// A member: a number, or the name of a set that was there before.
template <class Visit>
void walk_field(Walk& w, const DataLines& lines, std::string_view field, std::size_t index,
                int depth, Visit& visit) {
  const auto at = static_cast<std::size_t>(field.data() - lines.text.data());
  count_members(w, 1, lines.text, at);
  if (is_number(field)) {
    const std::int64_t row = row_of(w.rows, integer_of(lines, field, "a number or a set's name"));
    row < 0 ? void(++w.unknown) : visit(static_cast<std::size_t>(row));
    return;
  }
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
    field = field.substr(1, field.size() - 2);
  }
  const auto found = w.sets.names.place.find(lower_case(field));
  if (found == w.sets.names.place.end()) {
    fail(lines.text, at,
         {.code = "unknown_set",
          .text = fmt::format("{} stands where a number or the name of a set before was expected",
                              in_quotes(field)),
          .remedy = "correct the name, or put that set first"});
  }
  if (depth >= deepest_set) {
    fail(lines.text, at,
         {.code = "count_too_big",
          .text = fmt::format("set {} is a set of sets of sets, {} deep", in_quotes(field), depth),
          .remedy = "list the members themselves"});
  }
  walk_set(w, found->second, index, depth + 1, visit);
}

/// The members that the lines at `index` give to their set.
template <class Visit>
void walk_lines(Walk& w, std::size_t index, int depth, Visit& visit) {
  const SetLines& part = w.sets.lines[index];
  if (part.is_block) {
    const std::size_t first = w.first_row[part.file];
    count_members(w, depth == 0 ? 0 : part.end - part.at, w.r.source.text, 0);
    for (std::size_t row = part.at; row < part.end; ++row) visit(first + row);
    return;
  }
  const AbaqusText& file = w.r.files[part.file];
  in_file(w.r.draft, file.name, file.text, [&] {
    DataLines lines{.text = file.text, .next = part.at};
    while (next_data_line(lines)) {
      if (part.generate) {
        walk_range(w, lines, visit);
        continue;
      }
      while (has_field(lines)) {
        const std::string_view field = next_field(lines);
        if (!field.empty()) walk_field(w, lines, field, index, depth, visit);
      }
    }
  });
}

/// All members that a set has before the lines at `behind`.
template <class Visit>
void walk_set(Walk& w, std::int32_t set, std::size_t behind, int depth, Visit& visit) {
  for (std::int32_t i = w.sets.last[static_cast<std::size_t>(set)]; i >= 0;
       i = w.sets.lines[static_cast<std::size_t>(i)].before) {
    count_members(w, 1, w.r.source.text, 0);
    if (static_cast<std::size_t>(i) < behind) {
      walk_lines(w, static_cast<std::size_t>(i), depth, visit);
    }
  }
}

/// N where the word is gmsh's name for the entity N of a dimension: Line1, Surface2, Volume3.
std::int32_t entity_in_word(std::string_view word, int dimension) {
  constexpr std::string_view names[] = {"Point", "Line", "Surface", "Volume"};
  const std::string_view name = names[dimension];
  std::int32_t number = 0;
  if (!word.starts_with(name)) return 0;
  const auto [stop, reason] =
      std::from_chars(word.data() + name.size(), word.data() + word.size(), number);
  return reason == std::errc{} && stop == word.data() + word.size() && number > 0 ? number : 0;
}

void warn_unknown(AbaqusReader& r, std::size_t count, std::string_view what) {
  // Elements that are left out have numbers too.
  if (count == 0 || !r.unknown.empty()) return;
  if (!r.draft.volume_cells.empty() || !r.draft.surface_cells.empty()) return;
  r.draft.findings.push_back(
      {.code = "unknown_member",
       .severity = Severity::warning,
       .count = count,
       .text = fmt::format("sets name {} {} that are not there", count, what),
       .remedy = "nothing to do, if they were left out on purpose"});
}

/// The rank by which one of its sets becomes an element's region, lowest first: sets with a section
/// of material; others; sets that hold all elements; entities of gmsh.
int rank_of(const AbaqusSets& sets, std::size_t set, bool holds_all) {
  if (sets.has_section[set]) return 0;
  const std::string& word = sets.names.words[set];
  for (int d = 1; d <= 3; ++d) {
    if (entity_in_word(word, d) != 0) return 3;
  }
  return holds_all ? 2 : 1;
}

struct Regions {
  std::vector<std::int32_t> set_of, entity_of;
  std::vector<bool> has_several;
};

/// Gives the members of a set to it, where they have none.
void take_members(Walk& w, Regions& regions, std::size_t set, int rank) {
  const std::string& word = w.sets.names.words[set];
  const auto take = [&](std::size_t row) {
    std::int32_t& own = regions.set_of[row];
    if (own == static_cast<std::int32_t>(set)) return;
    if (own < 0) {
      own = static_cast<std::int32_t>(set);
    } else if (rank < 2) {
      regions.has_several[row] = true;
    } else if (rank == 3) {
      const int dimension = row >= w.first_row[index_of(CellKind::tetrahedron)] ? 3
                            : row >= w.first_row[index_of(CellKind::triangle)]  ? 2
                                                                                : 1;
      const std::int32_t entity = entity_in_word(word, dimension);
      if (entity == 0) return;
      regions.entity_of.resize(regions.set_of.size(), 0);
      regions.entity_of[row] = entity;
    }
  };
  walk_set(w, static_cast<std::int32_t>(set), w.sets.lines.size(), 0, take);
}

Regions regions_of(Walk& w) {
  const std::size_t elements = w.numbers.size();
  const std::size_t sets = w.sets.names.words.size();
  const std::size_t budget = w.left;
  std::vector<std::vector<std::size_t>> by_rank(4);
  std::vector<std::uint32_t> seen(elements, 0);
  for (std::size_t set = 0; set < sets; ++set) {
    if (w.sets.is_internal[set]) continue;
    std::size_t members = 0;
    const auto count = [&](std::size_t row) {
      members += seen[row] != set + 1;
      seen[row] = static_cast<std::uint32_t>(set + 1);
    };
    walk_set(w, static_cast<std::int32_t>(set), w.sets.lines.size(), 0, count);
    by_rank[static_cast<std::size_t>(rank_of(w.sets, set, members == elements))].push_back(set);
  }
  w.left = budget;
  w.unknown = 0;
  seen = {};
  Regions regions{std::vector<std::int32_t>(elements, -1), {}, std::vector<bool>(elements, false)};
  for (std::size_t rank = 0; rank < by_rank.size(); ++rank) {
    for (const std::size_t set : by_rank[rank]) {
      take_members(w, regions, set, static_cast<int>(rank));
    }
  }
  return regions;
}

void read_element_sets(AbaqusReader& r) {
  FileMesh& mesh = r.draft.mesh;
  std::vector<std::int64_t> numbers;
  std::array<std::size_t, cell_kinds> first_row{};
  for (const CellKind kind : all_cell_kinds) {
    const std::vector<std::int64_t>& own = columns_of(mesh, kind).source_id;
    first_row[index_of(kind)] = numbers.size();
    numbers.insert(numbers.end(), own.begin(), own.end());
  }
  Walk w = new_walk(r, r.element_sets, r.element_rows, numbers);
  w.first_row = first_row;
  const Regions regions = regions_of(w);
  warn_unknown(r, w.unknown, "elements");
  const auto several = static_cast<std::size_t>(
      std::count(regions.has_several.begin(), regions.has_several.end(), true));
  if (several > 0) {
    r.draft.findings.push_back(
        {.code = "several_sets",
         .severity = Severity::warning,
         .count = several,
         .text = fmt::format("{} in several sets: the first of each is kept, that of a section of "
                             "material before others",
                             counted(several, "element is", "elements are")),
         .remedy = "nothing to do, if the first sets are the ones you want"});
  }
  const auto part = [&](const std::vector<std::int32_t>& all, CellKind kind) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first_row[index_of(kind)]);
    return std::vector<std::int32_t>(
        begin, begin + static_cast<std::ptrdiff_t>(rows_of(mesh, kind).count));
  };
  for (const CellKind kind : all_cell_kinds) {
    if (kind == CellKind::vertex || rows_of(mesh, kind).count == 0) continue;
    CellColumns& cells = columns_of(mesh, kind);
    cells.region = part(regions.set_of, kind);
    if (regions.entity_of.empty()) continue;
    cells.entity = part(regions.entity_of, kind);
    drop_usual_entities(cells);
  }
  for (int d = 1; d <= 3; ++d) number_labels(mesh, d, r.element_sets.names);
}

/// Whether the set is that of all nodes, given with the nodes themselves: such a set adds nothing.
bool is_all_nodes(const AbaqusReader& r, std::size_t set) {
  std::size_t nodes = 0;
  const AbaqusSets& sets = r.node_sets;
  for (std::int32_t i = sets.last[set]; i >= 0;
       i = sets.lines[static_cast<std::size_t>(i)].before) {
    const SetLines& part = sets.lines[static_cast<std::size_t>(i)];
    if (!part.is_block) return false;
    nodes += part.end - part.at;
  }
  return nodes == r.draft.mesh.points.size();
}

void read_node_sets(AbaqusReader& r) {
  const AbaqusSets& sets = r.node_sets;
  CellList<1>& cells = r.draft.mesh.vertices;
  std::vector<bool> is_left_out = sets.is_internal;
  for (std::size_t set = 0; set < sets.names.words.size(); ++set) {
    if (is_left_out[set] || !is_all_nodes(r, set)) continue;
    is_left_out[set] = true;
    r.draft.findings.push_back({.code = "set_of_all",
                                .severity = Severity::note,
                                .text = fmt::format("set {} has all nodes: it is left out",
                                                    in_quotes(sets.names.words[set])),
                                .remedy = "nothing to do"});
  }
  Walk w = new_walk(r, sets, r.node_rows, r.draft.mesh.source_point_id);
  const auto for_members = [&](auto visit) {
    for (std::size_t i = 0; i < sets.lines.size(); ++i) {
      const std::int32_t set = sets.lines[i].set;
      if (is_left_out[static_cast<std::size_t>(set)]) continue;
      const auto visit_row = [&](std::size_t row) { visit(row, set); };
      walk_lines(w, i, 0, visit_row);
    }
  };
  std::size_t members = 0;
  const std::size_t budget = w.left;
  for_members([&](std::size_t, std::int32_t) { ++members; });
  w.left = budget;
  w.unknown = 0;
  cells.corners.reserve(members);
  cells.region.reserve(members);
  for_members([&](std::size_t row, std::int32_t set) {
    cells.corners.push_back({static_cast<std::uint32_t>(row)});
    cells.region.push_back(set);
  });
  warn_unknown(r, w.unknown, "nodes");
  number_regions(cells.region, sets.names, r.draft.mesh.region_name[0]);
  // Vertices without a region are written as those of region 0.
  if (std::ranges::all_of(cells.region, [](auto x) { return x == 0; })) cells.region.clear();
}

}  // namespace

std::int32_t set_called(AbaqusSets& sets, std::string_view name) {
  const std::int32_t place = place_of_word(sets.names, name);
  sets.last.resize(sets.names.words.size(), -1);
  sets.is_internal.resize(sets.names.words.size(), false);
  sets.has_section.resize(sets.names.words.size(), false);
  return place;
}

void add_lines(AbaqusSets& sets, SetLines lines) {
  std::int32_t& last = sets.last[static_cast<std::size_t>(lines.set)];
  lines.before = last;
  last = static_cast<std::int32_t>(sets.lines.size());
  sets.lines.push_back(lines);
}

void read_abaqus_sets(AbaqusReader& r) {
  constexpr std::size_t bytes_a_set = 32, always = 1000;
  const std::size_t sets = r.node_sets.names.words.size() + r.element_sets.names.words.size();
  if (sets > always + r.bytes / bytes_a_set) {
    throw ReadFailure{{.code = "count_too_big",
                       .text = fmt::format("{} sets in {} bytes", sets, r.bytes),
                       .remedy = "leave out sets without members"}};
  }
  read_element_sets(r);
  read_node_sets(r);
}

}  // namespace sunder::io
