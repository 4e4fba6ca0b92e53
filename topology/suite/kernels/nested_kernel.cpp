// SPDX-License-Identifier: MIT
// Two nested maps under judgement: a `DenseMap` that answers, and a finer `VolumeMap` with faces
// that are opened beforehand, like the faces of a crack that is still tied.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "topology/kernel/components.hpp"
#include "topology/kernel/dense_map.hpp"
#include "topology/kernel/invariants.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/suite/kernels/map_answers.hpp"

namespace sunder::suite {
namespace {

struct NestedMaps {
  std::optional<VolumeMap> fine;
  DenseMap coarse;
  std::vector<std::array<std::uint32_t, 4>> file;
  Components labels;
  ComponentScratch scratch;
  std::vector<std::string> faults;
};

/// Whether a face is open in the finer map from the beginning: about every third, of large bodies
/// every ninth (stars with a third of their faces open hardly hang together any more, and each
/// search in them goes far).
bool is_ahead(const DenseMap& map, HalfFaceId f, HalfFaceId across) {
  const std::size_t each = map.tetrahedra() > 20000 ? 9 : 3;
  return (std::min(f, across).index() * 2654435761U >> 7) % each == 0;
}

std::vector<Finding> load(NestedMaps& maps, const TetMesh& mesh) {
  Result<VolumeMap> built = build_map(mesh, Severity::warning);
  maps = {};
  maps.file = mesh.tetrahedra;
  maps.fine = std::move(built.value);
  if (!maps.fine) return built.findings;
  maps.coarse = maps.fine->dense();
  maps.labels = label_components(maps.coarse);
  for (std::size_t f = 0; f < 4 * maps.coarse.tetrahedra(); ++f) {
    const HalfFaceId across = maps.coarse.neighbour(HalfFaceId{f});
    if (across.is_none() || !is_ahead(maps.coarse, HalfFaceId{f}, across)) continue;
    split_face(*maps.fine, HalfFaceId{f});
  }
  return built.findings;
}

SplitAnswer split(NestedMaps& maps, FaceSide side) {
  const HalfFaceId face = half_face_at(maps.coarse, side);
  split_face(*maps.fine, face);
  const FaceSplit did = split_face(maps.coarse, face);
  SplitAnswer answer = in_file_points(maps.coarse, did);
  if (!did.did) return answer;
  answer.separated = update_components(maps.coarse, std::span(&did, 1), Detection::exact,
                                       maps.labels, maps.scratch)
                         .created > 0;
  return answer;
}

bool glue(NestedMaps& maps, FaceSide a, FaceSide b) {
  const HalfFaceId f = half_face_at(maps.coarse, a), g = half_face_at(maps.coarse, b);
  if (glue_face(maps.coarse, f, g).refusal != GlueRefusal::none) return false;
  maps.labels = label_components(maps.coarse);
  // A glued face is sewn in both maps, or tied: then the finer map stays as it is.
  const bool sewn =
      is_ahead(maps.coarse, f, g) || glue_face(*maps.fine, f, g).refusal == GlueRefusal::none;
  if (!sewn) maps.faults.emplace_back("the finer map refuses to be glued");
  return true;
}

/// Sewn in the finer map is sewn in the coarser one to the same face, and each vertex of the finer
/// lies in one of the coarser.
void judge_nesting(NestedMaps& maps) {
  std::vector<VertexId> lies_in(maps.fine->vertices(), VertexId::none());
  for (std::size_t t = 0; t < maps.coarse.tetrahedra(); ++t) {
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId f = half_face(TetId{t}, p);
      const HalfFaceId across = maps.fine->neighbour(f);
      if (!across.is_none() && across != maps.coarse.neighbour(f)) {
        maps.faults.emplace_back("a face is sewn in the finer map, not in the coarser");
      }
      const VertexId within = maps.coarse.corners(TetId{t})[p];
      VertexId& seen = lies_in[maps.fine->corners(TetId{t})[p].index()];
      if (!seen.is_none() && seen != within) {
        maps.faults.emplace_back("a vertex of the finer map lies in two of the coarser");
      }
      seen = within;
    }
  }
}

std::vector<std::string> own_faults(NestedMaps& maps) {
  judge_nesting(maps);
  for (const Finding& f : check(*maps.fine)) maps.faults.push_back(f.code + ": " + f.text);
  for (std::size_t v = 0; v < maps.coarse.vertices(); ++v) {
    const TetId t = maps.coarse.incident_tetrahedron(VertexId{v});
    if (t.is_none()) continue;
    const auto& rows = maps.coarse.corners(t);
    if (std::ranges::find(rows, VertexId{v}) == rows.end()) {
      maps.faults.emplace_back("a vertex is not in its incident tetrahedron");
    }
  }
  return std::exchange(maps.faults, {});
}

}  // namespace

JudgedKernel nested_kernel() {
  const auto maps = std::make_shared<NestedMaps>();
  JudgedKernel kernel;
  kernel.name = "nested";
  kernel.names_findings = true;
  kernel.load = [maps](const TetMesh& mesh) { return load(*maps, mesh); };
  kernel.split = [maps](FaceSide side) { return split(*maps, side); };
  kernel.glue = [maps](FaceSide a, FaceSide b) { return glue(*maps, a, b); };
  kernel.counts = [maps] { return cell_counts(maps->coarse); };
  kernel.vertex_of_corner = [maps] { return vertex_of_corner(maps->coarse, maps->file); };
  kernel.component_of_tetrahedron = [maps] {
    std::vector<std::uint32_t> labels;
    for (const ComponentId c : maps->labels.of_tetrahedron) labels.push_back(c.value);
    return labels;
  };
  kernel.own_faults = [maps] { return own_faults(*maps); };
  return kernel;
}

}  // namespace sunder::suite
