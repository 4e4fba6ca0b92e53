// SPDX-License-Identifier: MIT
// Brute force over points.
#include "tests/topology/cells/cell_twin.hpp"

#include <algorithm>

#include "topology/base/union_find.hpp"

namespace sunder::test {
namespace {

using Tet = std::array<std::uint32_t, 4>;
using Triple = std::array<std::uint32_t, 3>;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

constexpr std::array<std::array<std::size_t, 2>, 6> ends = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

Pair pair_of(const Tet& t, std::size_t e) { return std::minmax(t[ends[e][0]], t[ends[e][1]]); }

/// A point of a part: on the edge of these two points of the parent, or that point twice.
bool lies_on(const Triple& whole, std::uint32_t point,
             const std::map<std::uint32_t, Pair>& middle) {
  const auto has = [&](std::uint32_t p) { return std::ranges::find(whole, p) != whole.end(); };
  const auto m = middle.find(point);
  return m == middle.end() ? has(point) : has(m->second.first) && has(m->second.second);
}

std::vector<Tet> parts(Tet t, const std::map<Pair, std::uint32_t>& middles,
                       const std::set<Pair>& inner) {
  const auto m = [&](std::size_t a, std::size_t b) { return middles.at(std::minmax(t[a], t[b])); };
  for (int turn = 0; middles.size() == 6 && turn < 3; ++turn) {
    if (inner.contains(std::minmax(m(0, 2), m(1, 3)))) break;
    std::rotate(t.begin() + 1, t.begin() + 2, t.end());
  }
  if (middles.size() == 6) {  // Bey's list as he writes it
    return {{t[0], m(0, 1), m(0, 2), m(0, 3)},    {m(0, 1), t[1], m(1, 2), m(1, 3)},
            {m(0, 2), m(1, 2), t[2], m(2, 3)},    {m(0, 3), m(1, 3), m(2, 3), t[3]},
            {m(0, 1), m(0, 2), m(0, 3), m(1, 3)}, {m(0, 1), m(0, 2), m(1, 2), m(1, 3)},
            {m(0, 2), m(0, 3), m(1, 3), m(2, 3)}, {m(0, 2), m(1, 2), m(1, 3), m(2, 3)}};
  }
  for (std::size_t p = 0; p < 4 && middles.size() == 3; ++p) {
    std::vector<std::size_t> f;
    for (std::size_t i = 0; i < 4; ++i) {
      if (i != p) f.push_back(i);
    }
    const auto is_divided = [&](std::size_t a, std::size_t b) {
      return middles.contains(std::minmax(t[a], t[b]));
    };
    if (!is_divided(f[0], f[1]) || !is_divided(f[1], f[2]) || !is_divided(f[0], f[2])) continue;
    const auto ab = m(f[0], f[1]), bc = m(f[1], f[2]), ac = m(f[0], f[2]);
    return {{t[p], t[f[0]], ab, ac},
            {t[p], t[f[1]], ab, bc},
            {t[p], t[f[2]], ac, bc},
            {t[p], ab, bc, ac}};
  }
  std::map<std::uint32_t, Pair> turns;
  for (const auto& [pair, name] : middles) turns[name] = pair;
  std::vector<Tet> all{t};
  for (const auto& [name, pair] : turns) {
    std::vector<Tet> next;
    for (const Tet& x : all) {
      const bool has = std::ranges::count(x, pair.first) + std::ranges::count(x, pair.second) == 2;
      Tet a = x, b = x;
      if (has) {
        std::ranges::replace(a, pair.first, name);
        std::ranges::replace(b, pair.second, name);
        next.push_back(b);
      }
      next.push_back(a);
    }
    all = next;
  }
  return all;
}

Triple sorted(Triple t) {
  std::ranges::sort(t);
  return t;
}

}  // namespace

suite::GlueTwin glued(const CellTwin& twin) {
  std::uint32_t points = 0;
  for (const Tet& t : twin.tetrahedra) points = std::max(points, *std::ranges::max_element(t) + 1);
  suite::GlueTwin glue = suite::glue_twin(twin.tetrahedra, points);
  for (std::size_t f = 0; f < glue.glued.size(); ++f) {
    const Tet& t = twin.tetrahedra[f / 4];
    Triple rows;
    for (std::size_t i = 0, n = 0; i < 4; ++i) {
      if (i != f % 4) rows[n++] = t[i];
    }
    if (!glue.glued[f].is_none() && twin.cut.contains(sorted(rows))) {
      suite::unglue(glue, HalfFaceId{f});
    }
  }
  return glue;
}

std::vector<std::array<std::uint32_t, 6>> edge_classes(const CellTwin& twin) {
  const suite::GlueTwin glue = glued(twin);
  UnionFind classes(6 * twin.tetrahedra.size());
  for (std::size_t f = 0; f < glue.glued.size(); ++f) {
    if (glue.glued[f].is_none()) continue;
    const std::size_t t = f / 4, u = glue.glued[f].index() / 4;
    for (std::size_t e = 0; e < 6; ++e) {
      if (ends[e][0] == f % 4 || ends[e][1] == f % 4) continue;
      for (std::size_t g = 0; g < 6; ++g) {
        if (pair_of(twin.tetrahedra[t], e) == pair_of(twin.tetrahedra[u], g)) {
          classes.join(static_cast<std::uint32_t>(6 * t + e),
                       static_cast<std::uint32_t>(6 * u + g));
        }
      }
    }
  }
  const std::vector<std::uint32_t> roots = std::move(classes).roots();
  std::vector<std::array<std::uint32_t, 6>> rows(twin.tetrahedra.size());
  for (std::size_t i = 0; i < roots.size(); ++i) rows[i / 6][i % 6] = roots[i];
  return rows;
}

std::set<std::uint32_t> closed_edges(const std::vector<std::array<std::uint32_t, 6>>& classes,
                                     const std::vector<std::size_t>& cells) {
  std::set<std::uint32_t> edges;
  for (const std::size_t t : cells) edges.insert(classes[t].begin(), classes[t].end());
  for (bool grew = true; grew;) {
    grew = false;
    for (const auto& of : classes) {
      std::vector<std::size_t> has;
      for (std::size_t e = 0; e < 6; ++e) {
        if (edges.contains(of[e])) has.push_back(e);
      }
      if (has.size() <= 2 || has.size() == 6) continue;
      std::set<std::size_t> corners;
      for (const std::size_t e : has) corners.insert(ends[e].begin(), ends[e].end());
      if (has.size() == 3 && corners.size() == 3) continue;
      edges.insert(of.begin(), of.end());
      grew = true;
    }
  }
  return edges;
}

bool divide(CellTwin& twin, const std::set<std::uint32_t>& edges, const MiddleNames& names,
            const std::set<Pair>& inner) {
  const auto classes = edge_classes(twin);
  std::vector<Tet> after;
  for (std::size_t t = 0; t < twin.tetrahedra.size(); ++t) {
    std::map<Pair, std::uint32_t> middles;
    std::map<std::uint32_t, Pair> ends_of;
    for (std::size_t e = 0; e < 6; ++e) {
      if (!edges.contains(classes[t][e])) continue;
      const Pair pair = pair_of(twin.tetrahedra[t], e);
      const auto name = names.find(pair);
      if (name == names.end()) return false;
      middles[pair] = name->second;
      ends_of[name->second] = pair;
    }
    const std::vector<Tet> made = parts(twin.tetrahedra[t], middles, inner);
    for (std::size_t p = 0; p < 4; ++p) {
      Triple whole;
      for (std::size_t i = 0, n = 0; i < 4; ++i) {
        if (i != p) whole[n++] = twin.tetrahedra[t][i];
      }
      if (!twin.cut.contains(sorted(whole))) continue;
      for (const Tet& part : made) {
        for (std::size_t q = 0; q < 4; ++q) {
          Triple rows;
          for (std::size_t i = 0, n = 0; i < 4; ++i) {
            if (i != q) rows[n++] = part[i];
          }
          if (std::ranges::all_of(rows, [&](auto x) { return lies_on(whole, x, ends_of); })) {
            twin.cut.insert(sorted(rows));
          }
        }
      }
    }
    after.insert(after.end(), made.begin(), made.end());
  }
  twin.tetrahedra = std::move(after);
  return true;
}

std::vector<Tet> as_set(const std::vector<Tet>& tetrahedra) {
  std::vector<Tet> set = tetrahedra;
  for (Tet& t : set) std::ranges::sort(t);
  std::ranges::sort(set);
  return set;
}

}  // namespace sunder::test
