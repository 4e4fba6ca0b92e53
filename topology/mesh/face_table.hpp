// SPDX-License-Identifier: MIT
// The faces of tetrahedra by their points: which tetrahedra share one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sunder {

/// A face as one tetrahedron has it; the lowest of its points is known from the bucket it is in.
struct TableFace {
  std::uint64_t others;     ///< middle point << 32 | highest point
  std::uint32_t half_face;  ///< 4 t + p, opposite to corner p
  friend auto operator<=>(const TableFace&, const TableFace&) = default;
};

/// Faces in buckets of their lowest point, each sorted: the sides of one face stand together.
struct FaceTable {
  std::vector<std::size_t> first;  ///< |P| + 1: bucket p is first[p] to first[p + 1]
  std::vector<TableFace> entries;
};

/// All faces of `tetrahedra` (rows of `points` points), less those of tetrahedra with a 0 in
/// `usable`. Needs: fewer than 2^30 tetrahedra. O(|T|) but for the sorting within buckets.
FaceTable face_table(std::span<const std::array<std::uint32_t, 4>> tetrahedra, std::size_t points,
                     std::span<const char> usable = {});

/// Calls `visit(points, sides)` for each face, in rising order of its points (three, rising); sides
/// in rising order of half-face.
template <class Visit>
void for_each_face(const FaceTable& table, Visit visit) {
  for (std::uint32_t p = 0; p + 1 < table.first.size(); ++p) {
    for (std::size_t i = table.first[p], end = i; i < table.first[p + 1]; i = end) {
      const std::uint64_t others = table.entries[i].others;
      while (end < table.first[p + 1] && table.entries[end].others == others) ++end;
      const std::array points = {p, static_cast<std::uint32_t>(others >> 32),
                                 static_cast<std::uint32_t>(others)};
      visit(points, std::span(table.entries).subspan(i, end - i));
    }
  }
}

}  // namespace sunder
