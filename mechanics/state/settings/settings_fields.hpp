// SPDX-License-Identifier: MIT
// Every key of materials and of the integrator's settings: name, unit, meaning and range, said
// once. Defaults are those of the structs.
#pragma once

#include "mechanics/state/settings/field.hpp"
#include "mechanics/state/settings/material.hpp"
#include "mechanics/state/settings/settings.hpp"

namespace sunder::fields {

inline const Names<Integrator>& names_of(Integrator) {
  static const Names<Integrator> names = {{Integrator::floating_frame, "floating_frame"},
                                          {Integrator::implicit_euler, "implicit_euler"},
                                          {Integrator::verlet, "verlet"},
                                          {Integrator::broyden, "broyden"},
                                          {Integrator::newton_cg, "newton_cg"},
                                          {Integrator::sub_stepped, "sub_stepped"},
                                          {Integrator::modal, "modal"}};
  return names;
}
inline const Names<IsolatedTetrahedra>& names_of(IsolatedTetrahedra) {
  static const Names<IsolatedTetrahedra> names = {{IsolatedTetrahedra::rigid, "rigid"},
                                                  {IsolatedTetrahedra::projection, "projection"},
                                                  {IsolatedTetrahedra::qr, "qr"}};
  return names;
}
inline const Names<ElasticModel>& names_of(ElasticModel) {
  static const Names<ElasticModel> names = {{ElasticModel::rigid_reference, "rigid_reference"},
                                            {ElasticModel::corotational, "corotational"}};
  return names;
}
inline const Names<ElasticForce>& names_of(ElasticForce) {
  static const Names<ElasticForce> names = {{ElasticForce::conservative, "conservative"},
                                            {ElasticForce::paper, "paper"}};
  return names;
}
inline const Names<BroydenStart>& names_of(BroydenStart) {
  static const Names<BroydenStart> names = {{BroydenStart::mass, "mass"},
                                            {BroydenStart::factor, "factor"}};
  return names;
}
inline const Names<CorotationalSolve>& names_of(CorotationalSolve) {
  static const Names<CorotationalSolve> names = {{CorotationalSolve::reassembled, "reassembled"},
                                                 {CorotationalSolve::prefactored, "prefactored"}};
  return names;
}
inline const Names<EulerFrame>& names_of(EulerFrame) {
  static const Names<EulerFrame> names = {{EulerFrame::current, "current"},
                                          {EulerFrame::predicted, "predicted"}};
  return names;
}

template <class V>
void describe(V& v, Material& m) {
  v.field(Key{"young_modulus", "Pa", "Young's modulus E: stiffness in tension", above(0), false,
              "concrete is about 30e9 Pa"},
          m.young_modulus);
  v.field(Key{"poisson_ratio", "", "Poisson's ratio nu",
              Range{.low = -1, .high = 0.49, .without_low = true}, false,
              "linear tetrahedra cannot be incompressible (0.5); concrete is about 0.2"},
          m.poisson_ratio);
  v.field(
      Key{"density", "kg/m^3", "Mass per volume", above(0), false, "concrete is about 2400 kg/m^3"},
      m.density);
  v.field(Key{"tensile_strength", "Pa",
              "Largest principal stress xi that a vertex holds (to hold anything, set "
              "fracture.mode to off)",
              Range{.low = 0, .without_low = true, .with_infinity = true}, false,
              "concrete is about 3e6 Pa"},
          m.tensile_strength);
  v.field(Key{"toughness", "Pa sqrt(m)",
              "Fracture toughness K_Ic; replaces the strength at crack tips. If it is left out and "
              "fracture_energy is given: sqrt(E G_c / (1 - nu^2))",
              above(0), false, "leave it out or give about 1e6 for concrete"},
          m.toughness);
  v.field(Key{"fracture_energy", "J/m^2",
              "Fracture energy G_c: cracks take it with fracture.crack cohesive, and the toughness "
              "of crack tips follows from it; without it K_Ic^2 (1 - nu^2) / E",
              above(0), false, "leave it out or give about 33 for concrete"},
          m.fracture_energy);
  v.field(Key{"shear_weight", "",
              "beta^2, with fracture.crack cohesive: the strength of a crack in shear over that in "
              "tension, squared",
              above(0)},
          m.shear.weight);
  v.field(Key{"shear_energy_ratio", "",
              "kappa, with fracture.crack cohesive: fracture energy in shear over that in opening, "
              "G_II / G_I",
              above(0)},
          m.shear.energy_ratio);
}

template <class V>
void describe(V& v, RayleighDamping& d) {
  v.field(
      Key{"mass_factor", "1/s", "Damping proportional to mass, on deformation only", at_least(0)},
      d.mass_factor);
  v.field(Key{"stiffness_factor", "s",
              "Damping proportional to stiffness, on deformation only; verlet and sub_stepped need "
              "shorter steps with it",
              at_least(0)},
          d.stiffness_factor);
}

template <class V>
void describe(V& v, IntegratorSettings& i) {
  v.field(
      Key{"method", "",
          "floating_frame: rigid motion and deformation in the body frame, the default; "
          "implicit_euler: the paper's baseline, loses spin; verlet: explicit, needs steps of "
          "microseconds; broyden, newton_cg: implicit Euler by iterations; sub_stepped: as many "
          "steps of verlet as needed; modal: every mode exact, for small bodies"},
      i.integrator);
  v.field(
      Key{"rho_infinity", "",
          "Spectral radius of generalised-alpha: the share of an oscillation too fast for the step "
          "that remains after one step; falls to 0 for pieces whose slowest wave the step does "
          "not resolve",
          between(0, 0.5)},
      i.rho_infinity);
  v.field(Key{"damping", "", "Rayleigh damping"}, i.damping);
  v.field(Key{"euler_frame", "", "Frame in which implicit_euler linearises"}, i.euler_frame);
  v.field(Key{"elastic_force", "",
              "For broyden, newton_cg, verlet and sub_stepped with the model rigid_reference: "
              "conservative, or the paper's, which leaves a net torque of second order"},
          i.elastic_force);
  v.field(Key{"broyden_start", "",
              "First guess of broyden: the mass matrix (the paper's), or the factor of the step"},
          i.broyden_start);
  v.field(Key{"corotational_solve", "",
              "implicit_euler with the model corotational: reassembled and factored every step, or "
              "prefactored at rest and iterated"},
          i.corotational_solve);
  v.field(Key{"tolerance", "",
              "Residual of the step's equation over the first residual at which iterations end",
              Range{.low = 0, .high = 0.1, .without_low = true}},
          i.tolerance);
  v.field(Key{"max_iterations", "",
              "Most iterations of broyden, newton_cg (of conjugate gradients) and prefactored; the "
              "step "
              "is then solved with the factor, with a warning",
              between(1, 1e9)},
          i.max_iterations);
  v.field(Key{"max_sub_steps", "", "Most sub-steps of sub_stepped per step", between(1, 4e9)},
          i.max_sub_steps);
  v.field(
      Key{"broyden_memory", "", "Updates that broyden keeps before it restarts", between(1, 1e5)},
      i.broyden_memory);
}

}  // namespace sunder::fields
