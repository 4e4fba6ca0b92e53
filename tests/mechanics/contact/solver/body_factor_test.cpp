// SPDX-License-Identifier: MIT
// The block factor against a dense one.
#include "mechanics/contact/solver/body_factor.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace sunder;

namespace {

BodyFactor::Block random_block(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  return BodyFactor::Block::NullaryExpr([&] { return number(random); });
}

/// Joins `joined` at random, both into the factor and into a dense matrix.
Eigen::MatrixXd fill(BodyFactor& factor, std::size_t bodies, std::size_t joined, unsigned seed) {
  std::mt19937 random(seed);
  const auto size = static_cast<Eigen::Index>(6 * bodies);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
  factor.reset(bodies);
  const auto add = [&](std::uint32_t a, std::uint32_t b, const BodyFactor::Block& block) {
    factor.add(a, b, block);
    dense.block<6, 6>(6 * a, 6 * b) += block;
    if (a != b) dense.block<6, 6>(6 * b, 6 * a) += block.transpose();
  };
  for (std::uint32_t b = 0; b < bodies; ++b) add(b, b, 0.1 * BodyFactor::Block::Identity());
  for (std::size_t k = 0; k < joined && bodies > 1; ++k) {
    const auto first = static_cast<std::uint32_t>(random() % bodies);
    const auto other = static_cast<std::uint32_t>((first + 1 + random() % (bodies - 1)) % bodies);
    const auto [b, a] = std::minmax(first, other);
    const BodyFactor::Block left = random_block(random), right = random_block(random);
    add(a, a, left * left.transpose());
    add(b, b, right * right.transpose());
    add(a, b, left * right.transpose());
  }
  return dense;
}

}  // namespace

TEST_CASE("the factor of bodies solves what a dense one solves", "[mechanics][contact]") {
  const std::size_t bodies = GENERATE(1u, 2u, 7u, 40u);
  const std::size_t joined = bodies * GENERATE(0u, 1u, 4u);
  BodyFactor factor;
  const Eigen::MatrixXd dense = fill(factor, bodies, joined, 5);
  REQUIRE(factor.factor());
  const Eigen::VectorXd load = Eigen::VectorXd::LinSpaced(dense.rows(), -1, 2);
  Eigen::VectorXd x = load;
  factor.solve(x);
  CHECK((dense * x - load).norm() < 1e-9 * load.norm());
  fill(factor, bodies, joined, 5);
  REQUIRE(factor.factor());
  Eigen::VectorXd again = load;
  factor.solve(again);
  CHECK(again == x);
}

TEST_CASE("a matrix of bodies that is not positive definite has no factor",
          "[mechanics][contact]") {
  BodyFactor factor;
  factor.reset(2);
  factor.add(0, 0, BodyFactor::Block::Identity());
  factor.add(1, 1, BodyFactor::Block::Identity());
  factor.add(1, 0, 2 * BodyFactor::Block::Identity());
  CHECK_FALSE(factor.factor());
}
