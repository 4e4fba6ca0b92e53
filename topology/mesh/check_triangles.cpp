// SPDX-License-Identifier: MIT
// Triangles of a file compared with the faces of its tetrahedra.
#include <algorithm>

#include "topology/kernel/kernel.hpp"
#include "topology/mesh/survey.hpp"

namespace sunder {
namespace {

constexpr FindingWords stray_triangle = {
    "stray_triangle", Severity::warning,
    "% [triangle of the file is|triangles of the file are] faces of no tetrahedron",
    "remove them, or renumber their points: they bound nothing"};
constexpr FindingWords interface_triangle = {
    "interface_triangle", Severity::note,
    "% [triangle of the file lies|triangles of the file lie] between two tetrahedra, as an "
    "interface or a crack to be",
    "nothing to do"};

using Triangle = std::array<std::uint32_t, 3>;

struct SortedTriangle {
  std::uint64_t others;  // middle point << 32 | highest point
  std::uint32_t row;
  friend auto operator<=>(const SortedTriangle&, const SortedTriangle&) = default;
};

/// Triangles in buckets of their lowest point, each sorted: first[p] to first[p + 1].
struct TriangleBuckets {
  std::vector<std::size_t> first;
  std::vector<SortedTriangle> entries;
};

Triangle sorted(Triangle t) {
  if (t[1] < t[0]) std::swap(t[0], t[1]);
  if (t[2] < t[1]) std::swap(t[1], t[2]);
  if (t[1] < t[0]) std::swap(t[0], t[1]);
  return t;
}

std::uint64_t others_of(const Triangle& t) { return std::uint64_t{t[1]} << 32 | t[2]; }

TriangleBuckets bucket_triangles(const std::vector<Triangle>& triangles, std::size_t points) {
  TriangleBuckets buckets;
  buckets.first.assign(points + 2, 0);
  const auto is_usable = [points](const Triangle& t) { return t[2] < points; };
  for (const Triangle& t : triangles) {
    const Triangle s = sorted(t);
    if (is_usable(s)) ++buckets.first[s[0] + 2];
  }
  for (std::size_t p = 2; p < buckets.first.size(); ++p) buckets.first[p] += buckets.first[p - 1];
  buckets.entries.resize(buckets.first.back());
  for (std::uint32_t row = 0; row < triangles.size(); ++row) {
    const Triangle s = sorted(triangles[row]);
    if (is_usable(s)) buckets.entries[buckets.first[s[0] + 1]++] = {others_of(s), row};
  }
  for (std::size_t p = 0; p < points; ++p) {
    std::sort(buckets.entries.begin() + static_cast<std::ptrdiff_t>(buckets.first[p]),
              buckets.entries.begin() + static_cast<std::ptrdiff_t>(buckets.first[p + 1]));
  }
  return buckets;
}

}  // namespace

void survey_triangles(Survey& s, const std::vector<Triangle>& triangles) {
  const TriangleBuckets buckets = bucket_triangles(triangles, s.mesh.points.size());
  enum : char { nothing, boundary, interior };
  std::vector<char> bounds(triangles.size(), nothing);
  for (std::size_t t = 0; t < s.mesh.tetrahedra.size(); ++t) {
    const auto& c = s.mesh.tetrahedra[t];
    for (int p = 0; s.usable[t] && p < 4; ++p) {
      const Triangle face = sorted(corners_of_face(c, half_face(TetId{t}, p)));
      const auto begin =
          buckets.entries.begin() + static_cast<std::ptrdiff_t>(buckets.first[face[0]]);
      const auto end =
          buckets.entries.begin() + static_cast<std::ptrdiff_t>(buckets.first[face[0] + 1]);
      if (begin == end) continue;
      // The first of those with these points; the others follow below.
      const auto found = std::lower_bound(begin, end, SortedTriangle{others_of(face), 0});
      if (found == end || found->others != others_of(face)) continue;
      bounds[found->row] = s.neighbours[t][p].is_none() ? boundary : interior;
    }
  }
  for (std::size_t p = 0; p < s.mesh.points.size(); ++p) {
    for (std::size_t i = buckets.first[p] + 1; i < buckets.first[p + 1]; ++i) {
      const SortedTriangle &before = buckets.entries[i - 1], &here = buckets.entries[i];
      if (here.others == before.others) bounds[here.row] = bounds[before.row];
    }
  }
  Places stray(PlaceKind::triangles, s.keeps_places), interface = stray;
  for (std::size_t row = 0; row < triangles.size(); ++row) {
    if (bounds[row] == nothing) stray.add(row);
    if (bounds[row] == interior) interface.add(row);
  }
  report(s, stray_triangle, stray);
  report(s, interface_triangle, interface);
}

}  // namespace sunder
