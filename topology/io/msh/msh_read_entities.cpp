// SPDX-License-Identifier: MIT
// Groups, entities and partitions of MSH.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "topology/base/sort_unique.hpp"
#include "topology/io/msh/msh_reader.hpp"

namespace sunder::io {
namespace {

[[noreturn]] void fail_name(MshReader& r, std::size_t at, std::string_view name,
                            std::int64_t dimension) {
  fail(r.in.s.text, at,
       {.code = "bad_name",
        .text = fmt::format("{} of dimension {} stands where a name in double quotes, of "
                            "dimension 0 to 3, was expected",
                            in_quotes(name), dimension),
        .remedy = "write the name as \"name\""});
}

/// The number of a group; the name may follow it without a blank.
std::int32_t read_group(MshReader& r) {
  Scanner& s = r.in.s;
  skip_blanks(s);
  const std::size_t end = std::min(s.text.find_first_of(" \t\r\n\"", s.at), s.text.size());
  Scanner number{s.text.substr(0, end), s.at};
  if (end == s.at || s.text.substr(end, 1) != "\"") number.text = s.text;
  const auto group = read_number<std::int32_t>(number, "the number of a physical group");
  s.at = number.at;
  return group;
}

/// Calls `take(dimension, group, name)` for each row of $PhysicalNames. MSH 2.0 gives the group
/// alone, later versions its dimension before it.
template <class Take>
void for_each_name(MshReader& r, Take take) {
  Scanner& s = r.in.s;
  const std::size_t names = read_count(s, "physical names", 4);
  for (std::size_t i = 0; i < names; ++i) {
    std::int32_t group = read_group(r);
    Scanner ahead = s;
    const bool has_dimension = !peek_word(ahead).starts_with('"');
    const std::int64_t dimension = has_dimension ? group : 3;
    if (has_dimension) group = read_group(r);
    const std::size_t at = s.at;
    const std::string_view name = rest_of_line(s);
    const bool is_quoted = name.size() >= 2 && name.front() == '"' && name.back() == '"';
    if (!is_quoted || dimension < 0 || dimension > 3) fail_name(r, at, name, dimension);
    take(has_dimension ? std::optional(static_cast<std::size_t>(dimension)) : std::nullopt, group,
         name.substr(1, name.size() - 2));
  }
}

/// The first group of an entity, 0 for none.
std::int32_t read_groups(MshReader& r) {
  const std::size_t groups = read_size(r, "physical groups", 2, 4);
  r.entities_of_several_groups += groups > 1;
  std::int32_t first = 0;
  for (std::size_t g = 0; g < groups; ++g) {
    const std::int32_t group = read_tag(r, "a physical group");
    if (g == 0) first = group;
  }
  return first;
}

void skip_extent(MshReader& r, std::size_t dimension) {
  // Version 4.0 gives points a box too.
  const std::size_t extent = dimension == 0 && r.version == 41 ? 3 : 6;
  skip_numbers(r.in, extent, 8 * extent, "an entity's extent");
}

void skip_boundary(MshReader& r, std::size_t dimension) {
  if (dimension == 0) return;
  const std::size_t bounding = read_size(r, "bounding entities", 2, 4);
  skip_numbers(r.in, bounding, 4 * bounding, "a bounding entity");
}

void set_group(MshReader& r, std::size_t dimension, std::int64_t entity, std::int32_t group) {
  if (group != 0) r.physical_of_entity[dimension][entity] = group;
}

/// One entity of a part: its parent, the partitions that it lies in, then the fields of an entity.
void read_part(MshReader& r, std::size_t dimension) {
  const std::size_t at = place_of_next(r.in);
  const std::int32_t tag = read_tag(r, "an entity's number");
  const std::int64_t parent_dimension = read_int(r, "the dimension of a parent entity");
  const std::int32_t parent = read_tag(r, "the number of a parent entity");
  const std::size_t partitions = read_size(r, "partitions", 2, 4);
  const bool is_whole = parent_dimension == static_cast<std::int64_t>(dimension);
  MshPart part{.parent = is_whole ? parent : tag};
  for (std::size_t i = 0; i < partitions; ++i) {
    const std::int64_t partition = read_int(r, "a partition");
    if (i == 0) part.partition = partition;
  }
  if (partitions > 1) {
    add_skipped(r.draft, "further partitions of entities on seams", {}, at, partitions - 1);
  }
  skip_extent(r, dimension);
  std::int32_t group = read_groups(r);
  auto& groups = r.physical_of_entity[dimension];
  if (const auto own = groups.find(parent); group == 0 && is_whole && own != groups.end()) {
    group = own->second;
  }
  set_group(r, dimension, tag, group);
  skip_boundary(r, dimension);
  r.part_of_entity[dimension][tag] = part;
}

}  // namespace

void read_msh_names(MshReader& r) {
  r.names_at = r.in.s.at;
  for_each_name(
      r, [&](std::optional<std::size_t> dimension, std::int32_t group, std::string_view name) {
        r.has_plain_names = r.has_plain_names || !dimension;
        if (dimension) r.draft.mesh.region_name[*dimension][group] = std::string(name);
      });
}

void read_msh_entities(MshReader& r) {
  std::array<std::size_t, 4> entities;
  for (std::size_t& n : entities) n = read_size(r, "entities", 8, 12);
  for (std::size_t dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t i = 0; i < entities[dimension]; ++i) {
      const std::int64_t tag = read_int(r, "an entity's number");
      skip_extent(r, dimension);
      set_group(r, dimension, tag, read_groups(r));
      skip_boundary(r, dimension);
    }
  }
}

void read_msh_partitioned(MshReader& r) {
  read_size(r, "partitions", 1, 1);
  const std::size_t at = place_of_next(r.in);
  const std::size_t ghosts = read_size(r, "ghost entities", 4, 8);
  skip_numbers(r.in, 2 * ghosts, 8 * ghosts, "a ghost entity");
  add_skipped(r.draft, "ghost entities of partitions", {}, at, ghosts);
  std::array<std::size_t, 4> entities;
  for (std::size_t& n : entities) n = read_size(r, "entities", 8, 12);
  for (std::size_t dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t i = 0; i < entities[dimension]; ++i) read_part(r, dimension);
  }
}

void name_msh_groups(MshReader& r) {
  if (!r.has_plain_names) return;
  FileMesh& mesh = r.draft.mesh;
  std::array<std::vector<std::int32_t>, 4> groups;
  for (const CellKind kind : all_cell_kinds) {
    auto& of_dimension = groups[static_cast<std::size_t>(traits_of(kind).dimension)];
    std::vector<std::int32_t> own = columns_of(mesh, kind).region;
    sort_unique(own);
    of_dimension.insert(of_dimension.end(), own.begin(), own.end());
  }
  for (std::vector<std::int32_t>& of_dimension : groups) sort_unique(of_dimension);
  // Once more: the cells had to be there.
  const std::size_t end = std::exchange(r.in.s.at, r.names_at);
  for_each_name(
      r, [&](std::optional<std::size_t> dimension, std::int32_t group, std::string_view name) {
        bool is_used = dimension.has_value();
        for (std::size_t d = 0; d < 4 && !dimension; ++d) {
          if (!std::ranges::binary_search(groups[d], group)) continue;
          mesh.region_name[d][group] = std::string(name);
          is_used = true;
        }
        if (!is_used) add_skipped(r.draft, "names of groups without elements", name, r.names_at);
      });
  r.in.s.at = end;
}

void add_msh_partitions(MshReader& r) {
  for (const CellKind kind : all_cell_kinds) {
    std::vector<std::int64_t>& partition = r.partition[index_of(kind)];
    if (std::ranges::all_of(partition, [](std::int64_t p) { return p == 0; })) continue;
    columns_of(r.draft.mesh, kind)
        .data.push_back({"partition", 1, NumberType::int32, std::move(partition)});
  }
}

}  // namespace sunder::io
