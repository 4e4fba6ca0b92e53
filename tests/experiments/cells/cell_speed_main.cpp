// SPDX-License-Identifier: MIT
// `cell_speed [CELLS [ROUNDS [SEED]]]`: vertices in edges of a box of CELLS^3 cubes (6 tetrahedra
// each), the same edges by the same middles, by our operations on both kernels and by CGAL's
// insertions; the bodies have to be equal after. Each round divides random edges with rings that
// have no tetrahedron in common, as many as there are room for.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "apps/bench/clock.hpp"
#include "tests/experiments/cells/cgal_bisection.hpp"
#include "topology/cells/subdivide.hpp"
#include "topology/kernel/components.hpp"
#include "topology/kernel/invariants.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Edges of one round, by places: rows differ by the way in which edges were divided before.
struct Round {
  std::vector<DividedEdge> places;
  std::size_t tetrahedra = 0;  // round them
};

Round draw(const VolumeMap& map, std::mt19937_64& random) {
  EdgeRows edges = edge_rows(map);
  for (std::size_t i = edges.first.size(); i > 1; --i) {
    std::swap(edges.first[i - 1], edges.first[suite::below(random, i)]);
  }
  std::vector<char> taken(map.tetrahedra(), 0);
  Round round;
  for (const CellEdge& edge : edges.first) {
    const std::vector<CellEdge> ring = edge_ring(map, edge);
    const auto is_taken = [&](const CellEdge& e) { return taken[e.tetrahedron.index()] != 0; };
    if (std::ranges::any_of(ring, is_taken)) continue;
    for (const CellEdge& e : ring) taken[e.tetrahedron.index()] = 1;
    const auto ends = edge_ends[static_cast<std::size_t>(edge.place)];
    const auto corners = map.corners(edge.tetrahedron);
    DividedEdge place;
    for (std::size_t i = 0; i < 2; ++i) place.ends[i] = map.point(corners[ends[i]]);
    for (std::size_t i = 0; i < 3; ++i) {
      place.middle[i] = (1 - 0.5) * place.ends[0][i] + 0.5 * place.ends[1][i];
    }
    round.places.push_back(place);
    round.tetrahedra += ring.size();
  }
  return round;
}

std::vector<std::array<Point, 4>> places(const VolumeMap& map) {
  std::vector<std::array<Point, 4>> all;
  for (const auto& corners : map.corners()) {
    std::array<Point, 4> x;
    for (std::size_t i = 0; i < 4; ++i) x[i] = map.point(corners[i]);
    std::ranges::sort(x);
    all.push_back(x);
  }
  std::ranges::sort(all);
  return all;
}

/// A way to divide: its name and the microseconds of all rounds.
struct Way {
  std::string name;
  double us = 0;
};

std::vector<EdgeMark> marks_of(const VolumeMap& map, const Round& round) {
  std::map<std::pair<Point, Point>, CellEdge> known;
  for (const CellEdge& edge : edge_rows(map).first) {
    const auto ends = edge_ends[static_cast<std::size_t>(edge.place)];
    const auto corners = map.corners(edge.tetrahedron);
    known[std::minmax(map.point(corners[ends[0]]), map.point(corners[ends[1]]))] = edge;
  }
  std::vector<EdgeMark> marks;
  for (const DividedEdge& place : round.places) {
    marks.push_back({known.at(std::minmax(place.ends[0], place.ends[1])), 0.5});
  }
  return marks;
}

double divide(VolumeMap& map, const Round& round, bool at_once) {
  const std::vector<EdgeMark> marks = marks_of(map, round);
  const double start = thread_us();
  if (at_once) {
    divide_edges(map, marks);
  } else {
    for (const EdgeMark& mark : marks) insert_vertex(map, mark.edge, mark.weight);
  }
  return thread_us() - start;
}

bool same(const VolumeMap& map, const CgalBody& cgal) {
  const Counts c = count_cells(map);
  return cgal.is_valid && check(map).empty() && places(map) == cgal.tetrahedra &&
         cgal.cells[0] == c.vertices && cgal.cells[1] == c.edges && cgal.cells[2] == c.faces &&
         cgal.cells[3] == c.tetrahedra;
}

}  // namespace

int main(int argc, char** argv) {
  const auto word = [&](int i, std::size_t otherwise) {
    return argc > i ? std::strtoull(argv[i], nullptr, 10) : otherwise;
  };
  const int n = static_cast<int>(word(1, 12));
  const std::size_t rounds = word(2, 3);
  std::mt19937_64 random(word(3, 1));
  const TetMesh mesh = suite::jittered(suite::kuhn_box({n, n, n}, 0.1), 0.02, 1);
  std::array<VolumeMap, 4> maps = {*build_map(mesh, Severity::warning, MapKernel::dense),
                                   *build_map(mesh, Severity::warning, MapKernel::dense),
                                   *build_map(mesh, Severity::warning, MapKernel::lcc),
                                   *build_map(mesh, Severity::warning, MapKernel::lcc)};
  std::array<CgalBisection, 2> cgal = {CgalBisection(mesh, false), CgalBisection(mesh, true)};
  std::array<Way, 6> ways = {{{"rows, one by one"},
                              {"rows, at once"},
                              {"CGAL's darts and rows, one by one"},
                              {"CGAL's darts and rows, at once"},
                              {"CGAL's insertions, points alone"},
                              {"CGAL's insertions, our attributes"}}};
  std::size_t edges = 0, divided = 0;
  for (std::size_t r = 0; r < rounds; ++r) {
    const Round round = draw(maps[0], random);
    edges += round.places.size(), divided += round.tetrahedra;
    for (std::size_t i = 0; i < 4; ++i) {
      ways[i].us += divide(maps[i], round, i % 2 == 1);
    }
    for (std::size_t i = 0; i < 2; ++i) ways[4 + i].us += cgal[i].divide(round.places);
  }
  fmt::print("{} tetrahedra; {} edges in {} rounds, {} tetrahedra divided; {} after\n",
             mesh.tetrahedra.size(), edges, rounds, divided, maps[0].tetrahedra());
  for (const Way& way : ways) {
    fmt::print("{:<36}{:>8.3f} us an edge{:>8.3f} us a tetrahedron divided\n", way.name,
               way.us / static_cast<double>(edges), way.us / static_cast<double>(divided));
  }
  bool all_same = true;
  for (CgalBisection& c : cgal) {
    const CgalBody body = c.body();
    for (const VolumeMap& map : maps) all_same = all_same && same(map, body);
    fmt::print("CGAL: {} bytes a tetrahedron\n", body.bytes / maps[0].tetrahedra());
  }
  for (const std::size_t i : {0U, 2U}) {
    fmt::print("{}: {} bytes a tetrahedron\n", ways[i].name,
               total(maps[i].bytes()) / maps[i].tetrahedra());
  }
  fmt::print("{}\n",
             all_same ? "all six have the same tetrahedra and as many cells" : "THE BODIES DIFFER");
  return all_same ? 0 : 1;
}
