// SPDX-License-Identifier: MIT
// The smallest kernel in C++ that the suite can judge: glued faces, searches and union-find. Keep
// serve.hpp, and put a kernel of your own behind the six functions. It knows nothing of Sunder:
//   c++ -std=c++17 -O2 minimal.cpp -o minimal
#include "serve.hpp"

#include <cmath>
#include <numeric>
#include <set>

namespace {

using namespace adapter;

/// Groups of numbers that were joined.
class Union {
 public:
  explicit Union(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::uint32_t root(std::uint32_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Places of the corners of a tetrahedron's cells: 4 vertices, 6 edges, 4 faces.
constexpr std::array<unsigned, 14> cells = {1, 2, 4, 8, 3, 5, 9, 6, 10, 12, 7, 11, 13, 14};

class Kernel {
 public:
  std::string load(const Body& body) {
    body_ = body;
    if (body.tetrahedra.empty()) return "no tetrahedron";
    for (const auto& point : body.points) {
      for (const double x : point) {
        if (!std::isfinite(x)) return "a coordinate that is no number";
      }
    }
    std::set<std::set<std::uint32_t>> corners;
    std::set<std::array<std::uint32_t, 3>> twice;
    for (const Tetrahedron& t : body.tetrahedra) {
      const std::set<std::uint32_t> points(t.begin(), t.end());
      if (points.size() < 4) return "a repeated point";
      if (!corners.insert(points).second) return "a tetrahedron that is there twice";
    }
    across_.assign(4 * body.tetrahedra.size(), none);
    const auto common = common_faces(body);
    for (const auto& [a, b] : common) {
      std::array<std::uint32_t, 3> face = points_of(body, a);
      std::sort(face.begin(), face.end());
      twice.insert(face);
      glue(a, b);
    }
    for (std::uint32_t t = 0; t < body.tetrahedra.size(); ++t) {
      for (const std::uint32_t p : body.tetrahedra[t]) {
        std::array<std::uint32_t, 3> face = points_of(body, {t, p});
        std::sort(face.begin(), face.end());
        if (across_[row({t, p})] == none && twice.count(face)) return "a face of three tetrahedra";
      }
    }
    const std::vector<Tetrahedron> turned = alike(body, common);
    for (const auto& [a, b] : common) {
      if (same_sense(turned[a.tetrahedron], a.opposite, turned[b.tetrahedron], b.opposite)) {
        return "no common orientation";
      }
    }
    return "";
  }

  std::optional<Parted> split(Side side) {
    const std::uint32_t here = row(side), there = across_[here];
    if (there == none) return std::nullopt;
    across_[here] = across_[there] = none;
    const std::array<std::uint32_t, 3> face = points_of(body_, side);
    Parted parted;
    for (const std::uint32_t p : face) {
      if (!meet(here, there, {p})) parted.vertices.push_back(p);
    }
    for (const std::array<int, 2>& ends : {std::array{0, 1}, {0, 2}, {1, 2}}) {
      const std::uint32_t a = face[ends[0]], b = face[ends[1]];
      if (!meet(here, there, {a, b})) parted.edges.push_back({a, b});
    }
    parted.separated = !meet(here, there, {});
    return parted;
  }

  bool glue(Side a, Side b) {
    const std::uint32_t f = row(a), g = row(b);
    if (f == g || across_[f] != none || across_[g] != none) return false;
    across_[f] = g;
    across_[g] = f;
    return true;
  }

  Counts counts() {
    Union groups = classes();
    std::array<std::set<std::uint32_t>, 5> of_size;
    for (std::uint32_t t = 0; t < body_.tetrahedra.size(); ++t) {
      for (std::uint32_t c = 0; c < cells.size(); ++c) {
        of_size[c < 4 ? 1 : c < 10 ? 2 : 3].insert(groups.root(14 * t + c));
      }
    }
    const std::vector<std::uint32_t> component = components();
    of_size[4].insert(component.begin(), component.end());
    std::size_t boundary = 0;
    std::set<std::uint32_t> sheets;
    Union sheet = groups;  // boundary faces grow together across edges
    for (std::uint32_t f = 0; f < across_.size(); ++f) {
      if (across_[f] == none) join_edges(sheet, f);
    }
    for (std::uint32_t f = 0; f < across_.size(); ++f) {
      if (across_[f] != none) continue;
      ++boundary;
      sheets.insert(sheet.root(14 * (f / 4) + face_cell(f % 4)));
    }
    return {of_size[1].size(), of_size[2].size(), of_size[3].size(), body_.tetrahedra.size(),
            of_size[4].size(), boundary,          sheets.size()};
  }

  std::vector<std::uint32_t> vertices() {
    Union groups = classes();
    std::vector<std::uint32_t> of;
    for (std::uint32_t t = 0; t < body_.tetrahedra.size(); ++t) {
      for (std::uint32_t c = 0; c < 4; ++c) of.push_back(groups.root(14 * t + c));
    }
    return of;
  }

  std::vector<std::uint32_t> components() const {
    Union groups(body_.tetrahedra.size());
    for (std::uint32_t f = 0; f < across_.size(); ++f) {
      if (across_[f] != none) groups.join(f / 4, across_[f] / 4);
    }
    std::vector<std::uint32_t> of;
    for (std::uint32_t t = 0; t < body_.tetrahedra.size(); ++t) of.push_back(groups.root(t));
    return of;
  }

 private:
  static constexpr std::uint32_t none = 0xffffffffU;

  /// Four sides to a tetrahedron.
  std::uint32_t row(Side side) const {
    const Tetrahedron& corners = body_.tetrahedra[side.tetrahedron];
    return static_cast<std::uint32_t>(4 * side.tetrahedron + place_of(corners, side.opposite));
  }
  /// Which of `cells` the face opposite to a place is.
  static std::uint32_t face_cell(std::uint32_t place) { return 13 - place; }

  /// Whether glued faces that contain all the points lead from one side's tetrahedron to another's.
  bool meet(std::uint32_t a, std::uint32_t b, const std::vector<std::uint32_t>& points) {
    return search_.connected(a / 4, b / 4, body_.tetrahedra.size(),
                             [&](std::uint32_t t, const auto& visit) {
                               for (std::uint32_t k = 0; k < 4; ++k) {
                                 const std::uint32_t p = body_.tetrahedra[t][k];
                                 if (std::count(points.begin(), points.end(), p)) continue;
                                 if (across_[4 * t + k] != none) visit(across_[4 * t + k] / 4);
                               }
                             });
  }

  /// The cell of another tetrahedron with the same points.
  std::uint32_t same_cell(std::uint32_t t, unsigned places, std::uint32_t other) const {
    unsigned found = 0;
    for (unsigned k = 0; k < 4; ++k) {
      if (places >> k & 1) found |= 1U << place_of(body_.tetrahedra[other], body_.tetrahedra[t][k]);
    }
    return static_cast<std::uint32_t>(std::find(cells.begin(), cells.end(), found) - cells.begin());
  }

  /// Cells of all tetrahedra, 14 each, that are one: by glued faces that contain them.
  Union classes() const {
    Union groups(14 * body_.tetrahedra.size());
    for (std::uint32_t f = 0; f < across_.size(); ++f) {
      if (across_[f] == none) continue;
      const std::uint32_t t = f / 4, other = across_[f] / 4;
      for (std::uint32_t c = 0; c < cells.size(); ++c) {
        if (cells[c] >> f % 4 & 1) continue;
        groups.join(14 * t + c, 14 * other + same_cell(t, cells[c], other));
      }
    }
    return groups;
  }

  /// A boundary face and its edges become one sheet.
  void join_edges(Union& sheet, std::uint32_t f) const {
    for (std::uint32_t c = 4; c < 10; ++c) {
      if (!(cells[c] >> f % 4 & 1)) sheet.join(14 * (f / 4) + c, 14 * (f / 4) + face_cell(f % 4));
    }
  }

  Body body_;
  std::vector<std::uint32_t> across_;
  Search search_;
};

}  // namespace

int main() { return serve(Kernel(), "minimal-cpp"); }
