// SPDX-License-Identifier: MIT
// Momenta and energies as plain sums over rows.
#include "mechanics/energy.hpp"

#include "mechanics/strain_displacement.hpp"

namespace sunder {

Vec3 momentum(const VertexColumns& vertices) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t v = 0; v < vertices.size(); ++v) sum += vertices.mass[v] * vertices.velocity[v];
  return sum;
}

Vec3 angular_momentum(const VertexColumns& vertices) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    sum += vertices.mass[v] * vertices.position[v].cross(vertices.velocity[v]);
  }
  return sum;
}

double kinetic_energy(const VertexColumns& vertices) {
  double sum = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    sum += 0.5 * vertices.mass[v] * vertices.velocity[v].squaredNorm();
  }
  return sum;
}

double element_strain_energy(const MechanicsState& state, TetId element) {
  // sigma : eps from sigma alone: (sigma : sigma - nu/(1+nu) tr^2) / (2 mu), with
  // lambda / (3 lambda + 2 mu) = nu / (1 + nu).
  const ElementColumns& elements = state.elements;
  const std::size_t t = element.index();
  const Material& material = state.materials[elements.material[t].index()];
  const double mu = lame(material).mu;
  const double nu = material.poisson_ratio;
  const Mat3& sigma = elements.stress[t];
  const double trace = sigma.trace();
  const double density = (sigma.squaredNorm() - nu / (1 + nu) * trace * trace) / (2 * mu);
  return 0.5 * elements.rest_volume[t] * density;
}

double strain_energy(const MechanicsState& state) {
  double sum = 0;
  for (std::size_t t = 0; t < state.elements.size(); ++t) {
    sum += element_strain_energy(state, TetId{t});
  }
  return sum;
}

double gravity_energy(const VertexColumns& vertices, const Vec3& gravity) {
  double sum = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    sum -= vertices.mass[v] * gravity.dot(vertices.position[v]);
  }
  return sum;
}

}  // namespace sunder
