// SPDX-License-Identifier: MIT
// From nodes in the order of `edge_ends` to VTK's.
#include "apps/output/node_mesh.hpp"

#include <utility>
#include <vector>

#include "fracture/simulation/simulation_state.hpp"

namespace sunder {
namespace {

/// Columns of the cells of one order.
struct CellData {
  std::vector<std::int64_t> component, body, crack, crack_side;
};

void put_down(CellColumns& columns, CellData data) {
  if (data.component.empty()) return;
  const auto add = [&](const char* name, std::vector<std::int64_t> values) {
    columns.data.push_back({name, 1, NumberType::int32, std::move(values)});
  };
  add("component", std::move(data.component));
  add("body", std::move(data.body));
  if (data.crack.empty()) return;
  add("crack", std::move(data.crack));
  add("crack_side", std::move(data.crack_side));
}

}  // namespace

CrackData crack_data(const Cells& cells, CrackMode mode) {
  CrackData data;
  if (mode == CrackMode::paper) return data;
  data.crack.assign(cells.map.tetrahedra(), -1);
  data.side.assign(cells.map.tetrahedra(), 0);
  for (const CrackLabel& label : cells.cracks.labels) {
    data.crack[label.tetrahedron.index()] = static_cast<std::int32_t>(label.crack.value);
    data.side[label.tetrahedron.index()] = label.positive ? 1 : -1;
  }
  return data;
}

FileMesh node_mesh(const Simulation& simulation) {
  const MechanicsState& mechanics = simulation.state->mechanics;
  const auto corners = simulation.state->cells.map.corners();
  FileMesh mesh;
  for (const Vec3& x : mechanics.vertices.position) mesh.points.push_back({x[0], x[1], x[2]});
  OtherCells& second = other_cells(mesh, CellKind::tetrahedron10);
  CellData of_first, of_second;
  const CrackData cracks = crack_data(simulation.state->cells, simulation.scene.fracture.crack);
  for (std::size_t b = 0; b < simulation.bodies.size(); ++b) {
    const BodyRows& rows = simulation.bodies[b];
    const std::vector<std::int32_t>& region = simulation.scene.bodies[b].mesh.region;
    for (std::size_t t = rows.first_tetrahedron; t < rows.end_tetrahedron; ++t) {
      const bool is_second = is_second_order(mechanics.elements, TetId{t});
      const Corners& c = corners[t];
      if (is_second) {
        for (const VertexId v : c) second.points.push_back(v.value);
        for (const auto& [i, j] : edges_of(CellKind::tetrahedron)) {
          const auto e = static_cast<std::size_t>(edge_between(i, j));
          second.points.push_back(mechanics.elements.edge_nodes[t][e].value);
        }
      } else {
        mesh.tetrahedra.corners.push_back({c[0].value, c[1].value, c[2].value, c[3].value});
      }
      CellColumns& columns = is_second ? static_cast<CellColumns&>(second) : mesh.tetrahedra;
      columns.region.push_back(region.empty() ? 0 : region[t - rows.first_tetrahedron]);
      CellData& data = is_second ? of_second : of_first;
      data.component.push_back(simulation.state->cells.labels.of_tetrahedron[t].value);
      data.body.push_back(static_cast<std::int64_t>(b));
      if (cracks.crack.empty()) continue;
      data.crack.push_back(cracks.crack[t]);
      data.crack_side.push_back(cracks.side[t]);
    }
  }
  put_down(mesh.tetrahedra, std::move(of_first));
  put_down(second, std::move(of_second));
  return mesh;
}

void add_node_column(FileMesh& mesh, std::string name, std::span<const double> values,
                     std::size_t components) {
  mesh.point_data.push_back({std::move(name), components, NumberType::float64,
                             std::vector<double>(values.begin(), values.end())});
}

void add_node_column(FileMesh& mesh, std::string name, std::span<const Vec3> values) {
  std::vector<double> numbers;
  for (const Vec3& v : values) numbers.insert(numbers.end(), {v[0], v[1], v[2]});
  add_node_column(mesh, std::move(name), numbers, 3);
}

}  // namespace sunder
