// SPDX-License-Identifier: MIT
// Internal to MEDIT: sections like HexahedraQ2Ordering, which give the order of a cell's nodes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "topology/mesh/kinds/cell_kinds.hpp"

namespace sunder::io {

/// Codes of keywords in binary files.
inline constexpr int dimension_code = 3, vertices_code = 4, end_code = 54;

/// A section of an order: as many rows as the kind has nodes, of so many numbers each.
struct MeditOrder {
  std::string_view keyword;
  /// Of binary files.
  int code;
  CellKind kind;
  std::size_t numbers;
};
inline constexpr MeditOrder medit_orders[] = {
    {"EdgesP2Ordering", 127, CellKind::edge3, 1},
    {"TrianglesP2Ordering", 129, CellKind::triangle6, 3},
    {"QuadrilateralsQ2Ordering", 131, CellKind::quad9, 2},
    {"TetrahedraP2Ordering", 133, CellKind::tetrahedron10, 4},
    {"PyramidsP2Ordering", 135, CellKind::pyramid14, 3},
    {"PrismsP2Ordering", 137, CellKind::prism18, 4},
    {"HexahedraQ2Ordering", 139, CellKind::hexahedron27, 3},
};

/// The order section of a kind; a null pointer where it has none.
const MeditOrder* medit_order_of(CellKind kind);

/// Whether files without an order section leave the order of the kind's nodes open: true of all but
/// simplices, for which programs agree on the order of midpoints.
bool needs_medit_order(CellKind kind);

/// A node's place as such a section gives it: its Bezier indices of degree two. Along an edge from
/// 0 to 2; in simplices one number for each corner, their sum 2; in prisms the triangle's three and
/// the height; in pyramids the first two from 0 to 2 at the base, 0 to 1 half way up.
using BezierPlace = std::array<std::int64_t, 4>;

/// The places of a kind's nodes in our order; unused numbers are 0. Needs: medit_order_of(kind).
std::vector<BezierPlace> bezier_places(CellKind kind);

/// For each node as the file lists it, its place in our order; none where `places` are not those of
/// the kind, each once.
std::optional<std::vector<std::uint8_t>> order_of_places(CellKind kind,
                                                         std::span<const BezierPlace> places);

}  // namespace sunder::io
