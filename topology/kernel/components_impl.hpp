// SPDX-License-Identifier: MIT
// Bodies of components.hpp, for the sources that instantiate them for a kernel.
#pragma once

#include <algorithm>

#include "topology/kernel/components.hpp"
#include "topology/kernel/part_search.hpp"

namespace sunder::detail {

/// Gives every closed part but the largest a fresh id, and its members that label.
template <Kernel K>
std::size_t relabel_parts(const K& map, ComponentId old, bool rest_keeps_id, Components& labels,
                          ComponentScratch& s) {
  auto& closed = s.closed;
  std::sort(closed.begin(), closed.end(), [&s](std::uint32_t a, std::uint32_t b) {
    return s.parts[a].lowest < s.parts[b].lowest;
  });
  if (!rest_keeps_id) {
    // The first of equals in this order has the lowest tetrahedron.
    closed.erase(std::max_element(
        closed.begin(), closed.end(),
        [&s](std::uint32_t a, std::uint32_t b) { return s.parts[a].found < s.parts[b].found; }));
  }
  for (const std::uint32_t part : closed) {
    const ComponentId fresh{labels.size.size()};
    labels.size.push_back(s.parts[part].found);
    labels.parent.push_back(old);
    labels.size[old.index()] -= s.parts[part].found;
    for_each_tetrahedron(s, part, [&](TetId t) {
      labels.of_tetrahedron[t.index()] = fresh;
      for (const VertexId v : map.corners(t)) labels.of_vertex[v.index()] = fresh;
    });
  }
  return closed.size();
}

/// Where the search starts: both sides of the faces that count, by component.
inline void collect_sources(std::span<const FaceSplit> splits, Detection detection,
                            const Components& labels, ComponentScratch& s) {
  s.sources.clear();
  for (const FaceSplit& split : splits) {
    if (!split.did || (asks_oracle(detection) && !oracle_says_new(split))) continue;
    const TetId a = tetrahedron_of(split.face), b = tetrahedron_of(split.opposite);
    s.sources.push_back({labels.of_tetrahedron[a.index()], a, split.vertex_count});
    s.sources.push_back({labels.of_tetrahedron[b.index()], b, 0});
  }
  std::sort(s.sources.begin(), s.sources.end(),
            [](const ComponentScratch::Source& a, const ComponentScratch::Source& b) {
              return a.component != b.component ? a.component < b.component
                                                : a.tetrahedron < b.tetrahedron;
            });
}

inline void label_copies(std::span<const FaceSplit> splits, std::size_t vertices,
                         Components& labels) {
  labels.of_vertex.resize(vertices);
  for (const FaceSplit& split : splits) {
    for (int i = 0; i < split.vertex_count; ++i) {
      const auto [from, to] = split.split_vertices[i];
      labels.of_vertex[to.index()] = labels.of_vertex[from.index()];
    }
  }
}

}  // namespace sunder::detail

namespace sunder {

template <Kernel K>
Components label_components(const K& map) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return label_components(kernel); });
  }
  Components labels;
  labels.of_tetrahedron.resize(map.tetrahedra());
  labels.of_vertex.resize(map.vertices());
  std::vector<TetId> stack;
  for (std::size_t first = 0; first < map.tetrahedra(); ++first) {
    if (!labels.of_tetrahedron[first].is_none()) continue;
    const ComponentId id{labels.size.size()};
    labels.size.push_back(0);
    labels.parent.push_back(ComponentId::none());
    labels.of_tetrahedron[first] = id;
    stack.push_back(TetId{first});
    while (!stack.empty()) {
      const TetId t = stack.back();
      stack.pop_back();
      ++labels.size[id.index()];
      for (const VertexId v : map.corners(t)) labels.of_vertex[v.index()] = id;
      for (int p = 0; p < 4; ++p) {
        const HalfFaceId across = map.neighbour(half_face(t, p));
        if (across.is_none()) continue;
        ComponentId& label = labels.of_tetrahedron[tetrahedron_of(across).index()];
        if (!label.is_none()) continue;
        label = id;
        stack.push_back(tetrahedron_of(across));
      }
    }
  }
  return labels;
}

template <Kernel K>
ComponentUpdate update_components(const K& map, std::span<const FaceSplit> splits,
                                  Detection detection, Components& labels,
                                  ComponentScratch& scratch) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) {
      return update_components(kernel, splits, detection, labels, scratch);
    });
  }
  ComponentUpdate update;
  update.first_new = ComponentId{labels.size.size()};
  for (const FaceSplit& split : splits) update.predicted += oracle_says_new(split) ? 1 : 0;
  detail::label_copies(splits, map.vertices(), labels);
  detail::collect_sources(splits, detection, labels, scratch);
  const auto& sources = scratch.sources;
  for (std::size_t first = 0; first < sources.size();) {
    const ComponentId old = sources[first].component;
    PartSearch<K> search(map, scratch);
    int parted = 0;
    for (; first < sources.size() && sources[first].component == old; ++first) {
      search.add_source(sources[first].tetrahedron);
      parted += sources[first].parted;
    }
    if (detection == Detection::dirty_counter && parted < 3) continue;
    search.run(detection == Detection::exact ? 1 : 0);
    bool rest_keeps_id = search.growing() > 0;
    if (rest_keeps_id) {
      // Nobody walked the rest to its end; that is needed only where it may not be the largest.
      const std::size_t rest = labels.size[old.index()] - search.closed_size();
      const bool largest =
          std::all_of(scratch.closed.begin(), scratch.closed.end(),
                      [&](std::uint32_t part) { return scratch.parts[part].found < rest; });
      if (!largest) {
        search.run(0);
        rest_keeps_id = false;
      }
    }
    update.visited += search.visited();
    update.created += detail::relabel_parts(map, old, rest_keeps_id, labels, scratch);
  }
  return update;
}

}  // namespace sunder
