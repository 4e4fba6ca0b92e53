// SPDX-License-Identifier: MIT
// Bricks of six tetrahedra, each the mirror image of its neighbours.
#include "topology/mesh/solids/orient.hpp"
#include "topology/mesh/solids/solids.hpp"

namespace sunder {
namespace {

/// The end of a brick along an axis whose number is even, and the other one.
std::uint32_t even_end(std::uint32_t brick) { return brick + brick % 2; }
std::uint32_t odd_end(std::uint32_t brick) { return brick + 1 - brick % 2; }

}  // namespace

TetMesh box_solid(const std::array<double, 3>& size, const std::array<std::uint32_t, 3>& cells) {
  TetMesh mesh;
  const auto row = [&](const std::array<std::uint32_t, 3>& p) {
    return (p[2] * (cells[1] + 1) + p[1]) * (cells[0] + 1) + p[0];
  };
  const auto place = [&](std::uint32_t p, std::size_t axis) {
    return size[axis] * (static_cast<double>(p) / cells[axis] - 0.5);
  };
  for (std::uint32_t k = 0; k <= cells[2]; ++k) {
    for (std::uint32_t j = 0; j <= cells[1]; ++j) {
      for (std::uint32_t i = 0; i <= cells[0]; ++i) {
        mesh.points.push_back({place(i, 0), place(j, 1), place(k, 2)});
      }
    }
  }
  for (std::uint32_t k = 0; k < cells[2]; ++k) {
    for (std::uint32_t j = 0; j < cells[1]; ++j) {
      for (std::uint32_t i = 0; i < cells[0]; ++i) {
        const std::array<std::uint32_t, 3> end = {odd_end(i), odd_end(j), odd_end(k)};
        for (const auto& order : axis_orders) {
          std::array<std::uint32_t, 3> at = {even_end(i), even_end(j), even_end(k)};
          std::array<std::uint32_t, 4> corners = {row(at)};
          for (std::size_t step = 0; step < 3; ++step) {
            at[order[step]] = end[order[step]];
            corners[step + 1] = row(at);
          }
          add_positive(mesh, corners);
        }
      }
    }
  }
  return mesh;
}

}  // namespace sunder
