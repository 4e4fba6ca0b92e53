// SPDX-License-Identifier: MIT
// Bodies of components.hpp, for the sources that instantiate them for a kernel.
#pragma once

#include <algorithm>
#include <limits>

#include "topology/kernel/components.hpp"

namespace sunder::detail {

inline constexpr std::uint32_t no_tetrahedron = std::numeric_limits<std::uint32_t>::max();

/// Parts of one old component that grow towards each other; lists of tetrahedra are chained
/// through `scratch.next`, so that joining two parts is O(1). Of `K` only tetrahedra() and
/// neighbour() are asked.
template <class K>
class Lockstep {
 public:
  Lockstep(const K& map, ComponentScratch& scratch) : map_(map), s_(scratch) {
    if (s_.stamp.size() != map.tetrahedra() || ++s_.now == 0) {
      s_.stamp.assign(map.tetrahedra(), 0);
      s_.owner.resize(map.tetrahedra());
      s_.next.resize(map.tetrahedra());
      s_.now = 1;
    }
    s_.parts.clear();
    s_.live.clear();
    s_.closed.clear();
  }

  void add_source(TetId t) {
    if (met(t)) return;
    const auto part = static_cast<std::uint32_t>(s_.parts.size());
    s_.parts.push_back(
        {part, no_tetrahedron, no_tetrahedron, no_tetrahedron, no_tetrahedron, 0, t});
    s_.live.push_back(part);
    ++growing_;
    add(part, t);
  }

  /// Grows all live parts in turn until at most `enough` of them still grow.
  void run(std::size_t enough) {
    while (growing_ > enough) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < s_.live.size(); ++i) {
        const std::uint32_t part = s_.live[i];
        if (s_.parts[part].parent != part) continue;  // it joined another
        if (growing_ > enough && !step(part)) continue;
        // A step may have made it join a part earlier in the list: that one stays, not this.
        if (s_.parts[part].parent == part) s_.live[kept++] = part;
      }
      s_.live.resize(kept);
    }
  }

  /// Tetrahedra met by parts that have no room left to grow.
  std::size_t closed_size() const {
    std::size_t sum = 0;
    for (const std::uint32_t part : s_.closed) sum += s_.parts[part].found;
    return sum;
  }
  std::size_t visited() const { return visited_; }
  std::size_t growing() const { return growing_; }

 private:
  bool met(TetId t) const { return s_.stamp[t.index()] == s_.now; }

  std::uint32_t root(std::uint32_t part) {
    while (s_.parts[part].parent != part) {
      part = s_.parts[part].parent = s_.parts[s_.parts[part].parent].parent;
    }
    return part;
  }

  void add(std::uint32_t part, TetId t) {
    s_.stamp[t.index()] = s_.now;
    s_.owner[t.index()] = part;
    s_.next[t.index()] = no_tetrahedron;
    auto& p = s_.parts[part];
    (p.todo_head == no_tetrahedron ? p.todo_head : s_.next[p.todo_tail]) = t.value;
    p.todo_tail = t.value;
    p.lowest = std::min(p.lowest, t);
    ++p.found;
    ++visited_;
  }

  void join(std::uint32_t into, std::uint32_t part) {
    auto& a = s_.parts[into];
    auto& b = s_.parts[part];
    b.parent = into;
    chain(a.todo_head, a.todo_tail, b.todo_head, b.todo_tail);
    chain(a.done_head, a.done_tail, b.done_head, b.done_tail);
    a.found += b.found;
    a.lowest = std::min(a.lowest, b.lowest);
    --growing_;
  }

  void chain(std::uint32_t& head, std::uint32_t& tail, std::uint32_t more, std::uint32_t end) {
    if (more == no_tetrahedron) return;
    (head == no_tetrahedron ? head : s_.next[tail]) = more;
    tail = end;
  }

  /// Looks around one tetrahedron of `part`; false when there is none left: the part is closed.
  bool step(std::uint32_t part) {
    auto& p = s_.parts[part];
    const std::uint32_t t = p.todo_head;
    if (t == no_tetrahedron) {
      s_.closed.push_back(part);
      --growing_;
      return false;
    }
    p.todo_head = s_.next[t];
    s_.next[t] = no_tetrahedron;
    chain(p.done_head, p.done_tail, t, t);
    for (int place = 0; place < 4; ++place) {
      const HalfFaceId across = map_.neighbour(half_face(TetId{t}, place));
      if (across.is_none()) continue;
      const TetId u = tetrahedron_of(across);
      if (!met(u)) {
        add(part, u);
      } else if (const std::uint32_t other = root(s_.owner[u.index()]); other != part) {
        join(part, other);
      }
    }
    return true;
  }

  const K& map_;
  ComponentScratch& s_;
  std::size_t growing_ = 0;  // live parts that are not known to be closed
  std::size_t visited_ = 0;
};

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
    for (std::uint32_t t = s.parts[part].done_head; t != no_tetrahedron; t = s.next[t]) {
      labels.of_tetrahedron[t] = fresh;
      for (const VertexId v : map.corners(TetId{t})) labels.of_vertex[v.index()] = fresh;
    }
  }
  return closed.size();
}

/// Where the search starts: both sides of the faces that count, by component.
inline void collect_sources(std::span<const FaceSplit> splits, Detection detection,
                            const Components& labels, ComponentScratch& s) {
  s.sources.clear();
  for (const FaceSplit& split : splits) {
    const bool only_suspects = detection == Detection::oracle || detection == Detection::exact;
    if (!split.did || (only_suspects && !oracle_says_new(split))) continue;
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
  ComponentUpdate update;
  update.first_new = ComponentId{labels.size.size()};
  for (const FaceSplit& split : splits) update.predicted += oracle_says_new(split) ? 1 : 0;
  detail::label_copies(splits, map.vertices(), labels);
  detail::collect_sources(splits, detection, labels, scratch);
  const auto& sources = scratch.sources;
  for (std::size_t first = 0; first < sources.size();) {
    const ComponentId old = sources[first].component;
    detail::Lockstep<K> search(map, scratch);
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
