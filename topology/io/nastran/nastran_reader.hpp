// SPDX-License-Identifier: MIT
// Internal to the Nastran reader: the data kept between its passes; the cards that are elements,
// and their kinds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "topology/io/format_traits.hpp"
#include "topology/io/text/number_index.hpp"
#include "topology/mesh/kinds/cell_kinds.hpp"

namespace sunder::io {

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
  /// The property that stands for no region, in files of ours; else 0.
  std::int32_t no_region = 0;
};

/// Finds the bulk data of the file and of those that it includes; reports the lines before BEGIN
/// BULK. Fails with unsupported_keyword, bad_keyword, missing_file or include_cycle.
void find_bulk_data(NastranReader& r);

/// A card that gives elements of one shape.
struct NastranType {
  std::string_view name;
  CellKind linear;
  /// Place of the first node among the fields behind the name: 2, or 1 without a property.
  std::size_t first_node = 2;
  /// The most nodes that stand there.
  std::size_t most_nodes;
};

/// The type of a card; a null pointer where it gives no cell of ours.
const NastranType* nastran_type(std::string_view card);

/// Whether a card is an element that has no like here: a spring, a mass, a rigid one, ...
bool is_other_element(std::string_view card);

/// Whether a card is met at the beginning of bulk data.
bool is_bulk_card(std::string_view card);

/// The comment that names the property that stands for no region, in files of ours.
inline constexpr std::string_view no_region_mark = "$ no region: property ";

/// The kind of a shape with so many nodes; the linear one where there is none.
CellKind nastran_kind(CellKind linear, std::size_t nodes);

/// For each node as Nastran lists it, its place in our order; empty where the two are the same.
std::span<const std::uint8_t> nastran_order(CellKind kind);

}  // namespace sunder::io
