// SPDX-License-Identifier: MIT
// Universal files written: nodes (2411), elements (2412), a group for each region (2467).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "topology/base/sort_unique.hpp"
#include "topology/io/unv/unv.hpp"
#include "topology/io/unv/unv_reader.hpp"

namespace sunder::io {
namespace {

/// The kinds that are written, by the numbers that Gmsh and Salome read too.
constexpr UnvType written_types[] = {
    {21, CellKind::edge},          {24, CellKind::edge3},          {91, CellKind::triangle},
    {92, CellKind::triangle6},     {94, CellKind::quad4},          {95, CellKind::quad8},
    {111, CellKind::tetrahedron},  {118, CellKind::tetrahedron10}, {115, CellKind::hexahedron8},
    {116, CellKind::hexahedron20}, {112, CellKind::prism6},        {113, CellKind::prism15}};

/// Columns of ten characters, a blank before each number.
constexpr std::int64_t highest_number = 999'999'999;

bool are_held(std::vector<std::int64_t> numbers, std::size_t rows) {
  if (numbers.size() != rows) return false;
  sort_unique(numbers);
  return numbers.size() == rows &&
         (rows == 0 || (numbers.front() > 0 && numbers.back() <= highest_number));
}

void put_real(std::string& out, double x) {
  const std::size_t before = out.size();
  fmt::format_to(std::back_inserter(out), "{:25.16e}", x);
  const std::size_t exponent = out.find('e', before);
  if (exponent != std::string::npos) out[exponent] = 'D';
}

template <class Numbers>
void put_integers(std::string& out, const Numbers& numbers) {
  constexpr std::size_t in_line = 8;
  std::size_t n = 0;
  for (const std::int64_t number : numbers) {
    if (n > 0 && n % in_line == 0) out += '\n';
    fmt::format_to(std::back_inserter(out), "{:10}", number);
    ++n;
  }
  out += '\n';
}

void begin_section(std::string& out, int number) {
  fmt::format_to(std::back_inserter(out), "    -1\n{:6}\n", number);
}

void end_section(std::string& out) { out += "    -1\n"; }

/// A group's members while it is written: pairs of type and number.
void put_group(std::string& out, std::int32_t region, std::string_view name,
               const std::vector<std::int64_t>& members) {
  put_integers(out, std::array<std::int64_t, 8>{region, 0, 0, 0, 0, 0, 0,
                                                static_cast<std::int64_t>(members.size() / 4)});
  out += name;
  out += '\n';
  if (!members.empty()) put_integers(out, members);
}

std::string name_of_group(const FileMesh& mesh, std::size_t dimension, std::int32_t region) {
  const auto& names = mesh.region_name[dimension];
  const auto found = names.find(region);
  const bool is_held = found != names.end() && region != 0 && is_unv_name(found->second);
  return is_held ? found->second : fmt::format("region_{}", region);
}

}  // namespace

bool is_unv_name(std::string_view name) {
  constexpr std::size_t longest = 40;
  const auto is_plain = [](char c) { return c >= ' ' && c <= '~'; };
  return !name.empty() && name.size() <= longest && std::ranges::all_of(name, is_plain) &&
         name.front() != ' ' && name.back() != ' ' && name != "-1" && !name.starts_with("region_");
}

HeldNumbers unv_holds(const FileMesh& mesh) {
  std::vector<std::int64_t> cells;
  std::size_t rows = 0;
  for (const CellKind kind : all_cell_kinds) {
    if (kind == CellKind::vertex) continue;
    const std::vector<std::int64_t>& own = columns_of(mesh, kind).source_id;
    cells.insert(cells.end(), own.begin(), own.end());
    rows += rows_of(mesh, kind).count;
  }
  return {are_held(mesh.source_point_id, mesh.points.size()), are_held(std::move(cells), rows)};
}

std::vector<Finding> lost_in_unv(const FileMesh& mesh) {
  std::size_t lost = 0;
  for (std::size_t d = 0; d < mesh.region_name.size(); ++d) {
    for (const auto& [region, name] : mesh.region_name[d]) {
      bool is_used = false;
      for (const CellKind kind : all_cell_kinds) {
        if (traits_of(kind).dimension != static_cast<int>(d)) continue;
        is_used = is_used || std::ranges::find(columns_of(mesh, kind).region, region) !=
                                 columns_of(mesh, kind).region.end();
      }
      lost += !is_used || region == 0 || !is_unv_name(name);
    }
  }
  if (lost == 0) return {};
  return {{.code = "names_lost",
           .severity = Severity::warning,
           .count = lost,
           .text =
               "UNV has names of at most 40 plain characters, for regions that have cells: others "
               "are lost",
           .remedy = "give shorter names, or write another format than UNV to keep them"}};
}

std::string write_unv(const FileMesh& mesh) {
  std::string out;
  out.reserve(118 * mesh.points.size() + 110 * cell_count(mesh));
  const HeldNumbers own = unv_holds(mesh);
  const auto node = [&](std::size_t row) {
    return own.points ? mesh.source_point_id[row] : static_cast<std::int64_t>(row) + 1;
  };
  begin_section(out, 2411);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    put_integers(out, std::array<std::int64_t, 4>{node(i), 1, 1, 11});
    for (const double x : mesh.points[i]) put_real(out, x);
    out += '\n';
  }
  end_section(out);

  // By dimension and region: the members of the groups.
  std::array<std::map<std::int32_t, std::vector<std::int64_t>>, 4> groups;
  std::int64_t next = 1;
  begin_section(out, 2412);
  std::vector<std::int64_t> nodes;
  for (const UnvType& type : written_types) {
    const CellRows rows = rows_of(mesh, type.kind);
    const CellColumns& cells = columns_of(mesh, type.kind);
    const std::vector<std::int32_t>& label = label_of(cells);
    const std::span<const std::uint8_t> order = unv_order(type.kind);
    const auto d = static_cast<std::size_t>(traits_of(type.kind).dimension);
    for (std::size_t i = 0; i < rows.count; ++i) {
      const std::int64_t number = own.cells ? cells.source_id[i] : next++;
      const auto count = static_cast<std::int64_t>(rows.nodes);
      put_integers(out, std::array<std::int64_t, 6>{number, type.number, 1, 1, 7, count});
      if (is_unv_beam(type.number)) put_integers(out, std::array<std::int64_t, 3>{});
      nodes.clear();
      for (std::size_t k = 0; k < rows.nodes; ++k) {
        nodes.push_back(node(rows[i][order.empty() ? k : order[k]]));
      }
      put_integers(out, nodes);
      if (!label.empty() && label[i] != 0) {
        auto& members = groups[d][label[i]];
        members.insert(members.end(), {8, number, 0, 0});
      }
    }
  }
  end_section(out);

  begin_section(out, 2467);
  // Vertices are groups of nodes, one for each run of a region: they come back in their order.
  const std::vector<std::int32_t>& label = label_of(mesh.vertices);
  const auto label_at = [&](std::size_t i) { return label.empty() ? 0 : label[i]; };
  const std::size_t vertices = mesh.vertices.corners.size();
  for (std::size_t i = 0; i < vertices;) {
    const std::int32_t region = label_at(i);
    std::vector<std::int64_t> members;
    for (; i < vertices && label_at(i) == region; ++i) {
      members.insert(members.end(), {7, node(mesh.vertices.corners[i][0]), 0, 0});
    }
    put_group(out, region, name_of_group(mesh, 0, region), members);
  }
  for (std::size_t d = 1; d < groups.size(); ++d) {
    for (const auto& [region, members] : groups[d]) {
      put_group(out, region, name_of_group(mesh, d, region), members);
    }
  }
  end_section(out);
  return out;
}

}  // namespace sunder::io
