// SPDX-License-Identifier: MIT
// The slow twin of operations on cells: tetrahedra as points, a set of cut triples, brute force. It
// knows no dart and no row: two faces are glued exactly when they have three points that are not
// cut.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "topology/suite/judge/glue_twin.hpp"

namespace sunder::test {

struct CellTwin {
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
  std::set<std::array<std::uint32_t, 3>> cut;
};

/// The tetrahedra with their faces glued where they are not cut.
suite::GlueTwin glued(const CellTwin& twin);

/// For each of the six edges (01 02 03 12 13 23) of each tetrahedron the number of its class under
/// glued faces.
std::vector<std::array<std::uint32_t, 6>> edge_classes(const CellTwin& twin);

/// All edges that are to be divided when those of `cells` are: every tetrahedron ends with none,
/// one, two, those of a face, or all.
std::set<std::uint32_t> closed_edges(const std::vector<std::array<std::uint32_t, 6>>& classes,
                                     const std::vector<std::size_t>& cells);

/// Names of new points by the two points that they lie between.
using MiddleNames = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;

/// Divides the classes `edges`; false when a name is missing. `inner`: edges that the map has now,
/// which show the one of three inside each tetrahedron that becomes eight.
bool divide(CellTwin& twin, const std::set<std::uint32_t>& edges, const MiddleNames& names,
            const std::set<std::pair<std::uint32_t, std::uint32_t>>& inner);

/// The tetrahedra, each with its points sorted, sorted: equal for equal complexes.
std::vector<std::array<std::uint32_t, 4>> as_set(
    const std::vector<std::array<std::uint32_t, 4>>& tetrahedra);

}  // namespace sunder::test
