// SPDX-License-Identifier: MIT
// Columns sorted by what each kind says stands before what.
#include "topology/mesh/kinds/column_order.hpp"

#include <algorithm>
#include <map>
#include <string_view>

namespace sunder {
namespace {

/// Columns in the order in which they come first, and for each those right before it in some kind.
struct ColumnGraph {
  std::vector<const DataColumn*> columns;
  std::vector<std::vector<std::size_t>> before;
};

ColumnGraph graph_of(const FileMesh& mesh) {
  ColumnGraph graph;
  std::map<std::string_view, std::size_t> place_of;
  for (const CellKind kind : all_cell_kinds) {
    std::size_t last = 0;
    bool is_first = true;
    for (const DataColumn& column : columns_of(mesh, kind).data) {
      const auto [found, is_new] = place_of.emplace(column.name, graph.columns.size());
      if (is_new) {
        graph.columns.push_back(&column);
        graph.before.emplace_back();
      }
      const std::size_t place = found->second;
      if (!is_first && last != place) graph.before[place].push_back(last);
      last = place;
      is_first = false;
    }
  }
  return graph;
}

}  // namespace

std::vector<const DataColumn*> ordered_cell_columns(const FileMesh& mesh) {
  const ColumnGraph graph = graph_of(mesh);
  const std::size_t n = graph.columns.size();
  std::vector<const DataColumn*> ordered;
  std::vector<bool> is_placed(n, false);
  const auto is_ready = [&](std::size_t i) {
    return !is_placed[i] &&
           std::ranges::all_of(graph.before[i], [&](std::size_t b) { return is_placed[b]; });
  };
  std::size_t waiting = 0;  // all before it are placed
  while (ordered.size() < n) {
    while (is_placed[waiting]) ++waiting;
    std::size_t next = waiting;
    while (next < n && !is_ready(next)) ++next;
    if (next == n) next = waiting;  // kinds contradict each other
    is_placed[next] = true;
    ordered.push_back(graph.columns[next]);
  }
  return ordered;
}

}  // namespace sunder
