// SPDX-License-Identifier: MIT
// Internal to the MSH reader: the state that its sections share.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "topology/io/draft.hpp"
#include "topology/io/text/number_index.hpp"
#include "topology/io/text/number_source.hpp"
#include "topology/io/text/row_watch.hpp"

namespace sunder::io {

/// An entity that lies in a part of a partitioned mesh.
struct MshPart {
  /// The entity that it is a part of, where that has its dimension; else the entity itself.
  std::int32_t parent = 0;
  std::int64_t partition = 0;
};

struct MshReader {
  NumberSource in;
  Draft draft;
  RowWatch watch;
  /// 0 until the first section was read, then 10, 20, 40 or 41.
  int version = 0;
  /// Sizes and numbers of version 4.1 have 4 bytes in binary data, as 32-bit programs write them.
  bool has_short_sizes = false;
  bool has_nodes = false;
  bool has_elements = false;
  /// First physical group of each entity, by dimension (4.0 and 4.1).
  std::array<std::unordered_map<std::int64_t, std::int32_t>, 4> physical_of_entity;
  /// Whether some entity belongs to further groups, which one label cannot say.
  std::size_t entities_of_several_groups = 0;
  /// Where entities of a partitioned mesh lie (4.0 and 4.1), by dimension.
  std::array<std::unordered_map<std::int64_t, MshPart>, 4> part_of_entity;
  /// Of each cell, by kind; empty where the file has no partitions.
  std::array<std::vector<std::int64_t>, cell_kinds> partition;
  /// Where $PhysicalNames begins, and whether it has names of no dimension, as MSH 2.0 writes them.
  std::size_t names_at = 0;
  bool has_plain_names = false;
  NumberIndex nodes;
  /// The row that a message needs the place of, and that place.
  std::size_t sought_node = static_cast<std::size_t>(-1);
  std::size_t sought_at = 0;
  /// Of cells by kind; made when the first data of cells come.
  std::optional<std::array<NumberIndex, cell_kinds>> cells;
  /// Numbers in the columns of data so far, those that no section gave too.
  std::size_t data_numbers = 0;
};

/// Where the next row begins, which is watched in text.
inline std::size_t begin_row(MshReader& r) {
  const std::size_t at = place_of_next(r.in);
  begin_row(r.watch, at);
  return at;
}

inline void end_row(MshReader& r) {
  if (!r.in.is_binary) end_row(r.watch, r.in.s);
}

/// An integer that binary files store in 4 bytes.
inline std::int64_t read_int(MshReader& r, std::string_view what) {
  return read_next<std::int64_t, std::int32_t>(r.in, what);
}

inline std::int32_t read_tag(MshReader& r, std::string_view what) {
  return read_next<std::int32_t>(r.in, what);
}

/// The bytes of a number of a node or an element: 4 before version 4.1, then those of a size.
inline std::size_t bytes_of_number(const MshReader& r) {
  return r.version >= 41 && !r.has_short_sizes ? 8 : 4;
}

inline std::int64_t read_number_of_cell(MshReader& r, std::string_view what) {
  if (bytes_of_number(r) == 8) return read_next<std::int64_t>(r.in, what);
  if (r.version >= 41) return read_next<std::int64_t, std::uint32_t>(r.in, what);
  return read_int(r, what);
}

/// A size of versions 4: as read_bounded.
inline std::size_t read_size(MshReader& r, std::string_view what, std::size_t least_text,
                             std::size_t least_raw) {
  return r.has_short_sizes ? read_bounded<std::uint32_t>(r.in, what, least_text, least_raw)
                           : read_bounded<std::uint64_t>(r.in, what, least_text, least_raw);
}

/// The physical and elementary tags of one element, and its partition; 0 for none.
struct MshTags {
  std::int32_t physical = 0;
  std::int32_t entity = 0;
  std::int64_t partition = 0;
};

/// $PhysicalNames, $Entities and $PartitionedEntities, to the end of their rows.
void read_msh_names(MshReader& r);
void read_msh_entities(MshReader& r);
void read_msh_partitioned(MshReader& r);

/// Names without a dimension go to the dimensions that have cells of the group.
void name_msh_groups(MshReader& r);

/// The partitions of the cells become a column of data.
void add_msh_partitions(MshReader& r);

/// $Nodes (or $NOD) and $Elements (or $ELM), to the end of their rows.
void read_msh_nodes(MshReader& r);
void read_msh_elements(MshReader& r);

/// $NodeData and $ElementData, to the end of their rows.
void read_msh_data(MshReader& r, bool of_nodes);

}  // namespace sunder::io
