// SPDX-License-Identifier: MIT
// Nodes and elements of MSH, as each version lays them out.
#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "topology/io/msh/msh_elements.hpp"
#include "topology/io/msh/msh_reader.hpp"

namespace sunder::io {
namespace {

constexpr std::string_view node_number = "a node number";

Point read_point(MshReader& r) {
  constexpr std::string_view what = "a coordinate";
  const double x = read_next<double>(r.in, what);
  const double y = read_next<double>(r.in, what);
  const double z = read_next<double>(r.in, what);
  return {x, y, z};
}

/// Sums over blocks are checked against the total that the section announced.
void check_total(MshReader& r, std::string_view what, std::size_t announced, std::size_t found) {
  if (announced == found) return;
  fail(r.in.s.text, r.in.s.at,
       {.code = "wrong_count",
        .text = fmt::format("the section announces {} {}, but its blocks hold {}", announced, what,
                            found),
        .remedy = "correct the counts, or write the file again"});
}

/// Remembers where the node that is sought has its number.
void note_place(MshReader& r, std::size_t at) {
  if (r.draft.mesh.source_point_id.size() == r.sought_node) r.sought_at = at;
}

/// Versions 1 and 2: the count is text in binary files too.
void read_nodes_2(MshReader& r) {
  const std::size_t nodes = read_count(r.in.s, "nodes", 8);
  if (r.in.is_binary) rest_of_line(r.in.s);
  r.draft.mesh.points.reserve(nodes);
  r.draft.mesh.source_point_id.reserve(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    const std::size_t at = begin_row(r);
    note_place(r, at);
    r.draft.mesh.source_point_id.push_back(read_int(r, node_number));
    add_point(r.draft, read_point(r), at);
    end_row(r);
  }
}

/// The head before the nodes or elements of an entity: 4.0 gives its number first.
struct EntityHead {
  std::int64_t dimension = 0;
  std::int32_t tag = 0;
};
EntityHead read_entity_head(MshReader& r) {
  EntityHead head;
  const auto dimension = [&] {
    head.dimension = read_int(r, "the dimension of an entity (0 to 3)");
  };
  if (r.version == 41) dimension();
  head.tag = read_tag(r, "an entity's number");
  if (r.version == 40) dimension();
  return head;
}

void read_nodes_4(MshReader& r) {
  const std::size_t blocks = read_size(r, "blocks of nodes", 8, 16);
  const std::size_t nodes = read_size(r, "nodes", 8, 28);
  if (r.version == 41)
    skip_numbers(r.in, 2, 2 * bytes_of_number(r), "the lowest and highest node number");
  FileMesh& mesh = r.draft.mesh;
  mesh.points.reserve(nodes);
  mesh.source_point_id.reserve(nodes);
  const auto number = [&](std::size_t at) {
    note_place(r, at);
    mesh.source_point_id.push_back(read_number_of_cell(r, node_number));
  };
  for (std::size_t b = 0; b < blocks; ++b) {
    const EntityHead head = read_entity_head(r);
    const std::int64_t parametric = read_int(r, "0 or 1 (parametric)");
    const std::size_t in_block = read_size(r, "nodes", 8, 28);
    const auto parameters = static_cast<std::size_t>(
        parametric == 0 ? 0 : std::clamp<std::int64_t>(head.dimension, 0, 3));
    for (std::size_t i = 0; r.version == 41 && i < in_block; ++i) {
      number(begin_row(r));
      end_row(r);
    }
    for (std::size_t i = 0; i < in_block; ++i) {
      const std::size_t at = begin_row(r);
      if (r.version == 40) number(at);
      add_point(r.draft, read_point(r), at);
      skip_numbers(r.in, parameters, 8 * parameters, "a parametric coordinate");
      if (parameters > 0) add_skipped(r.draft, "parametric coordinates of points", {}, at);
      end_row(r);
    }
  }
  check_total(r, "nodes", nodes, mesh.points.size());
}

const ElementType& read_element_type(MshReader& r) {
  const std::size_t at = place_of_next(r.in);
  const std::int64_t number = read_int(r, "an element type");
  for (const ElementType& type : element_types) {
    if (type.number == number) return type;
  }
  fail(r.in.s.text, at,
       {.code = "unknown_cell_type",
        .text = fmt::format("element type {} is not known", number),
        .remedy = "save the mesh with first-order elements only"});
}

/// Partitions are kept from the first cell of a kind that has one.
void add_partition(MshReader& r, CellKind kind, std::size_t cells, std::int64_t partition) {
  std::vector<std::int64_t>& list = r.partition[index_of(kind)];
  if (list.empty() && partition == 0) return;
  list.resize(cells - 1, 0);
  list.push_back(partition);
}

/// The nodes of an element, behind its number and tags, into the list of its kind.
void read_element(MshReader& r, const ElementType& type, std::int64_t number, MshTags tags,
                  std::size_t at) {
  FileCell& cell = r.draft.cell;
  const std::size_t nodes = is_curved(type) ? traits_of(type.kind).nodes : type.nodes;
  const std::span<const std::uint8_t> order = msh_order(type.kind);
  cell.begin(nodes, at);
  for (std::size_t k = 0; k < nodes; ++k) {
    const std::size_t place = order.empty() ? k : order[k];
    const std::int64_t node = read_number_of_cell(r, node_number);
    cell.numbers[place] = node;
    cell.rows[place] = row_of(r.nodes, node);
  }
  const std::size_t others = type.nodes - nodes;
  skip_numbers(r.in, others, bytes_of_number(r) * others, node_number);
  add_cell(r.draft, type.kind, cell);
  CellColumns& cells = columns_of(r.draft.mesh, type.kind);
  cells.source_id.push_back(number);
  cells.region.push_back(tags.physical);
  cells.entity.push_back(tags.entity);
  add_partition(r, type.kind, cells.entity.size(), tags.partition);
}

/// Counts elements of too high an order.
void count_kind(MshReader& r, const ElementType& type, std::size_t count, std::size_t at) {
  if (is_curved(type)) add_curved_cells(r.draft, type.name, count, at);
}

/// Tags of version 2: physical group, entity, how many partitions, then those; ghosts are negative.
MshTags read_tags_2(MshReader& r, std::size_t tags, std::size_t at) {
  MshTags read;
  if (tags > 0) read.physical = read_tag(r, "a physical group");
  if (tags > 1) read.entity = read_tag(r, "an entity's number");
  if (tags > 2) read_int(r, "a number of partitions");
  if (tags > 3) read.partition = read_int(r, "a partition");
  if (tags <= 4) return read;
  skip_numbers(r.in, tags - 4, 4 * (tags - 4), "a tag");
  add_skipped(r.draft, "further tags of elements: ghosts of partitions", {}, at, tags - 4);
  return read;
}

void read_elements_1(MshReader& r) {
  const std::size_t elements = read_count(r.in.s, "elements", 8);
  for (std::size_t i = 0; i < elements; ++i) {
    const std::size_t at = begin_row(r);
    const std::int64_t number = read_int(r, "an element number");
    const ElementType& type = read_element_type(r);
    MshTags tags;
    tags.physical = read_tag(r, "a physical group");
    tags.entity = read_tag(r, "an entity's number");
    const std::int64_t nodes = read_int(r, "a number of nodes");
    if (nodes != static_cast<std::int64_t>(type.nodes)) {
      fail(r.in.s.text, at,
           {.code = "wrong_count",
            .text = fmt::format("{} nodes are announced for an element of type {}, which has {}",
                                nodes, type.number, type.nodes),
            .remedy = "correct the count, or write the file again"});
    }
    count_kind(r, type, 1, at);
    read_element(r, type, number, tags, at);
    end_row(r);
  }
}

/// In text every element has its own head, in binary data a head may stand for many.
void read_elements_2(MshReader& r) {
  const std::size_t elements = read_count(r.in.s, "elements", 8);
  if (r.in.is_binary) rest_of_line(r.in.s);
  for (std::size_t found = 0; found < elements;) {
    const std::size_t at = begin_row(r);
    std::int64_t number = r.in.is_binary ? 0 : read_int(r, "an element number");
    const ElementType& type = read_element_type(r);
    const std::size_t in_block =
        r.in.is_binary ? read_bounded<std::int32_t>(r.in, "elements", 8, 4 * (1 + type.nodes)) : 1;
    const std::size_t tags = read_bounded<std::int32_t>(r.in, "tags", 2, 4);
    if (in_block == 0 || in_block > elements - found) {
      check_total(r, "elements", elements, found + in_block + (in_block == 0));
    }
    found += in_block;
    count_kind(r, type, in_block, at);
    for (std::size_t i = 0; i < in_block; ++i) {
      if (r.in.is_binary) number = read_int(r, "an element number");
      const MshTags read = read_tags_2(r, tags, at);
      read_element(r, type, number, read, at);
    }
    end_row(r);
  }
}

void read_elements_4(MshReader& r) {
  const std::size_t blocks = read_size(r, "blocks of elements", 8, 16);
  const std::size_t elements = read_size(r, "elements", 4, 8);
  if (r.version == 41)
    skip_numbers(r.in, 2, 2 * bytes_of_number(r), "the lowest and highest element number");
  const std::size_t word = bytes_of_number(r);
  std::size_t found = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t at = place_of_next(r.in);
    const EntityHead head = read_entity_head(r);
    const ElementType& type = read_element_type(r);
    const std::size_t words = 1 + type.nodes;
    const std::size_t in_block = read_size(r, "elements", 2 * words, word * words);
    found += in_block;
    count_kind(r, type, in_block, at);
    MshTags tags{.entity = head.tag};
    const auto dimension = static_cast<std::size_t>(traits_of(type.kind).dimension);
    const auto& groups = r.physical_of_entity[dimension];
    if (const auto group = groups.find(head.tag); group != groups.end()) {
      tags.physical = group->second;
    }
    const auto& parts = r.part_of_entity[dimension];
    if (const auto part = parts.find(head.tag); part != parts.end()) {
      tags.entity = part->second.parent;
      tags.partition = part->second.partition;
    }
    for (std::size_t i = 0; i < in_block; ++i) {
      const std::size_t element_at = begin_row(r);
      const std::int64_t number = read_number_of_cell(r, "an element number");
      read_element(r, type, number, tags, element_at);
      end_row(r);
    }
  }
  check_total(r, "elements", elements, found);
}

}  // namespace

void read_msh_nodes(MshReader& r) { r.version < 40 ? read_nodes_2(r) : read_nodes_4(r); }

void read_msh_elements(MshReader& r) {
  r.version == 10 ? read_elements_1(r) : r.version < 40 ? read_elements_2(r) : read_elements_4(r);
}

}  // namespace sunder::io
