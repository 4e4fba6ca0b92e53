// SPDX-License-Identifier: MIT
// Cells of every kind cut into simplices, compared with a twin that takes them one by one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "tests/support/cell_rows.hpp"
#include "tests/support/random_kinds.hpp"
#include "topology/mesh/kinds/split_cells.hpp"

using namespace sunder;
using namespace sunder::test;
using suite::below;
using suite::unit;

namespace {

using Random = std::mt19937_64;

long double six_volumes(const FileMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                        std::uint32_t d) {
  long double e[3][3];
  const std::uint32_t corners[] = {b, c, d};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      e[i][k] = static_cast<long double>(mesh.points[corners[i]][k]) - mesh.points[a][k];
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
         e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/// The face turned so that its least corner is first, in triangles from there.
std::vector<Rows> fan_of(Rows face) {
  std::ranges::rotate(face, std::ranges::min_element(face));
  std::vector<Rows> triangles;
  for (std::size_t k = 2; k < face.size(); ++k)
    triangles.push_back({face[0], face[k - 1], face[k]});
  return triangles;
}

Point area_of(const FileMesh& mesh, const Rows& face) {
  long double sum[3] = {};
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Point &a = mesh.points[face[i]], &b = mesh.points[face[(i + 1) % face.size()]];
    for (std::size_t k = 0; k < 3; ++k) {
      sum[k] += static_cast<long double>(a[(k + 1) % 3]) * b[(k + 2) % 3] -
                static_cast<long double>(a[(k + 2) % 3]) * b[(k + 1) % 3];
    }
  }
  return {static_cast<double>(sum[0]), static_cast<double>(sum[1]), static_cast<double>(sum[2])};
}

double product(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A second implementation of split_cells.
SplitCells split(FileMesh& mesh) {
  SplitCells report;
  bool any = false;
  for (const CellKind kind : all_cell_kinds) any = any || !columns_of(mesh, kind).source_id.empty();
  std::int64_t last = 0, place = 0;
  for (const CellKind kind : all_cell_kinds) {
    auto& ids = columns_of(mesh, kind).source_id;
    for (std::size_t i = 0; i < rows_of(mesh, kind).count; ++i) {
      ++place;
      if (any && ids.size() == i) ids.push_back(place);
      if (any) last = std::max(last, ids[i]);
    }
  }
  for (const CellKind kind : all_cell_kinds) {
    const CellKind linear = linear_kind(kind);
    const bool is_volume = traits_of(kind).dimension == 3;
    const std::vector<Rows> cells = cells_of(mesh, kind);
    if (traits_of(kind).dimension < 2 || traits_of(linear).corners == 3 ||
        linear == CellKind::tetrahedron)
      continue;
    if (cells.empty()) continue;
    const CellKind simplex = is_volume ? CellKind::tetrahedron : CellKind::triangle;
    Rows parents;
    std::vector<Rows> parts;
    for (std::uint32_t row = 0; row < cells.size(); ++row) {
      Rows corners = cells[row];
      if (kind != CellKind::polygon) corners.resize(traits_of(kind).corners);
      const std::uint32_t least = *std::ranges::min_element(corners);
      std::vector<Rows> triangles;
      long double whole = 0;
      for (const FaceCorners& f : faces_of(linear)) {
        Rows face{corners[f[0]], corners[f[1]], corners[f[2]]};
        if (f[3] != f[2]) face.push_back(corners[f[3]]);
        for (std::size_t k = 2; k < face.size(); ++k)
          whole += six_volumes(mesh, corners[0], face[0], face[k - 1], face[k]);
        if (std::ranges::count(face, least) > 0) continue;
        for (const Rows& t : fan_of(face)) triangles.push_back(t);
      }
      if (!is_volume) triangles = fan_of(corners);
      const Point area = area_of(mesh, corners);
      bool is_concave = false;
      for (Rows t : triangles) {
        if (std::set(t.begin(), t.end()).size() < 3) {
          ++report.empty_parts;
          continue;
        }
        if (is_volume) {
          const long double part =
              six_volumes(mesh, least, t[0], t[1], t[2]) * (whole < 0 ? -1 : 1);
          if (!(part > 1e-12L * std::abs(whole))) is_concave = true;
          t.insert(t.begin(), least);
        } else if (!(product(area_of(mesh, t), area) > 1e-12 * product(area, area))) {
          is_concave = true;
        }
        parts.push_back(t);
        parents.push_back(row);
      }
      (is_volume ? report.concave_volumes : report.concave_faces) += is_concave ? 1 : 0;
      if (kind != CellKind::polygon) continue;
      double off = 0, size = 0;
      for (const std::uint32_t c : corners) {
        Point d = mesh.points[c];
        for (std::size_t k = 0; k < 3; ++k) d[k] -= mesh.points[corners[0]][k];
        off = std::max(off, std::abs(product(d, area)));
        size = std::max(size, std::sqrt(product(d, d)));
      }
      report.bent_polygons += off > 1e-6 * size * std::sqrt(product(area, area)) ? 1 : 0;
    }
    report.cut[index_of(kind)] = cells.size();
    (is_volume ? report.tetrahedra : report.triangles) += parts.size();
    CellColumns columns = some_of(columns_of(mesh, kind), parents);
    for (std::size_t i = 1; i < columns.source_id.size(); ++i) {
      if (parents[i] != parents[i - 1]) continue;
      columns.source_id[i] = ++last;
      ++report.numbers_added;
    }
    std::vector<Rows> all = cells_of(mesh, simplex);
    columns = joined(columns_of(mesh, simplex), all.size(), columns, parts.size());
    all.insert(all.end(), parts.begin(), parts.end());
    put(mesh, simplex, all, columns);
    put(mesh, kind, {}, {});
  }
  return report;
}

/// Cells that are nearly boxes, of all kinds that are cut: some convex, some not, some inside out.
FileMesh nearly_boxes(Random& random) {
  FileMesh mesh;
  const double shake = below(random, 3) == 0 ? 0 : unit(random);
  // 4e-6: off the plane by about the reported limit.
  const double bend = std::array{0.0, 1e-9, 4e-6, 1e-4}[below(random, 4)];
  for (const CellKind kind : all_cell_kinds) {
    if (traits_of(kind).dimension < 2 || below(random, 2) == 0) continue;
    const std::size_t rows = 1 + below(random, 3);
    for (std::size_t i = 0; i < rows; ++i) {
      const std::size_t n =
          kind == CellKind::polygon ? 3 + below(random, 6) : traits_of(kind).nodes;
      const bool is_flat = traits_of(kind).dimension == 2;
      const auto first = static_cast<std::uint32_t>(mesh.points.size());
      const double turn = below(random, 2) == 0 ? 1 : -1;
      Rows nodes;
      for (std::size_t k = 0; k < n; ++k) {
        // Around the axis: three corners below and above for prisms, one tip for pyramids.
        const std::size_t round = is_flat ? n : linear_kind(kind) == CellKind::prism6 ? 3 : 4;
        const double angle =
            turn * 6.283185307179586 * static_cast<double>(k % round) / static_cast<double>(round);
        Point p{std::cos(angle), std::sin(angle), k < round ? 0.0 : 1.0};
        if (linear_kind(kind) == CellKind::pyramid5 && k == 4) p = {0, 0, 1};
        for (std::size_t d = 0; d < (is_flat ? 2U : 3U); ++d) p[d] += shake * (unit(random) - 0.5);
        if (is_flat) p = {p[0] + 3, p[1] - 2, 0.3 * p[0] - 0.8 * p[1] + bend * unit(random)};
        mesh.points.push_back(p);
        nodes.push_back(first + static_cast<std::uint32_t>(k));
      }
      // Which corner is the least: points in another order, the cell the same.
      Rows order = nodes;
      std::shuffle(order.begin(), order.end(), random);
      std::vector<Point> points(mesh.points.begin() + first, mesh.points.end());
      for (std::size_t k = 0; k < n; ++k) mesh.points[order[k]] = points[k];
      // Two neighbours become one. Some cells would keep a volume of nothing, with a sign that is a
      // matter of rounding.
      const bool may_repeat = shake > 0 && linear_kind(kind) != CellKind::pyramid5;
      if (may_repeat && below(random, 5) == 0) {
        const std::size_t k = below(random, n - 1);
        order[k + 1] = order[k];
      }
      append_cell(mesh, kind, order);
    }
    columns_of(mesh, kind) = random_columns(random, rows);
  }
  return mesh;
}

}  // namespace

TEST_CASE("cells cut into simplices, told one by one", "[mesh][split]") {
  Random random(5);
  SplitCells sum;
  for (int round = 0; round < 200; ++round) {
    INFO("round " << round);
    FileMesh mesh = nearly_boxes(random), expected = mesh;
    const SplitCells twin = split(expected), report = split_cells(mesh);
    REQUIRE(words(mesh) == words(expected));
    CHECK(report.cut == twin.cut);
    CHECK(report.triangles == twin.triangles);
    CHECK(report.tetrahedra == twin.tetrahedra);
    CHECK(report.empty_parts == twin.empty_parts);
    CHECK(report.concave_volumes == twin.concave_volumes);
    CHECK(report.concave_faces == twin.concave_faces);
    CHECK(report.bent_polygons == twin.bent_polygons);
    CHECK(report.numbers_added == twin.numbers_added);
    sum.tetrahedra += report.tetrahedra;
    sum.concave_volumes += report.concave_volumes;
    sum.concave_faces += report.concave_faces;
    sum.bent_polygons += report.bent_polygons;
  }
  // All of it happens, and none of it always.
  CHECK(sum.tetrahedra > 500);
  CHECK(sum.concave_volumes > 15);
  CHECK(sum.concave_faces > 15);
  CHECK(sum.bent_polygons > 10);
}

TEST_CASE("a part is flat up to 1e-12 of its cell, whichever way the cell is turned",
          "[mesh][split]") {
  // The base is cut from corner 0 to 2; corner 3 is so near to this line that its side is `part` of
  // the whole.
  for (const double tip : {1.0, -1.0}) {
    for (const double part : {0.75e-12, 1.5e-12}) {
      FileMesh mesh;
      mesh.points = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1 + 2 * part, 0}, {0, 0, tip}};
      append_cell(mesh, CellKind::pyramid5, Rows{0, 1, 2, 3, 4});
      CHECK(split_cells(mesh).concave_volumes == (part < 1e-12 ? 1 : 0));
    }
  }
}

TEST_CASE("cells of no volume or area are concave, but where all parts are positive",
          "[mesh][split]") {
  FileMesh mesh;
  for (std::uint32_t i = 0; i < 8; ++i) mesh.points.push_back({1.0 * (i % 4), 1.0 * (i / 4), 0});
  append_cell(mesh, CellKind::hexahedron8, Rows{0, 1, 2, 3, 4, 5, 6, 7});
  append_cell(mesh, CellKind::quad4, Rows{0, 1, 2, 3});
  const SplitCells flat = split_cells(mesh);
  CHECK(flat.concave_volumes == 1);
  CHECK(flat.concave_faces == 1);
  // The base is bent: along its other diagonal, from the least corner, both parts are 1 or -1.
  for (const double turn : {1.0, -1.0}) {
    mesh = {};
    mesh.points = {
        {1, 0, -2 * turn}, {0, 0, -2 * turn}, {1, 1, -2 * turn}, {0, 1, 0}, {0, 1, -turn}};
    append_cell(mesh, CellKind::pyramid5, Rows{1, 0, 2, 3, 4});
    CHECK(split_cells(mesh).concave_volumes == (turn < 0 ? 0 : 1));
  }
}

TEST_CASE("numbers of parts begin with 1 where no cell has one above 0", "[mesh][split]") {
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  append_cell(mesh, CellKind::quad4, Rows{0, 1, 2, 3});
  columns_of(mesh, CellKind::quad4).source_id = {0};
  CHECK(split_cells(mesh).numbers_added == 1);
  CHECK(mesh.triangles.source_id == std::vector<std::int64_t>{0, 1});
}

TEST_CASE("faces of volume cells look outward, and two go through each edge", "[mesh][kinds]") {
  const std::map<CellKind, std::vector<Point>> shapes = {
      {CellKind::tetrahedron, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {CellKind::hexahedron8,
       {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}},
      {CellKind::prism6, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
      {CellKind::pyramid5, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}}}};
  for (const CellKind kind : all_cell_kinds) {
    INFO(traits_of(kind).name);
    const auto found = shapes.find(kind);
    if (found == shapes.end()) {
      CHECK(faces_of(kind).empty());
      continue;
    }
    FileMesh mesh;
    mesh.points = found->second;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const FaceCorners& f : faces_of(kind)) {
      Rows face(f.begin(), f.end() - (f[2] == f[3] ? 1 : 0));
      const Point area = area_of(mesh, face);
      for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
        Point d = mesh.points[p];
        for (std::size_t k = 0; k < 3; ++k) d[k] -= mesh.points[face[0]][k];
        const bool is_on = std::ranges::count(face, p) > 0;
        CHECK((is_on ? std::abs(product(d, area)) < 1e-12 : product(d, area) < -0.1));
      }
      for (std::size_t k = 0; k < face.size(); ++k) ++sides[{face[k], face[(k + 1) % face.size()]}];
    }
    for (const auto& [ends, count] : sides) {
      CHECK(count == 1);
      CHECK(sides.contains({ends.second, ends.first}));
    }
    CHECK(sides.size() / 2 == mesh.points.size() + faces_of(kind).size() - 2);  // Euler
  }
}
