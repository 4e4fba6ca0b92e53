// SPDX-License-Identifier: MIT
// Reading Gmsh's MSH 2.x and 4.1 in ASCII, section by section.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "topology/io/msh.hpp"
#include "topology/io/msh_elements.hpp"
#include "topology/io/scan.hpp"

namespace sunder::io {
namespace {

struct MshReader {
  Scanner s;
  Draft draft;
  /// 0 until $MeshFormat was read, then 2 or 4.
  int version = 0;
  bool has_nodes = false;
  bool has_elements = false;
  /// Region by the physical group, and by the volume entity, of each tetrahedron.
  std::vector<std::int32_t> physical;
  std::vector<std::int32_t> entity;
  /// MSH 4.1: first physical group of each volume entity.
  std::unordered_map<std::int64_t, std::int32_t> physical_of_volume;
  /// Row of each node number: an array where the numbers are dense, else a hash.
  std::int64_t lowest_number = 0;
  std::vector<std::int64_t> dense_row;
  std::unordered_map<std::int64_t, std::int64_t> sparse_row;
};

std::int32_t read_tag(MshReader& r, std::string_view what) {
  return read_number<std::int32_t>(r.s, what);
}

std::int64_t row_of(const MshReader& r, std::int64_t number) {
  if (!r.dense_row.empty()) {
    const std::uint64_t place =
        static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(r.lowest_number);
    return place < r.dense_row.size() ? r.dense_row[place] : -1;
  }
  const auto found = r.sparse_row.find(number);
  return found == r.sparse_row.end() ? -1 : found->second;
}

/// Fills the table from node numbers to rows; `at` is the section's place.
void index_nodes(MshReader& r, std::size_t at) {
  const std::vector<std::int64_t>& numbers = r.draft.mesh.source_point_id;
  if (numbers.empty()) return;
  const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
  r.lowest_number = *low;
  const std::uint64_t spread = static_cast<std::uint64_t>(*high) - static_cast<std::uint64_t>(*low);
  const bool dense = spread / 4 <= numbers.size();
  if (dense) r.dense_row.assign(spread + 1, -1);
  for (std::size_t row = 0; row < numbers.size(); ++row) {
    if (const std::int64_t before = row_of(r, numbers[row]); before >= 0) {
      fail(r.s.text, at,
           {.code = "duplicate_id",
            .ids = {before, static_cast<std::int64_t>(row)},
            .text = fmt::format("the points in rows {} and {} of this section have the same number "
                                "{}",
                                before, row, numbers[row]),
            .remedy = "give every point its own number"});
    }
    if (dense) {
      r.dense_row[static_cast<std::uint64_t>(numbers[row]) -
                  static_cast<std::uint64_t>(r.lowest_number)] = static_cast<std::int64_t>(row);
    } else {
      r.sparse_row.emplace(numbers[row], static_cast<std::int64_t>(row));
    }
  }
}

const ElementType& read_element_type(MshReader& r) {
  skip_blanks(r.s);
  const std::size_t at = r.s.at;
  const auto number = read_number<std::int64_t>(r.s, "an element type");
  for (const ElementType& type : element_types) {
    if (type.number == number) return type;
  }
  fail(r.s.text, at,
       {.code = "unknown_cell_type",
        .text = fmt::format("element type {} is not known", number),
        .remedy = "save the mesh with first-order elements only"});
}

void read_format(MshReader& r) {
  skip_blanks(r.s);
  const std::size_t at = r.s.at;
  const std::string_view version = next_word(r.s);
  if (version == "4.1") {
    r.version = 4;
  } else if (version == "2" || version.substr(0, 2) == "2.") {
    r.version = 2;
  } else {
    if (version.empty()) fail_expected(r.s, "a format version");
    fail(r.s.text, at,
         {.code = "unknown_version",
          .text = fmt::format("MSH version {} is not read: 2.x and 4.1 are", in_quotes(version)),
          .remedy = "convert it: gmsh FILE -save -format msh41 -o NEW.msh"});
  }
  const auto binary = read_number<std::int64_t>(r.s, "0 (ASCII) or 1 (binary)");
  if (binary != 0) {
    fail(r.s.text, at,
         {.code = "binary_not_read",
          .text = fmt::format("this is a binary MSH {} file: only ASCII is read", version),
          .remedy = "convert it: gmsh FILE -save -format msh41 -bin 0 -o NEW.msh"});
  }
  read_number<std::int64_t>(r.s, "the size of a floating-point number");
  expect_word(r.s, "$EndMeshFormat");
}

void read_physical_names(MshReader& r) {
  const std::size_t names = read_count(r.s, "physical names", 6);
  for (std::size_t i = 0; i < names; ++i) {
    const auto dimension = read_number<std::int64_t>(r.s, "the dimension of a physical group");
    const std::int32_t tag = read_tag(r, "the number of a physical group");
    const std::size_t at = r.s.at;
    const std::string_view name = rest_of_line(r.s);
    if (name.size() < 2 || name.front() != '"' || name.back() != '"') {
      fail(r.s.text, at,
           {.code = "bad_name",
            .text = fmt::format("{} stands where a name in double quotes was expected",
                                in_quotes(name)),
            .remedy = "write the name as \"name\""});
    }
    if (dimension == 3) {
      r.draft.mesh.region_name[tag] = std::string(name.substr(1, name.size() - 2));
    }
  }
  expect_word(r.s, "$EndPhysicalNames");
}

/// MSH 4.1: of the entities only the volumes' physical groups are kept.
void read_entities(MshReader& r) {
  std::array<std::size_t, 4> entities;
  for (std::size_t& n : entities) n = read_count(r.s, "entities", 8);
  for (std::size_t dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t i = 0; i < entities[dimension]; ++i) {
      const std::int32_t tag = read_tag(r, "an entity's number");
      skip_words(r.s, dimension == 0 ? 3 : 6, "an entity's extent");
      const std::size_t groups = read_count(r.s, "physical groups", 2);
      for (std::size_t g = 0; g < groups; ++g) {
        const std::int32_t group = read_tag(r, "a physical group");
        if (dimension == 3 && g == 0) r.physical_of_volume[tag] = group;
      }
      if (dimension == 0) continue;
      skip_words(r.s, read_count(r.s, "bounding entities", 2), "a bounding entity");
    }
  }
  expect_word(r.s, "$EndEntities");
}

Point read_point(MshReader& r) {
  constexpr std::string_view what = "a coordinate";
  const double x = read_number<double>(r.s, what);
  const double y = read_number<double>(r.s, what);
  const double z = read_number<double>(r.s, what);
  return {x, y, z};
}

void read_nodes_2(MshReader& r) {
  const std::size_t nodes = read_count(r.s, "nodes", 8);
  r.draft.mesh.points.reserve(nodes);
  r.draft.mesh.source_point_id.reserve(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    skip_blanks(r.s);
    const std::size_t at = r.s.at;
    r.draft.mesh.source_point_id.push_back(read_number<std::int64_t>(r.s, "a node number"));
    add_point(r.draft, read_point(r), at);
  }
}

/// Sums over blocks are checked against the total that the section announced.
void check_total(MshReader& r, std::string_view what, std::size_t announced, std::size_t found) {
  if (announced == found) return;
  fail(r.s.text, r.s.at,
       {.code = "wrong_count",
        .text = fmt::format("the section announces {} {}, but its blocks hold {}", announced, what,
                            found),
        .remedy = "correct the counts, or write the file again"});
}

void read_nodes_4(MshReader& r) {
  const std::size_t blocks = read_count(r.s, "blocks of nodes", 8);
  const std::size_t nodes = read_count(r.s, "nodes", 8);
  skip_words(r.s, 2, "the lowest and highest node number");
  TetMesh& mesh = r.draft.mesh;
  mesh.points.reserve(nodes);
  mesh.source_point_id.reserve(nodes);
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto dimension = read_number<std::int64_t>(r.s, "the dimension of an entity (0 to 3)");
    read_tag(r, "an entity's number");
    const auto parametric = read_number<std::int64_t>(r.s, "0 or 1 (parametric)");
    const std::size_t in_block = read_count(r.s, "nodes", 8);
    for (std::size_t i = 0; i < in_block; ++i) {
      mesh.source_point_id.push_back(read_number<std::int64_t>(r.s, "a node number"));
    }
    for (std::size_t i = 0; i < in_block; ++i) {
      skip_blanks(r.s);
      const std::size_t at = r.s.at;
      add_point(r.draft, read_point(r), at);
      if (parametric != 0) {
        skip_words(r.s, static_cast<std::size_t>(std::clamp<std::int64_t>(dimension, 0, 3)),
                   "a parametric coordinate");
      }
    }
  }
  check_total(r, "nodes", nodes, mesh.points.size());
}

void read_tetrahedron(MshReader& r) {
  FileTetrahedron tetrahedron;
  tetrahedron.at = r.s.at;
  for (int k = 0; k < 4; ++k) {
    tetrahedron.numbers[k] = read_number<std::int64_t>(r.s, "a node number");
    tetrahedron.rows[k] = row_of(r, tetrahedron.numbers[k]);
  }
  add_tetrahedron(r.draft, tetrahedron);
}

void read_elements_2(MshReader& r) {
  const std::size_t elements = read_count(r.s, "elements", 8);
  for (std::size_t i = 0; i < elements; ++i) {
    skip_blanks(r.s);
    const std::size_t at = r.s.at;
    const auto number = read_number<std::int64_t>(r.s, "an element number");
    const ElementType& type = read_element_type(r);
    const std::size_t tags = read_count(r.s, "tags", 2);
    if (type.number != tetrahedron_type) {
      add_other_cells(r.draft, type.name, type.dimension, 1, at);
      skip_words(r.s, tags + type.nodes, "a node number");
      continue;
    }
    r.draft.mesh.source_tetrahedron_id.push_back(number);
    r.physical.push_back(tags > 0 ? read_tag(r, "a physical group") : 0);
    r.entity.push_back(tags > 1 ? read_tag(r, "a volume's number") : 0);
    if (tags > 2) skip_words(r.s, tags - 2, "a tag");
    read_tetrahedron(r);
  }
}

void read_elements_4(MshReader& r) {
  const std::size_t blocks = read_count(r.s, "blocks of elements", 8);
  const std::size_t elements = read_count(r.s, "elements", 4);
  skip_words(r.s, 2, "the lowest and highest element number");
  std::size_t found = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    skip_blanks(r.s);
    const std::size_t at = r.s.at;
    const auto dimension = read_number<std::int64_t>(r.s, "the dimension of an entity (0 to 3)");
    const std::int32_t tag = read_tag(r, "an entity's number");
    const ElementType& type = read_element_type(r);
    const std::size_t in_block = read_count(r.s, "elements", 2 * (1 + type.nodes));
    found += in_block;
    if (type.number != tetrahedron_type) {
      add_other_cells(r.draft, type.name, type.dimension, in_block, at);
      skip_words(r.s, in_block * (1 + type.nodes), "a node number");
      continue;
    }
    const auto group = dimension == 3 ? r.physical_of_volume.find(tag) : r.physical_of_volume.end();
    const std::int32_t physical = group == r.physical_of_volume.end() ? 0 : group->second;
    r.physical.insert(r.physical.end(), in_block, physical);
    r.entity.insert(r.entity.end(), in_block, tag);
    r.draft.mesh.tetrahedra.reserve(r.draft.mesh.tetrahedra.size() + in_block);
    for (std::size_t i = 0; i < in_block; ++i) {
      r.draft.mesh.source_tetrahedron_id.push_back(
          read_number<std::int64_t>(r.s, "an element number"));
      read_tetrahedron(r);
    }
  }
  check_total(r, "elements", elements, found);
}

[[noreturn]] void fail_order(MshReader& r, std::size_t at, std::string text, std::string remedy) {
  fail(r.s.text, at,
       {.code = "wrong_section_order", .text = std::move(text), .remedy = std::move(remedy)});
}

void read_nodes(MshReader& r, std::size_t at) {
  if (r.has_nodes) fail_order(r, at, "a second $Nodes section", "join the two sections");
  r.has_nodes = true;
  r.version == 2 ? read_nodes_2(r) : read_nodes_4(r);
  expect_word(r.s, "$EndNodes");
  index_nodes(r, at);
}

void read_elements(MshReader& r, std::size_t at) {
  if (!r.has_nodes) {
    fail_order(r, at, "$Elements stands before $Nodes", "move the section behind $EndNodes");
  }
  if (r.has_elements) fail_order(r, at, "a second $Elements section", "join the two sections");
  r.has_elements = true;
  r.version == 2 ? read_elements_2(r) : read_elements_4(r);
  expect_word(r.s, "$EndElements");
}

/// Periodic links, partitions, post-processing data and whatever else comes.
void skip_section(MshReader& r, std::string_view name, std::size_t at) {
  const std::string end = fmt::format("$End{}", name.substr(1));
  const std::size_t found = r.s.text.find(end, r.s.at);
  if (found == std::string_view::npos) {
    fail(r.s.text, at,
         {.code = "truncated_file",
          .text = fmt::format("section {} has no {}", in_quotes(name), in_quotes(end)),
          .remedy = "the file was cut short, or the section's name is wrong"});
  }
  r.s.at = found + end.size();
}

void read_section(MshReader& r, std::string_view name, std::size_t at) {
  if (name.front() != '$' || name.size() < 2) {
    fail(r.s.text, at,
         {.code = "unknown_section",
          .text = fmt::format("{} stands where a section's name ($Nodes, ...) was expected",
                              in_quotes(name)),
          .remedy = "delete what stands outside the sections, or write the file again"});
  }
  if (name == "$MeshFormat" && r.version == 0) return read_format(r);
  if (name == "$Comments") return skip_section(r, name, at);
  if (r.version == 0) {
    if (name == "$NOD" || name == "$PostFormat") {
      fail(
          r.s.text, at,
          {.code = "unknown_version",
           .text = fmt::format("a file that starts with {} is not read: MSH 2.x and 4.1 are", name),
           .remedy = "convert it: gmsh FILE -save -format msh41 -o NEW.msh"});
    }
    fail_order(r, at, fmt::format("{} stands before $MeshFormat", in_quotes(name)),
               "put $MeshFormat first");
  }
  if (name == "$PhysicalNames") return read_physical_names(r);
  if (name == "$Entities" && r.version == 4) {
    if (r.has_elements) {
      fail_order(r, at, "$Entities stands behind $Elements", "move it before $Nodes");
    }
    return read_entities(r);
  }
  if (name == "$Nodes") return read_nodes(r, at);
  if (name == "$Elements") return read_elements(r, at);
  skip_section(r, name, at);
}

/// Physical groups where the file has any, else the volume entities where there are several.
void choose_regions(MshReader& r) {
  const auto varied = [](const std::vector<std::int32_t>& v) {
    return std::adjacent_find(v.begin(), v.end(), std::not_equal_to<>()) != v.end();
  };
  const bool grouped = r.physical_of_volume.size() > 0 ||
                       std::any_of(r.physical.begin(), r.physical.end(), [](auto p) { return p; });
  if (grouped) {
    r.draft.mesh.region = std::move(r.physical);
  } else if (varied(r.entity)) {
    r.draft.mesh.region = std::move(r.entity);
  }
}

}  // namespace

Draft read_msh(std::string_view text) {
  MshReader r{.s = {.text = text}, .draft = {.text = text}};
  while (!peek_word(r.s).empty()) {
    const std::size_t at = r.s.at;
    read_section(r, next_word(r.s), at);
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
  choose_regions(r);
  return std::move(r.draft);
}

}  // namespace sunder::io
