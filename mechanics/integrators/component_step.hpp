// SPDX-License-Identifier: MIT
// Input of every integrator for one component, and how it reads and writes its rows.
#pragma once

#include "mechanics/integrators/scratch.hpp"
#include "mechanics/solver/component_system.hpp"
#include "mechanics/state/step_input.hpp"

namespace sunder {

/// One component in one step. Integrators read the state, write `scratch.predicted` and the systems
/// that they need in `state.systems`.
struct ComponentStep {
  MechanicsScratch& scratch;
  MechanicsState& state;
  const StepInput& input;
  const Component& component;
  ComponentSystem* system;  ///< built and factored; null for isolated tetrahedra and verlet
};

/// Whether supports move vertices of a component against its frame, or lead that ever faster:
/// frozen, it would be stretched at its supports alone. Or leave it to slide.
bool is_pulled(const MechanicsState& state, const Component& component);

/// How a component's deformation goes through the part of a step.
Deformation deformation_of(const StepInput& input, const MechanicsState& state,
                           const Component& component);

/// The settings as a component takes them in this step: rho_infinity follows the step.
IntegratorSettings settings_of(const StepInput& input, const MechanicsState& state,
                               const Component& component);

/// As many places for systems as the state has components, and rows as it has vertices.
void fit_systems(MechanicsState& state);

/// The system of a component, built where it is not yet; nothing is said of its factor.
ComponentSystem& built_system(MechanicsState& state, std::span<const Corners> corners,
                              const Component& component);

/// The system of a component, built and factored for this part of a step: at once where that is
/// done already.
ComponentSystem& prepared_system(MechanicsState& state, const StepInput& input,
                                 const Component& component);

/// Scratch vectors of a component, by name.
enum class ScratchField {
  displacement,
  rate,
  acceleration,
  load,
  argument,
  product,
  position,
  spare
};

/// `scratch.local[which]` as 3 x n; grows, never shrinks. Contents are undefined.
inline Eigen::Map<Eigen::Matrix3Xd> scratch_field(MechanicsScratch& scratch, ScratchField which,
                                                  std::size_t n) {
  std::vector<double>& buffer = scratch.local[static_cast<std::size_t>(which)];
  if (buffer.size() < 3 * n) buffer.resize(3 * n);
  return {buffer.data(), 3, static_cast<Eigen::Index>(n)};
}

/// The same numbers as one long vector, 3 n.
inline Eigen::Map<Eigen::VectorXd> as_vector(Eigen::Map<Eigen::Matrix3Xd>& field) {
  return {field.data(), field.size()};
}

/// Column i = column[order[i]].
inline void gather(LocalField field, std::span<const VertexId> order,
                   std::span<const Vec3> column) {
  for (std::size_t i = 0; i < order.size(); ++i) {
    field.col(static_cast<Eigen::Index>(i)) = column[order[i].index()];
  }
}

/// column[order[i]] = column i.
inline void scatter(std::span<Vec3> column, std::span<const VertexId> order,
                    ConstLocalField field) {
  for (std::size_t i = 0; i < order.size(); ++i) {
    column[order[i].index()] = field.col(static_cast<Eigen::Index>(i));
  }
}

/// Adds m g + force, turned into the body frame.
void add_body_load(LocalField load, const ComponentStep& step, const Mat3& R);

/// Present velocity of a held vertex, m/s.
inline Vec3 support_velocity(const MechanicsState& state, VertexId vertex) {
  return state.motions[state.vertices.support[vertex.index()].index()].velocity;
}

}  // namespace sunder
