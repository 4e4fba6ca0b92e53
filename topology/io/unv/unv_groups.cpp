// SPDX-License-Identifier: MIT
// Groups of universal files: those of elements become regions, those of nodes vertices.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "topology/base/counted.hpp"
#include "topology/io/abaqus/abaqus_lines.hpp"
#include "topology/io/text/scan.hpp"
#include "topology/io/unv/unv_reader.hpp"

namespace sunder::io {
namespace {

constexpr std::int64_t of_nodes = 7, of_elements = 8;

struct Group {
  std::int64_t number = 0;
  std::string_view name;
  /// By dimension: the region that it has there; 0 where it has no cells.
  std::array<std::int32_t, 4> region{};
};

/// Whether its name is `region_N`, N its number: that stands for no name.
bool is_unnamed(const Group& group) { return group.name == fmt::format("region_{}", group.number); }

struct Groups {
  std::vector<Group> groups;
  NumberIndex element_rows;
  /// By row of all elements: their kinds in the order of kinds, and their groups; -1 for none.
  std::vector<CellKind> kind_of;
  std::vector<std::int32_t> group_of;
  std::vector<std::int32_t> group_of_vertex;
  std::vector<bool> has_several;
  std::size_t unknown = 0, others = 0;
};

void index_elements(UnvReader& r, Groups& g) {
  std::vector<std::int64_t> numbers;
  for (const CellKind kind : all_cell_kinds) {
    const std::vector<std::int64_t>& own = columns_of(r.draft.mesh, kind).source_id;
    numbers.insert(numbers.end(), own.begin(), own.end());
    g.kind_of.resize(numbers.size(), kind);
  }
  g.group_of.assign(numbers.size(), -1);
  g.has_several.assign(numbers.size(), false);
  std::array<std::int64_t, 2> twice;
  if (index_numbers(g.element_rows, numbers, twice)) return;
  throw ReadFailure{{.code = "duplicate_id",
                     .text = fmt::format("two elements have the number {}",
                                         numbers[static_cast<std::size_t>(twice[0])]),
                     .remedy = "give every element its own number"}};
}

void take_member(UnvReader& r, Groups& g, std::int64_t type, std::int64_t number, std::size_t at) {
  const auto group = static_cast<std::int32_t>(g.groups.size() - 1);
  if (type == of_nodes) {
    const std::int64_t row = row_of(r.node_rows, number);
    if (row < 0) return void(++g.unknown);
    FileCell& cell = r.draft.cell;
    cell.begin(1, at);
    cell.rows[0] = row;
    cell.numbers[0] = number;
    add_cell(r.draft, CellKind::vertex, cell);
    g.group_of_vertex.push_back(group);
  } else if (type == of_elements) {
    const std::int64_t found = row_of(g.element_rows, number);
    if (found < 0) return void(++g.unknown);
    const auto row = static_cast<std::size_t>(found);
    if (g.group_of[row] < 0) {
      g.group_of[row] = group;
    } else if (g.group_of[row] != group) {
      g.has_several[row] = true;
    }
  } else {
    ++g.others;
  }
}

/// A head of eight numbers, a name, then the members: two numbers each, or four.
void read_groups(UnvReader& r, Groups& g, UnvLines& lines, std::size_t numbers_each) {
  std::array<std::int64_t, 8> head{}, members{};
  while (next_line(lines)) {
    const std::size_t at = lines.at;
    const std::size_t found = integers_of(lines, head, "a number");
    if (found == 0) continue;
    if (found < head.size()) {
      fail(lines.text, at,
           {.code = "wrong_count",
            .text =
                "a group begins with eight numbers, the last of which is how many members it has",
            .remedy = "correct the line, or write the file again"});
    }
    check_count({lines.text.substr(0, lines.end), lines.next}, at, head[7], "members",
                2 * numbers_each);
    expect_line(lines, "the name of a group");
    g.groups.push_back({head[0], trimmed(lines.line)});
    for (auto left = static_cast<std::size_t>(head[7]); left > 0;) {
      expect_line(lines, "a member of a group");
      const std::size_t words = integers_of(lines, members, "a number of a member");
      const std::size_t n = words / numbers_each;
      if (words == 0 || words % numbers_each != 0 || n > left) {
        fail(lines.text, lines.at,
             {.code = "wrong_count",
              .text = fmt::format("{} numbers stand where {} members of {} numbers each are left",
                                  words, left, numbers_each),
              .remedy = "correct the count of the group, or write the file again"});
      }
      for (std::size_t i = 0; i < n; ++i) {
        take_member(r, g, members[i * numbers_each], members[i * numbers_each + 1], lines.at);
      }
      left -= n;
    }
  }
}

/// The regions of the groups that have cells of a dimension: their own numbers where those are
/// free, else the next that are; and their names. Groups of one number and name are one region, and
/// `region_N` is the region N without a name.
void number_groups(UnvReader& r, Groups& g, std::size_t dimension,
                   const std::vector<bool>& is_used) {
  std::map<std::int32_t, std::string>& names = r.draft.mesh.region_name[dimension];
  std::map<std::int32_t, std::size_t> taken;
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < g.groups.size(); ++i) {
    if (!is_used[i]) continue;
    Group& group = g.groups[i];
    const auto region = static_cast<std::int32_t>(group.number);
    const bool fits = group.number == region && (region != 0 || is_unnamed(group));
    if (fits) {
      const Group& first = g.groups[taken.emplace(region, i).first->second];
      if (&first == &group || first.name == group.name) {
        group.region[dimension] = region;
        continue;
      }
    }
    waiting.push_back(i);
  }
  std::int32_t next = 1;
  for (const std::size_t i : waiting) {
    while (!taken.emplace(next, i).second) ++next;
    g.groups[i].region[dimension] = next;
  }
  for (const auto& [region, i] : taken) {
    const Group& group = g.groups[i];
    if (!group.name.empty() && !is_unnamed(group)) names.emplace(region, group.name);
  }
}

void give_regions(UnvReader& r, Groups& g) {
  FileMesh& mesh = r.draft.mesh;
  std::array<std::vector<bool>, 4> is_used;
  is_used.fill(std::vector<bool>(g.groups.size(), false));
  const auto dimension_of = [](CellKind kind) {
    return static_cast<std::size_t>(traits_of(kind).dimension);
  };
  for (std::size_t row = 0; row < g.group_of.size(); ++row) {
    if (g.group_of[row] < 0) continue;
    is_used[dimension_of(g.kind_of[row])][static_cast<std::size_t>(g.group_of[row])] = true;
  }
  for (const std::int32_t group : g.group_of_vertex)
    is_used[0][static_cast<std::size_t>(group)] = true;
  for (std::size_t d = 0; d < 4; ++d) number_groups(r, g, d, is_used[d]);
  std::size_t row = 0;
  for (const CellKind kind : all_cell_kinds) {
    const std::size_t d = dimension_of(kind);
    std::vector<std::int32_t>& region = columns_of(mesh, kind).region;
    const auto give = [&](std::int32_t group) {
      region.push_back(group < 0 ? 0 : g.groups[static_cast<std::size_t>(group)].region[d]);
    };
    if (kind == CellKind::vertex) {
      for (const std::int32_t group : g.group_of_vertex) give(group);
    }
    for (; kind != CellKind::vertex && row < g.group_of.size() && g.kind_of[row] == kind; ++row)
      give(g.group_of[row]);
    if (std::ranges::all_of(region, [](auto x) { return x == 0; })) region.clear();
  }
}

void warn(UnvReader& r, std::string_view code, std::size_t count, std::string text,
          std::string_view remedy) {
  if (count == 0) return;
  r.draft.findings.push_back({.code = std::string(code),
                              .severity = Severity::warning,
                              .count = count,
                              .text = std::move(text),
                              .remedy = std::string(remedy)});
}

}  // namespace

void read_unv_groups(UnvReader& r) {
  Groups g;
  index_elements(r, g);
  for (const UnvSection& section : r.sections) {
    UnvLines lines{.text = r.draft.text, .next = section.begin, .end = section.end};
    const std::int64_t n = section.number;
    if (n == 2435 || n == 2452 || n == 2467 || n == 2477) read_groups(r, g, lines, 4);
    if (n == 2417 || n == 2429 || n == 2430 || n == 2432) read_groups(r, g, lines, 2);
  }
  give_regions(r, g);
  const auto several =
      static_cast<std::size_t>(std::count(g.has_several.begin(), g.has_several.end(), true));
  warn(r, "several_sets", several,
       fmt::format("{} in several groups: the first of each is kept",
                   counted(several, "element is", "elements are")),
       "nothing to do, if the first groups are the ones you want");
  const bool is_short = !r.draft.volume_cells.empty() || !r.draft.surface_cells.empty();
  warn(r, "unknown_member", is_short ? 0 : g.unknown,
       fmt::format("groups name {} not there",
                   counted(g.unknown, "node or element that is", "nodes or elements that are")),
       "nothing to do, if they were left out on purpose");
  warn(r, "skipped_members", g.others,
       fmt::format("{} left out: neither nodes nor elements",
                   counted(g.others, "member of a group is", "members of groups are")),
       "nothing to do, unless they matter");
}

}  // namespace sunder::io
