// SPDX-License-Identifier: MIT
// Elimination tree, counts, postorder, supernodes.
#include "mechanics/solver/block_analysis.hpp"

#include <algorithm>
#include <numeric>

#include <Eigen/OrderingMethods>

#include "mechanics/solver/block_panel.hpp"

namespace sunder {
namespace {

constexpr std::uint32_t no_node = Supernode::none;
using Rows = std::vector<std::uint32_t>;

Rows minimum_degree(const VertexGraph& graph) {
  const int n = static_cast<int>(graph.size());
  Eigen::SparseMatrix<char> pattern(n, n);
  pattern.reserve(static_cast<Eigen::Index>(graph.neighbour.size() + graph.size()));
  for (int j = 0; j < n; ++j) {
    pattern.startVec(j);
    for (std::uint32_t i : graph.of(static_cast<std::size_t>(j))) {
      pattern.insertBackByOuterInnerUnordered(j, static_cast<Eigen::Index>(i)) = 1;
    }
    pattern.insertBackByOuterInnerUnordered(j, j) = 1;
  }
  pattern.finalize();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> eliminated;
  Eigen::internal::minimum_degree_ordering(pattern, eliminated);
  return {eliminated.indices().begin(), eliminated.indices().end()};
}

Rows inverse_of(const Rows& order) {
  Rows place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<std::uint32_t>(i);
  return place;
}

/// Elimination tree in some order, and how many rows of L lie below the diagonal of each column.
struct Tree {
  Rows parent, count;
};

Tree elimination_tree(const VertexGraph& graph, const Rows& order) {
  const std::size_t n = order.size();
  const Rows place = inverse_of(order);
  Tree tree{Rows(n, no_node), Rows(n, 0)};
  Rows ancestor(n, no_node), mark(n, no_node);
  for (std::uint32_t i = 0; i < n; ++i) {
    mark[i] = i;
    for (std::uint32_t neighbour : graph.of(order[i])) {
      std::uint32_t k = place[neighbour];
      if (k >= i) continue;
      for (std::uint32_t r = k; r != i;) {
        const std::uint32_t next = ancestor[r];
        ancestor[r] = i;
        if (next == no_node) tree.parent[r] = i;
        r = next == no_node ? i : next;
      }
      for (; mark[k] != i; k = tree.parent[k]) {
        mark[k] = i;
        ++tree.count[k];
      }
    }
  }
  return tree;
}

/// Columns in postorder; of the children of one column that with the most rows comes last, so that
/// it can join its parent's supernode.
Rows postorder(const Tree& tree) {
  const std::size_t n = tree.parent.size();
  Rows by_count(n);
  std::iota(by_count.begin(), by_count.end(), 0U);
  std::stable_sort(by_count.begin(), by_count.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return tree.count[a] < tree.count[b]; });
  // Heads of lists of children, the one with the most rows first; roots hang under column n.
  Rows child(n + 1, no_node), sibling(n, no_node);
  const auto above = [&](std::uint32_t j) {
    return tree.parent[j] == no_node ? n : tree.parent[j];
  };
  for (std::uint32_t j : by_count) {
    sibling[j] = child[above(j)];
    child[above(j)] = j;
  }
  // Reversed preorder: a column, then its children, the one with the most rows first.
  Rows order, stack;
  for (std::uint32_t root = child[n]; root != no_node; root = sibling[root]) stack.push_back(root);
  std::reverse(stack.begin(), stack.end());
  while (!stack.empty()) {
    const std::uint32_t j = stack.back();
    stack.pop_back();
    order.push_back(j);
    const std::size_t begin = stack.size();
    for (std::uint32_t c = child[j]; c != no_node; c = sibling[c]) stack.push_back(c);
    std::reverse(stack.begin() + static_cast<std::ptrdiff_t>(begin), stack.end());
  }
  std::reverse(order.begin(), order.end());
  return order;
}

/// The tree with its columns renamed: column i is old column `order[i]`.
Tree renamed(const Tree& tree, const Rows& order) {
  const Rows place = inverse_of(order);
  Tree next;
  for (std::uint32_t old : order) {
    next.parent.push_back(tree.parent[old] == no_node ? no_node : place[tree.parent[old]]);
    next.count.push_back(tree.count[old]);
  }
  return next;
}

/// A supernode in the making: columns, rows below, and blocks of zeros that merging cost.
struct NodeRange {
  std::uint32_t first, end, height;
  double zeros;
  std::uint32_t width() const { return end - first; }
};

/// The range of `child` and `parent`, which follows it, together.
NodeRange merged(const NodeRange& child, const NodeRange& parent) {
  const double more = static_cast<double>(parent.width()) + parent.height - child.height;
  return {child.first, parent.end, parent.height,
          child.zeros + parent.zeros + child.width() * more};
}

/// Merging saves indices and small products, and pays with arithmetic on zeros.
bool pays(const NodeRange& range) {
  const double width = range.width();
  const double blocks = width * (width + 1) / 2 + width * range.height;
  const double share = range.zeros / blocks;
  if (width <= 4) return share < 0.5;
  if (width <= 8) return share < 0.25;
  if (width <= 16) return share < 0.12;
  return share < 0.05;
}

std::vector<NodeRange> find_ranges(const Tree& tree) {
  std::vector<NodeRange> ranges;
  for (std::uint32_t j = 0; j < tree.parent.size(); ++j) {
    NodeRange range{j, j + 1, tree.count[j], 0};
    while (!ranges.empty()) {
      const NodeRange& last = ranges.back();
      const std::uint32_t above = tree.parent[last.end - 1];
      if (above == no_node || above >= range.end) break;
      const NodeRange both = merged(last, range);
      // Columns one row shorter each make one supernode, for any number of them.
      if (both.zeros > last.zeros + range.zeros && !pays(both)) break;
      range = both;
      ranges.pop_back();
    }
    ranges.push_back(range);
  }
  return ranges;
}

/// Rows below every supernode: those of its columns and of its children.
void find_rows(BlockAnalysis& analysis, const VertexGraph& graph) {
  const Rows place = inverse_of(analysis.order);
  const auto count = static_cast<std::uint32_t>(analysis.supernodes.size());
  Rows mark(analysis.order.size(), no_node), child(count, no_node), sibling(count, no_node);
  for (std::uint32_t s = 0; s < count; ++s) {
    Supernode& node = analysis.supernodes[s];
    node.below_begin = static_cast<std::uint32_t>(analysis.below.size());
    const auto add = [&](std::uint32_t row) {
      if (row < node.end || mark[row] == s) return;
      mark[row] = s;
      analysis.below.push_back(row);
    };
    for (std::uint32_t j = node.first; j < node.end; ++j) {
      analysis.supernode_of[j] = s;
      for (std::uint32_t neighbour : graph.of(analysis.order[j])) add(place[neighbour]);
    }
    for (std::uint32_t c = child[s]; c != no_node; c = sibling[c]) {
      const Supernode& below = analysis.supernodes[c];
      for (std::uint32_t e = below.below_begin; e < below.below_end; ++e) add(analysis.below[e]);
    }
    node.below_end = static_cast<std::uint32_t>(analysis.below.size());
    std::sort(analysis.below.begin() + node.below_begin, analysis.below.end());
    if (node.height() == 0) continue;
    // Supernodes after this one are not yet entered in `supernode_of`.
    const auto after = std::upper_bound(
        analysis.supernodes.begin(), analysis.supernodes.end(), analysis.below[node.below_begin],
        [](std::uint32_t row, const Supernode& other) { return row < other.end; });
    node.parent = static_cast<std::uint32_t>(after - analysis.supernodes.begin());
    sibling[s] = child[node.parent];
    child[node.parent] = s;
  }
}

/// Where panels begin, and how high the stack of updates grows.
void lay_out(BlockAnalysis& analysis) {
  std::vector<std::size_t> children(analysis.supernodes.size(), 0);
  std::size_t top = 0;
  for (std::size_t s = 0; s < analysis.supernodes.size(); ++s) {
    Supernode& node = analysis.supernodes[s];
    node.panel = analysis.panel_size;
    analysis.panel_size += panel_doubles(node.width(), node.height());
    const std::size_t own = update_doubles(node.height());
    analysis.stack_size = std::max(analysis.stack_size, top + own);
    top = top - children[s] + own;
    if (node.parent != no_node) children[node.parent] += own;
  }
}

}  // namespace

BlockAnalysis analyse(const VertexGraph& graph) {
  BlockAnalysis analysis;
  if (graph.size() == 0) return analysis;
  const Rows first = minimum_degree(graph);
  const Tree unordered = elimination_tree(graph, first);
  const Rows post = postorder(unordered);
  for (std::uint32_t j : post) analysis.order.push_back(first[j]);
  for (const NodeRange& range : find_ranges(renamed(unordered, post))) {
    analysis.supernodes.push_back({.first = range.first, .end = range.end});
  }
  analysis.supernode_of.resize(graph.size());
  find_rows(analysis, graph);
  lay_out(analysis);
  return analysis;
}

}  // namespace sunder
