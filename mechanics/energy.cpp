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

namespace {

/// What turns the stress of a material into energy: sigma : eps = (sigma : sigma - share tr^2) over
/// 2 mu, with share = lambda / (3 lambda + 2 mu) = nu / (1 + nu).
struct Compliance {
  double half_inverse;  ///< 1 / (4 mu), 1/Pa
  double share;
};

Compliance compliance_of(const Material& material) {
  return {0.25 / lame(material).mu, material.poisson_ratio / (1 + material.poisson_ratio)};
}

double energy_of(const Mat3& sigma, double volume, const Compliance& compliance) {
  const double trace = sigma.trace();
  return volume * compliance.half_inverse *
         (sigma.squaredNorm() - compliance.share * trace * trace);
}

}  // namespace

double element_strain_energy(const MechanicsState& state, TetId element) {
  const ElementColumns& elements = state.elements;
  const std::size_t t = element.index();
  return energy_of(elements.stress[t], elements.rest_volume[t],
                   compliance_of(state.materials[elements.material[t].index()]));
}

double strain_energy(const MechanicsState& state) {
  const ElementColumns& elements = state.elements;
  // Elements of one material follow each other.
  MaterialId material = MaterialId::none();
  Compliance compliance{};
  double sum = 0;
  for (std::size_t t = 0; t < elements.size(); ++t) {
    if (elements.material[t] != material) {
      material = elements.material[t];
      compliance = compliance_of(state.materials[material.index()]);
    }
    sum += energy_of(elements.stress[t], elements.rest_volume[t], compliance);
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
