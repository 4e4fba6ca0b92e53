// SPDX-License-Identifier: MIT
// The members of each struct of a saved state: one that gains or loses a member does not compile
// until this and `saved_state_format` are looked at. Findings about numbers name places with them.
#pragma once

#include "fracture/saving/archive.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/solver/component_system.hpp"

namespace sunder {

// Of the scene.
constexpr auto member_names(const Scene*) {
  return names("name", "bodies", "obstacles", "gravity", "duration", "integrator", "contact",
               "impact", "fracture", "ladder", "topology", "energy_ledger",
               "display_time_constant");
}
constexpr auto member_names(const TopologySettings*) { return names("kernel"); }
constexpr auto member_names(const BodySettings*) {
  return names("name", "mesh", "material", "translation", "rotation", "velocity", "spin", "held",
               "loads", "cuts", "strength", "unbreakable", "order", "rigid");
}
constexpr auto member_names(const TetMesh*) {
  return names("points", "tetrahedra", "region", "region_name", "source_point_id",
               "source_tetrahedron_id");
}
constexpr auto member_names(const Material*) {
  return names("young_modulus", "poisson_ratio", "density", "tensile_strength", "toughness",
               "fracture_energy", "shear");
}
constexpr auto member_names(const ShearLaw*) { return names("weight", "energy_ratio"); }
constexpr auto member_names(const HeldBox*) {
  return names("minimum", "maximum", "velocity", "axes", "ramp_time");
}
constexpr auto member_names(const LoadBox*) {
  return names("minimum", "maximum", "pressure", "force", "ramp_time");
}
constexpr auto member_names(const CutSettings*) { return names("faces", "box", "ball"); }
constexpr auto member_names(const CutPlane*) { return names("point", "normal"); }
constexpr auto member_names(const FaceList*) { return names("file", "points"); }
constexpr auto member_names(const RestBox*) { return names("minimum", "maximum"); }
constexpr auto member_names(const RestBall*) { return names("center", "radius"); }
constexpr auto member_names(const StrengthSettings*) {
  return names("regions", "painted", "field", "weibull");
}
constexpr auto member_names(const RegionName*) { return names("text"); }
constexpr auto member_names(const RegionStrength*) {
  return names("region", "tensile_strength", "toughness");
}
constexpr auto member_names(const WeibullSettings*) {
  return names("modulus", "reference_volume", "seed");
}
constexpr auto member_names(const UnbreakablePart*) { return names("where"); }
constexpr auto member_names(const GravitySettings*) { return names("acceleration", "ramp_time"); }
constexpr auto member_names(const IntegratorSettings*) {
  return names("time_step", "integrator", "rho_infinity", "damping", "euler_frame", "model",
               "elastic_force", "broyden_start", "corotational_solve", "tolerance",
               "max_iterations", "broyden_memory", "max_sub_steps", "isolated");
}
constexpr auto member_names(const RayleighDamping*) {
  return names("mass_factor", "stiffness_factor");
}
constexpr auto member_names(const ContactSettings*) {
  return names("method", "penalty_stiffness", "penalty_damping", "friction", "compliance",
               "push_out_speed", "allowed_penetration", "between_pieces", "ball_share",
               "max_iterations", "tolerance", "max_passes", "max_contacts_per_pair");
}
constexpr auto member_names(const ImpactSettings*) {
  return names("window", "negligible", "by_energy", "at_once", "max_sub_steps");
}
constexpr auto member_names(const FractureSettings*) {
  return names("mode", "max_fans", "max_new_pieces", "budget_time", "node_stress", "test",
               "criterion", "crack", "relax", "smallest_piece", "max_pieces", "detection",
               "face_order");
}
constexpr auto member_names(const LadderSettings*) {
  return names("rigid", "quasi_static", "sleep", "sleep_after", "rubble", "declared_rubble");
}
constexpr auto member_names(const Obstacle*) {
  return names("shape", "velocity", "spin", "friction", "mass");
}
constexpr auto member_names(const Plane*) { return names("normal", "offset"); }
constexpr auto member_names(const Sphere*) { return names("center", "radius"); }
constexpr auto member_names(const Box*) { return names("center", "orientation", "half_extent"); }
constexpr auto member_names(const BodyRows*) {
  return names("first_tetrahedron", "end_tetrahedron", "first_point", "end_point");
}
// Of cells.
constexpr auto member_names(const MapRows*) {
  return names("corners", "neighbours", "point_of_vertex", "points", "reoriented",
               "first_node_point");
}
constexpr auto member_names(const Components*) {
  return names("of_tetrahedron", "of_vertex", "size", "parent");
}
constexpr auto member_names(const Pieces*) { return names("map", "labels"); }
constexpr auto member_names(const EmptyFan*) { return names("vertex", "stress_direction"); }
constexpr auto member_names(const CrackLabels*) {
  return names("cracks", "labels", "last_label", "anchors", "last_anchor", "of_face");
}
constexpr auto member_names(const CrackLabel*) {
  return names("crack", "tetrahedron", "positive", "before");
}
constexpr auto member_names(const CrackAnchor*) {
  return names("crack", "vertex", "copy", "at", "normal", "time", "wave_speed", "reach", "before");
}
// Of mechanics.
constexpr auto member_names(const MechanicsState*) {
  return names("vertices", "elements", "materials", "motions", "components", "time", "systems");
}
constexpr auto member_names(const VertexColumns*) {
  return names("rest_position", "position", "velocity", "mass", "component", "displacement",
               "displacement_rate", "displacement_acceleration", "support");
}
constexpr auto member_names(const ElementColumns*) {
  return names("shape_gradient", "rest_volume", "mass", "material", "component", "stress",
               "edge_nodes", "corner_stress");
}
constexpr auto member_names(const PrescribedMotion*) { return names("velocity", "axes", "raised"); }
constexpr auto member_names(const RaisedVelocity*) { return names("velocity", "ramp_time"); }
constexpr auto member_names(const Component*) {
  return names("id", "vertices", "tetrahedra", "mass", "rest_centre", "rest_inertia", "rest_radius",
               "cell_travel", "centre", "orientation", "momentum", "angular_momentum", "supported",
               "partly_held", "frame_velocity", "rigid", "rung", "largest_turn", "strain_change");
}
constexpr auto member_names(const StrainChange*) { return names("before", "after", "difference"); }
constexpr auto member_names(const ComponentSystem*) {
  return names("order", "free_count", "held_scalars", "shape", "stiffness", "analysis",
               "factor_row", "border", "border_age", "step", "tetrahedra", "corners", "edge_nodes",
               "row_vertex");
}
constexpr auto member_names(const RestShape*) {
  return names("arm", "mass", "total_mass", "inertia");
}
constexpr auto member_names(const BlockMatrix*) { return names("start", "row", "value"); }
constexpr auto member_names(const BlockAnalysis*) {
  return names("order", "supernodes", "below", "supernode_of", "panel_size", "stack_size");
}
constexpr auto member_names(const Supernode*) {
  return names("first", "end", "below_begin", "below_end", "parent", "panel");
}
constexpr auto member_names(const BlockFactor*) { return names("panels", "positive_definite"); }
constexpr auto member_names(const SystemMatrix*) { return names("mass", "stiffness"); }
constexpr auto member_names(const FactorBorder*) { return names("base", "columns"); }
constexpr auto member_names(const FactorBorder::Column*) {
  return names("origin", "vertex_mass", "row", "stiffness");
}
constexpr auto member_names(const BorderFactor::Block*) { return names("first", "count", "W"); }
// Of all else that evolves.
constexpr auto member_names(const ContactMemory*) {
  return names("last_contacts", "partners", "ties");
}
constexpr auto member_names(const Tie*) {
  return names("face", "opposite", "crack", "corner", "opposite_corner", "normal",
               "fracture_energy", "shear", "corners");
}
constexpr auto member_names(const TieCorner*) {
  return names("area", "strength", "opened", "opening_end", "taken");
}
constexpr auto member_names(const Partner*) {
  return names("face", "opposite", "corner", "opposite_corner", "reach");
}
constexpr auto member_names(const ContactMemory::Remembered*) { return names("contact", "step"); }
constexpr auto member_names(const ContactPoint*) {
  return names("vertex", "tetrahedron_a", "ball", "corner", "edge_a", "tetrahedron", "obstacle",
               "edge_b", "face", "place", "place_a", "weights_a", "weights", "normal", "offset",
               "gap_start", "friction", "impulse");
}
constexpr auto member_names(const ImpactWindow*) { return names("quiet", "sub_step"); }
constexpr auto member_names(const LadderState*) { return names("still", "rubble"); }
constexpr auto member_names(const RubbleState*) {
  return names("memory", "apart", "ball_apart", "spent");
}
constexpr auto member_names(const RubbleMemory*) { return names("points"); }
constexpr auto member_names(const RubbleMemory::Point*) {
  return names("a", "b", "at", "force", "friction", "twist");
}
constexpr auto member_names(const Pose*) { return names("centre", "orientation"); }
constexpr auto member_names(const OpenCrack*) {
  return names("fan", "time", "area", "projected", "sides", "followed");
}
constexpr auto member_names(const CrackSide*) { return names("vertex", "force", "opening"); }
constexpr auto member_names(const CornerLoad*) {
  return names("corner", "edge", "force", "turns", "ramp_time", "load");
}
constexpr auto member_names(const FanScript*) { return names("fans", "next", "departure"); }
constexpr auto member_names(const ScriptedFan*) {
  return names("place", "round", "vertex", "normal", "stress", "strength", "crack", "anchor",
               "labels");
}
constexpr auto member_names(const SearchPlace*) { return names("step", "part"); }
constexpr auto member_names(const ScriptDeparture*) { return names("fan", "reason"); }

}  // namespace sunder
