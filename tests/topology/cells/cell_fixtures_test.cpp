// SPDX-License-Identifier: MIT
// Operations on cells of bodies of meshes/suite, compared with the expectations of a second program
// (make_cell_fixtures.py).
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/built.hpp"
#include "topology/cells/journal.hpp"
#include "topology/cells/plane_cut.hpp"
#include "topology/cells/refine.hpp"
#include "topology/suite/fixtures/fixture.hpp"
#include "topology/suite/homology/homology.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;
using Json = nlohmann::json;

namespace {

/// The body of a case: "08-figure-4/two-sections".
TetMesh body_of(const std::string& name) {
  const std::string file = name.substr(0, name.find('/')) + ".json";
  const auto fixtures = read_fixtures(std::string(SUNDER_MESHES) + "/suite/" + file);
  REQUIRE(fixtures);
  for (const Fixture& f : *fixtures) {
    if (f.name == name) return f.body;
  }
  FAIL("no case " << name);
  return {};
}

TetId cell_on(const VolumeMap& map, std::array<std::uint32_t, 4> points) {
  std::ranges::sort(points);
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
    std::array<std::uint32_t, 4> x;
    for (std::size_t i = 0; i < 4; ++i) x[i] = map.point_of_vertex(map.corners(TetId{t})[i]);
    std::ranges::sort(x);
    if (x == points) return TetId{t};
  }
  FAIL("no such tetrahedron");
  return {};
}

BettiNumbers betti_2(const VolumeMap& map) {
  GlueTwin twin = twin_of(map, map.points().size());
  for (std::size_t f = 0; f < twin.glued.size(); ++f) twin.glued[f] = map.neighbour(HalfFaceId{f});
  return betti_numbers(orbit_complex(twin), 2);
}

double volume_of(const VolumeMap& map, TetId t) {
  std::array<Point, 4> x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = map.point(map.corners(t)[i]);
  double six = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    six += (x[1][i] - x[0][i]) *
           ((x[2][j] - x[0][j]) * (x[3][k] - x[0][k]) - (x[2][k] - x[0][k]) * (x[3][j] - x[0][j]));
  }
  return std::abs(six) / 6;
}

/// A map with its journal, and the effect of the file's steps on it.
struct Course {
  VolumeMap map;
  Journal journal;

  void insert(const Json& step, const Json& after) {
    const std::array<std::uint32_t, 2> edge = step["edge"];
    const TetId t = cell_on(map, step["cell"]);
    std::array<int, 2> at{};
    for (int i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 2; ++k) {
        if (map.point_of_vertex(map.corners(t)[static_cast<std::size_t>(i)]) == edge[k]) at[k] = i;
      }
    }
    const CellEdge where{t, edge_between(at[0], at[1])};
    CHECK(edge_ring(map, where).size() == after["ring"]);
    enter(journal, insert_vertex(map, where, step["weight"]).undo);
  }

  void refine(const Json& step, const Json& after) {
    std::vector<TetId> marked;
    for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
      const auto is_near = [&](VertexId v) {
        const Point x = map.point(v), at = step["near"];
        const double within = step["within"];
        double square = 0;
        for (std::size_t i = 0; i < 3; ++i) square += (x[i] - at[i]) * (x[i] - at[i]);
        return square < within * within;
      };
      if (step == "all" || std::ranges::any_of(map.corners(TetId{t}), is_near)) {
        marked.emplace_back(t);
      }
    }
    RefinedLevel level = refine_marked(map, marked);
    CHECK(level.red == after["red"]);
    CHECK(level.green == after["green"]);
    enter(journal, std::move(level.edit.undo));
  }

  void cut(const Json& step, const Json& after) {
    const CuttingPlane plane{step["normal"], step["offset"]};
    auto made = cut_cells(map, plane);
    REQUIRE(made);
    CHECK(made->on_plane == after["on_plane"]);
    CHECK(made->edit.vertices.size() == after["new_vertices"]);
    CHECK(made->faces.size() == after["section_faces"]);
    double volume = 0;
    for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
      double farthest = 0;
      for (const VertexId v : map.corners(TetId{t})) {
        double d = -plane.offset;
        for (std::size_t i = 0; i < 3; ++i) d += plane.normal[i] * map.point(v)[i];
        if (std::abs(d) > std::abs(farthest)) farthest = d;
      }
      if (farthest > 0) volume += volume_of(map, TetId{t});
    }
    CHECK(volume == Approx(after["positive_volume"].get<double>()).epsilon(1e-12).margin(1e-14));
    enter(journal, std::move(made->edit.undo));
  }

  void take(const std::string& word, const Json& step, const Json& after) {
    if (word == "insert") return insert(step, after);
    if (word == "refine") return refine(step, after);
    if (word == "cut") return cut(step, after);
    if (word == "split") {
      CHECK(split_face(map, face_on(map, step), journal).did);
      return;
    }
    REQUIRE(word == "undo");
    for (int i = 0; i < step; ++i) REQUIRE(undo(map, journal));
  }

  void hold_against(const Json& expected) const {
    const Counts c = count_cells(map);
    CHECK(c.vertices == expected["vertices"]);
    CHECK(c.edges == expected["edges"]);
    CHECK(c.faces == expected["faces"]);
    CHECK(c.tetrahedra == expected["tetrahedra"]);
    CHECK(c.components == expected["components"]);
    CHECK(c.boundary_faces == expected["boundary_faces"]);
    CHECK(c.boundary_sheets == expected["boundary_sheets"]);
    CHECK(betti_2(map) == expected["betti_2"]);
    CHECK(check(map).empty());
  }
};

}  // namespace

TEST_CASE("operations on cells come to what a second program expects", "[topology][cells]") {
  std::ifstream in(std::string(SUNDER_CELL_DATA) + "/cell_fixtures.json");
  const Json file = Json::parse(in);
  REQUIRE(file["fixtures"].size() > 40);
  for (const MapKernel kernel : {MapKernel::dense, MapKernel::lcc}) {
    for (const Json& fixture : file["fixtures"]) {
      INFO(fixture["body"]);
      auto map = build_map(body_of(fixture["body"]), Severity::warning, kernel);
      REQUIRE(map);
      Course course{std::move(*map), {}};
      course.hold_against(fixture["before"]);
      for (const Json& step : fixture["steps"]) {
        INFO(step);
        for (const auto& [word, what] : step.items()) {
          if (word == "after") continue;
          course.take(word, what, step["after"]);
        }
        course.hold_against(step["after"]);
      }
    }
  }
}
