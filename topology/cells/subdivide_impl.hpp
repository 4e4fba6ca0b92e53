// SPDX-License-Identifier: MIT
// Bodies of subdivide.hpp, for the source that instantiates them for a kernel.
#pragma once

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "topology/base/assert.hpp"
#include "topology/cells/cell_templates.hpp"
#include "topology/cells/subdivide.hpp"
#include "topology/kernel/edges_impl.hpp"
#include "topology/mesh/radius_ratio.hpp"

namespace sunder::detail {

inline constexpr unsigned all_edges = 63;

/// A tetrahedron that is divided.
struct DividedCell {
  TetId row;
  std::array<VertexId, 4> corners;
  std::array<VertexId, 6> middles;  ///< none() on edges that stay whole
  std::array<double, 6> weights;    ///< from the lower place
  std::size_t first = 0;            ///< of its parts among all
};

/// A part of one, in its row to be.
struct DividedPart {
  CellPart nodes;
  TetId row;
  std::uint32_t parent = 0;
};

/// A division as it is worked out, before anything of the map changes.
template <CellKernel K>
class Division {
 public:
  Division(const K& map, std::span<const EdgeMark> marks, std::span<const char> as_they_stand)
      : map_(map),
        as_they_stand_(as_they_stand),
        change_{map.points().size(), map.vertices(), map.tetrahedra(), {}, {}, {}, {}} {
    add_vertices(marks);
    make_parts();
    for (std::uint32_t i = 0; i < parts_.size(); ++i) write(parts_[i]);
    for (auto& [row, cell] : beside_) change_.cells.push_back(cell);
    move_begins();
  }

  CellEdit carry_out(K& map) && {
    edit_.undo = map.apply(change_);
    return std::move(edit_);
  }

 private:
  void add_vertices(std::span<const EdgeMark> marks) {
    struct Touch {
      CellEdge edge;
      VertexId vertex;
      double weight;
    };
    std::vector<Touch> touches;
    // Both sides of a crack get one point.
    std::map<std::tuple<std::uint32_t, std::uint32_t, double>, std::uint32_t> points;
    for (const auto& [edge, weight] : marks) {
      SUNDER_ASSERT(weight > 0 && weight < 1, "a vertex inside its edge");
      const auto ends = edge_ends[static_cast<std::size_t>(edge.place)];
      const auto corners = map_.corners(edge.tetrahedron);
      std::array<VertexId, 2> rows = {corners[ends[0]], corners[ends[1]]};
      if (map_.point_of_vertex(rows[1]) < map_.point_of_vertex(rows[0]))
        std::swap(rows[0], rows[1]);
      const std::uint32_t a = map_.point_of_vertex(rows[0]), b = map_.point_of_vertex(rows[1]);
      const auto fresh = static_cast<std::uint32_t>(change_.kept_points + change_.points.size());
      const auto [point, is_new] = points.try_emplace({a, b, weight}, fresh);
      if (is_new) {
        const Point x = map_.point(rows[0]), y = map_.point(rows[1]);
        Point middle;
        for (std::size_t i = 0; i < 3; ++i) middle[i] = (1 - weight) * x[i] + weight * y[i];
        change_.points.push_back(middle);
      }
      const VertexId vertex{change_.kept_vertices + change_.vertices.size()};
      change_.vertices.push_back(point->second);
      edit_.vertices.push_back({vertex, rows, weight});
      for (const CellEdge& at : edge_ring(map_, edge)) {
        const auto low = static_cast<std::size_t>(edge_ends[static_cast<std::size_t>(at.place)][0]);
        const bool same_way = map_.corners(at.tetrahedron)[low] == rows[0];
        touches.push_back({at, vertex, same_way ? weight : 1 - weight});
      }
    }
    std::ranges::stable_sort(touches, {}, [](const Touch& t) { return t.edge.tetrahedron; });
    for (const Touch& touch : touches) {
      const TetId t = touch.edge.tetrahedron;
      if (cells_.empty() || cells_.back().row != t) {
        cells_.push_back({t, map_.corners(t), {}, {}});
      }
      const auto e = static_cast<std::size_t>(touch.edge.place);
      SUNDER_ASSERT(cells_.back().middles[e].is_none(), "each edge is marked once");
      cells_.back().middles[e] = touch.vertex;
      cells_.back().weights[e] = touch.weight;
    }
  }

  void make_parts() {
    std::size_t appended = change_.kept_tetrahedra;
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
      DividedCell& cell = cells_[i];
      unsigned edges = 0;
      std::array<std::uint32_t, 6> order{};
      for (std::size_t e = 0; e < 6; ++e) {
        if (cell.middles[e].is_none()) continue;
        edges |= 1U << e;
        order[e] = change_.vertices[cell.middles[e].index() - change_.kept_vertices];
      }
      cell.first = parts_.size();
      const auto add = [&](const CellPart& nodes) {
        const bool is_first = parts_.size() == cell.first;
        parts_.push_back({nodes, is_first ? cell.row : TetId{appended++}, i});
      };
      if (edges == all_edges) {
        std::ranges::for_each(parts_by_eight(turn_of(cell)), add);
      } else {
        std::ranges::for_each(parts_of_cell(edges, order), add);
      }
    }
  }

  /// Which edge inside one that becomes eight: see divide_edges.
  int turn_of(const DividedCell& cell) const {
    if (!as_they_stand_.empty() && as_they_stand_[cell.row.index()] != 0) return 0;
    std::array<Point, 6> middles;
    for (std::size_t e = 0; e < 6; ++e) {
      const std::size_t appended = cell.middles[e].index() - change_.kept_vertices;
      middles[e] = change_.points[change_.vertices[appended] - change_.kept_points];
    }
    int best = 0;
    double least = 0;
    for (int turn = 0; turn < 3; ++turn) {
      double here = 1;
      for (std::size_t part = 4; part < 8; ++part) {
        std::array<Point, 4> x;
        for (std::size_t i = 0; i < 4; ++i) {
          x[i] = middles[static_cast<std::size_t>(parts_by_eight(turn)[part][i] - 4)];
        }
        here = std::min(here, radius_ratio(x));
      }
      if (here > least * (1 + 1e-9)) best = turn, least = here;
    }
    return best;
  }

  std::span<const DividedPart> parts_of(const DividedCell& cell) const {
    const std::size_t end = &cell == &cells_.back() ? parts_.size() : (&cell + 1)->first;
    return std::span(parts_).subspan(cell.first, end - cell.first);
  }
  const DividedCell* divided(TetId t) const {
    const auto at = std::ranges::lower_bound(cells_, t, {}, &DividedCell::row);
    return at != cells_.end() && at->row == t ? &*at : nullptr;
  }
  static VertexId row_of(const DividedCell& cell, int node) {
    return node < 4 ? cell.corners[static_cast<std::size_t>(node)]
                    : cell.middles[static_cast<std::size_t>(node - 4)];
  }

  /// The half-face of a part of `cell` that lies in its face `p` (4: inside) and has these
  /// vertices, not that of part `but`.
  HalfFaceId find(const DividedCell& cell, int p, std::array<VertexId, 3> vertices,
                  TetId but = TetId::none()) const {
    std::ranges::sort(vertices);
    for (const DividedPart& part : parts_of(cell)) {
      if (part.row == but) continue;
      for (int q = 0; q < 4; ++q) {
        const auto nodes = corners_of_face(part.nodes, half_face(TetId{0}, q));
        if (face_of_nodes(nodes) != p) continue;
        std::array<VertexId, 3> rows;
        for (std::size_t i = 0; i < 3; ++i) rows[i] = row_of(cell, nodes[i]);
        std::ranges::sort(rows);
        if (rows == vertices) return half_face(part.row, q);
      }
    }
    SUNDER_ASSERT(false, "both sides of a face are divided alike");
    return HalfFaceId::none();
  }

  void write(const DividedPart& part) {
    const DividedCell& cell = cells_[part.parent];
    CellChange::Cell out{part.row, {}, {}};
    ChildCell child{part.row, cell.row, share(cell, part.nodes)};
    for (std::size_t i = 0; i < 4; ++i) out.corners[i] = row_of(cell, part.nodes[i]);
    for (int q = 0; q < 4; ++q) {
      const HalfFaceId mine = half_face(part.row, q);
      const int p = face_of_nodes(corners_of_face(part.nodes, half_face(TetId{0}, q)));
      const auto rows = corners_of_face(out.corners, mine);
      child.face[static_cast<std::size_t>(q)] = static_cast<std::uint8_t>(p);
      out.neighbours[static_cast<std::size_t>(q)] =
          p == 4 ? find(cell, 4, rows, part.row) : across(half_face(cell.row, p), mine, rows);
    }
    change_.cells.push_back(out);
    edit_.cells.push_back(child);
  }

  /// The half-face across the part `mine` of the parent's face `whole`.
  HalfFaceId across(HalfFaceId whole, HalfFaceId mine, const std::array<VertexId, 3>& rows) {
    const HalfFaceId other = map_.neighbour(whole);
    if (other.is_none()) return other;
    const TetId u = tetrahedron_of(other);
    if (const DividedCell* cell = divided(u)) return find(*cell, place_of(other), rows);
    const auto [beside, is_new] = beside_.try_emplace(u);
    CellChange::Cell& cell = beside->second;
    if (is_new) {
      cell = {u, map_.corners(u), {}};
      for (int q = 0; q < 4; ++q) {
        cell.neighbours[static_cast<std::size_t>(q)] = map_.neighbour(half_face(u, q));
      }
    }
    cell.neighbours[static_cast<std::size_t>(place_of(other))] = mine;
    return other;
  }

  /// The part's volume over its parent's: the determinant of its corners' weights.
  static double share(const DividedCell& cell, const CellPart& nodes) {
    std::array<std::array<double, 4>, 4> w{};
    for (std::size_t i = 0; i < 4; ++i) {
      if (nodes[i] < 4) {
        w[i][static_cast<std::size_t>(nodes[i])] = 1;
        continue;
      }
      const auto e = static_cast<std::size_t>(nodes[i] - 4);
      w[i][static_cast<std::size_t>(edge_ends[e][0])] = 1 - cell.weights[e];
      w[i][static_cast<std::size_t>(edge_ends[e][1])] = cell.weights[e];
    }
    const auto minor = [&](std::size_t r, std::size_t a, std::size_t b, std::size_t c) {
      const std::size_t r1 = r == 0 ? 1 : 0, r2 = r <= 1 ? 2 : 1, r3 = r <= 2 ? 3 : 2;
      return w[r1][a] * (w[r2][b] * w[r3][c] - w[r2][c] * w[r3][b]) -
             w[r1][b] * (w[r2][a] * w[r3][c] - w[r2][c] * w[r3][a]) +
             w[r1][c] * (w[r2][a] * w[r3][b] - w[r2][b] * w[r3][a]);
    };
    return w[0][0] * minor(0, 1, 2, 3) - w[1][0] * minor(1, 1, 2, 3) + w[2][0] * minor(2, 1, 2, 3) -
           w[3][0] * minor(3, 1, 2, 3);
  }

  /// Walks round a vertex begin in a tetrahedron that still has it.
  void move_begins() {
    std::vector<char> has_begin(change_.vertices.size(), 0);
    for (const DividedCell& cell : cells_) {
      for (int i = 0; i < 10; ++i) {
        const VertexId v = row_of(cell, i);
        if (v.is_none()) continue;
        if (i < 4) {
          if (map_.incident_tetrahedron(v) != cell.row) continue;
        } else if (std::exchange(has_begin[v.index() - change_.kept_vertices], 1) != 0) {
          continue;
        }
        const auto parts = parts_of(cell);
        const auto has = std::ranges::find_if(parts, [&](const DividedPart& part) {
          return std::ranges::find(part.nodes, i) != part.nodes.end();
        });
        if (i >= 4 || has->row != cell.row) change_.begins.push_back({v, has->row});
      }
    }
  }

  const K& map_;
  std::span<const char> as_they_stand_;
  CellChange change_;
  CellEdit edit_;
  std::vector<DividedCell> cells_;  // by rising rows
  std::vector<DividedPart> parts_;
  std::map<TetId, CellChange::Cell> beside_;  // whole, but with a new neighbour
};

}  // namespace sunder::detail

namespace sunder {

template <CellKernel K>
CellEdit divide_edges(K& map, std::span<const EdgeMark> marks,
                      std::span<const char> as_they_stand) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return divide_edges(kernel, marks, as_they_stand); });
  } else {
    return detail::Division<K>(map, marks, as_they_stand).carry_out(map);
  }
}

template <CellKernel K>
CellEdit insert_vertex(K& map, CellEdge edge, double weight) {
  const EdgeMark mark{edge, weight};
  return divide_edges(map, std::span(&mark, 1));
}

}  // namespace sunder
