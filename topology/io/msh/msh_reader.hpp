// SPDX-License-Identifier: MIT
// Internal to the MSH reader: what its sections share.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "topology/io/draft.hpp"
#include "topology/io/text/number_index.hpp"
#include "topology/io/text/number_source.hpp"

namespace sunder::io {

struct MshReader {
  NumberSource in;
  Draft draft;
  /// 0 until the first section was read, then 10, 20, 40 or 41.
  int version = 0;
  bool has_nodes = false;
  bool has_elements = false;
  /// First physical group of each entity, by dimension (4.0 and 4.1).
  std::array<std::unordered_map<std::int64_t, std::int32_t>, 4> physical_of_entity;
  /// Whether some entity belongs to further groups, which one label cannot say.
  std::size_t entities_of_several_groups = 0;
  NumberIndex nodes;
  /// Of cells by kind; made when the first data of cells come.
  std::optional<std::array<NumberIndex, cell_kinds>> cells;
  /// Numbers in the columns of data so far, those that no section gave too.
  std::size_t data_numbers = 0;
};

/// An integer that binary files store in 4 bytes.
inline std::int64_t read_int(MshReader& r, std::string_view what) {
  return read_next<std::int64_t, std::int32_t>(r.in, what);
}

inline std::int32_t read_tag(MshReader& r, std::string_view what) {
  return read_next<std::int32_t>(r.in, what);
}

/// A number of a node or an element: 4 bytes before version 4.1, then 8.
inline std::int64_t read_number_of_cell(MshReader& r, std::string_view what) {
  return r.version >= 41 ? read_next<std::int64_t>(r.in, what) : read_int(r, what);
}

/// The physical and elementary tags of one element.
struct MshTags {
  std::int32_t physical = 0;
  std::int32_t entity = 0;
};

/// $Nodes (or $NOD) and $Elements (or $ELM), to the end of their rows.
void read_msh_nodes(MshReader& r);
void read_msh_elements(MshReader& r);

/// $NodeData and $ElementData, to the end of their rows.
void read_msh_data(MshReader& r, bool of_nodes);

}  // namespace sunder::io
