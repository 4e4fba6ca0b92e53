// SPDX-License-Identifier: MIT
// Commands that messages recommend: they run as they stand.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

#include "tests/support/program.hpp"

using namespace sunder::test;

namespace {

std::string replaced(std::string text, const std::string& word, const std::string& by) {
  const std::size_t at = text.find(word);
  REQUIRE(at != std::string::npos);
  return text.replace(at, word.size(), by);
}

bool shell(const std::string& words) { return std::system(words.c_str()) == 0; }

}  // namespace

TEST_CASE("a surface in place of a body names the commands that fill it", "[apps][hints]") {
  const bool has_tetgen = shell("command -v tetgen >/dev/null");
  if (!has_tetgen) WARN("not run: tetgen is not installed");
  for (const char* name : {"gmsh.stl", "assimp.ply", "assimp.obj", "openscad.off"}) {
    const Workplace here;
    const std::string surface = std::string(SUNDER_IO_DATA "/") + name;
    const Outcome refused = here.run({"split", surface, "--plane", "1,0,0,0"});
    INFO(name << ": " << refused.err);
    REQUIRE(refused.exit_code == 3);
    const std::size_t begin = refused.err.find("sunder convert FILE"),
                      end = refused.err.find(" writes surface.1.ele");
    REQUIRE(end != std::string::npos);
    if (!has_tetgen) continue;
    std::string command = refused.err.substr(begin, end - begin);
    command =
        replaced(replaced(command, "sunder", "'" SUNDER_PROGRAM "'"), "FILE", "'" + surface + "'");
    REQUIRE(shell("cd '" + here.path("") + "' && { " + command + "; } >out.txt 2>&1"));
    const Outcome checked = here.run({"check", here.path("surface.1.ele"), "--json"});
    CHECK(checked.exit_code == 0);
    CHECK(checked.json()["counts"]["tetrahedra"].get<int>() > 0);
  }
}
