// SPDX-License-Identifier: MIT
// Single functions of topology/{base,kernel,cells,mesh}, and right maps made wrong.
#pragma once

#include "tests/mutants/operators/digest.hpp"
#include "tests/support/random_meshes.hpp"
#include "topology/base/split_text.hpp"
#include "topology/cells/cell_templates.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/mesh/check.hpp"
#include "topology/mesh/kinds/cell_kinds.hpp"
#include "topology/mesh/repair.hpp"

namespace sunder::test {

/// Functions that the other areas call seldom or with right numbers only.
inline void parts_round(Random& random, Digest& out) {
  std::string text;
  for (std::size_t i = suite::below(random, 12); i > 0; --i)
    text += "ab,\n"[suite::below(random, 4)];
  for (const std::string_view part : split_text(text, ',')) out.add(std::string(part));
  for (const Severity s : {Severity::note, Severity::warning, Severity::error}) {
    out.add(std::string(to_string(s)));
  }
  for (unsigned edges = 0; edges < 64; ++edges) out.add(is_divisible(edges));
  for (const CellKind kind : all_cell_kinds) {
    out.add(held_kind(static_cast<KindSet>(suite::below(random, all_kinds + 1)), kind));
  }
  TetMesh mesh = body(random);
  const Result<VolumeMap> map = build_map(mesh, Severity::warning, MapKernel::dense);
  if (map && map->tetrahedra() > 0) {
    std::vector<std::array<std::uint32_t, 3>> wanted;
    for (int i = 0; i < 9; ++i) {
      const auto& t = mesh.tetrahedra[suite::below(random, mesh.tetrahedra.size())];
      wanted.push_back({t[suite::below(random, 4)], t[3], t[1]});
    }
    out.add(find_faces(*map, wanted));
    MapRows rows = map->dense().rows();
    for (int i = 0; i < 40; ++i) {
      rows.corners[suite::below(random, rows.corners.size())][suite::below(random, 4)] =
          VertexId{suite::below(random, map->vertices() + 1)};
    }
    const auto begins = map->dense().incident_tetrahedra();
    out.add(check(VolumeMap(rows, {begins.begin(), begins.end()})));
  }
  mesh.region.assign(suite::below(random, 3), 1);
  mesh.source_point_id.assign(suite::below(random, 3), 1);
  out.add(check_mesh(mesh));
  FileMesh close;
  for (int i = 0; i < 12; ++i) close.points.push_back({suite::unit(random), 0, 0});
  out.all(merge_points(close, 0.2), close);
}

}  // namespace sunder::test
