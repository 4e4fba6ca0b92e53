// SPDX-License-Identifier: MIT
// Cracks from the command line: cut faces, written files, refusals.
#include <catch2/catch.hpp>
#include <fstream>
#include <string>

#include "tests/support/program.hpp"
#include "topology/io/mesh_file.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

const std::string bar = std::string(SUNDER_MESHES) + "/bar.msh";

std::size_t lines_that_begin(const std::string& path, const std::string& word) {
  std::ifstream in(path);
  std::size_t count = 0;
  for (std::string line; std::getline(in, line);) count += line.rfind(word, 0) == 0;
  return count;
}

}  // namespace

TEST_CASE("a plane cuts the bar in two, and the pairs are listed", "[apps][convert][crack]") {
  const Workplace here;
  const std::string pairs = here.path("pairs.csv");
  const Outcome cut = here.run({"convert", bar, here.path("a.vtu"), "--crack-plane", "1,0,0,0.5",
                                "--crack-pairs", pairs, "--json"});
  INFO(cut.out << cut.err);
  REQUIRE(cut.exit_code == 0);
  CHECK(cut.json()["counts"]["points"] == 975 + 39);
  CHECK(cut.json()["lossless"] == true);
  CHECK(lines_that_begin(pairs, "point,") == 39);
  CHECK(lines_that_begin(pairs, "face,") == 48);
  const Outcome check = here.run({"check", here.path("a.vtu")});
  CHECK(check.out.find("components                   2") != std::string::npos);
  // Separated points can be glued again.
  const Outcome glued =
      here.run({"convert", here.path("a.vtu"), here.path("b.vtu"), "--merge-points", "0"});
  REQUIRE(glued.exit_code == 0);
  CHECK(read_file_mesh(here.path("b.vtu"))->tetrahedra.corners ==
        read_file_mesh(bar)->tetrahedra.corners);
}

TEST_CASE("a crack that cannot be opened is told, and nothing is written",
          "[apps][convert][crack]") {
  const Workplace here;
  const std::string out = here.path("a.vtu");
  { std::ofstream(here.path("faces.txt")) << "0 1 2\n"; }
  CHECK(here.run({"convert", bar, out, "--crack-plane", "1,0,0,99"}).exit_code == 3);
  CHECK(here.run({"convert", bar, out, "--crack-regions", "bar,hole"}).exit_code == 3);
  CHECK(here.run({"convert", bar, out, "--crack-faces", here.path("faces.txt")}).exit_code == 3);
  CHECK(here.run({"convert", bar, out, "--crack-faces", here.path("none.txt")}).exit_code == 3);
  CHECK(here.run({"convert", bar, out, "--crack-plane", "1,0,0"}).exit_code == 2);
  CHECK(here.run({"convert", bar, out, "--crack-regions", "1"}).exit_code == 2);
  CHECK(here.run({"convert", bar, out, "--crack-pairs", "p.csv"}).exit_code == 2);
  CHECK_FALSE(std::ifstream(out).good());
}
