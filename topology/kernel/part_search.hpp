// SPDX-License-Identifier: MIT
// The lockstep search: the parts of a body, found at the cost of all parts but the largest.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "topology/base/union_find.hpp"
#include "topology/kernel/components.hpp"

namespace sunder {

namespace detail {
inline constexpr std::uint32_t no_tetrahedron = std::numeric_limits<std::uint32_t>::max();
}

/// Calls `visit(tetrahedron)` for every one that a part has met.
template <class Visit>
void for_each_tetrahedron(const ComponentScratch& scratch, std::uint32_t part, Visit visit) {
  const ComponentScratch::Part& lists = scratch.parts[part];
  for (const std::uint32_t head : {lists.todo_head, lists.done_head}) {
    for (std::uint32_t t = head; t != detail::no_tetrahedron; t = scratch.next[t]) visit(TetId{t});
  }
}

/// Parts of one component that grow towards each other, in turn by one tetrahedron each. Parts that
/// meet are joined, a part with no neighbour left to take is closed. The results are left in
/// `scratch.closed` (parts by their rows in `scratch.parts`) and `scratch.live`. Lists of
/// tetrahedra are chained through `scratch.next`, so that joining two parts is O(1). Of `K` only
/// tetrahedra() and neighbour() are used, so it may be a view of a map.
template <class K>
class PartSearch {
 public:
  /// Discards the contents of the scratch.
  PartSearch(const K& map, ComponentScratch& scratch) : map_(map), s_(scratch) {
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

  /// A part that begins with `t`; none where another has it already.
  void add_source(TetId t) {
    if (met(t)) return;
    const auto part = static_cast<std::uint32_t>(s_.parts.size());
    s_.parts.push_back({part, detail::no_tetrahedron, detail::no_tetrahedron,
                        detail::no_tetrahedron, detail::no_tetrahedron, 0, t});
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
        // Parts that it meets in a step join it, not it them.
        if (growing_ <= enough || step(part)) s_.live[kept++] = part;
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
    return root_of(part, [this](std::uint32_t i) -> std::uint32_t& { return s_.parts[i].parent; });
  }

  void add(std::uint32_t part, TetId t) {
    s_.stamp[t.index()] = s_.now;
    s_.owner[t.index()] = part;
    s_.next[t.index()] = detail::no_tetrahedron;
    auto& p = s_.parts[part];
    (p.todo_head == detail::no_tetrahedron ? p.todo_head : s_.next[p.todo_tail]) = t.value;
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
    if (more == detail::no_tetrahedron) return;
    (head == detail::no_tetrahedron ? head : s_.next[tail]) = more;
    tail = end;
  }

  /// Looks around one tetrahedron of `part`; false when there is none left: the part is closed.
  bool step(std::uint32_t part) {
    auto& p = s_.parts[part];
    const std::uint32_t t = p.todo_head;
    if (t == detail::no_tetrahedron) {
      s_.closed.push_back(part);
      --growing_;
      return false;
    }
    p.todo_head = s_.next[t];
    s_.next[t] = detail::no_tetrahedron;
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

}  // namespace sunder
