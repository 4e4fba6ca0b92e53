// SPDX-License-Identifier: MIT
// Engines and meshes of arrays as hosts have them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "apps/host/sunder.h"

namespace sunder::test {

using Engine = std::unique_ptr<sunder_engine, void (*)(sunder_engine*)>;

/// The mesh "a": three coordinates per point, four rows of points per tetrahedron. The arrays must
/// outlive it.
inline sunder_mesh mesh_of_arrays(std::span<const double> points,
                                  std::span<const std::uint32_t> rows) {
  sunder_mesh mesh{};
  mesh.size = sizeof mesh;
  mesh.name = "a";
  mesh.points = points.data();
  mesh.point_count = points.size() / 3;
  mesh.tetrahedra = rows.data();
  mesh.tetrahedron_count = rows.size() / 4;
  return mesh;
}

}  // namespace sunder::test
