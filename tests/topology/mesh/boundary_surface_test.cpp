// SPDX-License-Identifier: MIT
// The skin of careless meshes against a twin that counts faces in a map.
#include "topology/mesh/boundary_surface.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>

#include "tests/support/random_meshes.hpp"
#include "topology/base/point_math.hpp"
#include "topology/mesh/kinds/move_cells.hpp"
#include "topology/mesh/surface/surface_check.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

using Face = std::array<std::uint32_t, 3>;

template <std::size_t N>
std::array<std::uint32_t, N> rising(std::array<std::uint32_t, N> corners) {
  std::ranges::sort(corners);
  return corners;
}

/// The lowest point first, turned no other way.
Face turned(const Face& f) { return std::min({f, Face{f[1], f[2], f[0]}, Face{f[2], f[0], f[1]}}); }

/// Row `from` of a column behind `to`; `filling` where there is none.
template <class Value>
void append(std::vector<Value>& to, const std::vector<Value>& column, const std::size_t* from,
            std::size_t components, Value filling) {
  if (column.empty()) return;
  for (std::size_t k = 0; k < components; ++k) {
    to.push_back(from == nullptr ? filling : column.at(*from * components + k));
  }
}

void append(std::vector<DataColumn>& to, const std::vector<DataColumn>& columns,
            const std::size_t* from) {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const DataColumn& column = columns[c];
    if (to.size() == c) {
      to.push_back(column);
      std::visit([](auto& values) { values.clear(); }, to[c].values);
    }
    std::visit(
        [&](auto& values) {
          using Values = std::decay_t<decltype(values)>;
          using Value = typename Values::value_type;
          append(values, std::get<Values>(column.values), from, column.components,
                 static_cast<Value>(std::is_integral_v<Value> ? 0 : NAN));
        },
        to[c].values);
  }
}

template <std::size_t N>
void append(CellList<N>& to, const CellList<N>& cells, const std::size_t* from) {
  append(to.region, cells.region, from, 1, 0);
  append(to.entity, cells.entity, from, 1, 0);
  append(to.source_id, cells.source_id, from, 1, std::int64_t{0});
  append(to.data, cells.data, from);
}

/// Cells of lower dimension with all their points on the surface.
template <std::size_t N>
std::size_t keep(CellList<N>& to, const CellList<N>& cells,
                 const std::map<std::uint32_t, std::uint32_t>& row_of) {
  for (std::size_t i = 0; i < cells.corners.size(); ++i) {
    auto corners = cells.corners[i];
    if (!std::ranges::all_of(corners, [&](auto p) { return row_of.contains(p); })) continue;
    for (auto& p : corners) p = row_of.at(p);
    to.corners.push_back(corners);
    append(to, cells, &i);
  }
  return cells.corners.size() - to.corners.size();
}

/// A second implementation of boundary_surface.
BoundarySurface expected_of(const FileMesh& mesh) {
  BoundarySurface s;
  s.mesh.region_name = mesh.region_name;
  s.mesh.region_name[3] = {};
  s.mesh.point_data = mesh.point_data;
  for (DataColumn& c : s.mesh.point_data) std::visit([](auto& v) { v.clear(); }, c.values);
  std::map<Face, int> sides;
  const auto face_of = [&](std::size_t t, std::size_t p) {
    const auto& x = mesh.tetrahedra.corners[t];
    return Face{x[p == 0 ? 1 : 0], x[p <= 1 ? 2 : 1], x[p <= 2 ? 3 : 2]};
  };
  const std::size_t n = mesh.tetrahedra.corners.size();
  for (std::size_t t = 0; t < n; ++t) {
    for (std::size_t p = 0; p < 4; ++p) ++sides[rising(face_of(t, p))];
  }
  std::map<Face, std::size_t> own;
  for (std::size_t i = 0; i < mesh.triangles.corners.size(); ++i) {
    own.emplace(rising(mesh.triangles.corners[i]), i);
  }
  std::map<std::uint32_t, std::uint32_t> row_of;
  std::size_t found = 0;
  std::vector<const std::size_t*> rows;
  for (std::size_t t = 0; t < n; ++t) {
    for (std::size_t p = 0; p < 4; ++p) {
      Face f = face_of(t, p);
      if (sides[rising(f)] != 1) continue;
      const auto& x = mesh.tetrahedra.corners[t];
      const double volume = detail::six_volumes(mesh.points[x[0]], mesh.points[x[1]],
                                                mesh.points[x[2]], mesh.points[x[3]]);
      // Seen from corner 0 of a positive tetrahedron 1, 2, 3 turn outward, from 1 the other way.
      if ((volume < 0) != (p % 2 == 1)) std::swap(f[1], f[2]);
      s.mesh.triangles.corners.push_back(f);
      const auto mine = own.find(rising(f));
      rows.push_back(mine == own.end() ? nullptr : &mine->second);
      if (mine != own.end()) ++found;
      for (const auto corner : f) row_of[corner] = 0;
    }
  }
  if (found > 0) {
    for (const auto* row : rows) append(s.mesh.triangles, mesh.triangles, row);
    std::int64_t last = 0;
    for_each_cell_list(mesh, [&](const auto& cells, int) {
      for (const auto id : cells.source_id) last = std::max(last, id);
    });
    for (std::size_t i = 0; i < s.mesh.triangles.source_id.size(); ++i) {
      if (rows[i] == nullptr) s.mesh.triangles.source_id[i] = ++last;
    }
  }
  s.lost_cells[index_of(CellKind::triangle)] = mesh.triangles.corners.size() - found;
  for (auto& [p, row] : row_of) {
    row = static_cast<std::uint32_t>(s.mesh.points.size());
    const std::size_t from = p;
    s.mesh.points.push_back(mesh.points[p]);
    append(s.mesh.source_point_id, mesh.source_point_id, &from, 1, std::int64_t{0});
    append(s.mesh.point_region, mesh.point_region, &from, 1, 0);
    append(s.mesh.point_data, mesh.point_data, &from);
  }
  s.lost_points = mesh.points.size() - row_of.size();
  if (s.lost_points > 0 && mesh.source_point_id.empty()) {
    for (const auto& [p, row] : row_of) s.mesh.source_point_id.push_back(p + 1L);
  }
  for (auto& f : s.mesh.triangles.corners) {
    for (auto& p : f) p = row_of.at(p);
  }
  s.lost_cells[0] = keep(s.mesh.vertices, mesh.vertices, row_of);
  s.lost_cells[1] = keep(s.mesh.edges, mesh.edges, row_of);
  return s;
}

/// Numbers that are none are equal to themselves here.
void name_nans(FileMesh& mesh) {
  const auto name = [](double& x) { x = std::isnan(x) ? -12345 : x; };
  for (auto& p : mesh.points) std::ranges::for_each(p, name);
  for_each_cell_list(mesh, [&](auto& cells, int) {
    for (DataColumn& column : cells.data) {
      if (auto* reals = std::get_if<0>(&column.values)) std::ranges::for_each(*reals, name);
    }
  });
  for (Face& f : mesh.triangles.corners) f = turned(f);
}

}  // namespace

TEST_CASE("the surface of careless meshes is that of faces counted in a map, with all columns",
          "[topology][surface]") {
  std::size_t columns = 0, lost_edges = 0, lost_vertices = 0, lost_triangles = 0;
  for (std::uint64_t seed = 0; seed < 250; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    FileMesh mesh = careless(random);
    const bool in_range = std::ranges::all_of(mesh.tetrahedra.corners, [&](const auto& t) {
      return std::ranges::all_of(t, [&](auto p) { return p < mesh.points.size(); });
    });
    if (!in_range) continue;
    BoundarySurface surface = boundary_surface(mesh);
    BoundarySurface expected = expected_of(mesh);
    name_nans(surface.mesh), name_nans(expected.mesh);
    CHECK(surface.mesh == expected.mesh);
    CHECK(surface.lost_cells == expected.lost_cells);
    CHECK(surface.lost_points == expected.lost_points);
    columns += surface.mesh.triangles.data.size();
    lost_vertices += surface.lost_cells[0];
    lost_edges += surface.lost_cells[1];
    lost_triangles += surface.lost_cells[index_of(CellKind::triangle)];
  }
  CHECK(columns > 20);
  CHECK(lost_vertices > 3);
  CHECK(lost_edges > 3);
  CHECK(lost_triangles > 100);
}

TEST_CASE("triangles that the mesh did not have get numbers as far as there are numbers",
          "[topology][surface]") {
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tetrahedra.corners = {{0, 1, 2, 3}};
  mesh.triangles.corners = {{1, 2, 3}};
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  mesh.triangles.source_id = {most - 4};
  CHECK(boundary_surface(mesh).mesh.triangles.source_id ==
        std::vector<std::int64_t>{most - 4, most - 3, most - 2, most - 1});
  mesh.triangles.source_id = {most - 3};
  CHECK(boundary_surface(mesh).mesh.triangles.source_id.empty());
  mesh.triangles.source_id = {-7};
  CHECK(boundary_surface(mesh).mesh.triangles.source_id == std::vector<std::int64_t>{-7, 1, 2, 3});
  mesh.tetrahedra.source_id = {12};
  CHECK(boundary_surface(mesh).mesh.triangles.source_id ==
        std::vector<std::int64_t>{-7, 13, 14, 15});
}

TEST_CASE("the surface of cells of several kinds looks outward, however each is turned",
          "[topology][surface]") {
  // Two cubes side by side with a pyramid on the first and a prism on the second.
  FileMesh mesh;
  for (const double z : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      for (const double x : {0.0, 1.0, 2.0}) mesh.points.push_back({x, y, z});
    }
  }
  mesh.points.insert(mesh.points.end(), {{0.5, 0.5, 4}, {1.5, 0, 2}, {1.5, 1, 2}});
  std::array<std::array<std::uint32_t, 8>, 2> cubes = {
      {{0, 1, 4, 3, 6, 7, 10, 9}, {1, 2, 5, 4, 7, 8, 11, 10}}};
  std::array<std::uint32_t, 5> pyramid = {6, 7, 10, 9, 12};
  std::array<std::uint32_t, 6> prism = {7, 8, 13, 10, 11, 14};
  for (int turned = 0; turned < 16; ++turned) {
    FileMesh here = mesh;
    for (std::size_t i = 0; i < 2; ++i) {
      auto cube = cubes[i];
      if ((turned >> i & 1) != 0) std::rotate(cube.begin(), cube.begin() + 4, cube.end());
      append_cell(here, CellKind::hexahedron8, cube);
    }
    auto p = pyramid;
    if ((turned & 4) != 0) std::swap(p[1], p[3]);
    append_cell(here, CellKind::pyramid5, p);
    auto q = prism;
    if ((turned & 8) != 0) std::rotate(q.begin(), q.begin() + 3, q.end());
    append_cell(here, CellKind::prism6, q);
    append_cell(here, CellKind::polygon, std::array<std::uint32_t, 5>{0, 1, 2, 5, 3});
    const BoundarySurface surface = boundary_surface(here);
    const SurfaceCheck check = check_surface(surface.mesh);
    INFO("turned " << turned);
    CHECK(check.triangles == 6);
    CHECK(check.quadrilaterals == 10);
    CHECK((check.is_closed && check.is_oriented));
    CHECK(check.volume.value_or(0) == Approx(2 + 1 + 0.5));
    CHECK(surface.lost_points == 0);
    CHECK(surface.lost_cells[index_of(CellKind::polygon)] == 1);
  }
  CHECK(BoundarySurface{}.lost_points == 0);
}

TEST_CASE("faces of cells apart come by kind, row and face, turned as their cells are",
          "[topology][surface]") {
  const std::array<std::pair<CellKind, std::vector<Point>>, 4> shapes = {
      {{CellKind::tetrahedron, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
       {CellKind::hexahedron8,
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}},
       {CellKind::prism6, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
       {CellKind::pyramid5, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}}}};
  const auto nodes = [](FileMesh& mesh, CellKind kind) {
    const auto all = nodes_of(mesh, kind);
    return std::vector<std::uint32_t>(all.begin(), all.end());
  };
  // Right way round, mirrored and flat: those without volume stay as they are numbered.
  for (const double height : {0.1, -0.1, 0.0}) {
    INFO("height " << height);
    FileMesh mesh;
    std::vector<std::uint32_t> triangles, quads;
    double at = 0;
    for (const auto& [kind, corners] : shapes) {
      for (int row = 0; row < 2; ++row, ++at) {
        const auto first = static_cast<std::uint32_t>(mesh.points.size());
        FileMesh alone;
        std::vector<std::uint32_t> cell, own;
        for (const Point& p : corners) {
          cell.push_back(static_cast<std::uint32_t>(mesh.points.size()));
          own.push_back(static_cast<std::uint32_t>(alone.points.size()));
          mesh.points.push_back({0.1 * p[0] + at, 0.1 * p[1], height * p[2]});
          alone.points.push_back(mesh.points.back());
        }
        append_cell(mesh, kind, cell);
        append_cell(alone, kind, own);
        const FileMesh skin = boundary_surface(alone).mesh;
        CHECK(rows_of(skin, CellKind::triangle).count + rows_of(skin, CellKind::quad4).count ==
              faces_of(kind).size());
        for (const FaceCorners& f : faces_of(kind)) {
          std::vector<std::uint32_t> face(f.begin(), f.begin() + (f[2] == f[3] ? 3 : 4));
          for (std::uint32_t& p : face) p += first;
          if (height < 0) std::ranges::reverse(face);
          auto& all = face.size() == 3 ? triangles : quads;
          all.insert(all.end(), face.begin(), face.end());
        }
      }
    }
    BoundarySurface surface = boundary_surface(mesh);
    CHECK(surface.lost_points == 0);
    CHECK(nodes(surface.mesh, CellKind::triangle) == triangles);
    CHECK(nodes(surface.mesh, CellKind::quad4) == quads);
  }
}

TEST_CASE("the volume of a tetrahedron by its faces is that by its corners, to the bit",
          "[topology][surface]") {
  // The skin of tetrahedra alone and of those among other cells are turned by one and the other.
  std::mt19937_64 random(3);
  FileMesh mesh;
  const auto hold = [&] {
    const auto& x = mesh.points;
    CHECK(six_volumes_of(mesh, CellKind::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 3}) ==
          detail::six_volumes(x[0], x[1], x[2], x[3]));
  };
  for (int trial = 0; trial < 100; ++trial) {
    mesh.points.assign(4, {});
    for (Point& p : mesh.points) std::ranges::generate(p, [&] { return suite::unit(random); });
    hold();
  }
  mesh.points = {{0, 0, 0}, {1e200, 1e200, 0}, {0, 1e-200, 0}, {0, 0, 1}};
  hold();
}

TEST_CASE("cells of second order among others have the surface of their corners",
          "[topology][surface]") {
  FileMesh mesh;
  for (int i = 0; i < 64; ++i) mesh.points.push_back({1.0 * (i % 4), 1.0 * (i / 4 % 4), i / 16.0});
  for (const CellKind kind : all_cell_kinds) {
    if (kind == CellKind::polygon) continue;
    std::vector<std::uint32_t> cell(traits_of(kind).nodes);
    for (std::size_t k = 0; k < cell.size(); ++k) {
      cell[k] = static_cast<std::uint32_t>((k * 7 + 3 * index_of(kind)) % 64);
    }
    append_cell(mesh, kind, cell);
  }
  FileMesh linear = mesh;
  make_linear(linear);
  const BoundarySurface surface = boundary_surface(mesh), expected = boundary_surface(linear);
  CHECK(surface.mesh == expected.mesh);
  CHECK(surface.lost_cells == expected.lost_cells);
  CHECK(surface.lost_points == expected.lost_points);
  CHECK(rows_of(surface.mesh, CellKind::quad4).count >= 20);
}

TEST_CASE("the surface of cells of second order is that of their corners", "[topology][surface]") {
  FileMesh linear;
  linear.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  linear.tetrahedra.corners = {{0, 1, 2, 3}};
  FileMesh mesh;
  mesh.points = linear.points;
  for (const auto& [a, b] : {std::array{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}) {
    mesh.points.push_back(detail::middle(mesh.points[a], mesh.points[b]));
  }
  append_cell(mesh, CellKind::tetrahedron10,
              std::array<std::uint32_t, 10>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  CHECK(has_volume_cells(mesh));
  const BoundarySurface surface = boundary_surface(mesh);
  CHECK(surface.mesh.triangles.corners == boundary_surface(linear).mesh.triangles.corners);
  CHECK(surface.mesh.points == linear.points);
  CHECK(surface.lost_points == 6);
}
