// SPDX-License-Identifier: MIT
// A fracture operation of one's own. Where the largest principal stress passes the strength, a
// vertex is torn: faces at it are split, those across the pull first, until it comes apart.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <sunder/cells.hpp>
#include <sunder/cgal_map.hpp>
#include <sunder/rows.hpp>
#include <sunder/scene.hpp>

using namespace sunder;

/// The inner face at a vertex that lies most nearly across `pull`; none() when all are open.
HalfFaceId face_across(const Simulation& sim, VertexId v, const Vec3& pull) {
  const DartMap& darts = map_of(sim).darts();
  const auto at = [&](DartMap::Dart d) {  // from a dart to a column
    return rows_of(sim).rest_position[darts.vertex(d).index()];
  };
  HalfFaceId best = HalfFaceId::none();
  double most = -1;
  auto faces = darts.complex().one_dart_per_incident_cell<2, 0>(darts.dart(v));
  for (auto it = faces.begin(); it != faces.end(); ++it) {
    const DartMap::Dart d = darts.dart(it);
    if (darts.is_free(d)) continue;
    const Vec3 a = at(d), b = at(darts.beta1(d)), c = at(darts.beta0(d));
    const double across = std::abs((b - a).cross(c - a).normalized().dot(pull));
    if (across > most) most = across, best = darts.half_face_of(d);  // and back to a row
  }
  return best;
}

/// Tears the vertex with the largest stress beside its strength of those that can be; false when
/// none passes it. `torn` is a column of one's own: how often the vertex, or the one it was once,
/// has been torn.
bool tear(Simulation& sim, std::vector<int>& torn) {
  struct Candidate {
    double ratio;
    VertexId vertex;
    Vec3 pull;
  };
  std::vector<Candidate> over;
  const std::vector<Mat3> stress = vertex_stress(sim);
  const auto strength = rows_of(sim).strength;
  for (std::size_t v = 0; v < stress.size(); ++v) {
    const Eigen::SelfAdjointEigenSolver<Mat3> principal(stress[v]);
    const double ratio = principal.eigenvalues()[2] / strength[v];
    if (ratio > 1) over.push_back({ratio, VertexId{v}, principal.eigenvectors().col(2)});
  }
  std::ranges::sort(over, std::greater<>(), &Candidate::ratio);
  for (const auto& [ratio, vertex, pull] : over) {
    HalfFaceId face = face_across(sim, vertex, pull);
    if (face.is_none()) continue;
    ++torn[vertex.index()];
    for (bool apart = false; !apart && !face.is_none(); face = face_across(sim, vertex, pull)) {
      const Result<FanEvent> event = split_faces(sim, std::span(&face, 1));
      for (const FaceSplit& split : event->faces) {
        extend_vertices(torn, split);  // by the rule copy
        for (int i = 0; i < split.vertex_count; ++i) {
          apart |= split.split_vertices[i].old_row == vertex;
        }
      }
    }
    return true;
  }
  return false;
}

int main(int argc, char** argv) {
  if (argc != 2) return std::puts("usage: tear SCENE.json"), 2;
  auto file = read_scene(argv[1]);
  if (!file) return std::puts(file.findings.front().text.c_str()), 3;
  file->scene.duration = 0.1;
  file->scene.topology.kernel = MapKernel::lcc;   // CGAL's darts answer
  file->scene.fracture.mode = FractureMode::off;  // and nobody breaks but we
  auto sim = build_simulation(file->scene);
  if (!sim) return std::puts(sim.findings.front().text.c_str()), 3;
  std::vector<int> torn(map_of(*sim).vertices());
  std::size_t pieces = 0;
  for (const auto n = step_count(sim->scene); steps_taken(*sim) < n;) {
    for (int i = 0; i < 20 && tear(*sim, torn); ++i) {
    }
    pieces = advance(*sim).components;
    const std::vector<Finding> damage = check_map(*sim);
    if (!damage.empty()) return std::puts(damage.front().text.c_str()), 1;
  }
  std::printf("%zu pieces, %zu vertices, the most torn %d times\n", pieces, torn.size(),
              *std::max_element(torn.begin(), torn.end()));
}
