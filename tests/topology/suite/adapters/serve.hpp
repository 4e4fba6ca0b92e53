// SPDX-License-Identifier: MIT
// The shared part of all adapters in C++: the loop over questions of docs/reference/suite.md,
// common faces of a body as it is read, and turning its tetrahedra round until they lie alike. It
// knows no library, and nothing of Sunder.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace adapter {

using Tetrahedron = std::array<std::uint32_t, 4>;

struct Body {
  std::vector<std::array<double, 3>> points;
  std::vector<Tetrahedron> tetrahedra;
};

/// A face seen from one of its tetrahedra: opposite to its corner at a point.
struct Side {
  std::uint32_t tetrahedron = 0, opposite = 0;
};

/// The cells that came apart when a face was split: points and edges of it, and any component.
struct Parted {
  std::vector<std::uint32_t> vertices;
  std::vector<std::array<std::uint32_t, 2>> edges;
  bool separated = false;
};

/// Vertices, edges, faces, tetrahedra, components, boundary faces, boundary sheets.
using Counts = std::array<std::size_t, 7>;

inline std::size_t place_of(const Tetrahedron& corners, std::uint32_t point) {
  return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), point) -
                                  corners.begin());
}

/// The points of a face, in the order of the tetrahedron's corners.
inline std::array<std::uint32_t, 3> points_of(const Body& body, Side side) {
  std::array<std::uint32_t, 3> face = {};
  std::size_t n = 0;
  bool left_out = false;
  for (const std::uint32_t p : body.tetrahedra[side.tetrahedron]) {
    if (p == side.opposite && !left_out) {
      left_out = true;
    } else if (n < 3) {
      face[n++] = p;
    }
  }
  return face;
}

/// Pairs of sides with the same three points, the first two of each: a third tetrahedron on a face
/// stays apart.
inline std::vector<std::array<Side, 2>> common_faces(const Body& body) {
  std::map<std::array<std::uint32_t, 3>, std::optional<Side>> open;
  std::vector<std::array<Side, 2>> pairs;
  for (std::uint32_t t = 0; t < body.tetrahedra.size(); ++t) {
    for (const std::uint32_t p : body.tetrahedra[t]) {
      std::array<std::uint32_t, 3> face = points_of(body, {t, p});
      std::sort(face.begin(), face.end());
      const auto [it, fresh] = open.emplace(face, Side{t, p});
      if (fresh || !it->second) continue;
      pairs.push_back({*it->second, Side{t, p}});
      it->second.reset();
    }
  }
  return pairs;
}

/// Whether an even permutation leads from `a` to `b`, the one point that only `a` has taken for the
/// one that only `b` has: then the two tetrahedra lie on their common face in the same sense.
inline bool same_sense(const Tetrahedron& a, std::uint32_t only_a, Tetrahedron b,
                       std::uint32_t only_b) {
  b[place_of(b, only_b)] = only_a;
  bool even = true;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto j = static_cast<std::size_t>(std::find(b.begin() + i, b.end(), a[i]) - b.begin());
    if (j == i || j == 4) continue;
    std::swap(b[i], b[j]);
    even = !even;
  }
  return even;
}

/// The tetrahedra with two corners exchanged where that is needed for neighbours to lie alike, as
/// far as the body can be oriented: an oriented map wants that.
inline std::vector<Tetrahedron> alike(const Body& body,
                                      const std::vector<std::array<Side, 2>>& common) {
  struct Next {
    std::uint32_t tetrahedron;
    bool same;
  };
  std::vector<std::vector<Next>> next(body.tetrahedra.size());
  for (const auto& [a, b] : common) {
    const bool same = same_sense(body.tetrahedra[a.tetrahedron], a.opposite,
                                 body.tetrahedra[b.tetrahedron], b.opposite);
    next[a.tetrahedron].push_back({b.tetrahedron, same});
    next[b.tetrahedron].push_back({a.tetrahedron, same});
  }
  std::vector<std::optional<bool>> turn(next.size());
  std::vector<std::uint32_t> stack;
  for (std::uint32_t seed = 0; seed < turn.size(); ++seed) {
    if (turn[seed]) continue;
    turn[seed] = false;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      for (const auto& [u, same] : next[t]) {
        if (turn[u]) continue;
        turn[u] = *turn[t] != same;
        stack.push_back(u);
      }
    }
  }
  std::vector<Tetrahedron> turned = body.tetrahedra;
  for (std::size_t t = 0; t < turned.size(); ++t) {
    if (*turn[t]) std::swap(turned[t][2], turned[t][3]);
  }
  return turned;
}

/// Whether two tetrahedra hang together: a search from both in turn. `neighbours(t, visit)` calls
/// `visit` with each tetrahedron that shares a face with t now.
class Search {
 public:
  template <class Neighbours>
  bool connected(std::uint32_t a, std::uint32_t b, std::size_t size, const Neighbours& neighbours) {
    seen_.resize(size);
    const std::size_t stamp = ++searches_;
    std::array<std::vector<std::uint32_t>, 2> queue;
    bool met = a == b;
    const auto meet = [&](int side, std::uint32_t t) {
      if (seen_[t].stamp == stamp) {
        met = met || seen_[t].side != side;
        return;
      }
      seen_[t] = {stamp, side};
      queue[side].push_back(t);
    };
    meet(0, a);
    meet(1, b);
    std::array<std::size_t, 2> at = {0, 0};
    for (int side = 0; !met && at[side] < queue[side].size(); side = 1 - side) {
      neighbours(queue[side][at[side]++], [&](std::uint32_t t) { meet(side, t); });
    }
    return met;
  }

 private:
  struct Seen {
    std::size_t stamp = 0;
    int side = 0;
  };
  std::vector<Seen> seen_;
  std::size_t searches_ = 0;
};

inline Body read_body(std::size_t points, std::size_t tetrahedra) {
  Body body;
  body.points.resize(points);
  body.tetrahedra.resize(tetrahedra);
  std::string word;
  for (auto& point : body.points) {
    for (double& x : point) {
      std::cin >> word;  // "nan" is no number to a stream
      x = std::stod(word);
    }
  }
  for (auto& corners : body.tetrahedra) {
    for (std::uint32_t& p : corners) std::cin >> p;
  }
  return body;
}

template <class List>
void say_list(std::ostream& out, const std::string& word, const List& list) {
  out << word;
  for (const auto& x : list) out << ' ' << x;
}

inline void say(std::ostream& out, const std::optional<Parted>& parted) {
  if (!parted) {
    out << "boundary";
    return;
  }
  say_list(out, "split " + std::to_string(parted->vertices.size()), parted->vertices);
  out << ' ' << parted->edges.size();
  for (const auto& [a, b] : parted->edges) out << ' ' << a << ' ' << b;
  out << (parted->separated ? " 1" : " 0");
}

/// Answers questions until there are no more. A kernel has load(Body), an empty text or why it
/// refuses; split(Side), nothing on the boundary; glue(Side, Side), whether it did; counts();
/// vertices() and components(), lists of numbers. A point that is not there is refused here: to a
/// library it would be undefined.
template <class Kernel>
int serve(Kernel&& kernel, const std::string& name) {
  std::ios::sync_with_stdio(false);
  // Some libraries print messages on std::cout, where only answers belong.
  std::ostream out(std::cout.rdbuf());
  std::cout.rdbuf(std::cerr.rdbuf());
  std::string word;
  while (std::cin >> word && word != "quit") {
    if (word == "hello") {
      std::cin >> word;
      out << "hello 1 " << name << " glue";
    } else if (word == "mesh") {
      std::size_t points = 0, tetrahedra = 0;
      std::cin >> points >> tetrahedra;
      const Body body = read_body(points, tetrahedra);
      const bool there = std::all_of(body.tetrahedra.begin(), body.tetrahedra.end(),
                                     [points](const Tetrahedron& t) {
                                       return *std::max_element(t.begin(), t.end()) < points;
                                     });
      const std::string why = there ? kernel.load(body) : "a point that is not there";
      out << (why.empty() ? "ok" : "refused " + why);
    } else if (word == "split") {
      Side side;
      std::cin >> side.tetrahedron >> side.opposite;
      say(out, kernel.split(side));
    } else if (word == "glue") {
      Side a, b;
      std::cin >> a.tetrahedron >> a.opposite >> b.tetrahedron >> b.opposite;
      out << (kernel.glue(a, b) ? "ok" : "refused");
    } else if (word == "counts") {
      say_list(out, "counts", kernel.counts());
    } else if (word == "vertices") {
      say_list(out, "vertices", kernel.vertices());
    } else if (word == "components") {
      say_list(out, "components", kernel.components());
    } else {
      out << "unknown";
    }
    out << std::endl;
  }
  return 0;
}

}  // namespace adapter
