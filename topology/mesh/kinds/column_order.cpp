// SPDX-License-Identifier: MIT
// Columns sorted by the orders that the kinds of cells have them in.
#include "topology/mesh/kinds/column_order.hpp"

#include <map>
#include <set>
#include <string_view>
#include <vector>

namespace sunder {
namespace {

/// Columns in the order in which they come first, for each those right after it in some kind, and
/// in how many places one stands right before it.
struct ColumnGraph {
  std::vector<const DataColumn*> columns;
  std::vector<std::vector<std::size_t>> after;
  std::vector<std::size_t> waits_for;
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
        graph.after.emplace_back();
        graph.waits_for.push_back(0);
      }
      const std::size_t place = found->second;
      if (!is_first && last != place) {
        graph.after[last].push_back(place);
        ++graph.waits_for[place];
      }
      last = place;
      is_first = false;
    }
  }
  return graph;
}

}  // namespace

std::vector<const DataColumn*> ordered_cell_columns(const FileMesh& mesh) {
  ColumnGraph graph = graph_of(mesh);
  const std::size_t n = graph.columns.size();
  std::vector<const DataColumn*> ordered;
  std::vector<bool> is_placed(n, false);
  std::set<std::size_t> ready;  // all before them are placed
  for (std::size_t i = 0; i < n; ++i) {
    if (graph.waits_for[i] == 0) ready.insert(i);
  }
  std::size_t waiting = 0;  // all that come first before it are placed
  while (ordered.size() < n) {
    while (is_placed[waiting]) ++waiting;
    // Where none is ready, kinds contradict each other.
    const std::size_t next = ready.empty() ? waiting : *ready.begin();
    ready.erase(next);
    is_placed[next] = true;
    ordered.push_back(graph.columns[next]);
    for (const std::size_t i : graph.after[next]) {
      if (--graph.waits_for[i] == 0 && !is_placed[i]) ready.insert(i);
    }
  }
  return ordered;
}

}  // namespace sunder
