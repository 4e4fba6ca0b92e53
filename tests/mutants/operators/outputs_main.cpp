// SPDX-License-Identifier: MIT
// All answers of topology/{kernel,cells,mesh} about random bodies, damaged meshes and operations,
// as one number per area: `sunder_operator_outputs ROUNDS SEED`. A mutant that is said to change
// nothing has to print the numbers of the program without it. `SUNDER_REACHED`: a file that gets
// the numbers of the mutants asked for.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>

#include "sunder_fault.hpp"
#include "tests/mutants/operators/digest.hpp"
#include "tests/mutants/operators/parts_round.hpp"
#include "tests/support/careless_surface.hpp"
#include "tests/support/random_kinds.hpp"
#include "tests/support/random_meshes.hpp"
#include "topology/cells/columns.hpp"
#include "topology/cells/file_cells.hpp"
#include "topology/cells/journal.hpp"
#include "topology/cells/plane_cut.hpp"
#include "topology/cells/refine.hpp"
#include "topology/kernel/components.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/kernel/invariants.hpp"
#include "topology/kernel/map_mesh.hpp"
#include "topology/mesh/boundary_surface.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/mesh/check.hpp"
#include "topology/mesh/crack.hpp"
#include "topology/mesh/finding_cells.hpp"
#include "topology/mesh/kinds/column_order.hpp"
#include "topology/mesh/kinds/move_cells.hpp"
#include "topology/mesh/kinds/second_order.hpp"
#include "topology/mesh/kinds/split_cells.hpp"
#include "topology/mesh/kinds/take_rows.hpp"
#include "topology/mesh/repair.hpp"
#include "topology/mesh/surface/crossing.hpp"
#include "topology/mesh/surface/exact_side.hpp"
#include "topology/mesh/surface/surface_check.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace {

using namespace sunder;
using suite::below;
using suite::unit;
using test::Digest;

using test::body, test::careless, test::parts_round, test::Random;

/// Often along an axis or through a vertex, where signs are a matter of rounding.
Point normal_of(Random& random) {
  Point n{};
  for (double& x : n) {
    x = below(random, 2) == 0 ? static_cast<double>(below(random, 3)) - 1 : 2 * unit(random) - 1;
  }
  return n;
}

CuttingPlane plane_of(Random& random) {
  return {normal_of(random),
          below(random, 2) == 0 ? static_cast<double>(below(random, 4)) / 2 : 2 * unit(random)};
}

constexpr std::array ways = {Detection::walk, Detection::dirty_counter, Detection::oracle,
                             Detection::exact};

/// One fan, section or single face of random kind, in both kernels.
std::vector<HalfFaceId> faces_to_split(const VolumeMap& map, Random& random, Digest& out) {
  std::vector<HalfFaceId> faces;
  const std::size_t which = below(random, 8);
  if (which == 0) {
    const auto section = plane_faces(map, plane_of(random));
    out.add(section);
    if (section) faces = *section;
  } else if (which < 6) {
    const auto fan = fan_faces(map, VertexId{below(random, map.vertices() + 1)}, normal_of(random));
    out.add(fan);
    if (fan) faces = *fan;
  } else {
    faces.push_back(HalfFaceId{below(random, 4 * map.tetrahedra())});
  }
  order_faces(map, below(random, 2) == 0 ? FaceOrder::paper : FaceOrder::given, faces);
  return faces;
}

void kernel_round(Random& random, Digest& out) {
  const TetMesh mesh = body(random);
  std::array<Result<VolumeMap>, 2> maps = {build_map(mesh, Severity::warning, MapKernel::lcc),
                                           build_map(mesh, Severity::warning, MapKernel::dense)};
  out.add(maps[0].findings);
  if (!maps[0]) return;
  std::array<Components, 4> labels;
  for (auto& l : labels) l = label_components(*maps[0]);
  std::array<ComponentScratch, 4> scratch;
  std::vector<FaceSplit> done;
  for (int step = 0; step < 12 && maps[0]->tetrahedra() > 0; ++step) {
    const std::vector<HalfFaceId> faces = faces_to_split(*maps[0], random, out);
    const Counts before = count_cells(*maps[0]);
    std::vector<FaceSplit> splits;
    for (const HalfFaceId f : faces) {
      splits.push_back(split_face(*maps[0], f));
      out.all(splits.back(), split_face(*maps[1], f));
      if (splits.back().did) done.push_back(splits.back());
    }
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const ComponentUpdate u = update_components(*maps[1], splits, ways[i], labels[i], scratch[i]);
      out.all(u.predicted, u.first_new, u.created, u.visited, labels[i]);
    }
    const Counts after = count_cells(*maps[0]);
    out.all(after, count_cells(*maps[1]), count_boundary_sheets(*maps[0]), check(*maps[0]));
    out.add(counts_after(before, *maps[1], splits, after.components - before.components));
    if (splits.size() == 1) out.add(check_split_laws(before, after, splits[0]));
    if (step % 4 == 3) {
      for (std::size_t i = 0; i < 3 && !done.empty(); ++i) {
        const FaceSplit s = done[below(random, done.size())];
        const HalfFaceId other = below(random, 4) == 0
                                     ? HalfFaceId{below(random, 4 * maps[0]->tetrahedra())}
                                     : s.opposite;
        for (auto& map : maps) out.add(glue_face(*map, s.face, other));
      }
      for (auto& l : labels) l = label_components(*maps[1]);
    }
  }
  out.all(*maps[0], *maps[1], unexpressed_cuts(*maps[0]));
  for (const MeshPoints points : {MeshPoints::vertices, MeshPoints::source}) {
    out.add(mesh_of_map(*maps[1], mesh, points));
  }
}

void check_round(Random& random, Digest& out) {
  const FileMesh mesh = careless(random);
  const MeshCheck check = check_file_mesh(mesh, true);
  out.all(check, check_file_mesh(mesh).findings, cells_of_findings(mesh, check));
  FileMesh copy = mesh;
  out.all(tet_mesh_of(std::move(copy)), cell_count(mesh), name_count(mesh),
          label_of(mesh.tetrahedra));
}

bool in_range(const FileMesh& mesh) {
  for (const auto& t : mesh.tetrahedra.corners) {
    for (const std::uint32_t p : t) {
      if (p >= mesh.points.size()) return false;
    }
  }
  return true;
}

void repair_round(Random& random, Digest& out) {
  const FileMesh mesh = careless(random);
  if (!in_range(mesh)) return;
  for (int which = 0; which < 8; ++which) {
    FileMesh mended = mesh;
    Repairs repairs;
    const bool all = which == 7;
    if (all || which == 0) repairs.merge_points = 0;
    if (which == 6) repairs.merge_points = 0.3;
    repairs.drop_duplicates = all || which == 1;
    repairs.split_nonmanifold = all || which == 2;
    repairs.largest_component = all || which == 3;
    repairs.fix_orientation = all || which == 4;
    repairs.drop_unused = all || which == 5;
    out.all(repair(mended, repairs), mended);
  }
  const BoundarySurface surface = boundary_surface(mesh);
  out.all(surface.mesh, surface.lost_cells, surface.lost_points);
}

void crack_round(Random& random, Digest& out) {
  FileMesh mesh = careless(random);
  if (!in_range(mesh)) return;
  const auto links = face_links(mesh);
  out.add(links.findings);
  if (!links) return;
  out.add(links.value->across);
  std::vector<std::array<std::uint32_t, 3>> listed;
  for (std::size_t i = 0; i < 5; ++i) {
    const auto& t = mesh.tetrahedra.corners[below(random, mesh.tetrahedra.corners.size())];
    listed.push_back({t[1], t[0], t[2 + below(random, 2)]});
  }
  const std::array found = {listed_faces(mesh, *links, listed),
                            section_faces(mesh, *links, plane_of(random)),
                            interface_faces(mesh, *links, {"one", "0"})};
  for (const auto& faces : found) {
    out.add(faces);
    if (!faces) continue;
    FileMesh cracked = mesh;
    out.all(open_crack(cracked, *links, *faces), cracked);
  }
  for (const char* word : {"one", "2", "-1", "none", "1x"}) out.add(region_called(mesh, word));
}

void kinds_round(Random& random, Digest& out) {
  const FileMesh mesh = test::mesh_of_kinds(random);
  for (const CellKind kind : all_cell_kinds) {
    FileMesh moved = mesh, dropped = mesh, taken = mesh;
    if (traits_of(kind).lower != kind) move_cells(moved, kind, traits_of(kind).lower);
    drop_cells(dropped, kind);
    std::vector<std::uint32_t> rows;
    for (std::size_t i = rows_of(mesh, kind).count; i > 0; --i) {
      rows.push_back(static_cast<std::uint32_t>(below(random, rows_of(mesh, kind).count)));
    }
    take_cells(taken, kind, rows);
    out.all(moved, dropped, taken, faces_of(kind));
  }
  for (const DataColumn* column : ordered_cell_columns(mesh)) out.add(*column);
  FileMesh linear = mesh, cut = mesh, dealt = mesh;
  make_linear(linear);
  out.all(linear, split_cells(cut), cut);
  const std::vector<bool> used = used_points(mesh);
  for (const bool is_so : used) out.add(is_so);
  out.all(drop_points_out_of_use(linear, used), linear);
  std::vector<CellKind> kind_of_row;
  for (const CellKind kind : all_cell_kinds) {
    columns_of(dealt, kind) = {};
    kind_of_row.insert(kind_of_row.end(), rows_of(dealt, kind).count, kind);
  }
  deal_columns(dealt, test::random_columns(random, kind_of_row.size()), kind_of_row);
  FileMesh raised = mesh;
  out.all(raise_order(raised), raised);
  for (const CellKind kind : all_cell_kinds) {
    const CurvedCells curved = curved_cells(mesh, kind);
    out.all(curved.count, curved.first, curved.most);
  }
  const BoundarySurface skin = boundary_surface(mesh);
  out.all(dealt, skin.mesh, skin.lost_cells, skin.lost_points, has_volume_cells(mesh));
}

void surface_round(Random& random, Digest& out) {
  out.add(check_surface(test::careless_surface(random)));
  const FileMesh mesh = careless(random);
  if (in_range(mesh)) out.add(extent_of_tetrahedra(mesh));
  // Points of whole numbers, shaken by a rounding: near a plane, a line, each other.
  std::vector<Point> points;
  for (int i = 0; i < 30; ++i) {
    points.push_back({1.0 * below(random, 4), 1.0 * below(random, 4), 1.0 * below(random, 4)});
    if (below(random, 3) == 0) points.back()[below(random, 3)] += 0x1p-50 * (unit(random) - 0.5);
  }
  std::vector<SurfaceTriangle> triangles;
  const auto some = [&] { return static_cast<std::uint32_t>(below(random, points.size())); };
  for (std::uint32_t i = 0; i < 60; ++i) {
    const std::uint32_t a = some(), b = some(), c = some(), d = some();
    const Point &p = points[a], &q = points[b], &r = points[c];
    out.add(side_of_plane(p, q, r, points[d]));
    out.add(side_of_line({p[0], p[1]}, {q[0], q[1]}, {r[0], r[1]}));
    triangles.push_back({{a, b, c}, i / 2});
  }
  const Crossings found = find_crossings(points, triangles);
  out.all(found.pairs, found.is_finished);
}

void cells_round(Random& random, Digest& out) {
  TetMesh mesh = body(random);
  const FileMesh file = file_mesh_of(mesh);
  auto dense = build_map(mesh, Severity::warning, MapKernel::dense);
  auto darts = build_map(mesh, Severity::warning, MapKernel::lcc);
  if (!dense) return;
  std::vector<double> mass(dense->tetrahedra(), 1), heat;
  std::vector<std::uint32_t> label(4 * dense->tetrahedra(), 0), nearest(dense->vertices(), 0);
  std::vector<Point> place;
  for (std::size_t v = 0; v < dense->vertices(); ++v) place.push_back(dense->point(VertexId{v}));
  for (std::size_t i = 0; i < label.size(); ++i) label[i] = static_cast<std::uint32_t>(i);
  for (std::size_t v = 0; v < nearest.size(); ++v) nearest[v] = static_cast<std::uint32_t>(v);
  heat.assign(dense->vertices(), 0);
  for (double& h : heat) h = unit(random);
  Journal journal;
  std::vector<CellEdit> edits;
  bool may_file = true;
  for (int step = 0; step < 6 && dense->tetrahedra() > 0 && dense->tetrahedra() < 800; ++step) {
    const auto enter_edit = [&](const CellEdit& edit, const CellEdit& other) {
      out.all(edit, other);
      extend_cells(mass, edit, CellRule::share);
      extend_faces(label, edit, 77U);
      extend_vertices(nearest, edit, VertexRule::nearest);
      extend_vertices(place, edit, VertexRule::interpolate);
      out.add(extend_vertices(heat, edit, VertexRule::interpolate).values);
      enter(journal, edit.undo);
      edits.push_back(edit);
    };
    const std::size_t which = below(random, 5);
    if (which == 0) {
      const CellEdge edge{TetId{below(random, dense->tetrahedra())},
                          static_cast<int>(below(random, 6))};
      const double weight = below(random, 2) == 0 ? 0.5 : 0.1 + 0.8 * unit(random);
      out.add(edge_rows(*dense).of_cell);
      const CellEdit edit = insert_vertex(*dense, edge, weight);
      enter_edit(edit, insert_vertex(*darts, edge, weight));
    } else if (which == 1) {
      std::vector<TetId> marked;
      for (std::size_t i = below(random, 4); i > 0; --i)
        marked.emplace_back(below(random, dense->tetrahedra()));
      const RefinedLevel level = refine_marked(*dense, marked),
                         other = refine_marked(*darts, marked);
      out.all(level.red, level.green, other.red);
      enter_edit(level.edit, other.edit);
      VolumeMap copy = *dense;
      const auto wanted = [&marked](const VolumeMap&, TetId, TetId of) {
        return std::ranges::find(marked, of) != marked.end();
      };
      for (const RefinedLevel& l : refine(copy, 2, wanted)) out.all(l.red, l.green, l.edit);
      out.add(copy);
    } else if (which == 2) {
      const CuttingPlane plane = plane_of(random);
      auto made = cut_cells(*dense, plane);
      auto other = cut_cells(*darts, plane);
      out.add(made.findings);
      if (!made) continue;
      out.all(made->faces, made->on_plane, other->faces);
      enter_edit(made->edit, other->edit);
    } else if (which == 3) {
      may_file = false;
      const HalfFaceId f{below(random, 4 * dense->tetrahedra())};
      if (dense->neighbour(f).is_none()) continue;
      const FaceSplit split = split_face(*dense, f, journal);
      split_face(*darts, f);
      out.add(split);
      extend_vertices(nearest, split), extend_vertices(place, split);
      share_vertices(heat, split, parted_shares(*dense, split));
    } else if (!journal.undo.empty()) {
      VolumeMap copy = *dense;
      Journal of_copy = journal;
      while (undo(copy, of_copy)) out.add(copy);
      while (below(random, 4) != 0 && redo(copy, of_copy)) out.add(copy);
    }
    out.all(*dense, *darts, mass, label, nearest, place, heat, check(*darts), count_cells(*darts));
  }
  if (may_file && !edits.empty()) {
    FileMesh divided = file;
    for (std::size_t i = 0; i < 30; ++i) {
      const auto& t = file.tetrahedra.corners[below(random, file.tetrahedra.corners.size())];
      divided.triangles.corners.push_back({t[0], t[1], t[2]});
      divided.edges.corners.push_back({t[1], t[3]});
    }
    divided.tetrahedra.data.push_back(
        {"mass", 1, NumberType::float64, std::vector<double>(file.tetrahedra.corners.size(), 1)});
    divided.point_region.assign(divided.points.size(), 1);
    divided.point_region.front() = 2;
    divided.tetrahedra.source_id.assign(file.tetrahedra.corners.size(), 3);
    try {
      const DividedFile d = divide_file(divided, *dense, edits, {"mass"});
      out.all(d.divided, d.numbers_added, divided);
    } catch (const std::exception& error) {
      out.add(std::string(error.what()));
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return fmt::print(stderr, "usage: {} ROUNDS SEED\n", argv[0]), 2;
  const std::uint64_t rounds = std::strtoull(argv[1], nullptr, 10);
  const std::map<std::string, void (*)(Random&, Digest&)> areas = {
      {"kernel", kernel_round}, {"check", check_round}, {"repair", repair_round},
      {"crack", crack_round},   {"kinds", kinds_round}, {"surface", surface_round},
      {"cells", cells_round},   {"parts", parts_round}};
  for (const auto& [name, round] : areas) {
    Digest out;
    for (std::uint64_t i = 0; i < rounds; ++i) {
      Random random(std::strtoull(argv[2], nullptr, 10) + 1000003 * i);
      round(random, out);
    }
    fmt::print("{} {:016x}\n", name, out.value);
    std::fflush(stdout);
  }
  if (const char* path = std::getenv("SUNDER_REACHED")) {
    std::FILE* reached = std::fopen(path, "w");
    for (std::size_t n = 0; n < sizeof sunder_reached_faults; ++n) {
      if (sunder_reached_faults[n] != 0) fmt::print(reached, "{} ", n);
    }
    std::fclose(reached);
  }
}
