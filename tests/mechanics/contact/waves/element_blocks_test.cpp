// SPDX-License-Identifier: MIT
// Packed elements against the forces of one element, and the bound of their stiffness.
#include "mechanics/contact/waves/element_blocks.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "mechanics/element/strain_displacement.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "tests/support/second_order.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

std::array<Vec3, 4> random_tetrahedron(std::mt19937& random) {
  std::array<Vec3, 4> x{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  for (Vec3& p : x) p += 0.3 * random_vector(random);
  return x;
}

}  // namespace

TEMPLATE_TEST_CASE("four packed tetrahedra have the forces of each, and places left over have none",
                   "[mechanics][waves]", FirstOrderBlock, SecondOrderBlock) {
  constexpr std::size_t nodes = std::extent_v<decltype(TestType::node)>;
  std::mt19937 random(7);
  const Lame constants{2, 3};
  for (int trial = 0; trial < 50; ++trial) {
    const std::size_t filled = 1 + static_cast<std::size_t>(trial) % 4, all = 4 * nodes;
    TestType block{};
    QuadColumn displacement(4 * all, 0.0), rate(4 * all, 0.0), inner(4 * all, 0.0);
    std::vector<Vec3> expected(all, Vec3::Zero());
    for (std::size_t i = 0; i < all; ++i) {
      row_of(displacement, i) = random_vector(random);
      row_of(rate, i) = random_vector(random);
    }
    for (std::size_t lane = 0; lane < 4; ++lane) {
      // Elements share node 0.
      std::array<std::uint32_t, nodes> node{};
      for (std::size_t a = 1; a < nodes; ++a) {
        node[a] = static_cast<std::uint32_t>(nodes * lane + a);
      }
      if (lane >= filled) {
        set_element(block, lane, ShapeGradient::Zero(), Lame{0, 0}, node);
        continue;
      }
      const std::array<Vec3, 4> x = random_tetrahedron(random);
      const double volume = tetrahedron_volume(x);
      const ShapeGradient G = shape_gradients(x);
      set_element(block, lane, G, Lame{volume * constants.lambda, volume * constants.mu}, node);
      const double viscosity = 0.3 * static_cast<double>(lane);
      block.viscosity[lane] = viscosity;
      for (std::size_t b = 0; b < nodes; ++b) {
        const Vec3 d = row_of(displacement, node[b]) + viscosity * row_of(rate, node[b]);
        for (std::size_t a = 0; a < nodes; ++a) {
          expected[node[a]] += node_block(G, volume, constants, nodes, a, b) * d;
        }
      }
    }
    add_block_forces({displacement, rate, inner}, std::span<const TestType>(&block, 1));
    for (std::size_t i = 0; i < all; ++i) {
      CHECK((row_of(inner, i) - expected[i]).norm() < 1e-12);
      CHECK(inner[4 * i + 3] == 0);
    }
  }
}

TEST_CASE("the nodes' stiffness bounds that of an element, of either order", "[mechanics][waves]") {
  std::mt19937 random(8);
  const std::size_t nodes = GENERATE(std::size_t{4}, std::size_t{10});
  for (int trial = 0; trial < 20; ++trial) {
    const std::array<Vec3, 4> x = random_tetrahedron(random);
    const double volume = tetrahedron_volume(x);
    const ShapeGradient G = shape_gradients(x);
    const Lame constants{0.5 + trial, 3};
    const double c = coupling_of(G, volume, constants, nodes);
    const std::array<double, 10> k = stiffness_of_nodes(G, volume, constants, nodes);
    const auto size = static_cast<Eigen::Index>(3 * nodes);
    Eigen::MatrixXd K(size, size);
    for (std::size_t a = 0; a < nodes; ++a) {
      for (std::size_t b = 0; b < nodes; ++b) {
        K.block<3, 3>(static_cast<Eigen::Index>(3 * a), static_cast<Eigen::Index>(3 * b)) =
            node_block(G, volume, constants, nodes, a, b);
      }
    }
    Eigen::MatrixXd rest = -K;
    for (std::size_t a = 0; a < nodes; ++a) {
      rest.block<3, 3>(static_cast<Eigen::Index>(3 * a), static_cast<Eigen::Index>(3 * a))
          .diagonal()
          .array() += c * k[a];
    }
    const Eigen::VectorXd left = symmetric_eigen(rest, Eigen::EigenvaluesOnly).eigenvalues();
    // Never negative, and zero for the field that is the stiffest.
    CHECK(left[0] > -1e-9 * left[size - 1]);
    CHECK(left[0] < 1e-9 * left[size - 1]);
    CHECK(c <= static_cast<double>(nodes));
  }
}
