// SPDX-License-Identifier: MIT
// Internal to the Nastran reader: which cards are elements, and what of what kind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "topology/mesh/kinds/cell_kinds.hpp"

namespace sunder::io {

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

/// The comment that tells which property stands for no region, in files of ours.
inline constexpr std::string_view no_region_mark = "$ no region: property ";

/// The kind of a shape with so many nodes; the linear one where there is none.
CellKind nastran_kind(CellKind linear, std::size_t nodes);

/// For each node as Nastran lists it, its place in our order; empty where the two are the same.
std::span<const std::uint8_t> nastran_order(CellKind kind);

}  // namespace sunder::io
