// SPDX-License-Identifier: MIT
// Equilibrium and natural modes of a scene.
#include "fracture/simulation/statics/statics.hpp"

#include <pybind11/stl.h>

#include "apps/python/arrays.hpp"
#include "apps/python/bindings.hpp"
#include "apps/python/findings.hpp"
#include "apps/python/scene_input.hpp"
#include "fracture/simulation/rows.hpp"

namespace sunder::python {
namespace {

py::dict extreme_of(const Extreme& e) {
  py::dict result;
  result["value"] = e.value;
  result["point"] = e.point;
  result["position"] = array_of(e.position);
  return result;
}

py::dict body_of(const BodyEquilibrium& b) {
  py::dict body;
  body["name"] = b.name;
  body["mass"] = b.mass;
  body["displacement"] = extreme_of(b.displacement);
  body["principal_stress"] = extreme_of(b.principal_stress);
  body["strength_share"] = extreme_of(b.strength_share);
  body["strain_energy"] = b.strain_energy;
  body["load"] = array_of(b.load);
  body["residual"] = b.residual;
  py::list supports;
  for (const SupportReaction& s : b.supports) {
    py::dict support;
    support["vertices"] = s.vertices;
    support["force"] = array_of(s.force);
    support["moment"] = array_of(s.moment);
    supports.append(support);
  }
  body["supports"] = supports;
  return body;
}

/// The simulation of a scene at its start, for statics.
Simulation at_rest(const SceneInput& input, std::vector<Finding>& findings) {
  SceneFile file = read_input(input, findings);
  Result<Simulation> built = build_statics(std::move(file.scene));
  findings.insert(findings.end(), built.findings.begin(), built.findings.end());
  return value_of(std::move(built));
}

py::dict solve(const SceneInput& input) {
  std::vector<Finding> findings;
  Simulation simulation;
  const Equilibrium equilibrium = unlocked([&] {
    simulation = at_rest(input, findings);
    Result<Equilibrium> solved = solve_scene(simulation);
    findings.insert(findings.end(), solved.findings.begin(), solved.findings.end());
    return value_of(std::move(solved));
  });
  py::dict result;
  py::list bodies;
  for (const BodyEquilibrium& body : equilibrium.bodies) bodies.append(body_of(body));
  result["bodies"] = bodies;
  const SimulationRows rows = rows_of(simulation);
  result["rest_positions"] = array_of(rows.rest_position);
  result["positions"] = array_of(rows.position);
  py::array_t<double> stress(
      {static_cast<py::ssize_t>(equilibrium.node_stress.size()), py::ssize_t{3}, py::ssize_t{3}});
  double* out = stress.mutable_data();
  for (const Mat3& sigma : equilibrium.node_stress) {
    std::memcpy(out, sigma.data(), 9 * sizeof(double));  // symmetric: its order does not matter
    out += 9;
  }
  result["stress"] = stress;
  result["findings"] = py::cast(findings);
  return result;
}

py::list modes(const SceneInput& input, std::size_t count) {
  const std::vector<PieceModes> found = unlocked([&] {
    std::vector<Finding> findings;
    Simulation simulation = at_rest(input, findings);
    return value_of(scene_modes(simulation, count));
  });
  py::list pieces;
  for (const PieceModes& piece : found) {
    py::dict entry;
    entry["body"] = piece.body;
    entry["rigid"] = piece.rigid;
    entry["frequencies"] = copied<double>(std::span(piece.frequency), 0);
    entry["vertices"] = ids<VertexId>(piece.vertex);
    py::array_t<double> shapes({static_cast<py::ssize_t>(piece.shape.size()),
                                static_cast<py::ssize_t>(piece.vertex.size()), py::ssize_t{3}});
    double* out = shapes.mutable_data();
    for (const std::vector<Vec3>& shape : piece.shape) {
      std::memcpy(out, shape.data(), shape.size() * sizeof(Vec3));
      out += 3 * shape.size();
    }
    entry["shapes"] = shapes;
    pieces.append(entry);
  }
  return pieces;
}

}  // namespace

void bind_statics(py::module_& module) {
  module.def("static", &solve, py::arg("scene"));
  module.def("modes", &modes, py::arg("scene"), py::arg("count"));
}

}  // namespace sunder::python
