// SPDX-License-Identifier: MIT
// `sunder convert` from outside: written files, reported losses, and how it ends.
#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>

#include "tests/support/program.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/io/mesh_file.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string io_sample(const std::string& name) { return SUNDER_IO_DATA "/" + name; }

}  // namespace

TEST_CASE("a two-material box goes round through every format and comes back", "[apps][convert]") {
  const Workplace here;
  const Result<FileMesh> first = read_file_mesh(io_sample("gmsh_41.msh"));
  REQUIRE(first);
  for (const FormatTraits& t : format_traits()) {
    if (!contains(t.cells, CellKind::tetrahedron)) continue;  // surfaces
    INFO(t.name);
    const std::string middle = here.path("middle" + std::string(t.extensions[0]));
    const Outcome there = here.run({"convert", io_sample("gmsh_41.msh"), middle, "--json"});
    INFO(there.out << there.err);
    REQUIRE(there.exit_code == 0);
    CHECK(there.json()["written"] == true);
    CHECK(there.json()["counts"]["tetrahedra"] == 48);
    const Outcome back = here.run({"convert", middle, here.path("back.msh")});
    INFO(back.out << back.err);
    REQUIRE(back.exit_code == 0);
    const Result<FileMesh> last = read_file_mesh(here.path("back.msh"));
    REQUIRE(last);
    CHECK(last->points == first->points);
    CHECK(last->tetrahedra.corners == first->tetrahedra.corners);
    CHECK(last->tetrahedra.region == first->tetrahedra.region);
    CHECK(last->triangles.region == first->triangles.region);
    CHECK(last->region_name == first->region_name);
    if (t.holds_entities) CHECK(*last == *first);
  }
}

TEST_CASE("with --strict nothing is written where something would be lost", "[apps][convert]") {
  const Workplace here;
  const std::string vtu = here.path("a.vtu");
  // Entities of surfaces and volumes fit into VTU, not into MEDIT.
  CHECK(here.run({"convert", io_sample("gmsh_41_all.msh"), vtu, "--strict"}).exit_code == 0);
  const Outcome lost = here.run(
      {"convert", io_sample("gmsh_41_all.msh"), here.path("a.mesh"), "--strict", "--json"});
  CHECK(lost.exit_code == 1);
  CHECK(lost.json()["written"] == false);
  CHECK(lost.json()["lossless"] == false);
  CHECK(here.names() == std::vector<std::string>{"a.vtu", "a.vtu.regions"});
  const Outcome kept = here.run({"convert", io_sample("gmsh_41_all.msh"), here.path("a.mesh")});
  CHECK(kept.exit_code == 0);
  CHECK(kept.err.find("entities_lost") != std::string::npos);
}

TEST_CASE("versions, encodings and --to decide what is written", "[apps][convert]") {
  const Workplace here;
  const auto converted = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments{"convert", io_sample("gmsh_41.msh"), here.path("a.out")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = here.run(arguments);
    return outcome.exit_code == 0 ? bytes_of(here.path("a.out")).substr(0, 21)
                                  : "exit " + std::to_string(outcome.exit_code);
  };
  CHECK(converted({"--to", "msh"}) == "$MeshFormat\n4.1 0 8\n$");
  CHECK(converted({"--to", "msh", "--format-version", "2.2"}) == "$MeshFormat\n2.2 0 8\n$");
  CHECK(converted({"--to", "msh", "--format-version", "4.0", "--binary"}).substr(0, 18) ==
        "$MeshFormat\n4 1 8\n");
  CHECK(converted({"--to", "msh", "--format-version", "1"}).substr(0, 5) == "$NOD\n");
  CHECK(converted({"--to", "mesh"}) == "MeshVersionFormatted ");
  CHECK(converted({"--to", "msh", "--format-version", "3"}) == "exit 2");
  CHECK(converted({"--to", "msh", "--format-version", "1", "--binary"}) == "exit 2");
  CHECK(converted({"--to", "vtu", "--text"}) == "<?xml version=\"1.0\"?>");
  CHECK(converted({"--to", "vtu", "--text", "--zlib"}) == "exit 2");
  CHECK(converted({"--to", "mesh", "--base64"}) == "exit 2");
  CHECK(converted({"--to", "step"}) == "exit 2");
  CHECK(converted({}) == "exit 2");  // .out names no format
}

TEST_CASE("what cannot be read or written ends with its own code", "[apps][convert]") {
  const Workplace here;
  const std::string good = io_sample("gmsh_41.msh");
  CHECK(here.run({"convert", here.path("none.msh"), here.path("a.vtu")}).exit_code == 3);
  CHECK(here.run({"convert", here.write("a.msh", "$Mesh"), here.path("a.vtu")}).exit_code == 3);
  CHECK(here.run({"convert", good, here.path("no/such/folder.vtu")}).exit_code == 4);
  CHECK(here.run({"convert", good}).exit_code == 2);
}

TEST_CASE("volume cells that are no tetrahedra are kept, or left out on request",
          "[apps][convert]") {
  const Workplace here;
  std::string text = bytes_of(io_sample("gmsh_22.msh"));
  const std::size_t count = text.find("$Elements\n") + 10;
  const std::size_t end = text.find("$EndElements");
  const int elements = std::stoi(text.substr(count));
  text.insert(end, "9999 5 2 7 1 1 2 3 4 5 6 7 8\n");
  text.replace(count, text.find('\n', count) - count, std::to_string(elements + 1));
  const std::string mixed = here.write("mixed.msh", text);
  const Outcome kept = here.run({"convert", mixed, here.path("a.vtu"), "--strict"});
  CHECK(kept.exit_code == 0);
  const Result<FileMesh> whole = read_file_mesh(here.path("a.vtu"));
  REQUIRE(whole);
  CHECK(rows_of(*whole, CellKind::hexahedron8).size() == 1);
  CHECK(here.run({"convert", mixed, here.path("a.vtu"), "--tetrahedra-only"}).exit_code == 0);
  const Outcome strict =
      here.run({"convert", mixed, here.path("b.vtu"), "--tetrahedra-only", "--strict"});
  CHECK(strict.exit_code == 1);
}

TEST_CASE("for solvers that read triangles as shells they are dropped, and that is told",
          "[apps][convert]") {
  const Workplace here;
  const std::string box = io_sample("gmsh_41_all.msh");
  for (const FormatTraits& t : format_traits()) {
    if (!contains(t.cells, CellKind::tetrahedron)) continue;
    INFO(t.name);
    const std::string out = here.path("solid" + std::string(t.extensions[0]));
    const Outcome dropped = here.run({"convert", box, out, "--triangles", "drop"});
    INFO(dropped.out << dropped.err);
    REQUIRE(dropped.exit_code == 0);
    CHECK(dropped.err.find("faces and edges were dropped") != std::string::npos);
    const Result<FileMesh> mesh = read_file_mesh(out);
    REQUIRE(mesh);
    CHECK(mesh->triangles.corners.empty());
    CHECK(mesh->edges.corners.empty());
    CHECK(mesh->tetrahedra.corners.size() == 48);
  }
  // The rest has none, and a surface would have nothing left.
  const Outcome again =
      here.run({"convert", here.path("solid.msh"), here.path("b.msh"), "--triangles", "drop"});
  CHECK(again.err.find("nothing was dropped") != std::string::npos);
  const Outcome surface =
      here.run({"convert", io_sample("meshio.off"), here.path("c.vtk"), "--triangles", "drop"});
  CHECK(surface.exit_code == 3);
  CHECK(here.run({"convert", box, here.path("c.vtk"), "--triangles", "some"}).exit_code == 2);
}

TEST_CASE("no sentence of a conversion counts nothing", "[apps][convert]") {
  const Workplace here;
  const std::string one =
      here.write("one.msh", TetMesh{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                    .tetrahedra = {{0, 1, 2, 3}}});
  const Outcome plain = here.run({"convert", one, here.path("one.vtu")});
  CHECK(plain.out ==
        here.path("one.vtu") + ": written from 4 points, 1 tetrahedron; nothing is lost\n");
  const Outcome repaired =
      here.run({"convert", one, here.path("two.vtu"), "--merge-points", "0", "--drop-duplicates",
                "--split-nonmanifold", "--fix-orientation", "--largest-component", "--drop-unused",
                "--triangles", "drop"});
  CHECK(repaired.exit_code == 0);
  const std::string said = repaired.out + repaired.err;
  INFO(said);
  for (std::size_t at = said.find('0'); at != std::string::npos; at = said.find('0', at + 1)) {
    const bool alone = (at == 0 || said[at - 1] == ' ') && said.compare(at, 2, "0 ") == 0;
    const bool is_distance = said.compare(at, 3, "0 m") == 0;
    CHECK((!alone || is_distance));
  }
}

TEST_CASE("repairs are made on request and told", "[apps][convert]") {
  const Workplace here;
  TetMesh mesh{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 5, 5}, {0, 0, 1}},
               .tetrahedra = {{0, 2, 1, 3}, {0, 1, 2, 5}}};
  const std::string faulty = here.write("faulty.msh", mesh);
  const Outcome repaired =
      here.run({"convert", faulty, here.path("clean.msh"), "--merge-points", "0",
                "--drop-duplicates", "--fix-orientation", "--drop-unused", "--json"});
  INFO(repaired.out << repaired.err);
  CHECK(repaired.exit_code == 0);
  CHECK(repaired.json()["counts"]["tetrahedra"] == 1);
  CHECK(repaired.json()["counts"]["points"] == 4);
  CHECK(here.run({"check", here.path("clean.msh")}).exit_code == 0);
  CHECK(here.run({"convert", faulty, here.path("a.msh"), "--merge-points", "-1"}).exit_code == 2);
}

TEST_CASE("the table of formats in the documentation is the program's own", "[apps][convert]") {
  const Workplace here;
  const Outcome table = here.run({"convert", "--formats"});
  CHECK(table.exit_code == 0);
  const std::string page = bytes_of(std::string(SUNDER_MESHES) + "/../docs/reference/formats.md");
  CHECK(page.find(table.out) != std::string::npos);
  for (const FormatTraits& t : format_traits()) {
    CHECK(table.out.find("| " + std::string(t.name) + " |") != std::string::npos);
  }
}

TEST_CASE("cells made linear are told in the right number", "[apps][convert]") {
  const Workplace here;
  const auto told = [&](const std::string& cells) {
    const std::string mesh = here.write(
        "a.mesh",
        "MeshVersionFormatted 2\nDimension 3\nVertices\n3\n0 0 0 0\n2 0 0 0\n1 0 0 0\nEdgesP2\n" +
            cells + "End\n");
    return here.run({"convert", mesh, here.path("b.vtu"), "--order", "1"}).err;
  };
  CHECK(told("1\n1 2 3 0\n").find("1 second-order edge is made linear") != std::string::npos);
  CHECK(told("2\n1 2 3 0\n2 1 3 0\n").find("2 second-order edges are made linear") !=
        std::string::npos);
}
