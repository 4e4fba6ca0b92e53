// SPDX-License-Identifier: MIT
// `sunder refine` and `sunder cut`: their files, reports and refusals.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/program.hpp"
#include "topology/io/mesh_file.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

const std::string bar = std::string(SUNDER_MESHES) + "/bar.msh";

/// Two tetrahedra of two regions, their common face as a triangle, an edge of it, data of each
/// kind.
FileMesh small() {
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.tetrahedra.corners = {{0, 1, 2, 3}, {1, 0, 2, 4}};
  mesh.tetrahedra.region = {7, 8};
  mesh.tetrahedra.data = {{"mass", 1, NumberType::float64, std::vector<double>{6, 12}},
                          {"kind", 1, NumberType::int32, std::vector<std::int64_t>{3, 4}}};
  mesh.triangles.corners = {{0, 1, 2}};
  mesh.triangles.region = {5};
  mesh.edges.corners = {{0, 1}};
  mesh.edges.region = {2};
  mesh.point_data = {{"heat", 1, NumberType::float64, std::vector<double>{0, 10, 20, 30, 40}}};
  mesh.region_name[3] = {{7, "upper"}, {8, "lower"}};
  return mesh;
}

const DataColumn& column(const std::vector<DataColumn>& columns, const std::string& name) {
  for (const DataColumn& c : columns) {
    if (c.name == name) return c;
  }
  FAIL("no column " << name);
  return columns.front();
}

double sum(const DataColumn& c) {
  double total = 0;
  for (const double x : std::get<std::vector<double>>(c.values)) total += x;
  return total;
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

double area(const FileMesh& mesh) {
  double total = 0;
  for (const auto& t : mesh.triangles.corners) {
    const Point &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    total += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;  // in z = 0
  }
  return total;
}

}  // namespace

TEST_CASE("refine: regions, lower cells and data go along", "[apps][cells]") {
  const Workplace here;
  const std::string in = here.path("in.vtu"), out = here.path("out.vtu");
  REQUIRE_FALSE(has_error(write_file_mesh(in, small(), {})));
  const Outcome fine = here.run({"refine", in, out, "--share", "mass", "--json"});
  INFO(fine.out << fine.err);
  REQUIRE(fine.exit_code == 0);
  CHECK(fine.json()["before"]["tetrahedra"] == 2);
  CHECK(fine.json()["after"]["tetrahedra"] == 16);
  CHECK(fine.json()["after"]["betti"] == fine.json()["before"]["betti"]);
  CHECK(fine.json()["levels"][0]["red"] == 2);
  const auto mesh = read_file_mesh(out);
  REQUIRE(mesh);
  CHECK(mesh->points.size() == 5 + 9);
  CHECK(std::ranges::count(mesh->tetrahedra.region, 7) == 8);
  CHECK(mesh->triangles.corners.size() == 4);
  CHECK(area(*mesh) == 0.5);  // none is turned over
  CHECK(mesh->edges.corners.size() == 2);
  CHECK(sum(column(mesh->tetrahedra.data, "mass")) == 18);
  const auto& heat = std::get<std::vector<double>>(column(mesh->point_data, "heat").values);
  for (std::size_t p = 0; p < mesh->points.size(); ++p) {
    const Point& x = mesh->points[p];  // heat is linear on each side of z = 0
    const double expected = 10 * x[0] + 20 * x[1] + (x[2] > 0 ? 30 * x[2] : -40 * x[2]);
    CHECK(heat[p] == Approx(expected));
  }
}

TEST_CASE("refine: a region, a plane, a crack", "[apps][cells]") {
  const Workplace here;
  const std::string in = here.path("in.vtu"), out = here.path("out.vtu");
  write_file_mesh(in, small(), {});
  const Outcome region = here.run({"refine", in, out, "--region", "8", "--json"});
  REQUIRE(region.exit_code == 0);
  CHECK(region.json()["after"]["tetrahedra"] == 12);  // eight, and four to fit
  CHECK(region.json()["levels"][0]["green"] == 1);

  const Outcome plane = here.run(
      {"refine", bar, out, "--plane", "1,0,0,0.5", "--within", "0.01", "--levels", "2", "--json"});
  REQUIRE(plane.exit_code == 0);
  CHECK(plane.json()["levels"].size() == 2);
  const Outcome check = here.run({"check", out});
  CHECK(check.exit_code == 0);
  for (const std::string kernel : {"dense", "lcc"}) {
    const std::string same = here.path(kernel + ".msh");
    REQUIRE(here.run({"refine", bar, same, "--plane", "1,0,0,0.5", "--kernel", kernel}).exit_code ==
            0);
  }
  CHECK(bytes_of(here.path("dense.msh")) == bytes_of(here.path("lcc.msh")));

  const std::string cracked = here.path("cracked.msh");
  REQUIRE(here.run({"convert", bar, cracked, "--crack-plane", "1,0,0,0.5"}).exit_code == 0);
  const Outcome crack = here.run({"refine", cracked, out, "--crack", "--json"});
  INFO(crack.out << crack.err);
  REQUIRE(crack.exit_code == 0);
  CHECK(crack.json()["levels"][0]["red"] > 90);
  CHECK(crack.json()["after"]["components"] == 2);
  // Both sides are divided alike: the halves can be glued.
  const Outcome glued = here.run({"convert", out, here.path("glued.msh"), "--merge-points", "0"});
  REQUIRE(glued.exit_code == 0);
  const Outcome whole = here.run({"check", here.path("glued.msh"), "--json"});
  CHECK(whole.exit_code == 0);
  CHECK(whole.json()["counts"]["components"] == 1);
}

TEST_CASE("cut: exactly and along faces", "[apps][cells]") {
  const Workplace here;
  const std::string out = here.path("out.msh");
  for (const std::string kernel : {"dense", "lcc"}) {
    const Outcome exact = here.run(
        {"cut", bar, out, "--plane", "1,0.2,0.1,0.37", "--exact", "--kernel", kernel, "--json"});
    INFO(exact.out << exact.err);
    REQUIRE(exact.exit_code == 0);
    CHECK(exact.json()["after"]["components"] == 2);
    CHECK(std::abs(exact.json()["after"]["volume"].get<double>() /
                       exact.json()["before"]["volume"].get<double>() -
                   1) < 1e-13);
    CHECK(exact.json()["closed_faces"] == 0);
  }
  CHECK(here.run({"check", out}).exit_code == 0);
  const Outcome along = here.run({"cut", bar, out, "--plane", "1,0,0,0.5", "--json"});
  REQUIRE(along.exit_code == 0);
  CHECK(along.json()["after"]["tetrahedra"] == along.json()["before"]["tetrahedra"]);
  CHECK(along.json()["points_copied"] == 39);
}

TEST_CASE("cut: a plane that nearly passes through points, and the tolerance", "[apps][cells]") {
  const Workplace here;
  const std::string out = here.path("out.vtu"), plane = "1,0,0,1.000000001",
                    cube = sample_mesh("cube.msh");  // it has points at x = 1
  const Outcome thin = here.run({"cut", cube, out, "--plane", plane, "--exact", "--json"});
  REQUIRE(thin.exit_code == 0);
  CHECK(thin.json()["nearest_to_an_end"].get<double>() < 1e-6);
  CHECK(thin.json()["on_plane"] == 0);
  const Outcome told = here.run({"cut", cube, out, "--plane", plane, "--exact"});
  CHECK(told.out.find("--tolerance 1e-6") != std::string::npos);
  const Outcome clean =
      here.run({"cut", cube, out, "--plane", plane, "--exact", "--tolerance", "1e-6", "--json"});
  REQUIRE(clean.exit_code == 0);
  CHECK(clean.json()["on_plane"].get<int>() > 0);
  CHECK(clean.json()["after"]["components"] == 2);
  CHECK(here.run({"check", out}).exit_code == 0);
}

TEST_CASE("refine and cut: what cannot be is refused in words", "[apps][cells]") {
  const Workplace here;
  const std::string out = here.path("out.msh");
  const auto refused = [&](std::vector<std::string> words, int code, const std::string& says) {
    const Outcome outcome = here.run(words);
    INFO(outcome.out << outcome.err);
    CHECK(outcome.exit_code == code);
    CHECK((outcome.err + outcome.out).find(says) != std::string::npos);
    CHECK_FALSE(std::ifstream(out).good());
  };
  refused({"refine", "no.msh", out}, 3, "no.msh");
  refused({"refine", bar, out, "--region", "nowhere"}, 2, "nowhere");
  refused({"refine", bar, out, "--within", "1"}, 2, "nothing to be near to");
  refused({"refine", bar, out, "--levels", "0"}, 2, "levels");
  refused({"refine", bar, out, "--crack"}, 2, "no two boundary faces");
  refused({"refine", bar, out, "--levels", "12"}, 2, "more than 134217728");
  refused({"refine", bar, out, "--plane", "1,0,0,77"}, 2, "no tetrahedron is near");
  refused({"refine", bar, out, "--plane", "1,0,0,0.5", "--within", "-1"}, 2, "0 or more");
  refused({"refine", bar, out, "--share", "mass"}, 2, "mass");
  refused({"cut", bar, out, "--plane", "0,0,0,1", "--exact"}, 2, "normal");
  refused({"cut", bar, out, "--plane", "1,0,0,77", "--exact"}, 2, "offset");
  refused({"cut", bar, out, "--plane", "1,0,0", "--exact"}, 2, "four numbers");
  refused({"cut", bar, out}, 2, "--plane");
  refused({"cut", bar, out, "--plane", "1,0,0,0.5", "--exact", "--tolerance", "0.3"}, 2, "0.01");
  refused({"cut", bar, out, "--plane", "1,0,0,0.5", "--tolerance", "1e-6"}, 2, "--exact");
  CHECK(here.run({"cut", bar, "/nowhere/at/all.msh", "--plane", "1,0,0,0.5"}).exit_code == 4);
}
