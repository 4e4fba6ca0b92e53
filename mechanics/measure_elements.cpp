// SPDX-License-Identifier: MIT
// One pass over the tetrahedra: stress, turn, and the change of the strain energy.
#include "mechanics/measure_elements.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/element/corotational_force.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/element/strain_displacement.hpp"

namespace sunder {
namespace {

/// The rest of a displacement gradient after an element has taken its own turn out of it.
Mat3 own_strain(const Mat3& H) {
  const Mat3 F = Mat3::Identity() + H;
  Mat3 strain = element_rotation(F, Mat3::Identity()).transpose() * F;
  strain.diagonal().array() -= 1;
  return strain;
}

/// sigma : eps / 2 of a displacement gradient, J/m^3, from its own numbers: those of a stress that
/// was just written would have to come back from memory.
double strain_density(const Mat3& H, const Lame& lame) {
  const double trace = H(0, 0) + H(1, 1) + H(2, 2);
  const double xy = H(0, 1) + H(1, 0), yz = H(1, 2) + H(2, 1), zx = H(2, 0) + H(0, 2);
  const double normal = H(0, 0) * H(0, 0) + H(1, 1) * H(1, 1) + H(2, 2) * H(2, 2);
  return 0.5 * lame.lambda * trace * trace +
         lame.mu * (normal + 0.5 * (xy * xy + yz * yz + zx * zx));
}

/// Stress at the corners, its mean, the largest turn, and the change of the strain energy.
void measure_second_order(MechanicsState& state, const MechanicsScratch& scratch,
                          std::span<const Corners> corners, TetId t, const ElementMeasure& measure,
                          StrainChange& change, double& largest) {
  ElementColumns& elements = state.elements;
  std::array<Mat3, 4> H = corner_gradients(elements, corners, state.vertices.displacement, t);
  if (measure.model == ElasticModel::corotational) {
    // Strains of the frames that forces are taken in, carried on to the corners.
    H = at_points(H);
    for (Mat3& at : H) at = own_strain(at);
    H = at_corners_of(H);
  }
  const std::size_t material = elements.material[t.index()].index();
  std::array<Mat3, 4> stress;
  for (std::size_t c = 0; c < 4; ++c) {
    stress[c] = stress_of(H[c], scratch.lame[material]);
    largest = std::max(largest, turn_of(H[c]));
  }
  std::array<Mat3, 4>& old = elements.corner_stress[t.index()];
  if (measure.strain) {
    const double volume = elements.rest_volume[t.index()];
    const double before = linear_stress_energy(old, volume, scratch.stress_energy[material]);
    const double after = 0.5 * volume * mean_product(stress, H);
    change.before += before;
    change.after += after;
    change.difference += 2 * (before + after - volume * mean_product(old, H));
  }
  old = stress;
  elements.stress[t.index()] = 0.25 * (stress[0] + stress[1] + stress[2] + stress[3]);
}

}  // namespace

void measure_elements(MechanicsState& state, MechanicsScratch& scratch,
                      std::span<const Corners> corners, const ElementMeasure& measure) {
  scratch.lame.clear();
  scratch.stress_energy.clear();
  for (const Material& material : state.materials) {
    scratch.lame.push_back(lame(material));
    scratch.stress_energy.emplace_back(material);
  }
  // On lower rungs displacements do not change; larger pieces that are rigid have none.
  const auto changes = [&](ComponentId id) {
    const Component& c = state.components[id.index()];
    return measure.members.has(id) && deforms(c.rung) && (!c.rigid || is_isolated(c));
  };
  for (Component& component : state.components) {
    component.strain_change = {};
    if (changes(component.id)) component.largest_turn = 0;
  }
  ElementColumns& elements = state.elements;
  // Sums of consecutive elements of one component stay in registers.
  ComponentId id = ComponentId::none();
  StrainChange change;
  double largest = 0;
  bool is_changing = false;
  const auto put_down = [&] {
    if (!is_changing) return;
    Component& component = state.components[id.index()];
    component.largest_turn = std::max(component.largest_turn, largest);
    StrainChange& sum = component.strain_change;
    sum.before += change.before;
    sum.after += change.after;
    sum.difference += change.difference;
  };
  for (std::size_t t = 0; t < elements.size(); ++t) {
    if (elements.component[t] != id) {
      put_down();
      id = elements.component[t];
      is_changing = changes(id);
      change = {};
      largest = 0;
    }
    if (!is_changing) continue;
    if (is_second_order(elements, TetId{t})) {
      measure_second_order(state, scratch, corners, TetId{t}, measure, change, largest);
      continue;
    }
    const CornerVectors d = at_corners(state.vertices.displacement, corners[t]);
    Mat3 H = displacement_gradient(elements.shape_gradient[t], d);
    if (measure.model == ElasticModel::corotational) H = own_strain(H);
    const MaterialId material = elements.material[t];
    const Mat3 stress = stress_of(H, scratch.lame[material.index()]);
    largest = std::max(largest, turn_of(H));
    if (!elements.corner_stress.empty()) elements.corner_stress[t].fill(stress);
    if (!measure.strain) {
      elements.stress[t] = stress;
      continue;
    }
    const double volume = elements.rest_volume[t];
    const double before =
        volume * scratch.stress_energy[material.index()].density(elements.stress[t]);
    const double after = volume * strain_density(H, scratch.lame[material.index()]);
    change.before += before;
    change.after += after;
    change.difference += 2 * (before + after - volume * elements.stress[t].cwiseProduct(H).sum());
    elements.stress[t] = stress;
  }
  put_down();
}

}  // namespace sunder
