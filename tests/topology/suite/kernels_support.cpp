// SPDX-License-Identifier: MIT
// Random steps on a kernel and on the twin.
#include "tests/topology/suite/kernels_support.hpp"

#include <algorithm>
#include <map>
#include <random>

using namespace sunder::suite;

namespace sunder::test {
namespace {

void compare_wholes(JudgedKernel& kernel, JudgedKernel& twin) {
  const CellCounts a = kernel.counts(), b = twin.counts();
  CHECK(a.vertices == b.vertices);
  CHECK(a.edges == b.edges);
  CHECK(a.faces == b.faces);
  CHECK(a.tetrahedra == b.tetrahedra);
  CHECK(a.components == b.components);
  CHECK(a.boundary_faces == b.boundary_faces);
  CHECK(a.boundary_sheets == b.boundary_sheets);
  CHECK(same_partition(kernel.vertex_of_corner(), twin.vertex_of_corner()));
  CHECK(same_partition(kernel.component_of_tetrahedron(), twin.component_of_tetrahedron()));
  if (kernel.own_faults) CHECK(kernel.own_faults() == std::vector<std::string>{});
  if (kernel.orientable) CHECK(kernel.orientable() == twin.orientable());
  if (!kernel.homology) return;
  if (const auto homology = kernel.homology()) CHECK(homology == twin.homology());
}

}  // namespace

bool same_partition(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  std::map<std::uint32_t, std::uint32_t> there, back;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (there.emplace(a[i], b[i]).first->second != b[i]) return false;
    if (back.emplace(b[i], a[i]).first->second != a[i]) return false;
  }
  return a.size() == b.size();
}

std::vector<std::vector<FaceSide>> faces_of(const TetMesh& mesh) {
  std::map<std::array<std::uint32_t, 3>, std::vector<FaceSide>> faces;
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    for (const std::uint32_t opposite : mesh.tetrahedra[t]) {
      std::array<std::uint32_t, 3> points;
      std::copy_if(mesh.tetrahedra[t].begin(), mesh.tetrahedra[t].end(), points.begin(),
                   [opposite](std::uint32_t p) { return p != opposite; });
      std::sort(points.begin(), points.end());
      faces[points].push_back({t, opposite});
    }
  }
  std::vector<std::vector<FaceSide>> sides;
  for (auto& [points, both] : faces) sides.push_back(std::move(both));
  return sides;
}

void walk_beside_twin(JudgedKernel& kernel, const TetMesh& mesh, const Walk& walk) {
  INFO("kernel " << kernel.name << ", seed " << walk.seed);
  std::mt19937_64 random(walk.seed);
  JudgedKernel twin = twin_kernel();
  REQUIRE_FALSE(has_error(twin.load(mesh)));
  REQUIRE_FALSE(has_error(kernel.load(mesh)));
  compare_wholes(kernel, twin);
  const auto faces = faces_of(mesh);
  std::vector<std::vector<FaceSide>> cut;
  for (std::size_t step = 1; step <= walk.steps; ++step) {
    INFO("step " << step);
    if (kernel.glue && !cut.empty() && below(random, 4) == 0) {
      std::swap(cut[below(random, cut.size())], cut.back());
      REQUIRE(kernel.glue(cut.back()[0], cut.back()[1]));
      REQUIRE(twin.glue(cut.back()[0], cut.back()[1]));
      CHECK_FALSE(kernel.glue(cut.back()[1], cut.back()[0]));
      cut.pop_back();
    } else {
      const auto& face = faces[below(random, faces.size())];
      const FaceSide side = face[below(random, face.size())];
      const SplitAnswer expected = twin.split(side), answer = kernel.split(side);
      INFO("tetrahedron " << side.tetrahedron << ", opposite to " << side.opposite);
      CHECK(answer.vertices == expected.vertices);
      CHECK(answer.edges == expected.edges);
      REQUIRE(answer == expected);
      if (answer.did) cut.push_back(face);
    }
    if (step % walk.every == 0 || step == walk.steps) compare_wholes(kernel, twin);
  }
}

}  // namespace sunder::test
