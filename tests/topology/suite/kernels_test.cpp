// SPDX-License-Identifier: MIT
// The kernels that come with Sunder against the twin, and CGAL's results for defective bodies.
#include <cmath>

#include "tests/topology/suite/kernels_support.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

TEST_CASE("the library's map and CGAL's answer random splits and glues as union-find does",
          "[suite][kernels]") {
  JudgedKernel kernel = GENERATE(volume_map_kernel(), nested_kernel(), cgal_kernel());
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    for (const std::uint64_t seed : {1U, 2U}) {
      const std::size_t steps = std::min<std::size_t>(3 * shape.mesh.tetrahedra.size(), 400);
      walk_beside_twin(kernel, shape.mesh, {.steps = steps, .every = 25, .seed = seed});
    }
  }
}

TEST_CASE("inverted tetrahedra are named by the file's points on every kernel",
          "[suite][kernels]") {
  TetMesh mesh = kuhn_box({2, 2, 1});
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); t += 3) {
    std::swap(mesh.tetrahedra[t][0], mesh.tetrahedra[t][2]);
  }
  JudgedKernel kernel = GENERATE(volume_map_kernel(), nested_kernel(), cgal_kernel());
  walk_beside_twin(kernel, mesh, {.steps = 150, .every = 10, .seed = 3});
}

TEST_CASE("a whole shatter of 6 000 tetrahedra is answered alike by all kernels",
          "[suite][kernels]") {
  const TetMesh mesh = kuhn_box({10, 10, 10});
  JudgedKernel twin = twin_kernel(), ours = volume_map_kernel(), cgal = cgal_kernel();
  for (JudgedKernel* k : {&twin, &ours, &cgal}) REQUIRE_FALSE(has_error(k->load(mesh)));
  std::size_t different = 0;
  for (const auto& face : faces_of(mesh)) {
    const SplitAnswer answer = twin.split(face[0]);
    different += answer == ours.split(face[0]) && answer == cgal.split(face[0]) ? 0 : 1;
  }
  CHECK(different == 0);
  for (JudgedKernel* k : {&twin, &ours, &cgal}) {
    CHECK(k->counts() == CellCounts{24000, 36000, 24000, 6000, 6000, 24000, 6000});
    if (k->own_faults) CHECK(k->own_faults().empty());
  }
}

TEST_CASE("the library's fan comes in the file's numbers, each face once", "[suite][kernels]") {
  const TetMesh mesh = jittered(kuhn_box({2, 2, 2}), 0.1, 4);
  JudgedKernel kernel = volume_map_kernel();
  REQUIRE_FALSE(has_error(kernel.load(mesh)));
  std::vector<FaceSide> fan = kernel.fan({0, mesh.tetrahedra[0][3]}, {1, 0, 0});
  REQUIRE_FALSE(fan.empty());
  for (const FaceSide side : fan) {
    CHECK(std::count(fan.begin(), fan.end(), side) == 1);
    const auto& t = mesh.tetrahedra[side.tetrahedron];
    CHECK(std::count(t.begin(), t.end(), side.opposite) == 1);
    CHECK(std::count(t.begin(), t.end(), mesh.tetrahedra[0][3]) == 1);
    CHECK(kernel.split(side).did);
  }
  CHECK(kernel.fan({0, mesh.tetrahedra[0][3]}, {0, 0, 0}).empty());
  CHECK(kernel.own_faults().size() == 1);
}

namespace {

TetMesh with(TetMesh mesh, const std::array<std::uint32_t, 4>& tetrahedron) {
  mesh.tetrahedra.push_back(tetrahedron);
  return mesh;
}

struct Defect {
  std::string name;
  TetMesh mesh;
  /// Codes of the twin, errors all.
  std::vector<std::string> codes;
  /// Cells that CGAL makes of it, unless it is refused for safety.
  CellCounts cgal;
};

std::vector<Defect> defects() {
  const TetMesh one = one_tetrahedron(), two = two_tetrahedra();
  TetMesh third = with(two, {0, 1, 2, 5});
  third.points.push_back({1, 1, -1});
  TetMesh nan = one;
  nan.points[2][1] = std::nan("");
  TetMesh none = one;
  none.tetrahedra.clear();
  return {
      {"duplicate", with(one, {0, 1, 2, 3}), {"duplicate_tetrahedron"}, {4, 6, 4, 2, 1, 0, 0}},
      {"mirrored", with(one, {0, 1, 3, 2}), {"mirrored_tetrahedron"}, {4, 6, 4, 2, 1, 0, 0}},
      {"overfull face", third, {"overfull_face"}, {9, 15, 11, 3, 2, 10, 2}},
      // The seam stays open: the body is the bar it was bent from.
      {"non-orientable ring", joined_ring(4, true), {"non_orientable"}, {20, 61, 66, 24, 1, 36, 1}},
      {"repeated vertex", with(one, {0, 1, 2, 2}), {"repeated_vertex"}, {8, 12, 8, 2, 2, 8, 2}},
      {"nan", nan, {"nan_coordinate"}, {4, 6, 4, 1, 1, 4, 1}},
      {"no tetrahedron", none, {"no_tetrahedron"}, {}}};
}

}  // namespace

TEST_CASE("the twin refuses what it cannot glue, by the library's codes", "[suite][kernels]") {
  for (const Defect& defect : defects()) {
    INFO(defect.name);
    std::vector<std::string> codes;
    for (const Finding& f : twin_kernel().load(defect.mesh)) codes.push_back(f.code);
    CHECK(codes == defect.codes);
    CHECK(has_error(volume_map_kernel().load(defect.mesh)));
  }
}

TEST_CASE("CGAL takes defective bodies and makes something of them", "[suite][kernels]") {
  for (const Defect& defect : defects()) {
    INFO(defect.name);
    JudgedKernel cgal = cgal_kernel();
    CHECK(cgal.load(defect.mesh).empty());
    const CellCounts c = cgal.counts();
    CAPTURE(c.vertices, c.edges, c.faces, c.tetrahedra, c.components, c.boundary_faces,
            c.boundary_sheets);
    CHECK(c == defect.cgal);
    CHECK(cgal.own_faults() == std::vector<std::string>{});
  }
}

TEST_CASE("a tetrahedron with a point that is not there is refused by every kernel",
          "[suite][kernels]") {
  const TetMesh mesh = with(one_tetrahedron(), {0, 1, 2, 9});
  JudgedKernel kernel =
      GENERATE(volume_map_kernel(), nested_kernel(), cgal_kernel(), twin_kernel());
  CHECK(has_error(kernel.load(mesh)));
}
