// SPDX-License-Identifier: MIT
// Block Cholesky by least degree.
#include "mechanics/contact/solver/body_factor.hpp"

#include <algorithm>
#include <utility>

#include "topology/base/assert.hpp"

namespace sunder {

void BodyFactor::reset(std::size_t bodies) {
  neighbours_.assign(bodies, {});
  diagonal_.assign(bodies, Block::Zero());
  blocks_.clear();
  order_.clear();
}

BodyFactor::Block& BodyFactor::between(std::uint32_t a, std::uint32_t b) {
  const auto before = [](const Entry& entry, std::uint32_t body) { return entry.body < body; };
  std::vector<Entry>& of_a = neighbours_[a];
  const auto at = std::lower_bound(of_a.begin(), of_a.end(), b, before);
  if (at != of_a.end() && at->body == b) return blocks_[at->block];
  const auto block = static_cast<std::uint32_t>(blocks_.size());
  of_a.insert(at, {b, block});
  std::vector<Entry>& of_b = neighbours_[b];
  of_b.insert(std::lower_bound(of_b.begin(), of_b.end(), a, before), {a, block});
  return blocks_.emplace_back(Block::Zero());
}

void BodyFactor::add(std::uint32_t a, std::uint32_t b, const Block& block) {
  SUNDER_ASSERT(a >= b, "BodyFactor::add: the block is above the diagonal");
  if (a == b) {
    diagonal_[a] += block;
  } else {
    between(a, b) += block;
  }
}

/// Eliminates a body from the remaining matrix: makes its columns of L and updates its neighbours.
void BodyFactor::eliminate(std::uint32_t body) {
  const std::vector<Entry>& column = neighbours_[body];
  for (const Entry& entry : column) {
    Block& block = blocks_[entry.block];
    if (entry.body < body) block.transposeInPlace();
    block = (block * diagonal_[body].transpose()).eval();
    diagonal_[entry.body].noalias() -= block * block.transpose();
    std::erase_if(neighbours_[entry.body], [&](const Entry& other) { return other.body == body; });
  }
  for (std::size_t u = 0; u < column.size(); ++u) {
    for (std::size_t w = 0; w < u; ++w) {
      Block& fill = between(column[u].body, column[w].body);
      fill.noalias() -= blocks_[column[u].block] * blocks_[column[w].block].transpose();
    }
  }
}

bool BodyFactor::factor() {
  std::vector<std::uint32_t> left(size());
  for (std::uint32_t b = 0; b < left.size(); ++b) left[b] = b;
  while (!left.empty()) {
    const auto least = std::ranges::min_element(
        left, {}, [&](std::uint32_t b) { return std::pair(neighbours_[b].size(), b); });
    const std::uint32_t body = *least;
    *least = left.back();
    left.pop_back();
    const Eigen::LLT<Block> pivot(diagonal_[body]);
    if (pivot.info() != Eigen::Success) return false;
    diagonal_[body] = pivot.matrixL().solve(Block::Identity());
    eliminate(body);
    order_.push_back(body);
  }
  return true;
}

void BodyFactor::solve(Eigen::VectorXd& x) const {
  using Twist = Eigen::Matrix<double, 6, 1>;
  for (const std::uint32_t body : order_) {
    const Twist y = diagonal_[body] * x.segment<6>(6 * body);
    x.segment<6>(6 * body) = y;
    for (const Entry& entry : neighbours_[body]) {
      x.segment<6>(6 * entry.body).noalias() -= blocks_[entry.block] * y;
    }
  }
  for (auto body = order_.rbegin(); body != order_.rend(); ++body) {
    Twist y = x.segment<6>(6 * *body);
    for (const Entry& entry : neighbours_[*body]) {
      y.noalias() -= blocks_[entry.block].transpose() * x.segment<6>(6 * entry.body);
    }
    x.segment<6>(6 * *body) = diagonal_[*body].transpose() * y;
  }
}

}  // namespace sunder
