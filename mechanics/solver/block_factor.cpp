// SPDX-License-Identifier: MIT
// Assembly of fronts, and solves panel by panel.
#include "mechanics/solver/block_factor.hpp"

#include <algorithm>
#include <cstring>

#include "mechanics/solver/block_panel.hpp"

namespace sunder {
namespace {

/// Three columns of a block into a panel or an update, `leading` apart.
void add_block(double* to, std::size_t leading, const double* from, std::size_t from_leading) {
  for (std::size_t c = 0; c < 3; ++c, to += leading, from += from_leading) {
    to[0] += from[0];
    to[1] += from[1];
    to[2] += from[2];
  }
}

/// Row `place` of every row of a supernode: its own first, then those below.
void place_rows(std::span<std::uint32_t> place, const BlockAnalysis& analysis,
                const Supernode& node) {
  for (std::uint32_t j = node.first; j < node.end; ++j) place[j] = j - node.first;
  std::uint32_t next = node.width();
  for (std::uint32_t row : analysis.rows_below(node)) place[row] = next++;
}

/// A's own blocks into the panel.
void assemble(const Panel& panel, const Supernode& node, const ShiftedMatrix& A,
              const FactorScratch& scratch, std::size_t rows) {
  for (std::uint32_t j = node.first; j < node.end; ++j) {
    const std::size_t column = tile_rows * 3 * (j - node.first);
    for (std::uint32_t e = A.K.start[j]; e < A.K.start[j + 1] && A.K.row[e] < rows; ++e) {
      double* to = panel.vertex_row(scratch.place[A.K.row[e]]) + column;
      const double* from = A.K.value.data() + 9 * std::size_t{e};
      for (std::size_t c = 0; c < 3; ++c, to += tile_rows, from += 3) {
        for (std::size_t r = 0; r < 3; ++r) to[r] = A.stiffness * from[r];
      }
    }
    double* diagonal = panel.vertex_row(j - node.first) + column;
    for (std::size_t c = 0; c < 3; ++c) {
      diagonal[(tile_rows + 1) * c] += A.mass * A.vertex_mass[static_cast<Eigen::Index>(j)];
    }
  }
}

/// A child's update into its parent's panel and update.
void add_update(const Panel& panel, double* update, std::span<const std::uint32_t> rows,
                const double* child, const FactorScratch& scratch) {
  const std::size_t n = rows.size(), leading = update_leading(n);
  const std::size_t own_leading = update_leading(panel.height);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t column = scratch.place[rows[k]];
    const double* from = child + 3 * k * leading;
    if (column < panel.width) {
      for (std::size_t i = k; i < n; ++i) {
        double* to = panel.vertex_row(scratch.place[rows[i]]) + 3 * column * tile_rows;
        add_block(to, tile_rows, from + 3 * i, leading);
      }
    } else {
      double* to = update + 3 * (column - panel.width) * own_leading;
      for (std::size_t i = k; i < n; ++i) {
        add_block(to + 3 * (scratch.place[rows[i]] - panel.width), own_leading, from + 3 * i,
                  leading);
      }
    }
  }
}

/// The stack of updates of children that wait for their parents.
struct UpdateStack {
  struct Entry {
    std::uint32_t supernode;
    std::size_t begin;
  };
  std::vector<Entry> entries;
  std::size_t top = 0;
};

/// The front of one supernode: assembled, factored, its update left on the stack.
bool factor_front(const Panel& panel, std::uint32_t s, const BlockAnalysis& analysis,
                  const ShiftedMatrix& A, FactorScratch& scratch, UpdateStack& stack) {
  const Supernode& node = analysis.supernodes[s];
  double* base = scratch.stack.data();
  double* update = base + stack.top;
  const std::size_t size = update_doubles(node.height());
  std::fill(update, update + size, 0.0);
  place_rows(scratch.place, analysis, node);
  assemble(panel, node, A, scratch, analysis.order.size());
  std::size_t begin = stack.top;
  while (!stack.entries.empty() &&
         analysis.supernodes[stack.entries.back().supernode].parent == s) {
    const UpdateStack::Entry child = stack.entries.back();
    add_update(panel, update, analysis.rows_below(analysis.supernodes[child.supernode]),
               base + child.begin, scratch);
    begin = child.begin;
    stack.entries.pop_back();
  }
  if (!factor_panel(panel)) return false;
  if (size > 0) {
    subtract_outer(update, panel);
    std::memmove(base + begin, update, size * sizeof(double));
    stack.entries.push_back({s, begin});
  }
  stack.top = begin + size;
  return true;
}

}  // namespace

void factor(BlockFactor& factor, const BlockAnalysis& analysis, const ShiftedMatrix& A,
            FactorScratch& scratch) {
  factor.panels.assign(analysis.panel_size, 0.0);
  scratch.stack.resize(std::max(scratch.stack.size(), analysis.stack_size));
  scratch.place.resize(std::max(scratch.place.size(), analysis.order.size()));
  UpdateStack stack;
  factor.positive_definite = true;
  for (std::uint32_t s = 0; s < analysis.supernodes.size(); ++s) {
    const Supernode& node = analysis.supernodes[s];
    const Panel panel{factor.panels.data() + node.panel, node.width(), node.height()};
    if (!factor_front(panel, s, analysis, A, scratch, stack)) {
      factor.positive_definite = false;
      return;
    }
  }
}

}  // namespace sunder
