// SPDX-License-Identifier: MIT
// The paper's four algorithms in their order, on a bar that is stretched, turned and let go.
#include <cstdio>

#include "fracture/algorithms/find_fractures.hpp"
#include "fracture/algorithms/split_fan.hpp"
#include "mechanics/element/elastic_force.hpp"
#include "mechanics/measure_elements.hpp"
#include "mechanics/rebuild.hpp"
#include "topology/kernel/components.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

/// Algorithm 3 asks for thresholds, and hands each vertex over its own to algorithm 4.
struct PaperSearch {
  BreakableBody body;
  const FractureSettings& settings;
  FractureReport& report;
  std::vector<double> threshold_of = body.cells.strength;
  ComponentScratch scratch = {};

  std::optional<double> threshold(VertexId v) { return threshold_of[v.index()]; }
  void split(VertexId v, const PrincipalTension& tension) {
    report.fans.push_back(split_fan(body, vertex_star(body.cells.map, v), tension.directions.col(0),
                                    settings, scratch));
  }
};

}  // namespace

int main() {
  VolumeMap map = std::move(*build_map(suite::kuhn_box({8, 2, 2}, 0.05)));
  std::vector<Vec3> rest;
  for (std::size_t v = 0; v < map.vertices(); ++v) {
    const Point& p = map.point(VertexId{v});
    rest.emplace_back(p[0], p[1], p[2]);
  }
  const std::vector<Material> concrete = {Material{}};
  MechanicsState state = std::move(
      *make_state({.rest_positions = rest, .corners = map.corners(), .materials = concrete}));
  Cells cells = make_cells(std::move(map), state);

  // Where the bar is: stretched by a quarter more than its strength bears, and turned.
  const double strain = 1.25 * concrete[0].tensile_strength / concrete[0].young_modulus;
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (std::size_t v = 0; v < rest.size(); ++v) {
    state.vertices.position[v] = turn * Vec3(rest[v] + strain * rest[v].x() * Vec3::UnitX());
  }

  // Algorithms 1 and 2: the rigid reference, displacements against it, and elastic forces.
  std::vector<Vec3> force(rest.size());
  const Pose frame = deformation_forces({state.vertices.displacement, force},
                                        {state, cells.map.corners(), state.vertices.position},
                                        state.components[0]);
  std::printf("the reference has turned by %.3f rad; the first vertex is pulled by %.0f N\n",
              frame.orientation.angularDistance(Eigen::Quaterniond::Identity()), force[0].norm());

  // Equation 5: the stress of each tetrahedron.
  MechanicsScratch scratch;
  measure_elements(state, scratch, cells.map.corners(), {});

  // Algorithms 3 and 4: the stress of each vertex, and a fan of faces unsewn where it is too large.
  FractureSettings settings;
  settings.node_stress = NodeStress::mass;
  settings.test = ThresholdTest::gershgorin;
  settings.detection = Detection::oracle;
  FractureReport report;
  NodeStressField field;
  find_fractures(report, field, cells, element_stress(cells, state, settings.node_stress), settings,
                 PaperSearch{{cells, state}, settings, report});
  std::size_t faces = 0;
  for (const FanEvent& fan : report.fans) faces += fan.faces.size();
  std::printf("%zu vertices are over their threshold; %zu fans open %zu faces; %zu pieces\n",
              static_cast<std::size_t>(report.reached), report.fans.size(), faces,
              cells.labels.size.size());
}
