// SPDX-License-Identifier: MIT
// Columns of a frame from the state of a simulation.
#include "apps/output/frame.hpp"

#include <array>
#include <cstdint>

#include "apps/output/node_mesh.hpp"
#include "fracture/algorithms/find_fractures.hpp"
#include "fracture/algorithms/threshold_test.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/io/vtu/vtu.hpp"

namespace sunder {
namespace {

/// The body and region that every tetrahedron came from. Splits do not change them.
struct Origins {
  std::vector<std::int32_t> body;
  /// 0 where the mesh names no regions.
  std::vector<std::int32_t> region;
};

Origins origins(const std::vector<BodySettings>& bodies) {
  Origins result;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const TetMesh& mesh = bodies[b].mesh;
    result.body.resize(result.body.size() + mesh.tetrahedra.size(), static_cast<std::int32_t>(b));
    result.region.insert(result.region.end(), mesh.region.begin(), mesh.region.end());
    result.region.resize(result.body.size(), 0);
  }
  return result;
}

/// Point data of a frame, a row a vertex.
struct VertexData {
  std::vector<Vec3> displacement;  ///< m, world
  std::vector<double> stress;      ///< Pa, world, six each in VTK's order
  std::vector<double> largest;     ///< Pa
};

VertexData vertex_data(const MechanicsState& mechanics, const std::vector<Mat3>& node_stress) {
  const VertexColumns& v = mechanics.vertices;
  VertexData data;
  data.displacement.reserve(v.size());
  data.stress.reserve(6 * v.size());
  data.largest.reserve(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Component& component = mechanics.components[v.component[i].index()];
    const Mat3 R = component.orientation.toRotationMatrix();
    data.displacement.emplace_back(R * v.displacement[i]);
    const Mat3 s = R * node_stress[i] * R.transpose();
    data.stress.insert(data.stress.end(), {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)});
    data.largest.push_back(largest_principal_stress(node_stress[i]));
  }
  return data;
}

/// Moves of points at rest as those of vertices in the world; nothing without any.
std::vector<Vec3> turned_moves(const Cells& cells, const MechanicsState& mechanics,
                               std::span<const Vec3> moves) {
  std::vector<Vec3> turned;
  for (std::size_t i = 0; !moves.empty() && i < mechanics.vertices.size(); ++i) {
    const Component& piece = mechanics.components[mechanics.vertices.component[i].index()];
    turned.emplace_back(piece.orientation * moves[cells.map.point_of_vertex(VertexId{i})]);
  }
  return turned;
}

}  // namespace

std::vector<Finding> write_frame(const std::filesystem::path& path, const Simulation& simulation,
                                 std::span<const Vec3> moves) {
  const Cells& cells = simulation.state->cells;
  const MechanicsState& mechanics = simulation.state->mechanics;
  const VertexColumns& v = mechanics.vertices;
  const VertexData data = vertex_data(
      mechanics, node_stress_of(cells, mechanics, simulation.scene.fracture.node_stress));
  const std::vector<Vec3> turned = turned_moves(cells, mechanics, moves);
  if (!mechanics.elements.edge_nodes.empty()) {
    FileMesh nodes = node_mesh(simulation);
    add_node_column(nodes, "displacement", data.displacement);
    add_node_column(nodes, "velocity", v.velocity);
    add_node_column(nodes, "node_stress", data.stress, 6);
    add_node_column(nodes, "largest_principal_stress", data.largest, 1);
    if (!turned.empty()) add_node_column(nodes, "crack_move", turned);
    return write_file_mesh(path, nodes, {.format = MeshFormat::vtu});
  }
  TetMesh mesh;
  mesh.points.reserve(v.size());
  for (const Vec3& x : v.position) mesh.points.push_back({x[0], x[1], x[2]});
  std::vector<std::uint32_t> component;
  component.reserve(cells.map.tetrahedra());
  mesh.tetrahedra.reserve(cells.map.tetrahedra());
  for (const std::array<VertexId, 4>& c : cells.map.corners()) {
    mesh.tetrahedra.push_back({c[0].value, c[1].value, c[2].value, c[3].value});
    component.push_back(cells.labels.of_tetrahedron[component.size()].value);
  }
  const Origins origin = origins(simulation.scene.bodies);
  std::vector point_data = {
      vector_column("displacement", data.displacement), vector_column("velocity", v.velocity),
      NamedColumn{"node_stress", std::span<const double>(data.stress), 6},
      NamedColumn{"largest_principal_stress", std::span<const double>(data.largest)}};
  if (!turned.empty()) point_data.push_back(vector_column("crack_move", turned));
  std::vector cell_data = {NamedColumn{"component", std::span<const std::uint32_t>(component)},
                           NamedColumn{"body", std::span<const std::int32_t>(origin.body)},
                           NamedColumn{"region", std::span<const std::int32_t>(origin.region)}};
  const CrackData cracks = crack_data(cells, simulation.scene.fracture.crack);
  if (!cracks.crack.empty()) {
    cell_data.push_back({"crack", std::span<const std::int32_t>(cracks.crack)});
    cell_data.push_back({"crack_side", std::span<const std::int32_t>(cracks.side)});
  }
  return write_vtu(path, mesh, point_data, cell_data);
}

}  // namespace sunder
