// SPDX-License-Identifier: MIT
// Momenta and energies as plain sums over rows.
#include "mechanics/element/energy.hpp"

#include "mechanics/element/second_order.hpp"
#include "mechanics/element/strain_displacement.hpp"

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

StressEnergy::StressEnergy(const Material& material)
    : factor(0.25 / lame(material).mu),
      share(material.poisson_ratio / (1 + material.poisson_ratio)) {}

double linear_stress_energy(const std::array<Mat3, 4>& stress, double rest_volume,
                            const StressEnergy& energy) {
  const Mat3 sum = stress[0] + stress[1] + stress[2] + stress[3];
  double densities = energy.density(sum);
  for (const Mat3& s : stress) densities += energy.density(s);
  return rest_volume / 20 * densities;
}

double element_strain_energy(const MechanicsState& state, TetId element) {
  const ElementColumns& elements = state.elements;
  const std::size_t t = element.index();
  const StressEnergy energy(material_of(state, TetId{t}));
  if (is_second_order(elements, element)) {
    return linear_stress_energy(elements.corner_stress[t], elements.rest_volume[t], energy);
  }
  return elements.rest_volume[t] * energy.density(elements.stress[t]);
}

double strain_energy(const MechanicsState& state) {
  const ElementColumns& elements = state.elements;
  // Elements of one material follow each other.
  MaterialId material = MaterialId::none();
  StressEnergy energy;
  double sum = 0;
  for (std::size_t t = 0; t < elements.size(); ++t) {
    if (elements.material[t] != material) {
      material = elements.material[t];
      energy = StressEnergy(state.materials[material.index()]);
    }
    sum += is_second_order(elements, TetId{t})
               ? linear_stress_energy(elements.corner_stress[t], elements.rest_volume[t], energy)
               : elements.rest_volume[t] * energy.density(elements.stress[t]);
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
