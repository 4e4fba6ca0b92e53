// SPDX-License-Identifier: MIT
// Limits of input: lowered by name, never raised, and kept by all readers.
#include "topology/base/limits.hpp"

#include <catch2/catch.hpp>

#include "tests/support/io_support.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/mesh_file.hpp"

using namespace sunder;
using namespace sunder::test;
using Catch::Contains;

TEST_CASE("limits are lowered by their names and never raised", "[io][limits]") {
  Limits limits;
  CHECK(lower_limits(limits, " steps=1e3, frames=7 ") == "");
  CHECK(limits.steps == 1000);
  CHECK(limits.frames == 7);
  CHECK(lower_limits(limits, "steps=2000 frames=1e300") == "");
  CHECK(limits.steps == 1000);
  CHECK(limits.frames == 7);
  CHECK(limits.unpacked_bytes == Limits{}.unpacked_bytes);
}

TEST_CASE("a mistake in a list of limits is named and lowers nothing", "[io][limits]") {
  for (const char* list : {"steps", "steps=", "steps=many", "steps=-1", "steps=nan", "stepz=1",
                           "=1", "frames=3 steps=1x"}) {
    INFO(list);
    Limits limits;
    CHECK_THAT(lower_limits(limits, list),
               Contains("is no limit with a number") && Contains("unpacked_bytes"));
    CHECK(limits.frames == Limits{}.frames);
    CHECK(limits.steps == Limits{}.steps);
  }
}

// The process has one set of limits: this test goes to the end of its process.
TEST_CASE("files beyond the limits are refused by name, packed or not", "[.][limits]") {
  const Folder folder;
  const auto plain = folder.path() / "a.msh", packed = folder.path() / "a.msh.gz";
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  REQUIRE(write_mesh(plain, mesh).empty());
  const std::string text = bytes_of(plain);
  REQUIRE_FALSE(write_file(packed, text));
  CHECK(read_mesh(packed));
  lower_limits({.unpacked_bytes = text.size()});
  CHECK(read_mesh(packed));
  lower_limits({.unpacked_bytes = text.size() - 1});
  const auto unfolded = read_mesh(packed);
  REQUIRE_FALSE(unfolded);
  CHECK(unfolded.findings.front().code == "too_large");
  CHECK(read_mesh(plain));
  lower_limits({.file_bytes = text.size() - 1});
  const auto large = read_mesh(plain);
  REQUIRE_FALSE(large);
  CHECK(large.findings.front().code == "too_large");
}
