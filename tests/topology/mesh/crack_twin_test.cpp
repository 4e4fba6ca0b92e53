// SPDX-License-Identifier: MIT
// Cracks in careless files: the cut faces, and the changes of points and of cells of lower
// dimension, against definitions by sets. Findings about missing regions and faces.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <numeric>
#include <set>

#include "tests/support/built.hpp"
#include "tests/support/random_meshes.hpp"
#include "topology/mesh/crack.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

using Row = std::uint32_t;
using Triangle = std::array<Row, 3>;

std::set<Row> face_points(const FileMesh& mesh, Row face) {
  const auto& t = mesh.tetrahedra.corners[face / 4];
  std::set<Row> points(t.begin(), t.end());
  points.erase(t[face % 4]);
  return points;
}

/// Faces by their points, each with the half-faces on them.
std::map<std::set<Row>, std::vector<Row>> sides_of(const FileMesh& mesh) {
  std::map<std::set<Row>, std::vector<Row>> sides;
  for (Row f = 0; f < 4 * mesh.tetrahedra.corners.size(); ++f)
    sides[face_points(mesh, f)].push_back(f);
  return sides;
}

/// A careless mesh of proper tetrahedra, no two alike, with finite points, small; none where it has
/// faults.
std::optional<FileMesh> proper(Random& random) {
  FileMesh mesh = careless(random);
  if (mesh.tetrahedra.corners.empty() || mesh.tetrahedra.corners.size() > 80) return std::nullopt;
  std::set<std::set<Row>> known;
  for (const auto& t : mesh.tetrahedra.corners) {
    const std::set<Row> points(t.begin(), t.end());
    if (points.size() < 4 || !known.insert(points).second) return std::nullopt;
    for (const Row p : t) {
      if (p >= mesh.points.size() || !is_finite(mesh.points[p])) return std::nullopt;
    }
  }
  return mesh;
}

/// The lower side of each inner face for which `is_cut` holds, in rising order.
template <class IsCut>
CutFaces chosen(const FileMesh& mesh, IsCut is_cut) {
  CutFaces faces;
  for (const auto& [points, sides] : sides_of(mesh)) {
    if (sides.size() == 2 && is_cut(points, sides[0] / 4, sides[1] / 4)) faces.push_back(sides[0]);
  }
  std::ranges::sort(faces);
  return faces;
}

void hold_choice(const Result<CutFaces>& result, const CutFaces& expected) {
  if (expected.empty()) {
    REQUIRE_FALSE(result);
    CHECK(result.findings[0].code == "no_face");
  } else {
    REQUIRE(result);
    CHECK(*result == expected);
  }
}

/// For each tetrahedron at `point` the lowest that it hangs together with across inner faces at
/// the point that are not in `cut`.
std::map<Row, Row> parts_at(const FileMesh& mesh,
                            const std::map<std::set<Row>, std::vector<Row>>& sides, Row point,
                            const std::set<Row>& cut) {
  std::map<Row, Row> low;
  for (Row t = 0; t < mesh.tetrahedra.corners.size(); ++t) {
    if (std::ranges::find(mesh.tetrahedra.corners[t], point) != mesh.tetrahedra.corners[t].end())
      low[t] = t;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [points, f] : sides) {
      if (f.size() != 2 || !points.contains(point) || cut.contains(f[0])) continue;
      Row &a = low.at(f[0] / 4), &b = low.at(f[1] / 4);
      changed = changed || a != b;
      a = b = std::min(a, b);
    }
  }
  return low;
}

/// The result of open_crack. Points of `mesh` are followed from tetrahedron to tetrahedron.
struct Expected {
  FileMesh mesh;
  std::vector<std::array<Row, 2>> copies;
};

template <std::size_t N>
void follow(CellList<N>& cells, const FileMesh& before, const FileMesh& after) {
  for (auto& corners : cells.corners) {
    for (std::size_t t = 0; t < before.tetrahedra.corners.size(); ++t) {
      const auto& old = before.tetrahedra.corners[t];
      const auto has = [&](Row p) { return std::ranges::find(old, p) != old.end(); };
      if (!std::ranges::all_of(corners, has)) continue;
      for (Row& p : corners) {
        p = after.tetrahedra
                .corners[t][static_cast<std::size_t>(std::ranges::find(old, p) - old.begin())];
      }
      break;
    }
  }
}

template <class Value>
void append(std::vector<Value>& column, const std::vector<std::array<Row, 2>>& copies,
            std::size_t components = 1) {
  if (column.empty()) return;
  for (const auto& [point, copy] : copies) {
    for (std::size_t k = 0; k < components; ++k) {
      const Value value = column[point * components + k];
      column.push_back(value);
    }
  }
}

Expected expected_crack(const FileMesh& before, const CutFaces& faces) {
  Expected e{before, {}};
  const auto sides = sides_of(before);
  const std::set<Row> cut(faces.begin(), faces.end());
  std::set<Row> points;
  for (const Row f : faces) points.merge(face_points(before, f));
  for (const Row point : points) {
    const auto whole = parts_at(before, sides, point, {}),
               parted = parts_at(before, sides, point, cut);
    std::map<Row, Row> row;
    for (const auto& [t, low] : parted) {
      if (low == t && whole.at(t) != t) {
        row[t] = static_cast<Row>(before.points.size() + e.copies.size());
        e.copies.push_back({point, row[t]});
      }
      if (row.contains(low)) std::ranges::replace(e.mesh.tetrahedra.corners[t], point, row[low]);
    }
  }
  append(e.mesh.points, e.copies), append(e.mesh.point_region, e.copies);
  append(e.mesh.source_point_id, e.copies);
  for (DataColumn& c : e.mesh.point_data) {
    std::visit([&](auto& values) { append(values, e.copies, c.components); }, c.values);
  }
  follow(e.mesh.vertices, before, e.mesh);
  follow(e.mesh.edges, before, e.mesh);
  follow(e.mesh.triangles, before, e.mesh);
  return e;
}

void hold_crack(const FileMesh& before, const FaceLinks& links, const CutFaces& faces,
                std::size_t& opened) {
  FileMesh mesh = before;
  const Crack crack = open_crack(mesh, links, faces);
  const Expected expected = expected_crack(before, faces);
  CHECK(mesh == expected.mesh);
  CHECK(crack.copies == expected.copies);
  std::size_t closed = 0, on_it = 0;
  std::set<std::set<Row>> cut;
  REQUIRE(crack.faces.size() == faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    cut.insert(face_points(before, faces[i]));
    const Row across = links.across[faces[i] / 4][faces[i] % 4] / 4;
    CHECK(crack.faces[i].tetrahedra == std::array<Row, 2>{faces[i] / 4, across});
    std::set<Row> seen;
    for (std::size_t k = 0; k < 3; ++k) {
      // Both stand where the tetrahedra had the same point.
      std::array<Row, 2> old{};
      for (std::size_t side = 0; side < 2; ++side) {
        const Row t = crack.faces[i].tetrahedra[side];
        const auto& now = mesh.tetrahedra.corners[t];
        const auto place = std::ranges::find(now, crack.faces[i].points[side][k]) - now.begin();
        REQUIRE(place < 4);
        old[side] = before.tetrahedra.corners[t][static_cast<std::size_t>(place)];
      }
      CHECK(old[0] == old[1]);
      seen.insert(old[0]);
    }
    CHECK(seen == face_points(before, faces[i]));
    closed += crack.faces[i].points[0] == crack.faces[i].points[1];
  }
  for (const Triangle& t : before.triangles.corners) on_it += cut.contains({t.begin(), t.end()});
  CHECK(crack.closed_faces == closed);
  CHECK(crack.triangles_on_it == on_it);
  opened += crack.copies.size();
}

}  // namespace

TEST_CASE("cracks in careless files cut the faces and part the points that sets say",
          "[topology][crack]") {
  std::size_t opened = 0, overfull = 0, regions = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const std::optional<FileMesh> mesh = proper(random);
    if (!mesh) continue;
    const auto sides = sides_of(*mesh);
    const auto links = face_links(*mesh);
    const auto bad = std::ranges::find_if(sides, [](const auto& s) { return s.second.size() > 2; });
    REQUIRE(static_cast<bool>(links) == (bad == sides.end()));
    if (!links) {
      ++overfull;
      const Finding& told = links.findings[0];
      CHECK(told.code == "overfull_face");
      const auto& [points, f] = *bad;
      CHECK(told.ids == std::vector<std::int64_t>{f[0] / 4, f[1] / 4, f[2] / 4});
      const std::vector<Row> p(points.begin(), points.end());
      CHECK(told.text ==
            fmt::format("more than two tetrahedra share the face on points {}, {}, {}: "
                        "a crack has two sides",
                        p[0], p[1], p[2]));
      continue;
    }
    for (Row f = 0; f < 4 * mesh->tetrahedra.corners.size(); ++f) {
      const auto& on = sides.at(face_points(*mesh, f));
      CHECK(links->across[f / 4][f % 4] ==
            (on.size() == 2 ? (on[0] == f ? on[1] : on[0]) : FaceLinks::none));
    }
    const CutFaces all = chosen(*mesh, [](auto&&...) { return true; });
    // Faces by their points, in any order, some twice, at last one that is not there.
    std::vector<Triangle> listed;
    std::set<std::set<Row>> wanted;
    for (std::size_t i = 1 + below(random, 12); i > 0 && !all.empty(); --i) {
      const std::set<Row> points = face_points(*mesh, all[below(random, all.size())]);
      wanted.insert(points);
      Triangle t{};
      std::ranges::copy(points, t.begin());
      std::ranges::shuffle(t, random);
      listed.push_back(t);
    }
    hold_choice(
        listed_faces(*mesh, *links, listed),
        chosen(*mesh, [&](const auto& points, Row, Row) { return wanted.contains(points); }));
    const auto at = static_cast<std::ptrdiff_t>(below(random, listed.size() + 1));
    for (const auto& [points, f] : sides) {
      if (f.size() != 1) continue;
      Triangle t{};
      std::ranges::copy(points, t.begin());
      listed.insert(listed.begin() + at, {t[1], t[0], t[2]});
      const auto missing = listed_faces(*mesh, *links, listed);
      REQUIRE_FALSE(missing);
      CHECK(missing.findings[0].code == "not_interior");
      CHECK(missing.findings[0].count == 1);
      CHECK(missing.findings[0].ids == std::vector<std::int64_t>{at});
      CHECK(
          missing.findings[0].text ==
          fmt::format("on points {}, {}, {} there is no face of two tetrahedra", t[1], t[0], t[2]));
      break;
    }
    const Point n = {2 * unit(random) - 1, 2 * unit(random) - 1, 2 * unit(random) - 1};
    const double offset = unit(random);
    const auto is_above = [&](Row t) {
      double sum = 0;
      for (const Row p : mesh->tetrahedra.corners[t]) {
        for (std::size_t k = 0; k < 3; ++k) sum += n[k] * mesh->points[p][k] / 4;
      }
      return sum > offset;
    };
    const CutFaces section =
        chosen(*mesh, [&](const auto&, Row a, Row b) { return is_above(a) != is_above(b); });
    hold_choice(section_faces(*mesh, *links, {n, offset}), section);
    const auto& label = label_of(mesh->tetrahedra);
    const auto has = [&](int r) { return std::ranges::find(label, r) != label.end(); };
    if (has(0) && has(1)) {
      ++regions;
      hold_choice(
          interface_faces(*mesh, *links, {"one", "0"}),
          chosen(*mesh, [&](const auto&, Row a, Row b) { return label[a] + label[b] == 1; }));
    }
    CutFaces some = all;
    std::erase_if(some, [&](Row) { return below(random, 3) == 0; });
    for (const CutFaces& faces : {section, some, all}) hold_crack(*mesh, *links, faces, opened);
  }
  CHECK(opened > 1000);
  CHECK(overfull >= 3);
  CHECK(regions > 10);
}

TEST_CASE("regions are called by number or name, and those there are are told",
          "[topology][crack]") {
  FileMesh mesh = file_mesh_of(suite::kuhn_box({1, 1, 3}));
  for (std::int32_t i = 0; i < 18; ++i) mesh.tetrahedra.region.push_back(-i % 13);
  mesh.region_name[3] = {{-3, "three"}, {-4, "-5"}, {99, "nowhere"}};
  mesh.region_name[2] = {{-1, "a surface"}};
  CHECK(*region_called(mesh, "-7") == -7);
  CHECK(*region_called(mesh, "0") == 0);
  CHECK(*region_called(mesh, std::string_view("-78").substr(0, 2)) == -7);
  CHECK(*region_called(mesh, "three") == -3);
  CHECK(*region_called(mesh, "-5") == -4);  // a name goes before a number
  for (const char* word : {"99", "nowhere", "1", "-7x", "x-7", "", "99999999999", "a surface"}) {
    INFO(word);
    const auto result = region_called(mesh, word);
    REQUIRE_FALSE(result);
    CHECK(result.findings[0].code == "unknown_region");
    CHECK(result.findings[0].text == fmt::format("no tetrahedron is in a region '{}'", word));
    CHECK(result.findings[0].remedy ==
          "the regions are -12, -11, -10, -9, -8, -7, -6, -5, -4 (-5), -3 (three), -2, -1, ...");
  }
  for (auto& r : mesh.tetrahedra.region) r = r == -12 ? 0 : r;
  CHECK(region_called(mesh, "1").findings[0].remedy ==
        "the regions are -11, -10, -9, -8, -7, -6, -5, -4 (-5), -3 (three), -2, -1, 0");
  for (auto& r : mesh.tetrahedra.region) r %= 2;
  CHECK(region_called(mesh, "1").findings[0].remedy == "the regions are -1, 0");
  mesh.tetrahedra.region = {};
  CHECK(region_called(mesh, "1").findings[0].remedy ==
        "the tetrahedra have no regions: choose otherwise");
}

TEST_CASE("of many faces that are not there the first few are listed, all are counted",
          "[topology][crack]") {
  const FileMesh mesh = file_mesh_of(suite::two_tetrahedra());
  std::vector<Triangle> listed(Finding::max_ids + 7, Triangle{0, 1, 3});
  const auto result = listed_faces(mesh, *face_links(mesh), listed);
  CHECK(result.findings[0].count == Finding::max_ids + 7);
  CHECK(result.findings[0].ids.size() == Finding::max_ids);
  CHECK(result.findings[0].ids.back() == Finding::max_ids - 1);
}
