// SPDX-License-Identifier: MIT
// Regina, run as another process, next to the twin: an independent kernel and homology.
#include <cstdlib>

#include "tests/topology/suite/abstract_bodies.hpp"
#include "tests/topology/suite/kernels_support.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// Whether Regina is installed; where it is not, CTest counts the test as skipped.
bool has_regina() {
  if (std::system(SUNDER_PYTHON " -c 'import regina' 2> /dev/null") == 0) return true;
  WARN("skipped: Regina (Debian: regina-normal) is not installed");
  return false;
}

}  // namespace

TEST_CASE("Regina's answers to random splits and glues are the twin's", "[suite][regina]") {
  if (!has_regina()) return;
  JudgedKernel kernel =
      process_kernel("exec " SUNDER_PYTHON " " SUNDER_ADAPTERS "/regina_adapter.py");
  REQUIRE(kernel.homology);
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    const std::size_t steps = std::min<std::size_t>(2 * shape.mesh.tetrahedra.size(), 100);
    walk_beside_twin(kernel, shape.mesh, {.steps = steps, .every = 50, .seed = 6});
  }
}

TEST_CASE("Regina finds our homology with torsion, intact and while the body is cut",
          "[suite][regina][homology]") {
  if (!has_regina()) return;
  const auto [name, tetrahedra] =
      GENERATE(table<std::string, Tetrahedra>({{"RP3", lens_space(2, 1)},
                                               {"S2 x S1", sphere_bundle(5, false)},
                                               {"the torus of dimension 3", three_torus(3)}}));
  INFO(name);
  std::uint32_t points = 0;
  for (const auto& t : tetrahedra)
    points = std::max({points, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1});
  TetMesh mesh;
  mesh.tetrahedra = tetrahedra;
  for (std::uint32_t p = 0; p < points; ++p) {
    const double x = p;
    mesh.points.push_back({x, x * x, x * x * x});
  }
  JudgedKernel kernel =
      process_kernel("exec " SUNDER_PYTHON " " SUNDER_ADAPTERS "/regina_adapter.py 200");
  walk_beside_twin(kernel, mesh, {.steps = 40, .every = 40, .seed = 7});
}
