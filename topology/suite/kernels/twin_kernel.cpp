// SPDX-License-Identifier: MIT
// The union-find twin as a kernel, with checks of its own: it refuses faces that cannot be glued.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "topology/suite/homology/homology.hpp"
#include "topology/suite/judge/glue_twin.hpp"
#include "topology/suite/kernels/judged_kernel.hpp"

namespace sunder::suite {
namespace {

using Quad = std::array<std::uint32_t, 4>;

Finding refusal(const std::string& code, const std::string& text) {
  Finding finding;
  finding.code = code;
  finding.text = text;
  finding.remedy = "mend the body";
  return finding;
}

/// Faults of single tetrahedra and points.
std::set<std::string> cell_faults(const TetMesh& mesh) {
  std::set<std::string> codes;
  if (mesh.tetrahedra.empty()) codes.insert(mesh.points.empty() ? "empty_mesh" : "no_tetrahedron");
  for (const Point& p : mesh.points) {
    for (const double x : p) {
      if (!std::isfinite(x)) codes.insert("nan_coordinate");
    }
  }
  for (const Quad& t : mesh.tetrahedra) {
    for (const std::uint32_t p : t) {
      if (p >= mesh.points.size()) codes.insert("index_out_of_range");
    }
    if (std::set<std::uint32_t>(t.begin(), t.end()).size() < 4) codes.insert("repeated_vertex");
  }
  return codes;
}

/// Whether a and b, the same four points, run through them in the same sense.
bool same_sense(const Quad& a, Quad b) {
  bool same = true;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto j = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[i]) - b.begin());
    if (i == j) continue;
    std::swap(b[i], b[j]);
    same = !same;
  }
  return same;
}

/// Faults that keep faces from being glued in pairs.
std::set<std::string> gluing_faults(const TetMesh& mesh) {
  std::set<std::string> codes;
  std::map<Quad, Quad> seen;
  std::map<std::array<std::uint32_t, 3>, int> sides;
  for (const Quad& t : mesh.tetrahedra) {
    Quad sorted = t;
    std::sort(sorted.begin(), sorted.end());
    const auto [it, fresh] = seen.emplace(sorted, t);
    if (!fresh) {
      codes.insert(same_sense(it->second, t) ? "duplicate_tetrahedron" : "mirrored_tetrahedron");
      continue;
    }
    for (std::size_t p = 0; p < 4; ++p) {
      std::array<std::uint32_t, 3> face;
      std::copy_if(sorted.begin(), sorted.end(), face.begin(),
                   [&](std::uint32_t x) { return x != sorted[p]; });
      if (++sides[face] > 2) codes.insert("overfull_face");
    }
  }
  return codes;
}

struct Twin {
  GlueTwin glue;

  HalfFaceId half_face_at(FaceSide side) const {
    const Quad& t = glue.tetrahedra[side.tetrahedron];
    const auto place = std::find(t.begin(), t.end(), side.opposite) - t.begin();
    return half_face(TetId{side.tetrahedron}, static_cast<int>(place));
  }
};

std::vector<Finding> load(Twin& twin, const TetMesh& mesh) {
  twin.glue = {};
  std::set<std::string> codes = cell_faults(mesh);
  if (codes.empty()) codes = gluing_faults(mesh);
  if (codes.empty()) {
    twin.glue = glue_twin(mesh.tetrahedra, mesh.points.size());
    if (!is_orientable(twin.glue)) codes.insert("non_orientable");
  }
  std::vector<Finding> findings;
  for (const std::string& code : codes) findings.push_back(refusal(code, "found by the twin"));
  return findings;
}

SplitAnswer split(Twin& twin, FaceSide side) {
  SplitAnswer answer;
  const HalfFaceId face = twin.half_face_at(side);
  if (twin.glue.glued[face.index()].is_none()) return answer;
  const LocalTruth truth = unglue(twin.glue, face);
  answer.did = true;
  answer.separated = truth.separated;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t p = truth.points[i], q = truth.points[(i + 1) % 3];
    if (truth.vertex_split[i]) answer.vertices.push_back(p);
    if (truth.edge_split[i]) answer.edges.push_back({std::min(p, q), std::max(p, q)});
  }
  std::sort(answer.vertices.begin(), answer.vertices.end());
  std::sort(answer.edges.begin(), answer.edges.end());
  return answer;
}

bool glue(Twin& twin, FaceSide a, FaceSide b) {
  const HalfFaceId f = twin.half_face_at(a), g = twin.half_face_at(b);
  if (f == g || !twin.glue.glued[f.index()].is_none() || !twin.glue.glued[g.index()].is_none()) {
    return false;
  }
  glue_again(twin.glue, f, g);
  return true;
}

CellCounts counts(const Twin& twin) {
  const TwinCounts c = union_find_counts(twin.glue);
  return {c.vertices,   c.edges,          c.faces,          c.tetrahedra,
          c.components, c.boundary_faces, c.boundary_sheets};
}

}  // namespace

JudgedKernel twin_kernel() {
  const auto twin = std::make_shared<Twin>();
  JudgedKernel kernel;
  kernel.name = "twin";
  kernel.load = [twin](const TetMesh& mesh) { return load(*twin, mesh); };
  kernel.split = [twin](FaceSide side) { return split(*twin, side); };
  kernel.glue = [twin](FaceSide a, FaceSide b) { return glue(*twin, a, b); };
  kernel.counts = [twin] { return counts(*twin); };
  kernel.vertex_of_corner = [twin] { return corner_classes(twin->glue); };
  kernel.component_of_tetrahedron = [twin] { return component_classes(twin->glue); };
  kernel.homology = [twin]() -> std::optional<IntegerHomology> {
    return integer_homology(orbit_complex(twin->glue));
  };
  kernel.orientable = [twin] { return std::optional<bool>(is_orientable(twin->glue)); };
  return kernel;
}

}  // namespace sunder::suite
