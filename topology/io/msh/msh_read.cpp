// SPDX-License-Identifier: MIT
// Reading Gmsh's MSH 1, 2.x, 4.0 and 4.1, in text and binary: the sections, one after the other.
#include <fmt/format.h>

#include <algorithm>

#include "topology/base/counted.hpp"
#include "topology/io/msh/msh.hpp"
#include "topology/io/msh/msh_reader.hpp"
#include "topology/io/nastran/nastran.hpp"
#include "topology/io/usual_entities.hpp"

namespace sunder::io {
namespace {

int version_of(std::string_view word) {
  if (word == "4.1") return 41;
  if (word == "4" || word == "4.0") return 40;
  if (word == "2" || word.substr(0, 2) == "2.") return 20;
  return 0;
}

void read_format(MshReader& r) {
  Scanner& s = r.in.s;
  skip_blanks(s);
  const std::size_t at = s.at;
  const std::string_view version = next_word(s);
  if (version.empty()) fail_expected(s, "a format version");
  r.version = version_of(version);
  if (r.version == 0) {
    fail(s.text, at,
         {.code = "unknown_version",
          .text = fmt::format("MSH version {} is not read: 1, 2.x, 4.0 and 4.1 are",
                              in_quotes(version)),
          .remedy = "convert it: gmsh FILE -save -format msh41 -o NEW.msh"});
  }
  const std::size_t kind_at = s.at;
  const auto binary = read_number<std::int64_t>(s, "0 (ASCII) or 1 (binary)");
  const auto size = read_number<std::int64_t>(s, "the size of numbers in bytes");
  // Of sizes in version 4.1, of real numbers before, for which Gmsh's manual allows 8 alone.
  r.has_short_sizes = binary == 1 && size == 4 && r.version == 41;
  const bool fits = size == 8 || (size == 4 && (binary == 0 || r.version == 41));
  if (binary < 0 || binary > 1 || !fits) {
    fail(s.text, kind_at,
         {.code = "unknown_version",
          .text = fmt::format("MSH of kind {} with numbers of {} bytes is not read: kind 0 (text) "
                              "is, and kind 1 (binary) with 8 bytes, in version 4.1 also with 4",
                              binary, size),
          .remedy = "write the file again with a 64-bit Gmsh, or as text"});
  }
  if (binary == 1) {
    rest_of_line(s);
    r.in.is_binary = true;
    const auto one = read_raw<std::int32_t>(r.in, "the number 1 that tells the byte order");
    r.in.swap = byte_swapped(one) == 1;
    if (one != 1 && !r.in.swap) {
      fail(s.text, at,
           {.code = "bad_number",
            .text = fmt::format("{} stands where the number 1 tells the byte order", one),
            .remedy = "the file is damaged: copy or write it again (as binary, not as text)"});
    }
    r.draft.text = {};  // there are no lines to count
  }
  expect_word(s, "$EndMeshFormat");
}

[[noreturn]] void fail_order(MshReader& r, std::size_t at, std::string text, std::string remedy) {
  fail(r.in.s.text, at,
       {.code = "wrong_section_order", .text = std::move(text), .remedy = std::move(remedy)});
}

/// Nothing but the line's end stands between a section's name and raw data.
void pass_line_end(MshReader& r) {
  if (r.in.is_binary) rest_of_line(r.in.s);
}

void read_nodes(MshReader& r, std::size_t at) {
  if (r.has_nodes) fail_order(r, at, "a second $Nodes section", "join the two sections");
  r.has_nodes = true;
  const std::size_t begin = r.in.s.at;
  read_msh_nodes(r);
  std::array<std::int64_t, 2> twice;
  const std::vector<std::int64_t>& numbers = r.draft.mesh.source_point_id;
  if (index_numbers(r.nodes, numbers, twice)) return;
  // Once more, for the line of the second.
  MshReader again{.in = r.in, .draft = {}};
  again.in.s.at = begin;
  again.version = r.version;
  again.sought_node = static_cast<std::size_t>(twice[1]);
  read_msh_nodes(again);
  fail(r.in.s.text, again.sought_at,
       {.code = "duplicate_id",
        .ids = {twice[0], twice[1]},
        .text = fmt::format("the points in rows {} and {} of the section have the same number {}",
                            twice[0], twice[1], numbers[static_cast<std::size_t>(twice[0])]),
        .remedy = "give every point its own number"});
}

void read_elements(MshReader& r, std::size_t at) {
  if (!r.has_nodes) {
    fail_order(r, at, "$Elements stands before $Nodes", "move the section behind $EndNodes");
  }
  if (r.has_elements) fail_order(r, at, "a second $Elements section", "join the two sections");
  r.has_elements = true;
  read_msh_elements(r);
}

/// Comments, and whatever else comes, which is reported.
void skip_section(MshReader& r, std::string_view name, std::size_t at) {
  Scanner& s = r.in.s;
  const std::string end = fmt::format("$End{}", name.substr(1));
  const std::size_t found = s.text.find(end, s.at);
  if (found == std::string_view::npos) {
    fail(s.text, at,
         {.code = "truncated_file",
          .text = fmt::format("section {} has no {}", in_quotes(name), in_quotes(end)),
          .remedy = "the file was cut short, or the section's name is wrong"});
  }
  s.at = found + end.size();
  if (name != "$Comments") add_skipped(r.draft, "sections", name, at);
}

void refuse_before_format(MshReader& r, std::string_view name, std::size_t at) {
  if (name == "$PostFormat") {
    fail(r.in.s.text, at,
         {.code = "unknown_version",
          .text = "a file that starts with $PostFormat holds a view, not a mesh",
          .remedy = "give the mesh itself (gmsh FILE -save -format msh41 -o NEW.msh)"});
  }
  fail_order(r, at, fmt::format("{} stands before $MeshFormat", in_quotes(name)),
             "put $MeshFormat first");
}

void read_section(MshReader& r, std::string_view name, std::size_t at) {
  if (name.front() != '$' || name.size() < 2) {
    fail(r.in.s.text, at,
         {.code = "unknown_section",
          .text = fmt::format("{} stands where a section's name ($Nodes, ...) was expected",
                              in_quotes(name)),
          .remedy = "delete what stands outside the sections, or write the file again"});
  }
  if (name == "$MeshFormat" && r.version == 0) return read_format(r);
  if (name == "$Comments") return skip_section(r, name, at);
  // Version 1 has no $MeshFormat.
  if (r.version == 0 && name == "$NOD") r.version = 10;
  if (r.version == 0) refuse_before_format(r, name, at);
  if (name == "$NOD" || name == "$Nodes") {
    pass_line_end(r);
    read_nodes(r, at);
    return expect_word(r.in.s, name == "$NOD" ? "$ENDNOD" : "$EndNodes");
  }
  if (name == "$ELM" || name == "$Elements") {
    pass_line_end(r);
    read_elements(r, at);
    return expect_word(r.in.s, name == "$ELM" ? "$ENDELM" : "$EndElements");
  }
  if (name == "$PhysicalNames") {
    read_msh_names(r);
    return expect_word(r.in.s, "$EndPhysicalNames");
  }
  const bool is_partitioned = name == "$PartitionedEntities";
  if ((name == "$Entities" || is_partitioned) && r.version >= 40) {
    if (r.has_elements) {
      fail_order(r, at, fmt::format("{} stands behind $Elements", name), "move it before $Nodes");
    }
    pass_line_end(r);
    is_partitioned ? read_msh_partitioned(r) : read_msh_entities(r);
    return expect_word(r.in.s, fmt::format("$End{}", name.substr(1)));
  }
  if (name == "$NodeData" || name == "$ElementData") {
    if (!r.has_elements) {
      fail_order(r, at, fmt::format("{} stands before $Elements", name),
                 "move the section to the file's end");
    }
    read_msh_data(r, name == "$NodeData");
    return expect_word(r.in.s, fmt::format("$End{}", name.substr(1)));
  }
  skip_section(r, name, at);
}

void read_sections(MshReader& r) {
  while (!peek_word(r.in.s).empty()) {
    const std::size_t at = r.in.s.at;
    read_section(r, next_word(r.in.s), at);
  }
}

/// A column that says nothing is dropped: groups that are all 0, entities that repeat the groups.
void drop_empty_labels(CellColumns& cells) {
  const auto none = [](const std::vector<std::int32_t>& labels) {
    return std::all_of(labels.begin(), labels.end(), [](std::int32_t x) { return x == 0; });
  };
  if (none(cells.region)) cells.region.clear();
  drop_usual_entities(cells);
}

}  // namespace

bool is_msh(std::string_view text) {
  Scanner s{text};
  const std::string_view name = next_word(s);
  if (!name.starts_with('$')) return false;
  constexpr std::string_view first_sections[] = {"$MeshFormat", "$Comments", "$NOD", "$PostFormat"};
  if (std::ranges::find(first_sections, name) != std::end(first_sections)) return true;
  // Comments of Nastran's bulk data begin with $ too: a section's name has an end that fits.
  return text.find(fmt::format("$End{}", name.substr(1)), s.at) != std::string_view::npos &&
         !is_nastran(text);
}

Draft read_msh(std::string_view text) {
  MshReader r{.in = {.s = {.text = text}}, .draft = {.text = text}};
  try {
    read_sections(r);
  } catch (ReadFailure& failure) {
    if (!r.in.is_binary) blame_row(r.watch, text, failure);
    throw;
  }
  for (const auto& [seen, name] :
       {std::pair{r.version != 0, "$MeshFormat"}, std::pair{r.has_nodes, "$Nodes"},
        std::pair{r.has_elements, "$Elements"}}) {
    if (seen) continue;
    fail(text, text.size(),
         {.code = "missing_section",
          .text = fmt::format("the file ends without a section {}", name),
          .remedy = "the file was cut short, or holds no mesh: write it again"});
  }
  name_msh_groups(r);
  add_msh_partitions(r);
  for (const CellKind kind : all_cell_kinds) drop_empty_labels(columns_of(r.draft.mesh, kind));
  if (r.entities_of_several_groups > 0) {
    r.draft.findings.push_back(
        {.code = "further_groups",
         .severity = Severity::warning,
         .count = r.entities_of_several_groups,
         .text = fmt::format(
             "{} to several physical groups: the first of each is kept",
             counted(r.entities_of_several_groups, "entity belongs", "entities belong")),
         .remedy = "give every entity one group, if the others matter"});
  }
  return std::move(r.draft);
}

}  // namespace sunder::io
