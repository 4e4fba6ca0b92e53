// SPDX-License-Identifier: MIT
#include "apps/host/block_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace sunder {
namespace {

constexpr double most_tetrahedra = 5e7;

bool is_possible(const std::array<double, 3>& lengths, const std::array<std::uint32_t, 3>& cells) {
  double tetrahedra = 6;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!std::isfinite(lengths[i]) || !(lengths[i] > 0) || cells[i] == 0) return false;
    tetrahedra *= cells[i];
  }
  return tetrahedra <= most_tetrahedra;
}

}  // namespace

Result<TetMesh> block_mesh(const std::array<double, 3>& lengths,
                           const std::array<std::uint32_t, 3>& cells) {
  if (!is_possible(lengths, cells)) {
    return Finding{.code = "bad_shape",
                   .text =
                       "a length of the block is not above 0, or its number of cells is 0 or "
                       "makes more than 50 million tetrahedra",
                   .remedy = "give three lengths in m and three numbers of cells"};
  }
  TetMesh mesh;
  const auto [nx, ny, nz] = cells;
  for (std::uint32_t k = 0; k <= nz; ++k) {
    for (std::uint32_t j = 0; j <= ny; ++j) {
      for (std::uint32_t i = 0; i <= nx; ++i) {
        mesh.points.push_back({lengths[0] * i / nx, lengths[1] * j / ny, lengths[2] * k / nz});
      }
    }
  }
  const std::array<std::uint32_t, 3> stride = {1, nx + 1, (nx + 1) * (ny + 1)};
  // Each order of the three axes is a path from the lowest corner of a cube to the highest one.
  std::array<std::uint32_t, 3> order = {0, 1, 2};
  std::array<std::array<std::uint32_t, 4>, 6> paths{};
  for (std::size_t p = 0; p < 6; ++p, std::ranges::next_permutation(order)) {
    for (std::size_t c = 1; c < 4; ++c) paths[p][c] = paths[p][c - 1] + stride[order[c - 1]];
    const bool is_odd = p == 1 || p == 2 || p == 5;
    if (is_odd) std::swap(paths[p][2], paths[p][1]);
  }
  // Exchanged corners orient the odd paths like the even ones.
  for (std::uint32_t k = 0; k < nz; ++k) {
    for (std::uint32_t j = 0; j < ny; ++j) {
      for (std::uint32_t i = 0; i < nx; ++i) {
        const std::uint32_t lowest = i + stride[1] * j + stride[2] * k;
        for (const auto& path : paths) {
          mesh.tetrahedra.push_back(
              {lowest + path[0], lowest + path[1], lowest + path[2], lowest + path[3]});
        }
      }
    }
  }
  return mesh;
}

}  // namespace sunder
