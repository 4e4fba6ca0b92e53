// SPDX-License-Identifier: MIT
// Short words for tests about maps: build one, name a face by its points, count, compare.
#pragma once

#include <catch2/catch.hpp>

#include <array>
#include <string>
#include <vector>

#include "topology/kernel/components.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/kernel/invariants.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/mesh/check.hpp"
#include "topology/suite/fixtures/shapes.hpp"
#include "topology/suite/judge/glue_twin.hpp"

namespace sunder::test {

/// The map of a mesh that has no error; volumes may be bad.
inline VolumeMap built(const TetMesh& mesh) {
  Result<VolumeMap> map = build_map(mesh, Severity::warning);
  for (const Finding& f : map.findings) UNSCOPED_INFO(f.code << ": " << f.text);
  REQUIRE(map);
  REQUIRE(check(*map).empty());
  return std::move(*map);
}

/// The half-face on three points of the file; none() when there is none.
inline HalfFaceId face_on(const VolumeMap& map, std::array<std::uint32_t, 3> points) {
  return find_faces(map, std::span<const std::array<std::uint32_t, 3>>(&points, 1)).front();
}

inline FaceSplit split_on(VolumeMap& map, std::array<std::uint32_t, 3> points) {
  return split_face(map, face_on(map, points));
}

/// (split vertices, split edges).
using SplitCount = std::array<int, 2>;
inline SplitCount split_count(const FaceSplit& s) { return {s.vertex_count, edge_count(s)}; }

/// V, E, F, T, CC.
using Cells5 = std::array<std::size_t, 5>;
inline Cells5 cells(const Counts& c) {
  return {c.vertices, c.edges, c.faces, c.tetrahedra, c.components};
}
inline Cells5 cells(const VolumeMap& map) { return cells(count_cells(map)); }

using Betti = std::array<std::ptrdiff_t, 3>;

/// Interior half-faces, each face once, from its lower side.
inline std::vector<HalfFaceId> interior_faces(const VolumeMap& map) {
  std::vector<HalfFaceId> faces;
  for (std::size_t i = 0; i < 4 * map.tetrahedra(); ++i) {
    const HalfFaceId f{i}, across = map.neighbour(f);
    if (!across.is_none() && f < across) faces.push_back(f);
  }
  return faces;
}

/// The twin of a freshly built map.
inline suite::GlueTwin twin_of(const VolumeMap& map, std::size_t points) {
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
  for (const auto& corners : map.corners()) {
    auto& t = tetrahedra.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) t[i] = map.point_of_vertex(corners[i]);
  }
  return suite::glue_twin(tetrahedra, points);
}

inline suite::TwinCounts counts_without_chi(const Counts& c) {
  return {c.vertices,   c.edges,          c.faces,          c.tetrahedra,
          c.components, c.boundary_faces, c.boundary_sheets};
}

/// A finding by its code; fails the test when there is none.
inline Finding finding(const std::vector<Finding>& findings, const std::string& code) {
  for (const Finding& f : findings) {
    if (f.code == code) return f;
  }
  FAIL("no finding " << code);
  return {};
}

inline std::vector<std::string> codes(const std::vector<Finding>& findings) {
  std::vector<std::string> list;
  for (const Finding& f : findings) list.push_back(f.code);
  return list;
}

}  // namespace sunder::test
