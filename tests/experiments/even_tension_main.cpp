// SPDX-License-Identifier: MIT
// `even_tension [MESH...]`: one crack through each body and through a jittered cube, along 30
// random planes, with cracks as the paper has them and as objects; means, as a CSV.
#include <cstdio>

#include "tests/experiments/cases/even_tension.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::accuracy;

namespace {

constexpr int planes = 30;

Vec3 direction(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (;;) {
    Vec3 n;
    for (double& x : n) x = 2 * suite::unit(random) - 1;
    if (n.norm() < 1 && n.norm() > 0.1) return n.normalized();
  }
}

void print_row(const char* name, const TetMesh& mesh, CrackMode mode) {
  double raw = 0, most_raw = 0, projected = 0, smooth = 0, smooth_projected = 0, pieces = 0,
         two = 0, least = 1, debris = 0, cracks = 0;
  for (std::uint64_t seed = 1; seed <= planes; ++seed) {
    const TornBody torn = tear(mesh, {.axis = direction(seed), .seed = seed, .crack = mode});
    raw += torn.raw / planes;
    most_raw = std::max(most_raw, torn.raw);
    projected += torn.projected / planes;
    smooth += torn.smooth_raw / planes;
    smooth_projected += torn.smooth_projected / planes;
    pieces += double(torn.pieces) / planes;
    two += torn.two_largest / planes;
    least = std::min(least, torn.two_largest);
    debris += double(torn.debris) / planes;
    cracks += double(torn.cracks) / planes;
  }
  std::printf("%s,%s,%.3f,%.3f,%.3f,%.3f,%.3f,%.1f,%.4f,%.4f,%.1f,%.1f\n", name,
              mode == CrackMode::paper ? "paper" : "object", raw, most_raw, projected, smooth,
              smooth_projected, pieces, two, least, debris, cracks);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::puts(
      "mesh,mode,raw area / section,most,projected / section,drawn smooth,projected,pieces,two "
      "largest,least,debris,cracks");
  const auto print = [](const char* name, const TetMesh& mesh) {
    for (const CrackMode mode : {CrackMode::paper, CrackMode::object}) print_row(name, mesh, mode);
  };
  print("jittered cube", suite::jittered(suite::kuhn_box({10, 10, 10}, 0.1), 0.02, 1));
  for (int i = 1; i < argc; ++i) {
    const Result<TetMesh> mesh = read_mesh(std::filesystem::path(argv[i]));
    for (const Finding& f : mesh.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
    if (!mesh) return 3;
    print(argv[i], *mesh);
  }
}
