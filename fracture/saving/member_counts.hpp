// SPDX-License-Identifier: MIT
// How many members each struct of a saved state has: one that gains or loses a member does not
// compile until this and `saved_state_format` are looked at.
#pragma once

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/solver/component_system.hpp"

namespace sunder {

// Of the scene.
constexpr int member_count(const Scene*) { return 13; }
constexpr int member_count(const TopologySettings*) { return 1; }
constexpr int member_count(const BodySettings*) { return 14; }
constexpr int member_count(const TetMesh*) { return 6; }
constexpr int member_count(const Material*) { return 7; }
constexpr int member_count(const ShearLaw*) { return 2; }
constexpr int member_count(const HeldBox*) { return 5; }
constexpr int member_count(const LoadBox*) { return 5; }
constexpr int member_count(const CutSettings*) { return 3; }
constexpr int member_count(const CutPlane*) { return 2; }
constexpr int member_count(const FaceList*) { return 2; }
constexpr int member_count(const RestBox*) { return 2; }
constexpr int member_count(const RestBall*) { return 2; }
constexpr int member_count(const StrengthSettings*) { return 4; }
constexpr int member_count(const RegionName*) { return 1; }
constexpr int member_count(const RegionStrength*) { return 3; }
constexpr int member_count(const WeibullSettings*) { return 3; }
constexpr int member_count(const UnbreakablePart*) { return 1; }
constexpr int member_count(const GravitySettings*) { return 2; }
constexpr int member_count(const IntegratorSettings*) { return 14; }
constexpr int member_count(const RayleighDamping*) { return 2; }
constexpr int member_count(const ContactSettings*) { return 13; }
constexpr int member_count(const ImpactSettings*) { return 5; }
constexpr int member_count(const FractureSettings*) { return 13; }
constexpr int member_count(const LadderSettings*) { return 6; }
constexpr int member_count(const Obstacle*) { return 5; }
constexpr int member_count(const Plane*) { return 2; }
constexpr int member_count(const Sphere*) { return 2; }
constexpr int member_count(const Box*) { return 3; }
constexpr int member_count(const BodyRows*) { return 4; }
// Of cells.
constexpr int member_count(const MapRows*) { return 5; }
constexpr int member_count(const Components*) { return 4; }
constexpr int member_count(const Pieces*) { return 2; }
constexpr int member_count(const EmptyFan*) { return 2; }
constexpr int member_count(const CrackLabels*) { return 6; }
constexpr int member_count(const CrackLabel*) { return 4; }
constexpr int member_count(const CrackAnchor*) { return 9; }
// Of mechanics.
constexpr int member_count(const MechanicsState*) { return 7; }
constexpr int member_count(const VertexColumns*) { return 9; }
constexpr int member_count(const ElementColumns*) { return 7; }
constexpr int member_count(const PrescribedMotion*) { return 3; }
constexpr int member_count(const RaisedVelocity*) { return 2; }
constexpr int member_count(const Component*) { return 18; }
constexpr int member_count(const StrainChange*) { return 3; }
constexpr int member_count(const ComponentSystem*) { return 15; }
constexpr int member_count(const RestShape*) { return 4; }
constexpr int member_count(const BlockMatrix*) { return 3; }
constexpr int member_count(const BlockAnalysis*) { return 6; }
constexpr int member_count(const Supernode*) { return 6; }
constexpr int member_count(const BlockFactor*) { return 2; }
constexpr int member_count(const SystemMatrix*) { return 2; }
constexpr int member_count(const FactorBorder*) { return 2; }
constexpr int member_count(const FactorBorder::Column*) { return 4; }
constexpr int member_count(const BorderFactor::Block*) { return 3; }
// Of all else that evolves.
constexpr int member_count(const ContactMemory*) { return 3; }
constexpr int member_count(const Tie*) { return 9; }
constexpr int member_count(const TieCorner*) { return 5; }
constexpr int member_count(const Partner*) { return 5; }
constexpr int member_count(const ContactMemory::Remembered*) { return 2; }
constexpr int member_count(const ContactPoint*) { return 13; }
constexpr int member_count(const ImpactWindow*) { return 2; }
constexpr int member_count(const LadderState*) { return 2; }
constexpr int member_count(const RubbleState*) { return 4; }
constexpr int member_count(const RubbleMemory*) { return 1; }
constexpr int member_count(const RubbleMemory::Point*) { return 6; }
constexpr int member_count(const Pose*) { return 2; }
constexpr int member_count(const OpenCrack*) { return 6; }
constexpr int member_count(const CrackSide*) { return 3; }
constexpr int member_count(const CornerLoad*) { return 5; }
constexpr int member_count(const FanScript*) { return 3; }
constexpr int member_count(const ScriptedFan*) { return 9; }
constexpr int member_count(const SearchPlace*) { return 2; }
constexpr int member_count(const ScriptDeparture*) { return 2; }

}  // namespace sunder
