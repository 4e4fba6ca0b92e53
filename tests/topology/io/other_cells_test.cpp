// SPDX-License-Identifier: MIT
// Cells of every kind and order through every format, version and encoding, and from each to each:
// whole, or reported.
#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "tests/support/io_support.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/mesh/boundary_surface.hpp"
#include "topology/mesh/kinds/move_cells.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

using Random = std::mt19937;

struct Variant {
  const FormatTraits* traits;
  std::string version;
  Encoding encoding = Encoding::text;
};

std::string to_string(const Variant& v) {
  constexpr const char* words[] = {" text", " binary", " base64"};
  return std::string(v.traits->name) + " " + v.version + words[static_cast<int>(v.encoding)];
}

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const FormatTraits& t : format_traits()) {
    std::vector<std::string> versions(t.versions.begin(), t.versions.end());
    if (versions.empty()) versions.emplace_back();
    for (const std::string& version : versions) {
      for (const Encoding encoding : t.encodings) {
        if (version == "1" && encoding != Encoding::text) continue;
        all.push_back({&t, version, encoding});
      }
    }
  }
  return all;
}

/// `n` different points of a mesh.
std::vector<std::uint32_t> nodes_at_random(Random& random, std::size_t points, std::size_t n) {
  std::vector<std::uint32_t> all(points);
  std::iota(all.begin(), all.end(), 0U);
  std::shuffle(all.begin(), all.end(), random);
  all.resize(n);
  return all;
}

DataColumn reals(Random& random, std::string name, std::size_t components, std::size_t rows) {
  std::vector<double> values;
  for (std::size_t i = 0; i < rows * components; ++i) {
    values.push_back(std::uniform_real_distribution(-1.0, 1.0)(random));
  }
  return {std::move(name), components, NumberType::float64, std::move(values)};
}

/// A mesh with some kinds of cells and some of all that can be said of them.
FileMesh mixed_mesh(Random& random) {
  const auto one_in = [&](unsigned n) { return random() % n == 0; };
  FileMesh mesh;
  mesh.points.resize(40);
  for (Point& p : mesh.points) {
    // Floats hold them, for binary STL.
    for (double& x : p) x = std::uniform_real_distribution<float>(-1, 1)(random);
  }
  const bool has_numbers = one_in(3), has_data = one_in(3);
  if (one_in(3)) mesh.point_data.push_back(reals(random, "height", 1, 40));
  std::int64_t number = 1000;
  for (const CellKind kind : all_cell_kinds) {
    if (!one_in(2)) continue;
    const std::size_t rows = 1 + random() % 3;
    CellColumns& cells = columns_of(mesh, kind);
    for (std::size_t i = 0; i < rows; ++i) {
      const std::size_t nodes =
          kind == CellKind::polygon ? 5 + random() % 4 : traits_of(kind).nodes;
      append_cell(mesh, kind, nodes_at_random(random, 40, nodes));
    }
    const bool has_region = one_in(2), has_entity = one_in(3);
    for (std::size_t i = 0; i < rows; ++i) {
      const auto region = static_cast<std::int32_t>(1 + random() % 3);
      if (has_region) cells.region.push_back(region);
      // An entity has one region, and one dimension.
      const auto own = static_cast<std::int32_t>(100 + 40 * index_of(kind) + 2 * (i % 2));
      if (has_entity) cells.entity.push_back(own + (has_region ? 10 * region : 0));
      if (has_numbers) cells.source_id.push_back(number += 7);
    }
    if (has_data) cells.data.push_back(reals(random, "damage", 1, rows));
    if (has_data && one_in(2)) cells.data.push_back(reals(random, "stress", 9, rows));
  }
  return mesh;
}

/// The rest of a mesh in a format, kinds by our own table.
FileMesh held(FileMesh mesh, const Variant& variant) {
  const FormatTraits& t = *variant.traits;
  const bool is_stl = t.format == MeshFormat::stl, is_msh = t.format == MeshFormat::msh;
  if (!contains(t.cells, CellKind::tetrahedron) && has_volume_cells(mesh)) {
    mesh = boundary_surface(mesh).mesh;
  }
  const auto has = [&](CellKind kind) { return rows_of(mesh, kind).count > 0; };
  const bool is_straight =
      has(CellKind::edge) || has(CellKind::triangle) || has(CellKind::tetrahedron);
  for (const CellKind kind : all_cell_kinds) {
    CellKind to = kind;
    const auto is_held = [&](CellKind k) {
      const bool one_order = t.format == MeshFormat::tetgen && linear_kind(k) != k && is_straight;
      return contains(t.cells, k) && !one_order;
    };
    while (!is_held(to) && traits_of(to).lower != to) to = traits_of(to).lower;
    if (!is_held(to)) {
      drop_cells(mesh, kind);
    } else if (to != kind) {
      move_cells(mesh, kind, to);
    }
  }
  bool all_have_numbers = true;
  for (const CellKind kind : all_cell_kinds) {
    CellColumns& cells = columns_of(mesh, kind);
    const int d = traits_of(kind).dimension;
    if (!t.holds_entities) {
      cells.region = label_of(cells);
      cells.entity.clear();
    }
    if (!t.holds_regions || (is_stl && variant.encoding == Encoding::binary)) cells.region.clear();
    if (!t.holds_cell_ids || d < t.cell_ids_from) cells.source_id.clear();
    if (!t.holds_cell_data || d < t.cell_data_from || (is_msh && variant.version == "1")) {
      cells.data.clear();
    }
    all_have_numbers = all_have_numbers && cells.source_id.size() == rows_of(mesh, kind).count;
  }
  for (const CellKind kind : all_cell_kinds) {
    if (is_msh && !all_have_numbers) columns_of(mesh, kind).source_id.clear();
  }
  if (!t.holds_point_ids) mesh.source_point_id.clear();
  if (!t.holds_point_data || (is_msh && variant.version == "1")) mesh.point_data.clear();
  if (t.format == MeshFormat::nastran) {
    for (Point& p : mesh.points) {
      for (double& x : p) x = in_sixteen_characters(x);
    }
  }
  return mesh;
}

bool same_values(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) { return x == y || (x != x && y != y); });
}

/// The first difference; empty when there is none. Not-a-number is equal to itself.
std::string difference(const FileMesh& a, const FileMesh& b) {
  if (a.points != b.points) return "points";
  if (a.point_data != b.point_data) return "data of points";
  for (const CellKind kind : all_cell_kinds) {
    const std::string of = " of " + std::string(traits_of(kind).plural);
    const CellRows p = rows_of(a, kind), q = rows_of(b, kind);
    if (p.count != q.count) return "number" + of;
    for (std::size_t i = 0; i < p.count; ++i) {
      if (!std::ranges::equal(p[i], q[i])) return "nodes" + of;
    }
    const CellColumns &x = columns_of(a, kind), &y = columns_of(b, kind);
    if (x.region != y.region) return "regions" + of;
    if (x.entity != y.entity) return "entities" + of;
    if (x.source_id != y.source_id) return "numbers" + of;
    const bool same = std::ranges::equal(x.data, y.data, [](const auto& c, const auto& d) {
      return c.name == d.name && c.components == d.components &&
             same_values(std::get<0>(c.values), std::get<0>(d.values));
    });
    if (!same) return "data" + of;
  }
  return {};
}

bool tells(const std::vector<Finding>& findings, std::string_view code) {
  return std::ranges::find(findings, code, &Finding::code) != findings.end();
}

/// Writes and reads; `back` is none where nothing was to be written.
struct Trip {
  std::vector<Finding> told;
  std::optional<FileMesh> back;
};
Trip through(const FileMesh& mesh, const Variant& variant) {
  const Folder folder;
  const auto path = folder.path() / ("mesh" + std::string(variant.traits->extensions[0]));
  Trip trip;
  trip.told =
      write_file_mesh(path, mesh, {variant.traits->format, variant.version, variant.encoding});
  INFO(summary(trip.told));
  if (tells(trip.told, "nothing_left")) {
    CHECK_FALSE(std::filesystem::exists(path));
    return trip;
  }
  REQUIRE_FALSE(has_error(trip.told));
  Result<FileMesh> back = read_file_mesh(path);
  INFO(summary(back.findings));
  REQUIRE(back);
  CHECK(std::ranges::all_of(back.findings,
                            [](const Finding& f) { return f.code == "degenerate_cell"; }));
  trip.back = std::move(*back);
  return trip;
}

bool is_loss(const Finding& f) { return f.severity != Severity::note; }

}  // namespace

TEST_CASE("cells of every kind come back in every bit from formats that have them, or it is told",
          "[io][round_trip][cells]") {
  const unsigned seed = Catch::rngSeed() != 0 ? Catch::rngSeed() : 20261125;
  INFO("seed " << seed);
  Random random(seed);
  for (int round = 0; round < 12; ++round) {
    const FileMesh mesh = mixed_mesh(random);
    for (const Variant& variant : variants()) {
      INFO("round " << round << ", " << to_string(variant));
      const Trip trip = through(mesh, variant);
      const bool any_loss = std::ranges::any_of(trip.told, is_loss);
      if (!trip.back) {
        CHECK(cell_count(held(mesh, variant)) == 0);
        continue;
      }
      if (!any_loss) CHECK(difference(mesh, *trip.back).empty());
      if (variant.traits->format == MeshFormat::stl) continue;  // points are those of facets
      CHECK(difference(held(mesh, variant), *trip.back).empty());
      // The rest goes through whole, and nothing is reported.
      const Trip again = through(*trip.back, variant);
      REQUIRE(again.back);
      CHECK(difference(*trip.back, *again.back).empty());
      CHECK(std::ranges::none_of(again.told, [](const Finding& f) {
        return is_loss(f) && f.code != "region_not_positive";
      }));
    }
  }
}

TEST_CASE("from each format to each other a mixed mesh is whole or its losses are told",
          "[io][round_trip][cells]") {
  Random random(7);
  const FileMesh mesh = mixed_mesh(random);
  for (const Variant& from : variants()) {
    const Trip first = through(mesh, from);
    if (!first.back) continue;
    for (const Variant& to : variants()) {
      INFO(to_string(from) << " to " << to_string(to));
      const Trip second = through(*first.back, to);
      if (!second.back) continue;
      const bool any_loss = std::ranges::any_of(second.told, is_loss);
      FileMesh sent = *first.back;
      for (const CellKind kind : all_cell_kinds) {
        // Where there is one label a cell, entities stand for regions that are not given.
        CellColumns& cells = columns_of(sent, kind);
        if (to.traits->holds_entities || !cells.region.empty()) continue;
        cells.region = label_of(cells);
        if (!cells.region.empty()) cells.entity.clear();
      }
      const std::string lost = difference(sent, *second.back);
      INFO(lost);
      CHECK((any_loss || lost.empty()));
    }
  }
}

TEST_CASE("a surface of one quadrilateral is no STL, and nothing is written", "[io][cells]") {
  const Folder folder;
  const Result<FileMesh> quad =
      read_file_mesh("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", "quad.obj");
  REQUIRE(quad);
  CHECK(quad.findings.empty());
  CHECK(rows_of(*quad, CellKind::quad4).count == 1);
  const auto findings = write_file_mesh(folder.path() / "quad.stl", *quad);
  INFO(summary(findings));
  CHECK(tells(findings, "nothing_left"));
  CHECK(tells(findings, "cells_lost"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "quad.stl"));
}

TEST_CASE("MEDIT writes hexahedra of 20 nodes with 8, and tells how many", "[io][medit][cells]") {
  FileMesh mesh;
  mesh.points.resize(20);
  for (std::size_t i = 0; i < 20; ++i) mesh.points[i] = {static_cast<double>(i), 0, 1};
  std::vector<std::uint32_t> nodes(20);
  std::iota(nodes.begin(), nodes.end(), 0U);
  append_cell(mesh, CellKind::hexahedron20, nodes);
  const Folder folder;
  const auto findings = write_file_mesh(folder.path() / "a.mesh", mesh);
  CHECK(summary(findings) == "warning nodes_lost 0");
  CHECK(findings[0].count == 1);
  CHECK(findings[0].text ==
        "MEDIT holds no 20-node hexahedra: one is written as a hexahedron, its other nodes stay as "
        "points");
  const Result<FileMesh> back = read_file_mesh(folder.path() / "a.mesh");
  REQUIRE(back);
  CHECK(back->points.size() == 20);
  CHECK(std::ranges::equal(rows_of(*back, CellKind::hexahedron8)[0], std::span(nodes).first(8)));
}

TEST_CASE("the boundary of a hexahedron is six quadrilaterals, outward", "[io][cells]") {
  FileMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.points.push_back({i % 4 == 1 || i % 4 == 2 ? 1.0 : 0.0, i % 4 >= 2 ? 1.0 : 0.0, i / 4.0});
    mesh.points.back()[2] = i >= 4;
  }
  std::vector<std::uint32_t> nodes{0, 1, 2, 3, 4, 5, 6, 7};
  const bool is_inverted = GENERATE(false, true);
  if (is_inverted) nodes = {4, 5, 6, 7, 0, 1, 2, 3};
  append_cell(mesh, CellKind::hexahedron8, nodes);
  const BoundarySurface surface = boundary_surface(mesh);
  const CellRows quads = rows_of(surface.mesh, CellKind::quad4);
  REQUIRE(quads.count == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto at = [&](std::size_t k) { return surface.mesh.points[quads[i][k]]; };
    double outward = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      const double normal = (at(1)[a] - at(0)[a]) * (at(3)[b] - at(0)[b]) -
                            (at(1)[b] - at(0)[b]) * (at(3)[a] - at(0)[a]);
      outward += normal * ((at(0)[k] + at(2)[k]) / 2 - 0.5);
    }
    CHECK(outward == 0.5);
  }
}
