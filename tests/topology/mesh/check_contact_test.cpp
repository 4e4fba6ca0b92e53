// SPDX-License-Identifier: MIT
// Vertices that hang, points that miss each other, faces in one place: planted ones, and every pair
// compared with every other.
#include <cmath>
#include <map>
#include <set>

#include "tests/support/built.hpp"
#include "topology/kernel/map_mesh.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

using Findings = std::vector<Finding>;

Findings findings_of(const TetMesh& mesh) { return check_file_mesh(file_mesh_of(mesh)).findings; }

std::size_t count_of(const Findings& findings, const std::string& code) {
  for (const Finding& f : findings) {
    if (f.code == code) return f.count;
  }
  return 0;
}

/// A box next to another one of half its cells' size: 4 coarse squares meet 16 fine ones.
TetMesh coarse_beside_fine() {
  TetMesh fine = kuhn_box({4, 4, 4}, 0.5);
  for (Point& p : fine.points) p[0] += 2;
  TetMesh both = kuhn_box({2, 2, 2});
  const auto first = static_cast<std::uint32_t>(both.points.size());
  both.points.insert(both.points.end(), fine.points.begin(), fine.points.end());
  for (auto t : fine.tetrahedra) {
    for (auto& p : t) p += first;
    both.tetrahedra.push_back(t);
  }
  return both;
}

/// The points of `mesh` with x beyond `at` get copies for the tetrahedra beyond it, moved by `gap`.
TetMesh cut_at(TetMesh mesh, double at, double gap) {
  std::map<std::uint32_t, std::uint32_t> copy;
  for (auto& t : mesh.tetrahedra) {
    double centre = 0;
    for (const auto p : t) centre += mesh.points[p][0] / 4;
    if (centre < at) continue;
    for (auto& p : t) {
      if (mesh.points[p][0] != at) continue;
      const auto [known, is_new] =
          copy.try_emplace(p, static_cast<std::uint32_t>(mesh.points.size()));
      if (is_new) mesh.points.push_back({at + gap, mesh.points[p][1], mesh.points[p][2]});
      p = known->second;
    }
  }
  return mesh;
}

/// Turned about an oblique axis by a random angle, moved, scaled.
TetMesh moved(TetMesh mesh, double scale, std::mt19937_64& random) {
  const double a = 6 * unit(random), b = 6 * unit(random);
  const Point shift = {unit(random), unit(random), unit(random)};
  for (Point& p : mesh.points) {
    const Point q = {std::cos(a) * p[0] - std::sin(a) * p[1],
                     std::sin(a) * p[0] + std::cos(a) * p[1], p[2]};
    p = {q[0], std::cos(b) * q[1] - std::sin(b) * q[2], std::sin(b) * q[1] + std::cos(b) * q[2]};
    for (int k = 0; k < 3; ++k) p[k] = scale * (p[k] + shift[k]);
  }
  return mesh;
}

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double distance(const Point& a, const Point& b) { return std::sqrt(dot(minus(a, b), minus(a, b))); }

using Triangle = std::array<std::uint32_t, 3>;

/// The expected findings of a check, by comparing every boundary face with every boundary point.
struct Twin {
  std::set<std::uint32_t> hanging, close;
  std::set<Triangle> hung_in;
  std::vector<Triangle> coincident;
};

struct TwinFace {
  std::array<std::uint32_t, 3> points;
  std::array<std::uint32_t, 4> tetrahedron;
};

std::vector<TwinFace> boundary_of(const TetMesh& mesh) {
  std::map<std::array<std::uint32_t, 3>, std::vector<TwinFace>> faces;
  for (const auto& t : mesh.tetrahedra) {
    for (int p = 0; p < 4; ++p) {
      std::array<std::uint32_t, 3> face = {t[(p + 1) % 4], t[(p + 2) % 4], t[(p + 3) % 4]};
      std::sort(face.begin(), face.end());
      faces[face].push_back({face, t});
    }
  }
  std::vector<TwinFace> boundary;
  for (const auto& [points, of] : faces) {
    if (of.size() == 1) boundary.push_back(of.front());
  }
  return boundary;
}

/// Whether x lies on the segment between a and b, its ends left out.
bool is_on_segment(const Point& x, const Point& a, const Point& b) {
  const double l = distance(a, b), s = dot(minus(x, a), minus(b, a)) / (l * l);
  const Point foot = {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])};
  return s > 0 && s < 1 && distance(x, foot) <= contact_tolerance * l;
}

/// Whether x lies in the triangle: by its weights, from the normal equations.
bool is_in_triangle(const Point& x, const std::array<Point, 3>& c) {
  const Point u = minus(c[1], c[0]), v = minus(c[2], c[0]), w = minus(x, c[0]);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), d = uu * vv - uv * uv;
  const double s = (dot(w, u) * vv - dot(w, v) * uv) / d, t = (dot(w, v) * uu - dot(w, u) * uv) / d;
  Point foot = c[0];
  for (int k = 0; k < 3; ++k) foot[k] += s * u[k] + t * v[k];
  const double longest =
      std::max({distance(c[0], c[1]), distance(c[1], c[2]), distance(c[2], c[0])});
  return s > 0 && t > 0 && s + t < 1 && distance(x, foot) <= contact_tolerance * longest;
}

Twin twin_of(const TetMesh& mesh) {
  Twin twin;
  const auto boundary = boundary_of(mesh);
  std::set<std::uint32_t> points;
  for (const TwinFace& f : boundary) points.insert(f.tetrahedron.begin(), f.tetrahedron.end());
  std::map<std::uint32_t, std::uint32_t> near;  // to a lower point, in the order of coordinates
  const auto rank = [&](std::uint32_t p) { return std::pair{mesh.points[p], p}; };
  for (const std::uint32_t p : points) {
    near[p] = p;
    for (const std::uint32_t q : points) {
      if (mesh.points[q] == mesh.points[p] && q < near[p]) near[p] = q;
    }
  }
  for (const TwinFace& f : boundary) {
    std::array<Point, 3> c;
    for (int k = 0; k < 3; ++k) c[k] = mesh.points[f.points[k]];
    const double shortest =
        std::min({distance(c[0], c[1]), distance(c[1], c[2]), distance(c[2], c[0])});
    for (const std::uint32_t p : points) {
      const Point& x = mesh.points[p];
      bool has_it = false, is_near = false;
      for (const std::uint32_t q : f.tetrahedron) has_it = has_it || mesh.points[q] == x;
      if (has_it) continue;
      for (int k = 0; k < 3; ++k) {
        if (distance(x, c[k]) > contact_tolerance * shortest) continue;
        is_near = true;
        const bool is_later = rank(f.points[k]) < rank(p);
        const std::uint32_t later = is_later ? p : f.points[k];
        twin.close.insert(later);
        near[later] = near[is_later ? f.points[k] : p];
      }
      if (is_near) continue;
      if (is_on_segment(x, c[0], c[1]) || is_on_segment(x, c[1], c[2]) ||
          is_on_segment(x, c[2], c[0]) || is_in_triangle(x, c)) {
        twin.hanging.insert(p);
        twin.hung_in.insert(f.points);
      }
    }
  }
  // Faces in one place and with different points: all but the one with the lowest.
  std::set<Triangle> places;
  for (const TwinFace& f : boundary) {
    Triangle place = {near[f.points[0]], near[f.points[1]], near[f.points[2]]};
    std::sort(place.begin(), place.end());
    if (!places.insert(place).second) twin.coincident.push_back(f.points);
  }
  return twin;
}

/// Triples of rows, each rising.
std::vector<Triangle> triangles_of(std::vector<std::uint32_t> rows) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i + 2 < rows.size(); i += 3) {
    triangles.push_back({rows[i], rows[i + 1], rows[i + 2]});
    std::sort(triangles.back().begin(), triangles.back().end());
  }
  return triangles;
}

void hold_against_twin(const TetMesh& mesh) {
  const MeshCheck check = check_file_mesh(file_mesh_of(mesh), true);
  const Twin twin = twin_of(mesh);
  const auto rows_of = [&](const std::string& code, PlaceKind kind) {
    for (const FindingPlaces& p : check.places) {
      if (p.code == code && p.kind == kind) return p.rows;
    }
    return std::vector<std::uint32_t>{};
  };
  const auto rows = [](const auto& set) {
    return std::vector<std::uint32_t>(set.begin(), set.end());
  };
  REQUIRE(rows_of("hanging_vertex", PlaceKind::points) == rows(twin.hanging));
  REQUIRE(rows_of("close_points", PlaceKind::points) == rows(twin.close));
  REQUIRE(triangles_of(rows_of("coincident_faces", PlaceKind::faces)) == twin.coincident);
  std::vector<Triangle> hung_in = triangles_of(rows_of("hanging_vertex", PlaceKind::faces));
  std::sort(hung_in.begin(), hung_in.end());
  REQUIRE(hung_in == std::vector<Triangle>(twin.hung_in.begin(), twin.hung_in.end()));
  REQUIRE(count_of(check.findings, "hanging_vertex") == twin.hanging.size());
  REQUIRE(count_of(check.findings, "contact_unfinished") == 0);
}

}  // namespace

TEST_CASE("a body glued whole has no finding about contact", "[topology][check][contact]") {
  CHECK(findings_of(kuhn_box({5, 4, 3})).empty());
  CHECK(findings_of(jittered(kuhn_box({5, 5, 5}), 0.1, 3)).empty());
  CHECK(findings_of(ring({3, 3, 1})).empty());
  CHECK(findings_of(one_tetrahedron()).empty());
  CHECK(findings_of(two_tetrahedra()).empty());
}

TEST_CASE("a fine grid against a coarse one hangs in the middles of its edges and squares",
          "[topology][check][contact]") {
  const Findings findings = findings_of(coarse_beside_fine());
  const Finding f = finding(findings, "hanging_vertex");
  CHECK(f.severity == Severity::warning);
  CHECK(f.count == 25 - 9);
  CHECK(count_of(findings, "coincident_points") == 9);
  CHECK(count_of(findings, "coincident_faces") == 0);
  for (const std::int64_t p : f.ids) {
    CHECK(coarse_beside_fine().points[static_cast<std::size_t>(p)][0] == 2);
  }
}

TEST_CASE("a vertex in the middle of an edge hangs, at its end it does not",
          "[topology][check][contact]") {
  TetMesh mesh = one_tetrahedron();
  const auto beside = [&](const Point& tip) {
    TetMesh both = mesh;
    both.points.insert(both.points.end(), {tip, {5, 5, 5}, {5, 6, 5}, {6, 5, 5}});
    both.tetrahedra.push_back({4, 5, 6, 7});
    return findings_of(both);
  };
  const Point &a = mesh.points[0], &b = mesh.points[1];
  const auto between = [&](double s) {
    return Point{a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])};
  };
  CHECK(finding(beside(between(0.5)), "hanging_vertex").ids == std::vector<std::int64_t>{4});
  CHECK(count_of(beside(between(1e-3)), "hanging_vertex") == 1);
  CHECK(count_of(beside(between(1e-8)), "hanging_vertex") == 0);
  CHECK(count_of(beside(between(1e-8)), "close_points") == 1);
  CHECK(count_of(beside(between(0)), "close_points") == 0);
  CHECK(count_of(beside(between(0)), "hanging_vertex") == 0);
  CHECK(count_of(beside(between(0)), "coincident_points") == 1);
  CHECK(count_of(beside(between(-1e-3)), "hanging_vertex") == 0);
}

TEST_CASE("a seam is told as faces in one place, with a rounding between as close points too",
          "[topology][check][contact]") {
  const TetMesh whole = kuhn_box({4, 3, 2});
  const Findings seam = findings_of(cut_at(whole, 2, 0));
  CHECK(finding(seam, "coincident_faces").count == 12);
  CHECK(finding(seam, "coincident_faces").ids.size() == 15);  // whole triples
  CHECK(finding(seam, "coincident_points").count == 12);
  CHECK(seam.size() == 2);
  const Findings rounded = findings_of(cut_at(whole, 2, 1e-9));
  CHECK(finding(rounded, "coincident_faces").count == 12);
  CHECK(finding(rounded, "close_points").count == 12);
  CHECK(rounded.size() == 2);
  CHECK(findings_of(cut_at(whole, 2, 1e-3)).empty());
}

TEST_CASE("contact is what every pair says, on random boxes side by side",
          "[topology][check][contact]") {
  const std::uint64_t seed = 61;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int trial = 0; trial < 60; ++trial) {
    INFO("trial " << trial);
    const auto size = [&random] { return 1 + static_cast<int>(below(random, 3)); };
    TetMesh mesh = kuhn_box({size(), size(), size()});
    TetMesh other = kuhn_box({size(), size(), size()}, below(random, 2) == 0 ? 1 : 0.75);
    const double x = std::max_element(mesh.points.begin(), mesh.points.end())->at(0);
    const double gap = below(random, 3) == 0 ? 1e-8 : 0;
    for (Point& p : other.points) p[0] += x + gap;
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    for (auto t : other.tetrahedra) {
      for (auto& p : t) p += first;
      mesh.tetrahedra.push_back(t);
    }
    hold_against_twin(shuffled(moved(mesh, 1, random), trial + 1));
  }
}

TEST_CASE("contact is what every pair says, on bodies cut along random faces",
          "[topology][check][contact]") {
  const std::uint64_t seed = 62;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int trial = 0; trial < 20; ++trial) {
    INFO("trial " << trial);
    const TetMesh mesh = jittered(kuhn_box({2, 2, 2}), 0.1, trial + 1);
    VolumeMap map = built(mesh);
    std::vector<HalfFaceId> faces = interior_faces(map);
    const std::size_t cuts = trial == 0 ? faces.size() : below(random, faces.size());
    for (std::size_t i = 0; i < cuts; ++i) {
      std::swap(faces[below(random, faces.size())], faces.back());
      split_face(map, faces.back());
      faces.pop_back();
    }
    hold_against_twin(mesh_of_map(map, mesh, MeshPoints::vertices));
  }
}

TEST_CASE("findings stay when a mesh is turned, scaled or renumbered",
          "[topology][check][contact]") {
  const std::uint64_t seed = 63;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  const auto counted = [](const TetMesh& mesh) {
    std::map<std::string, std::size_t> counts;
    for (const Finding& f : findings_of(mesh)) counts[f.code] = f.count;
    return counts;
  };
  TetMesh odd = coarse_beside_fine();
  std::swap(odd.tetrahedra[5][0], odd.tetrahedra[5][1]);
  odd.points.push_back({9, 9, 9});
  for (const TetMesh& mesh : {odd, cut_at(kuhn_box({4, 3, 2}), 2, 1e-9), kuhn_box({3, 3, 3})}) {
    const auto before = counted(mesh);
    for (const double scale : {1e-6, 1.0, 1e6, 1e-100, 1e100}) {
      INFO("scale " << scale);
      CHECK(counted(moved(mesh, scale, random)) == before);
      CHECK(counted(shuffled(moved(mesh, scale, random), 5)) == before);
    }
  }
}

TEST_CASE("a heap of bodies through each other is given up in time, and said so",
          "[topology][check][contact]") {
  std::mt19937_64 random(64);
  TetMesh heap;
  for (std::uint32_t t = 0; t < 5000; ++t) {
    for (int i = 0; i < 4; ++i) heap.points.push_back({unit(random), unit(random), unit(random)});
    heap.tetrahedra.push_back({4 * t, 4 * t + 1, 4 * t + 2, 4 * t + 3});
  }
  const Findings findings = findings_of(heap);
  const Finding f = finding(findings, "contact_unfinished");
  CHECK(f.severity == Severity::warning);
  CHECK(f.count < heap.points.size());
}

TEST_CASE("contact is what every pair says, of a tip a little more or less than the tolerance away",
          "[topology][check][contact]") {
  const std::uint64_t seed = 65;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  const auto number = [&random](double low, double high) {
    return low + (high - low) * unit(random);
  };
  std::array<std::size_t, 3> found{};
  for (int trial = 0; trial < 3000; ++trial) {
    INFO("trial " << trial);
    TetMesh mesh;
    for (int i = 0; i < 4; ++i) {
      // Long and short edges, so that it matters of which the tolerance is taken.
      mesh.points.push_back({number(-4, 4), number(-1, 1), number(-0.3, 0.3)});
    }
    mesh.tetrahedra = {{0, 1, 2, 3}, {4, 5, 6, 7}};
    // A place on the first face: a corner, an edge, the inside; sometimes beyond.
    const Point &a = mesh.points[1], &b = mesh.points[2], &c = mesh.points[3];
    double s = 0, t = 0;
    const std::size_t where = below(random, 4);
    if (where > 0) s = number(-0.3, 1.3);
    if (where > 1) t = number(-0.2, 1);
    const Point edges = {distance(a, b), distance(b, c), distance(c, a)};
    const double scale = edges[below(random, 3)] * contact_tolerance *
                         std::array{0.5, 0.9, 1.1, 2.0}[below(random, 4)];
    Point away = {number(-1, 1), number(-1, 1), number(-1, 1)};
    if (where > 1 && below(random, 2) == 0) {
      const Point u = minus(b, a), v = minus(c, a);
      away = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    }
    const double size = std::sqrt(dot(away, away));
    Point tip{};
    for (int k = 0; k < 3; ++k) {
      tip[k] = a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]) + scale * away[k] / size;
    }
    mesh.points.insert(mesh.points.end(), {tip, {50, 5, 5}, {50, 6, 5}, {60, 5, 5}});
    const TetMesh turned = moved(mesh, 1, random);
    hold_against_twin(turned);
    const Findings findings = findings_of(turned);
    ++found[count_of(findings, "hanging_vertex") > 0 ? 0
            : count_of(findings, "close_points") > 0 ? 1
                                                     : 2];
  }
  for (const std::size_t n : found) CHECK(n > 100);
}

TEST_CASE("far from the origin no gap counts that eight roundings can have made",
          "[topology][check][contact]") {
  const double far = 1 << 30, rounding = std::numeric_limits<double>::epsilon() * far;
  const auto close = [&](double gap) {
    TetMesh mesh;
    for (const double sign : {1.0, -1.0}) {
      mesh.points = {{sign * far, 0, 0},  {sign * (far - 1), 0, 0}, {sign * far, 1, 0},
                     {sign * far, 0, 1},  {sign * far, -gap, 0},    {sign * far, -2, 0},
                     {sign * far, -1, 1}, {sign * (far - 1), -1, 0}};
      mesh.tetrahedra = {{0, 1, 2, 3}, {4, 5, 6, 7}};
      CHECK(count_of(findings_of(mesh), "close_points") == (gap < 8 * rounding ? 1 : 0));
    }
  };
  close(7.9 * rounding);
  close(8.1 * rounding);
}

TEST_CASE("faces of which two corners are near the same point are in no place",
          "[topology][check][contact]") {
  const double far = 1 << 30, rounding = std::numeric_limits<double>::epsilon() * far;
  for (const Point third : {Point{far, 1, 0}, Point{far - 1, 0, 0}}) {
    TetMesh mesh;
    // Two needles, one face of each on the other's; the tip of a third is near both ends of theirs.
    for (const double side : {1.0, -1.0}) {
      mesh.points.insert(mesh.points.end(),
                         {{far, 0, 0}, {far, 10 * rounding, 0}, third, {far, 0, side}});
    }
    mesh.points.insert(mesh.points.end(),
                       {{far, 5 * rounding, 0}, {far, -4, 5}, {far, -5, 5}, {far - 1, -4, 4}});
    mesh.tetrahedra = {{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10, 11}};
    const Findings findings = findings_of(mesh);
    CHECK(count_of(findings, "close_points") == 3);
    // The two long faces of each needle are in one place; the short face of one is not in that of
    // the other, though they have the same corners.
    CHECK(count_of(findings, "coincident_faces") == 2);
  }
}
