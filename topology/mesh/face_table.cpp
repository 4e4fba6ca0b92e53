// SPDX-License-Identifier: MIT
// Faces sorted into buckets and within them.
#include "topology/mesh/face_table.hpp"

#include <algorithm>
#include <utility>

#include "topology/base/assert.hpp"

namespace sunder {
namespace {

/// The points of a face but that of corner p, rising.
std::array<std::uint32_t, 3> rising_points(const std::array<std::uint32_t, 4>& t, std::size_t p) {
  std::uint32_t a = t[p == 0 ? 1 : 0], b = t[p <= 1 ? 2 : 1], c = t[p == 3 ? 2 : 3];
  if (b < a) std::swap(a, b);
  if (c < b) std::swap(b, c);
  if (b < a) std::swap(a, b);
  return {a, b, c};
}

}  // namespace

FaceTable face_table(std::span<const std::array<std::uint32_t, 4>> tetrahedra, std::size_t points,
                     std::span<const char> usable) {
  SUNDER_ASSERT(tetrahedra.size() < std::size_t{1} << 30, "faces are numbered in 32 bits");
  const auto for_each = [&](auto work) {
    for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
      if (!usable.empty() && !usable[t]) continue;
      for (std::size_t p = 0; p < 4; ++p) {
        work(rising_points(tetrahedra[t], p), static_cast<std::uint32_t>(4 * t + p));
      }
    }
  };
  FaceTable table;
  table.first.assign(points + 2, 0);
  for_each([&](const auto& face, std::uint32_t) { ++table.first[face[0] + 2]; });
  for (std::size_t p = 2; p < table.first.size(); ++p) table.first[p] += table.first[p - 1];
  table.entries.resize(table.first.back());
  // Sorted again: keeping 96 bytes per tetrahedron between the passes gains no time. After this
  // pass first[p + 1] is where bucket p ends.
  for_each([&](const auto& face, std::uint32_t half_face) {
    table.entries[table.first[face[0] + 1]++] = {std::uint64_t{face[1]} << 32 | face[2], half_face};
  });
  table.first.pop_back();
  for (std::size_t p = 0; p < points; ++p) {
    const auto at = [&](std::size_t i) {
      return table.entries.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::sort(at(table.first[p]), at(table.first[p + 1]));
  }
  return table;
}

}  // namespace sunder
