// SPDX-License-Identifier: MIT
// Simplices for GUDHI, and its answer.
#include "tests/topology/suite/gudhi_homology.hpp"

// GUDHI 3.7.1's headers, all of them under the MIT licence, need std::cout.
#include <iostream>
// After it:
#include <gudhi/Persistent_cohomology.h>
#include <gudhi/Simplex_tree.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <vector>

namespace sunder::test {
namespace {

using suite::BettiNumbers;
using suite::OrbitComplex;
using SimplexTree = Gudhi::Simplex_tree<>;
using Field = Gudhi::persistent_cohomology::Field_Zp;
using Vertices = std::vector<std::uint32_t>;

/// Vertices of every cell, rising, by dimension.
std::array<std::vector<Vertices>, 4> vertices_of_cells(const OrbitComplex& complex) {
  std::array<std::vector<Vertices>, 4> vertices;
  for (std::uint32_t v = 0; v < complex.cells[0]; ++v) vertices[0].push_back({v});
  for (std::size_t d = 1; d < 4; ++d) {
    for (const auto& terms : complex.boundary[d]) {
      std::set<std::uint32_t> corners;
      for (std::size_t i = 0; i <= d; ++i) {
        const Vertices& of_side = vertices[d - 1][terms[i].cell];
        corners.insert(of_side.begin(), of_side.end());
      }
      vertices[d].emplace_back(corners.begin(), corners.end());
    }
  }
  return vertices;
}

BettiNumbers betti_of(SimplexTree& tree, int prime) {
  // `true`: the highest dimension as well.
  Gudhi::persistent_cohomology::Persistent_cohomology<SimplexTree, Field> cohomology(tree, true);
  cohomology.init_coefficients(prime);
  cohomology.compute_persistent_cohomology();
  BettiNumbers betti = {0, 0, 0, 0};
  for (int d = 0; d < 4; ++d) {
    betti[static_cast<std::size_t>(d)] = static_cast<std::size_t>(cohomology.betti_number(d));
  }
  return betti;
}

}  // namespace

bool is_simplicial(const OrbitComplex& complex) {
  auto vertices = vertices_of_cells(complex);
  for (std::vector<Vertices>& cells : vertices) {
    std::sort(cells.begin(), cells.end());
    if (std::adjacent_find(cells.begin(), cells.end()) != cells.end()) return false;
  }
  return true;
}

BettiNumbers gudhi_betti(const OrbitComplex& complex, int prime) {
  SimplexTree tree;
  const auto vertices = vertices_of_cells(complex);
  for (const Vertices& tetrahedron : vertices[3]) {
    tree.insert_simplex_and_subfaces(tetrahedron, 0.0);
  }
  const auto& n = complex.cells;
  if (tree.num_simplices() != n[0] + n[1] + n[2] + n[3]) {
    throw std::logic_error("GUDHI's simplices are not the cells");
  }
  return betti_of(tree, prime);
}

BettiNumbers gudhi_betti_of_subdivision(const OrbitComplex& complex, int prime) {
  std::array<std::uint32_t, 4> first = {};
  for (std::size_t d = 1; d < 4; ++d) {
    first[d] = first[d - 1] + static_cast<std::uint32_t>(complex.cells[d - 1]);
  }
  SimplexTree tree;
  for (std::uint32_t t = 0; t < complex.cells[3]; ++t) {
    for (const auto& face : complex.boundary[3][t]) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t edge = complex.boundary[2][face.cell][i].cell;
        for (std::size_t k = 0; k < 2; ++k) {
          const std::uint32_t vertex = complex.boundary[1][edge][k].cell;
          const Vertices chain = {vertex, first[1] + edge, first[2] + face.cell, first[3] + t};
          tree.insert_simplex_and_subfaces(chain, 0.0);
        }
      }
    }
  }
  return betti_of(tree, prime);
}

}  // namespace sunder::test
