// SPDX-License-Identifier: MIT
// A body under random operations, on both kernels and the twin.
#include "tests/topology/cells/random_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/topology/cells/cell_twin.hpp"
#include "topology/cells/columns.hpp"
#include "topology/cells/journal.hpp"
#include "topology/cells/plane_cut.hpp"
#include "topology/cells/refine.hpp"
#include "topology/kernel/invariants.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::test {
namespace {

using suite::below;
using suite::unit;

/// Columns that go along with a body: one for every rule.
struct Columns {
  std::vector<double> volume;          // share
  std::vector<std::uint32_t> label;    // copy: the tetrahedron of the beginning
  std::vector<Point> place;            // interpolate
  std::vector<std::uint32_t> nearest;  // nearest: the vertex of the beginning
  std::vector<char> surface;           // of faces: 1 on the boundary
  friend bool operator==(const Columns&, const Columns&) = default;
};

struct Rows {
  std::vector<std::array<VertexId, 4>> corners;
  std::vector<std::array<HalfFaceId, 4>> neighbours;
  std::vector<std::uint32_t> point_of_vertex;
  std::vector<Point> points;
  std::vector<TetId> begins;
  friend bool operator==(const Rows&, const Rows&) = default;
};

Rows rows_of(const VolumeMap& map) {
  const MapRows& rows = map.dense().rows();
  const auto begins = map.dense().incident_tetrahedra();
  return {rows.corners,
          rows.neighbours,
          rows.point_of_vertex,
          rows.points,
          {begins.begin(), begins.end()}};
}

double volume_of(const VolumeMap& map, TetId t) {
  const auto corners = map.corners(t);
  const Point a = map.point(corners[0]);
  std::array<Point, 3> d;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point b = map.point(corners[i + 1]);
    d[i] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  }
  return (d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
          d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
          d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0])) /
         6;
}

/// A body before an operation, to be compared after undoing.
struct Before {
  Rows rows;
  CellTwin twin;
  Columns columns;
};

class Trial {
 public:
  Trial(const TetMesh& mesh, std::mt19937_64& random, RandomCells& report, const CellWatch& watch)
      : random_(random),
        report_(report),
        watch_(watch),
        darts_(*build_map(mesh, Severity::warning, MapKernel::lcc).value),
        dense_(*build_map(mesh, Severity::warning, MapKernel::dense).value) {
    follow_rows();
    for (std::size_t t = 0; t < darts_.tetrahedra(); ++t) {
      columns_.volume.push_back(volume_of(darts_, TetId{t}));
      columns_.label.push_back(static_cast<std::uint32_t>(t));
      for (int p = 0; p < 4; ++p) {
        columns_.surface.push_back(darts_.neighbour(half_face(TetId{t}, p)).is_none());
      }
    }
    for (std::size_t v = 0; v < darts_.vertices(); ++v) {
      columns_.place.push_back(darts_.point(VertexId{v}));
      columns_.nearest.push_back(static_cast<std::uint32_t>(v));
    }
    start_ = columns_;
    compare(CellMoment::After::beginning);
  }

  void step() {
    const std::size_t which = below(random_, 100);
    if (which < 15 || darts_.tetrahedra() > 500) return undo_some();
    if (which < 50) return insert();
    if (which < 62) return refine_some();
    if (which < 75) return cut();
    split();
  }

 private:
  void require(bool holds, const std::string& what) {
    ++report_.comparisons;
    if (!holds) throw std::runtime_error(what);
  }

  /// Sets the twin's tetrahedra to those of the map; it keeps its own knowledge of cut faces.
  void follow_rows() {
    twin_.tetrahedra.clear();
    for (const auto& corners : darts_.corners()) {
      auto& t = twin_.tetrahedra.emplace_back();
      for (std::size_t i = 0; i < 4; ++i) t[i] = darts_.point_of_vertex(corners[i]);
    }
  }

  void remember() { before_.push_back({rows_of(darts_), twin_, columns_}); }

  MiddleNames names_of(const CellEdit& edit) const {
    MiddleNames names;
    for (const MiddleVertex& m : edit.vertices) {
      names[std::minmax(darts_.point_of_vertex(m.ends[0]), darts_.point_of_vertex(m.ends[1]))] =
          darts_.point_of_vertex(m.vertex);
    }
    return names;
  }

  std::set<std::pair<std::uint32_t, std::uint32_t>> edges_of_points() const {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& corners : darts_.corners()) {
      for (const auto& [i, j] : edge_ends) {
        edges.insert(std::minmax(darts_.point_of_vertex(corners[static_cast<std::size_t>(i)]),
                                 darts_.point_of_vertex(corners[static_cast<std::size_t>(j)])));
      }
    }
    return edges;
  }

  /// After an operation that divided `edges` (the twin's classes) on both kernels.
  void compare_division(const CellEdit& edit, const CellEdit& other,
                        const std::set<std::uint32_t>& edges) {
    require(edit.vertices.size() == edges.size(), "as many new vertices as edges divided");
    require(divide(twin_, edges, names_of(edit), edges_of_points()),
            "every divided edge has a name");
    const Counts before = counts_;
    compare(CellMoment::After::division);
    require(counts_.euler_characteristic == before.euler_characteristic &&
                counts_.betti == before.betti && counts_.components == before.components &&
                counts_.boundary_sheets == before.boundary_sheets &&
                counts_.vertices == before.vertices + edges.size(),
            "the body is the same as before but for its cells");
    require(edit.cells.size() == other.cells.size(), "both kernels divide the same cells");
    extend(edit);
    enter(journal_, edit.undo);
    enter(dense_journal_, other.undo);
  }

  void extend(const CellEdit& edit) {
    extend_cells(columns_.volume, edit, CellRule::share);
    extend_cells(columns_.label, edit, CellRule::copy);
    extend_vertices(columns_.place, edit, VertexRule::interpolate);
    extend_vertices(columns_.nearest, edit, VertexRule::nearest);
    extend_faces(columns_.surface, edit, char{0});
    std::vector<double> sum(start_.volume.size(), 0);
    double size = 0;
    for (const double v : start_.volume) size = std::max(size, std::abs(v));
    for (std::size_t t = 0; t < darts_.tetrahedra(); ++t) {
      const double volume = volume_of(darts_, TetId{t});
      require(std::abs(volume - columns_.volume[t]) <= 1e-12 * size, "shares are volumes");
      sum[columns_.label[t]] += columns_.volume[t];
      for (int p = 0; p < 4; ++p) {
        const HalfFaceId f = half_face(TetId{t}, p);
        require(darts_.neighbour(f).is_none() == (columns_.surface[f.index()] != 0),
                "a column of faces knows the boundary");
      }
    }
    for (std::size_t i = 0; i < sum.size(); ++i) {
      require(std::abs(sum[i] - start_.volume[i]) <= 1e-12 * size, "parts sum to the whole");
    }
    for (std::size_t v = 0; v < darts_.vertices(); ++v) {
      const Point x = darts_.point(VertexId{v});
      for (std::size_t i = 0; i < 3; ++i) {
        require(std::abs(columns_.place[v][i] - x[i]) <= 1e-12 * (1 + std::abs(x[i])),
                "a column between ends lies where its vertex does");
      }
      require(columns_.nearest[v] < start_.nearest.size(), "the nearest is one of before");
    }
  }

  /// Kernels against each other and against the twin.
  void compare(CellMoment::After after) {
    require(rows_of(darts_) == rows_of(dense_), "both kernels have the same rows");
    const std::vector<Finding> damage = check(darts_);
    require(damage.empty(), damage.empty() ? "" : damage.front().text);
    const auto expected = as_set(twin_.tetrahedra);
    follow_rows();
    require(as_set(twin_.tetrahedra) == expected, "the tetrahedra are the twin's");
    const suite::GlueTwin glue = glued(twin_);
    for (std::size_t f = 0; f < glue.glued.size(); ++f) {
      require(glue.glued[f] == darts_.neighbour(HalfFaceId{f}), "sewn as the twin glues");
    }
    const Counts c = count_cells(darts_);
    require(suite::union_find_counts(glue) ==
                suite::TwinCounts{c.vertices, c.edges, c.faces, c.tetrahedra, c.components,
                                  c.boundary_faces, c.boundary_sheets},
            "as many cells as the twin");
    counts_ = c;
    if (!watch_) return;
    const std::string wrong = watch_({after, glue, counts_});
    require(wrong.empty(), wrong);
  }

  void insert() {
    const TetId t{below(random_, darts_.tetrahedra())};
    const int e = static_cast<int>(below(random_, 6));
    const double weight = below(random_, 2) == 0 ? 0.5 : 0.1 + 0.8 * unit(random_);
    const auto edges = edge_classes(twin_);
    const std::vector<CellEdge> ring = edge_ring(darts_, {t, e});
    require(ring == edge_ring(dense_, {t, e}), "both kernels walk the same ring");
    remember();
    const Counts before = counts_;
    const CellEdit edit = insert_vertex(darts_, {t, e}, weight);
    const CellEdit other = insert_vertex(dense_, {t, e}, weight);
    compare_division(edit, other, {edges[t.index()][static_cast<std::size_t>(e)]});
    const std::size_t n = ring.size(), added_edges = counts_.edges - before.edges;
    require(counts_.tetrahedra == before.tetrahedra + n &&
                (added_edges == n + 1 || added_edges == n + 2) &&
                counts_.faces == before.faces + n + added_edges - 1,
            "n tetrahedra round an edge make n more, and the faces and edges that follow");
    ++report_.inserted;
  }

  void refine_some() {
    std::vector<TetId> marked;
    std::vector<std::size_t> cells;
    for (std::size_t i = 0, n = 1 + below(random_, 3); i < n; ++i) {
      cells.push_back(below(random_, darts_.tetrahedra()));
      marked.emplace_back(cells.back());
    }
    const std::set<std::uint32_t> edges = closed_edges(edge_classes(twin_), cells);
    remember();
    const RefinedLevel level = refine_marked(darts_, marked);
    const RefinedLevel other = refine_marked(dense_, marked);
    compare_division(level.edit, other.edit, edges);
    ++report_.refined;
  }

  void cut() {
    Point n;
    for (double& x : n) x = below(random_, 4) == 0 ? 0 : 2 * unit(random_) - 1;
    const Point at = darts_.point(darts_.corners(TetId{below(random_, darts_.tetrahedra())})[0]);
    // Half of the planes pass through a vertex.
    const double d =
        n[0] * at[0] + n[1] * at[1] + n[2] * at[2] + (below(random_, 2) == 0 ? 0 : 0.1);
    if (n == Point{0, 0, 0}) return;
    const auto distance = [&](std::uint32_t p) {
      const Point& x = darts_.points()[p];
      return n[0] * x[0] + n[1] * x[1] + n[2] * x[2] - d;
    };
    const auto classes = edge_classes(twin_);
    std::set<std::uint32_t> edges;
    for (std::size_t t = 0; t < twin_.tetrahedra.size(); ++t) {
      for (std::size_t e = 0; e < 6; ++e) {
        const double a = distance(twin_.tetrahedra[t][static_cast<std::size_t>(edge_ends[e][0])]);
        const double b = distance(twin_.tetrahedra[t][static_cast<std::size_t>(edge_ends[e][1])]);
        if (a * b < 0 && std::min(std::abs(a), std::abs(b)) > 1e-12) edges.insert(classes[t][e]);
      }
    }
    remember();
    const auto made = cut_cells(darts_, {n, d});
    const auto other = cut_cells(dense_, {n, d});
    require(made && other && made->faces == other->faces, "both kernels find the same section");
    compare_division(made->edit, other->edit, edges);
    for (const auto& corners : darts_.corners()) {
      double low = 0, high = 0;
      for (const VertexId v : corners) {
        const double s = distance(darts_.point_of_vertex(v));
        low = std::min(low, s), high = std::max(high, s);
      }
      require(low > -1e-12 || high < 1e-12, "no tetrahedron has corners on both sides");
    }
    for (const HalfFaceId f : made->faces) {
      for (const VertexId v : corners_of_face(darts_.corners(tetrahedron_of(f)), f)) {
        require(std::abs(distance(darts_.point_of_vertex(v))) <= 1e-12, "the section is flat");
      }
      if (below(random_, 4) == 0) split(f);
    }
    ++report_.cut;
  }

  void split() {
    const HalfFaceId f{below(random_, 4 * darts_.tetrahedra())};
    if (!darts_.neighbour(f).is_none()) split(f);
  }

  void split(HalfFaceId f) {
    remember();
    const HalfFaceId g = darts_.neighbour(f);
    const FaceSplit mine = split_face(darts_, f, journal_);
    split_face(dense_, f, dense_journal_);
    require(mine.did, "an interior face splits");
    std::array<std::uint32_t, 3> points;
    for (std::size_t i = 0; i < 3; ++i) points[i] = darts_.point_of_vertex(mine.vertices[i]);
    std::ranges::sort(points);
    twin_.cut.insert(points);
    columns_.surface[f.index()] = columns_.surface[g.index()] = 1;
    for (int i = 0; i < mine.vertex_count; ++i) {
      const VertexCopy& copy = mine.split_vertices[static_cast<std::size_t>(i)];
      columns_.place.push_back(columns_.place[copy.old_row.index()]);
      columns_.nearest.push_back(columns_.nearest[copy.old_row.index()]);
    }
    compare(CellMoment::After::split);
    ++report_.splits;
  }

  void undo_some() {
    std::vector<Before> after;
    const std::size_t n = darts_.tetrahedra() > 500 ? before_.size() : 1 + below(random_, 4);
    for (std::size_t i = 0; i < n && !before_.empty(); ++i) {
      after.push_back({rows_of(darts_), twin_, columns_});
      require(undo(darts_, journal_) && undo(dense_, dense_journal_), "there is one to undo");
      twin_ = before_.back().twin;
      columns_ = before_.back().columns;
      require(rows_of(darts_) == before_.back().rows, "undone to the same bytes");
      compare(CellMoment::After::undo);
      before_.pop_back();
      ++report_.undone;
    }
    if (darts_.tetrahedra() > 250 || below(random_, 2) == 0) return;
    for (; !after.empty(); after.pop_back()) {
      if (after.back().rows.corners.size() > 400) return;
      remember();
      require(redo(darts_, journal_) && redo(dense_, dense_journal_), "there is one to redo");
      twin_ = after.back().twin;
      columns_ = after.back().columns;
      require(rows_of(darts_) == after.back().rows, "done again to the same bytes");
      compare(CellMoment::After::undo);
      ++report_.redone;
    }
  }

  std::mt19937_64& random_;
  RandomCells& report_;
  const CellWatch& watch_;
  VolumeMap darts_, dense_;
  CellTwin twin_;
  Columns columns_, start_;
  Counts counts_;
  Journal journal_, dense_journal_;
  std::vector<Before> before_;
};

std::vector<suite::NamedMesh> ten_bodies() {
  return {{"one tetrahedron", suite::one_tetrahedron()},
          {"a face between two", suite::two_tetrahedra()},
          {"two with one edge", suite::two_tetrahedra_sharing_an_edge()},
          {"fan of seven", suite::closed_fan(7)},
          {"octahedron star", suite::octahedron_star()},
          {"box", suite::jittered(suite::kuhn_box({2, 2, 1}), 0.1, 1)},
          {"ring of figure 4", suite::ring({3, 3, 1})},
          {"shell", suite::shell({3, 3, 3})},
          {"bar that touches itself", suite::bent_bar(6, {{0, 0}, {0, 1}})},
          {"two bodies", suite::side_by_side(suite::closed_fan(4), suite::two_tetrahedra())}};
}

}  // namespace

RandomCells random_cells(std::size_t operations, std::uint64_t seed, const CellWatch& watch) {
  RandomCells report;
  std::mt19937_64 random(seed);
  const std::vector<suite::NamedMesh> bodies = ten_bodies();
  const auto done = [&] { return report.inserted + report.refined + report.cut + report.splits; };
  for (std::size_t body = 0; done() < operations; ++body) {
    const suite::NamedMesh& named = bodies[body % bodies.size()];
    const std::size_t begin = done();
    try {
      Trial trial(named.mesh, random, report, watch);
      for (int i = 0; i < 60; ++i) trial.step();
    } catch (const std::runtime_error& error) {
      report.failure = fmt::format("{}, operation {} of body {} ({}): {}", seed, done() - begin,
                                   body, named.name, error.what());
      return report;
    }
  }
  return report;
}

}  // namespace sunder::test
