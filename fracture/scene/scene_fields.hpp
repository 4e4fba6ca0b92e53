// SPDX-License-Identifier: MIT
// Every key of a scene: name, unit, meaning and range, said once; and the rules that concern
// several keys. Defaults are those of the structs.
#pragma once

#include "fracture/scene/choose_settings.hpp"
#include "fracture/scene/scene.hpp"
#include "mechanics/contact/contact_fields.hpp"

namespace sunder::fields {

inline const Names<Accuracy>& names_of(Accuracy) {
  static const Names<Accuracy> names = {
      {Accuracy::preview, "preview"}, {Accuracy::good, "good"}, {Accuracy::reference, "reference"}};
  return names;
}
inline const Names<FractureMode>& names_of(FractureMode) {
  static const Names<FractureMode> names = {
      {FractureMode::off, "off"}, {FractureMode::all, "all"}, {FractureMode::budget, "budget"}};
  return names;
}
inline const Names<FractureCriterion>& names_of(FractureCriterion) {
  static const Names<FractureCriterion> names = {{FractureCriterion::stress, "stress"},
                                                 {FractureCriterion::energy, "energy"}};
  return names;
}
inline const Names<MapKernel>& names_of(MapKernel) {
  static const Names<MapKernel> names = {{MapKernel::dense, "dense"}, {MapKernel::lcc, "lcc"}};
  return names;
}
inline const Names<RubbleMode>& names_of(RubbleMode) {
  static const Names<RubbleMode> names = {{RubbleMode::off, "off"},
                                          {RubbleMode::certified, "certified"}};
  return names;
}

inline const Names<CrackMode>& names_of(CrackMode) {
  static const Names<CrackMode> names = {{CrackMode::paper, "paper"},
                                         {CrackMode::object, "object"},
                                         {CrackMode::cohesive, "cohesive"}};
  return names;
}
inline const Names<NodeStress>& names_of(NodeStress) {
  static const Names<NodeStress> names = {
      {NodeStress::volume, "volume"}, {NodeStress::mass, "mass"}, {NodeStress::fit, "fit"}};
  return names;
}
inline const Names<ThresholdTest>& names_of(ThresholdTest) {
  static const Names<ThresholdTest> names = {{ThresholdTest::eigenvalues, "eigenvalues"},
                                             {ThresholdTest::gershgorin, "gershgorin"},
                                             {ThresholdTest::exact, "exact"},
                                             {ThresholdTest::chain, "chain"}};
  return names;
}
inline const Names<Detection>& names_of(Detection) {
  static const Names<Detection> names = {{Detection::exact, "exact"},
                                         {Detection::oracle, "oracle"},
                                         {Detection::dirty_counter, "dirty_counter"},
                                         {Detection::walk, "walk"}};
  return names;
}
inline const Names<FaceOrder>& names_of(FaceOrder) {
  static const Names<FaceOrder> names = {{FaceOrder::paper, "paper"}, {FaceOrder::given, "given"}};
  return names;
}

inline const Names<Axis>& names_of(Axis) {
  static const Names<Axis> names = {{Axis::x, "x"}, {Axis::y, "y"}, {Axis::z, "z"}};
  return names;
}

template <class V>
void describe(V& v, HeldBox& h) {
  v.field(Key{"minimum", "m", "Lower corner of the box, in the mesh's own coordinates", {}, true},
          h.minimum);
  v.field(Key{"maximum", "m", "Upper corner; the box's surface belongs to it", {}, true},
          h.maximum);
  v.field(Key{"velocity", "m/s", "Velocity at which the vertices are moved; zero holds them"},
          h.velocity);
  v.field(Key{"axes", "",
              "Axes of the mesh's own coordinates along which they are held; empty: all three. "
              "With some of them only for floating_frame, and not with fracture.relax or criterion "
              "energy"},
          h.axes);
  v.field(Key{"ramp_time", "s",
              "Time over which the velocity is raised linearly from 0; 0: at once", at_least(0)},
          h.ramp_time);
}

template <class V>
void describe(V& v, LoadBox& l) {
  v.field(Key{"minimum", "m", "Lower corner of the box, in the mesh's own coordinates", {}, true},
          l.minimum);
  v.field(Key{"maximum", "m", "Upper corner; the box's surface belongs to it", {}, true},
          l.maximum);
  v.field(
      Key{"pressure", "Pa",
          "On the boundary faces that lie whole in the box; positive pushes into the body; follows "
          "its rigid motion"},
      l.pressure);
  v.field(Key{"force", "N",
              "Total force in world axes, shared equally by the vertices in the box; keeps its "
              "direction"},
          l.force);
  v.field(
      Key{"ramp_time", "s", "Time over which both are raised linearly; 0: at once", at_least(0)},
      l.ramp_time);
}

template <class V>
void describe(V& v, RestBox& b) {
  v.field(Key{"minimum", "m", "Lower corner of the box, in the mesh's own coordinates", {}, true},
          b.minimum);
  v.field(Key{"maximum", "m", "Upper corner; the box's surface belongs to it", {}, true},
          b.maximum);
}

template <class V>
void describe(V& v, RestBall& b) {
  v.field(Key{"center", "m", "Centre, in the mesh's own coordinates", {}, true}, b.center);
  v.field(Key{"radius", "m", "Radius; the ball's surface belongs to it", above(0), true}, b.radius);
}

template <class V>
void describe(V& v, CutPlane& p) {
  v.field(Key{"point", "m", "On the plane, in the mesh's own coordinates", {}, true}, p.point);
  v.direction(Key{"normal", "", "Across the plane; any length but 0", {}, true}, p.normal);
}

template <class V>
void describe(V& v, CutSettings& c) {
  v.alternative(
      Key{"plane", "", "The faces between tetrahedra with their centres on its two sides"},
      CutPlane{}, c.faces);
  v.alternative(
      Key{"faces", "",
          "Text file, relative to the scene file: three rows of the mesh's points, counted "
          "from 0, a line (as `sunder split --faces`)"},
      FaceList{}, c.faces);
  v.field(Key{"box", "", "Where given, only faces whose three vertices lie in it"}, c.box);
  v.field(Key{"ball", "", "Where given, only faces whose three vertices lie in it"}, c.ball);
}

template <class V>
void describe(V& v, RegionStrength& r) {
  v.field(Key{"region", "", "Name or number of a region of the mesh", {}, true}, r.region);
  v.field(Key{"tensile_strength", "Pa", "In place of the material's", above(0)},
          r.tensile_strength);
  v.field(Key{"toughness", "Pa sqrt(m)", "In place of the material's", above(0)}, r.toughness);
}

template <class V>
void describe(V& v, WeibullSettings& w) {
  v.field(
      Key{"modulus", "", "Weibull's m: the larger, the smaller the scatter of strengths", above(0)},
      w.modulus);
  v.field(Key{"reference_volume", "m^3",
              "Volume whose strength has the scale that material, region or field give", above(0)},
          w.reference_volume);
  v.field(Key{"seed", "", "Another number draws other strengths", between(0, 4294967295.0)},
          w.seed);
}

template <class V>
void describe(V& v, StrengthSettings& s) {
  v.field(Key{"regions", "", "Regions of the mesh with strengths of their own"}, s.regions);
  v.field(Key{"field", "Pa",
              "Point field of the mesh file (point data of VTU and VTK, node data of MSH): the "
              "strength of each vertex, in place of those of material and regions"},
          s.field);
  v.field(Key{"weibull", "",
              "Draws each vertex's strength by Weibull's law, by the volume it stands for"},
          s.weibull);
}

template <class V>
void describe(V& v, UnbreakablePart& u) {
  v.alternative(Key{"region", "", "Name or number of a region: the vertices of its tetrahedra"},
                RegionName{}, u.where);
  v.alternative(Key{"box", "", "The vertices in it"}, RestBox{}, u.where);
}

template <class V>
void describe(V& v, BodySettings& b) {
  v.field(Key{"name", "", "What reports call the body"}, b.name);
  v.field(
      Key{"mesh",
          "",
          "Mesh file with tetrahedra, in any format that `sunder convert` reads, relative to the "
          "scene file",
          {},
          true},
      b.mesh);
  v.field(Key{"material", "", "What the body is made of"}, b.material);
  v.field(Key{"translation", "m", "Where the mesh's origin is put, after the rotation"},
          b.translation);
  v.field(Key{"rotation", "", "Turn of the mesh about its origin, before the translation"},
          b.rotation);
  v.field(Key{"velocity", "m/s", "Velocity of the mass centre at the start"}, b.velocity);
  v.field(Key{"spin", "rad/s", "Angular velocity about the mass centre at the start"}, b.spin);
  v.field(Key{"held", "", "Boxes whose vertices the outside world holds or moves"}, b.held);
  v.field(Key{"loads", "", "Boxes in which the body is pushed or pulled"}, b.loads);
  v.field(Key{"cuts", "", "Cracks that exist from the start, closed and without load"}, b.cuts);
  v.field(Key{"strength", "", "Strengths other than the material's (docs/strength.md)"},
          b.strength);
  v.field(Key{"unbreakable", "", "Parts whose vertices never split"}, b.unbreakable);
  v.field(
      Key{"order", "",
          "Of the tetrahedra. 1: displacement is linear in each; 2: quadratic, with a node in "
          "the middle of each edge, for what bends; with floating_frame and contact by impulses. "
          "Left out: 2 for small thin bodies of few layers (docs/defaults.md), else 1",
          between(1, 2)},
      b.order);
  v.field(Key{"rigid", "",
              "Whether the body neither deforms nor breaks: a rigid body, with the inertia of its "
              "lumped vertices; it cannot be held"},
          b.rigid);
}

template <class V>
void describe(V& v, GravitySettings& g) {
  v.field(Key{"acceleration", "m/s^2", "Gravity once it is fully raised"}, g.acceleration);
  v.field(Key{"ramp_time", "s", "Time over which it is raised linearly; 0: at once", at_least(0)},
          g.ramp_time);
}

template <class V>
void describe(V& v, FractureSettings& f) {
  v.field(Key{"mode", "",
              "off: nothing breaks; all: every vertex over its threshold breaks; budget: at most "
              "max_fans and max_new_pieces a budget_time, the most overstressed first"},
          f.mode);
  v.field(Key{"max_fans", "", "Cracks a budget_time in mode budget", between(1, 4294967295.0)},
          f.max_fans);
  v.field(Key{"max_new_pieces", "",
              "Pieces that may come off in a budget_time in mode budget; no crack follows the one "
              "that reaches it",
              between(1, 4294967295.0)},
          f.max_new_pieces);
  v.field(
      Key{"budget_time", "s",
          "What a budget is for, such as a frame, in whole steps; what waits is tested again in "
          "the next; 0: a step",
          at_least(0)},
      f.budget_time);
  v.field(Key{"node_stress", "",
              "Stress of a vertex: mean of the tetrahedra around it weighted by volume, or by mass "
              "(eq. 6, the paper's), or fit: linear fit over two rings, better at surfaces"},
          f.node_stress);
  v.field(Key{"criterion", "",
              "What breaks a crack tip of a material with a toughness: stress: the node stress "
              "there; energy: what the crack's front would release per area"},
          f.criterion);
  v.field(Key{"crack", "",
              "What a crack is: paper: each vertex is cut along its own plane; object: a surface "
              "that keeps its sides and grows along its front (docs/crack_objects.md); cohesive: "
              "the same, tied until it has taken the material's fracture energy "
              "(docs/cohesive.md)"},
          f.crack);
  v.field(Key{"relax", "",
              "Rings of tetrahedra around each fan whose stresses are solved for again within the "
              "step, so that the load of the crack passes to its tip at once; 0: none",
              between(0, 1000)},
          f.relax);
  v.field(
      Key{"test", "",
          "How vertices are tested against their threshold, with the same answers: eigenvalues; "
          "gershgorin: bound, then eigenvalues (the paper's); exact: leading minors; chain: "
          "bound, then minors"},
      f.test);
  v.field(Key{"smallest_piece", "kg",
              "A crack that would separate a lighter piece is refused; 0: no limit", at_least(0)},
          f.smallest_piece);
  v.field(Key{"max_pieces", "",
              "Largest number of pieces; a crack that would make more is refused; 0: no limit",
              between(0, 4294967295.0)},
          f.max_pieces);
  v.field(Key{"detection", "",
              "How new pieces are found, always the same: exact: search in lockstep, cost of the "
              "smaller "
              "side; oracle: walk where the paper's oracle says so (false alarms walk too); "
              "dirty_counter: walk where three vertices came apart; walk: walk after every fan"},
          f.detection);
  v.field(
      Key{"face_order", "",
          "Order in which the faces of a fan are unsewn: paper: those with an edge on the surface "
          "first; given: by number"},
      f.face_order);
}

template <class V>
void describe(V& v, LadderSettings& l) {
  v.field(
      Key{"rigid", "", "Whether components in free flight that cannot break move as rigid bodies"},
      l.rigid);
  v.field(Key{"quasi_static", "",
              "Whether supported components under slow loads go from equilibrium to equilibrium"},
          l.quasi_static);
  v.field(
      Key{"sleep", "", "Whether components at rest are not stepped until something touches them"},
      l.sleep);
  v.field(Key{"sleep_after", "s", "How long they must have been at rest", above(0)}, l.sleep_after);
  v.field(Key{"rubble",
              "",
              "Pieces that cannot break, with their contacts: off: like all others; certified: as "
              "rigid bodies on a clock of about 1/240 s, where a bound says that nothing of them "
              "can break before the next tick (docs/rubble.md); not for node_stress fit but single "
              "tetrahedra, nor with contact.method penalty",
              {},
              false,
              "",
              true},
          l.rubble);
  v.field(Key{"declared_rubble", "",
              "Pieces that came off with no more than this share of their body's mass never break "
              "again: by your word, not by a bound",
              between(0, 1), false, "", true},
          l.declared_rubble);
}

template <class V>
void describe(V& v, TopologySettings& t) {
  v.field(Key{"kernel", "",
              "What holds the volume mesh and answers for its topology, with the same results: "
              "lcc: CGAL's Linear_cell_complex, a 3-map with attributes; dense: rows of corners and "
              "neighbours alone, a twentieth of the memory of the map",
              {}, false, "", true},
          t.kernel);
}

template <class V>
void describe(V& v, Scene& s) {
  v.field(Key{"bodies", "", "Breakable bodies, at least one", {}, true}, s.bodies);
  v.field(Key{"obstacles", "", "What bodies run into"}, s.obstacles);
  v.field(Key{"gravity", "", "Gravity"}, s.gravity);
  v.field(Key{"time_step", "s", "Length of a step", above(0), false,
              "a strong blow lives for a few body lengths over the speed of sound"},
          s.integrator.time_step);
  v.field(Key{"duration", "s", "Length of the run", above(0)}, s.duration);
  v.field(
      Key{"model", "",
          "rigid_reference: linear elasticity in one frame a piece, the paper's and the default; "
          "corotational: in one frame a tetrahedron (of order 2 a Gauss point), which the paper "
          "compares "
          "with; not for floating_frame and modal. Left out: corotational with implicit_euler for "
          "one "
          "slender held body that nothing can strike"},
      s.integrator.model);
  v.field(
      Key{"isolated", "",
          "Free single tetrahedra: rigid bodies, which keep their spin; or the paper's two ways, "
          "which lose it: projection on the rigid shape, or elastic in the frame of their edges "
          "(qr)"},
      s.integrator.isolated);
  v.field(Key{"integrator", "", "How time is integrated"}, s.integrator);
  v.field(Key{"contact", "", "How contact is solved"}, s.contact);
  v.field(Key{"impact", "", "How impacts are resolved in time (docs/impact.md)"}, s.impact);
  v.field(Key{"energy_ledger", "",
              "Whether work, losses and the residual of every step are added up; without it a step "
              "without contact and cracks takes a tenth less time"},
          s.energy_ledger);
  v.field(Key{"fracture", "", "What breaks and how it is found"}, s.fracture);
  v.field(
      Key{"ladder", "", "Which components may be rigid, quasi-static or asleep (docs/ladder.md)"},
      s.ladder);
  v.field(Key{"topology", "", "The bodies' map (docs/kernel.md)"}, s.topology);
  v.field(Key{"display_time_constant", "s",
              "Time constant with which the drawn reference of a new piece approaches its own "
              "(section 3.3); "
              "0: at once",
              at_least(0)},
          s.display_time_constant);
}

}  // namespace sunder::fields
