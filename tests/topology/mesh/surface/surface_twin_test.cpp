// SPDX-License-Identifier: MIT
// All findings about surfaces, careless ones too, compared with sets, maps and whole numbers.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "tests/support/careless_surface.hpp"
#include "tests/support/cell_rows.hpp"
#include "tests/support/crossing_twin.hpp"
#include "topology/mesh/surface/surface_check.hpp"

using namespace sunder;
using namespace sunder::test;
using suite::below;

namespace {

using Random = std::mt19937_64;
using Ends = std::set<std::uint32_t>;

/// Labels joined where asked; every set is named by its lowest.
struct Sets {
  explicit Sets(std::size_t n) : low(n) { std::iota(low.begin(), low.end(), 0U); }
  void join(std::size_t a, std::size_t b) {
    const auto from = std::max(low[a], low[b]), to = std::min(low[a], low[b]);
    std::ranges::replace(low, from, to);
  }
  std::size_t count() const { return std::set(low.begin(), low.end()).size(); }
  std::vector<std::uint32_t> low;
};

struct Found {
  Severity severity;
  std::size_t a_place;
  std::vector<std::uint32_t> rows;
};

/// A second implementation of check_surface.
struct Twin {
  explicit Twin(const FileMesh& given) : x(given.points) {
    std::map<Point, std::uint32_t> lowest;
    for (std::uint32_t p = 0; p < x.size(); ++p) {
      place.push_back(lowest.emplace(x[p], p).first->second);
      if (place.back() != p) add("coincident_points", Severity::note, {p});
    }
    // Triangles, quadrilaterals, polygons; of each first those of first order.
    for (const CellKind linear : {CellKind::triangle, CellKind::quad4, CellKind::polygon}) {
      for (const CellKind kind : all_cell_kinds) {
        if (linear_kind(kind) != linear) continue;
        for (Rows face : cells_of(given, kind)) {
          if (linear != CellKind::polygon) face.resize(traits_of(linear).corners);
          for (auto& p : face) p = place[p];
          faces.push_back(face);
        }
      }
    }
    find_edges();
    find_vertices();
    find_copies();
    measure();
  }

  const std::vector<Point>& x;
  Rows place;
  std::vector<Rows> faces;
  std::map<std::string, Found> found;
  std::size_t edges = 0, components = 0, vertices = 0;
  std::vector<long double> areas;
  long double area = 0, volume = 0;
  std::array<long double, 3> by_area{}, by_volume{};
  std::vector<std::pair<Corners, std::uint32_t>> triangles;

  void add(const std::string& code, Severity severity, const Rows& rows) {
    Found& f = found.try_emplace(code, Found{severity, rows.size(), {}}).first->second;
    f.rows.insert(f.rows.end(), rows.begin(), rows.end());
  }
  bool has(const std::string& code) const { return found.contains(code); }

  void find_edges() {
    std::map<Ends, std::vector<std::pair<std::uint32_t, bool>>> sides;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      for (std::size_t k = 0; k < faces[f].size(); ++k) {
        const auto a = faces[f][k], b = faces[f][(k + 1) % faces[f].size()];
        if (a != b) sides[{a, b}].emplace_back(f, a < b);
      }
    }
    Sets parts(faces.size());
    for (const auto& [ends, list] : sides) {
      const Rows both(ends.begin(), ends.end());
      for (const auto& side : list) parts.join(side.first, list[0].first);
      if (list.size() == 1) add("open_edge", Severity::warning, both);
      if (list.size() > 2) add("nonmanifold_edge", Severity::warning, both);
      if (list.size() == 2 && list[0].second == list[1].second) {
        add("inconsistent_orientation", Severity::warning, both);
      }
    }
    edges = sides.size();
    components = parts.count();
  }

  /// Corners of faces at a place hang together where their neighbours are the same.
  void find_vertices() {
    std::map<std::uint32_t, std::vector<Ends>> around;
    for (const Rows& face : faces) {
      const std::size_t n = face.size();
      for (std::size_t k = 0; k < n; ++k)
        around[face[k]].push_back({face[(k + 1) % n], face[(k + n - 1) % n]});
    }
    for (const auto& [at, corners] : around) {
      Sets parts(corners.size());
      for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          if (std::ranges::any_of(corners[i], [&](auto p) { return corners[j].contains(p); }))
            parts.join(i, j);
        }
      }
      if (parts.count() > 1) add("nonmanifold_vertex", Severity::note, {at});
    }
    vertices = around.size();
  }

  void find_copies() {
    std::set<Rows> known;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      Rows sorted = faces[f];
      std::ranges::sort(sorted);
      if (!known.insert(sorted).second) add("duplicate_face", Severity::warning, {f});
    }
  }

  /// The least corner first, or the next one from which no triangle is a line.
  std::vector<Corners> fan_of(Rows face) const {
    std::vector<std::vector<Corners>> fans;
    std::ranges::rotate(face, std::ranges::min_element(face));
    for (std::size_t start = 0; start < face.size(); ++start) {
      auto& fan = fans.emplace_back();
      for (std::size_t k = 2; k < face.size(); ++k) fan.push_back({face[0], face[k - 1], face[k]});
      std::ranges::rotate(face, face.begin() + 1);
    }
    for (const auto& fan : fans) {
      if (std::ranges::all_of(fan, [&](const Corners& t) { return is_no_line(x, t); })) return fan;
    }
    return fans[0];
  }

  void measure() {
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      areas.push_back(0);
      for (const Corners& t : fan_of(faces[f])) {
        if (!is_no_line(x, t)) continue;
        triangles.emplace_back(t, f);
        const Whole a = whole(x[t[0]]), b = whole(x[t[1]]), c = whole(x[t[2]]);
        const Whole n = normal_of({a, b, c});
        const long double size = std::sqrt(static_cast<long double>(product(n, n))) / 2;
        const long double part = static_cast<long double>(product(a, crossed(b, c))) / 6;
        areas[f] += size;
        area += size;
        volume += part;
        for (std::size_t k = 0; k < 3; ++k) {
          by_area[k] += size * static_cast<long double>(a[k] + b[k] + c[k]) / 3;
          by_volume[k] += part * static_cast<long double>(a[k] + b[k] + c[k]) / 4;
        }
      }
      if (areas[f] == 0) add("flat_face", Severity::warning, {f});
    }
    std::set<std::array<std::uint32_t, 2>> crossing;
    for (const auto& [t, f] : triangles) {
      for (const auto& [u, g] : triangles) {
        if (f < g && twins_cross(x, t, u)) crossing.insert({f, g});
      }
    }
    for (const auto& pair : crossing) add("self_intersection", Severity::error, {pair[0], pair[1]});
  }
};

}  // namespace

TEST_CASE("careless surfaces are judged as a twin of sets and whole numbers judges them",
          "[mesh][surface_check]") {
  Random random(20261125);
  std::map<std::string, int> seen;
  for (int round = 0; round < 120; ++round) {
    INFO("round " << round);
    const FileMesh mesh = careless_surface(random);
    const Twin twin(mesh);
    const SurfaceCheck check = check_surface(mesh);
    const bool is_closed = !twin.has("open_edge") && !twin.has("nonmanifold_edge");
    const bool is_oriented = !twin.has("inconsistent_orientation");
    std::size_t told = 0;
    Severity last = Severity::error;
    for (const Finding& f : check.findings) {
      INFO(f.code);
      CHECK(f.severity <= last);
      last = f.severity;
      ++seen[f.code];
      CHECK_FALSE(f.remedy.empty());
      if (f.code == "inside_out") {
        CHECK((is_closed && is_oriented && twin.volume < 0));
        CHECK(f.severity == Severity::warning);
        continue;
      }
      ++told;
      REQUIRE(twin.has(f.code));
      const Found& same = twin.found.at(f.code);
      CHECK(f.severity == same.severity);
      CHECK(f.count == same.rows.size() / same.a_place);
      CHECK(f.text.starts_with(std::to_string(f.count) + " "));
      const std::size_t shown = std::min(f.count, Finding::max_ids / same.a_place) * same.a_place;
      CHECK(f.ids ==
            std::vector<std::int64_t>(same.rows.begin(),
                                      same.rows.begin() + static_cast<std::ptrdiff_t>(shown)));
    }
    CHECK(told == twin.found.size());
    const auto is_inside_out = [](const Finding& f) { return f.code == "inside_out"; };
    CHECK(std::ranges::any_of(check.findings, is_inside_out) ==
          (is_closed && is_oriented && twin.volume < 0));
    CHECK(check.is_closed == is_closed);
    CHECK(check.is_oriented == is_oriented);
    CHECK(check.is_manifold == (!twin.has("nonmanifold_edge") && !twin.has("nonmanifold_vertex")));
    CHECK(check.crosses_itself == twin.has("self_intersection"));
    CHECK((check.vertices == twin.vertices && check.edges == twin.edges));
    CHECK(check.components == twin.components);
    CHECK(check.triangles + check.quadrilaterals + check.polygons == twin.faces.size());
    CHECK(check.polygons == rows_of(mesh, CellKind::polygon).count);
    CHECK(check.triangles == rows_of(mesh, CellKind::triangle).count +
                                 rows_of(mesh, CellKind::triangle6).count +
                                 rows_of(mesh, CellKind::triangle7).count);
    CHECK(check.boundary_edges ==
          (twin.has("open_edge") ? twin.found.at("open_edge").rows.size() / 2 : 0));
    CHECK(check.euler_characteristic ==
          static_cast<std::ptrdiff_t>(twin.vertices + twin.faces.size()) -
              static_cast<std::ptrdiff_t>(twin.edges));
    CHECK(check.area == Approx(static_cast<double>(twin.area)).epsilon(1e-13));
    REQUIRE(check.volume.has_value() == (is_closed && is_oriented));
    if (check.volume)
      CHECK(*check.volume == Approx(static_cast<double>(twin.volume)).epsilon(1e-12).margin(1e-11));
    for (std::size_t k = 0; k < 3; ++k) {
      double low = 1e300, high = -1e300;
      for (const Rows& face : twin.faces) {
        for (const auto p : face)
          low = std::min(low, mesh.points[p][k]), high = std::max(high, mesh.points[p][k]);
      }
      CHECK((check.extent.box.low[k] == low && check.extent.box.high[k] == high));
      const long double middle = (low + high) / 2;
      const long double centre = check.volume && twin.volume != 0 ? twin.by_volume[k] / twin.volume
                                 : twin.area > 0                  ? twin.by_area[k] / twin.area
                                                                  : middle;
      CHECK(check.extent.centre[k] ==
            Approx(static_cast<double>(centre)).epsilon(1e-11).margin(1e-11));
    }
  }
  for (const char* code :
       {"self_intersection", "duplicate_face", "flat_face", "nonmanifold_edge", "open_edge",
        "inconsistent_orientation", "inside_out", "nonmanifold_vertex", "coincident_points"}) {
    INFO(code);
    CHECK(seen[code] > 2);
  }
}

TEST_CASE("box and centre of tetrahedra are those of their volume, however they are turned",
          "[mesh][surface_check]") {
  Random random(9);
  CHECK_FALSE(extent_of_tetrahedra({}));
  for (int round = 0; round < 200; ++round) {
    FileMesh mesh;
    for (int i = 0; i < 12; ++i) {
      mesh.points.push_back(
          {1.0 * below(random, 9) - 4, 1.0 * below(random, 9), 1.0 * below(random, 9) - 30});
    }
    for (std::size_t i = 1 + below(random, 4); i > 0; --i) {
      const auto any = [&] { return static_cast<std::uint32_t>(below(random, 12)); };
      mesh.tetrahedra.corners.push_back({any(), any(), any(), any()});
    }
    std::int64_t volume = 0;
    Whole moment{}, low{100, 100, 100}, high{-100, -100, -100};
    for (const auto& t : mesh.tetrahedra.corners) {
      std::array<Whole, 4> p;
      for (std::size_t i = 0; i < 4; ++i) p[i] = whole(mesh.points[t[i]]);
      const std::int64_t part =
          std::abs(product(minus(p[1], p[0]), crossed(minus(p[2], p[0]), minus(p[3], p[0]))));
      volume += part;
      for (std::size_t k = 0; k < 3; ++k) {
        moment[k] += part * (p[0][k] + p[1][k] + p[2][k] + p[3][k]);
        for (const Whole& q : p) low[k] = std::min(low[k], q[k]), high[k] = std::max(high[k], q[k]);
      }
    }
    const std::optional<Extent> extent = extent_of_tetrahedra(mesh);
    REQUIRE(extent.has_value() == (volume > 0));
    for (std::size_t k = 0; k < 3 && extent; ++k) {
      CHECK(extent->box.low[k] == static_cast<double>(low[k]));
      CHECK(extent->box.high[k] == static_cast<double>(high[k]));
      CHECK(extent->centre[k] ==
            Approx(static_cast<double>(moment[k]) / (4.0 * static_cast<double>(volume)))
                .margin(1e-11));
    }
  }
}

TEST_CASE("where the search for crossings does not end, nothing is said of them",
          "[mesh][surface_check]") {
  FileMesh mesh, crossed;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const double at = i * 0x1p-20;
    mesh.points.insert(mesh.points.end(), {{1 + at, at, at}, {at, 1 + at, at}, {at, at, 1 + at}});
    append_cell(mesh, CellKind::triangle, Rows{3 * i, 3 * i + 1, 3 * i + 2});
  }
  const auto told = [](const SurfaceCheck& check, const char* code) {
    return std::ranges::count(check.findings, code, &Finding::code);
  };
  const SurfaceCheck apart = check_surface(mesh);
  CHECK_FALSE(apart.crosses_itself.has_value());
  CHECK(told(apart, "crossings_unfinished") == 1);
  CHECK(told(apart, "self_intersection") == 0);
  // One pair is enough to know: from an edge of the first through the second to the third.
  crossed.points = mesh.points;
  append_cell(crossed, CellKind::triangle, Rows{0, 1, 8});
  for (const auto& corners : mesh.triangles.corners) {
    append_cell(crossed, CellKind::triangle, corners);
  }
  const SurfaceCheck check = check_surface(crossed);
  CHECK(check.crosses_itself == true);
  CHECK(told(check, "crossings_unfinished") == 1);
  CHECK(told(check, "self_intersection") == 1);
}
