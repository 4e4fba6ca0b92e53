// SPDX-License-Identifier: MIT
// Faulty surfaces of users: repaired with words about it, or refused with place and remedy.
#include "apps/sunder/break/mend.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "apps/sunder/break/fill.hpp"
#include "apps/sunder/process/run_process.hpp"
#include "tests/support/program.hpp"
#include "tests/topology/mesh/surface/repair/cube_surface.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

const Finding* note_of(const Result<Mended>& mended, std::string_view code) {
  const auto found = std::ranges::find(mended.findings, code, &Finding::code);
  return found == mended.findings.end() ? nullptr : &*found;
}

/// A cube that has a small box cut out of the middle of one face, which is left open there.
FileMesh with_small_hole() {
  FileMesh cube = cube_surface();
  cube.points.push_back({0.48, 0.48, 1});
  cube.points.push_back({0.52, 0.48, 1});
  cube.points.push_back({0.5, 0.52, 1});
  auto& t = cube.triangles.corners;
  t.erase(t.begin() + 2, t.begin() + 4);  // the face z = 1
  for (const auto& corners : std::vector<std::array<std::uint32_t, 3>>{
           {4, 5, 8}, {5, 9, 8}, {5, 6, 9}, {6, 10, 9}, {6, 7, 10}, {7, 8, 10}, {7, 4, 8}}) {
    t.push_back(corners);
  }
  return cube;
}

}  // namespace

TEST_CASE("a small hole is closed and reported, or refused where repairs are forbidden",
          "[break]") {
  const Result<Mended> mended = mend(with_small_hole(), Mending::small);
  for (const Finding& f : mended.findings) UNSCOPED_INFO(f.text);
  REQUIRE(mended);
  CHECK(mended->volume == Approx(1));
  const Finding* note = note_of(mended, "repaired");
  REQUIRE(note != nullptr);
  CHECK(note->severity == Severity::note);
  CHECK(note->text.find("1 hole closed, the widest 0.04") != std::string::npos);
  CHECK(note->text.find("it moved by") != std::string::npos);
  const Result<Mended> refused = mend(with_small_hole(), Mending::none);
  REQUIRE_FALSE(refused);
  CHECK(refused.findings[0].code == "open_surface");
  CHECK(refused.findings[0].text.find("3 edges of one face only at (0.") != std::string::npos);
  CHECK(refused.findings[0].remedy.find("leave out --repair none") != std::string::npos);
}

TEST_CASE("a wide hole is refused with its place and width", "[break]") {
  FileMesh open = cube_surface();
  open.triangles.corners.resize(10);
  const Result<Mended> refused = mend(open, Mending::small);
  REQUIRE_FALSE(refused);
  CHECK(refused.findings[0].code == "open_surface");
  CHECK(refused.findings[0].text.find("the widest 1 at (0, 0.5, 0.5)") != std::string::npos);
  CHECK(refused.findings[0].remedy.find("--repair wrap") != std::string::npos);
}

TEST_CASE("a whole surface is left as it is, and its parts are reported", "[break]") {
  const Result<Mended> whole = mend(cube_surface(), Mending::small);
  REQUIRE(whole);
  CHECK(whole.findings.empty());
  CHECK(whole->surface == cube_surface());
  const Result<Mended> two = mend(together(cube_surface(), cube_surface(3)), Mending::small);
  REQUIRE(two);
  CHECK(note_of(two, "several_parts") != nullptr);
  CHECK(note_of(two, "repaired") == nullptr);
}

TEST_CASE("shells that overlap are joined by sunder-repair, and refused without it", "[break]") {
  const FileMesh crossing = together(cube_surface(), cube_surface(0.5));
  const std::string before = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  const Result<Mended> refused = mend(crossing, Mending::small);
  REQUIRE_FALSE(refused);
  CHECK(refused.findings[0].code == "self_intersection");
  CHECK(refused.findings[0].remedy.find("--target sunder-repair") != std::string::npos);
  const std::filesystem::path own = std::filesystem::path(SUNDER_PROGRAM).parent_path();
  setenv("PATH", (own.string() + ":" + before).c_str(), 1);
  if (!find_program("sunder-repair")) {
    setenv("PATH", before.c_str(), 1);
    WARN("skipped: sunder-repair is not built");
    return;
  }
  const Result<Mended> joined = mend(crossing, Mending::small);
  FileMesh open = cube_surface();
  open.triangles.corners.resize(10);
  const Result<Mended> wrapped = mend(open, Mending::wrap);
  setenv("PATH", before.c_str(), 1);
  for (const Finding& f : joined.findings) UNSCOPED_INFO(f.text);
  REQUIRE(joined);
  CHECK(joined->volume == Approx(2 - 0.125));
  REQUIRE(note_of(joined, "repaired") != nullptr);
  CHECK(note_of(joined, "repaired")->text.find("2 closed shells joined") != std::string::npos);
  REQUIRE(wrapped);
  CHECK(note_of(wrapped, "repaired")->text.find("wrapped into one surface") != std::string::npos);
}

TEST_CASE("a cavity stays empty", "[break]") {
  if (!find_program("tetgen")) {
    WARN("skipped: tetgen is not installed");
    return;
  }
  FileMesh inner = cube_surface(0.25, 0.5);
  for (auto& t : inner.triangles.corners) std::swap(t[0], t[1]);
  const Result<Mended> hollow = mend(together(cube_surface(), inner), Mending::small);
  REQUIRE(hollow);
  CHECK(hollow->volume == Approx(0.875));
  const Result<Filled> filled = fill({{}, hollow->surface, hollow->volume}, 1000, "tetgen");
  for (const Finding& f : filled.findings) UNSCOPED_INFO(f.text);
  REQUIRE(filled);
  CHECK(filled->volume_error == Approx(0).margin(1e-9));
  CHECK(filled->gap.largest < 1e-9);
}
