// SPDX-License-Identifier: MIT
// Every key of a scene: name, unit, meaning and range, said once; and the rules that concern
// several keys. Defaults are those of the structs.
#pragma once

#include "fracture/scene/choose_settings.hpp"
#include "fracture/scene/scene.hpp"
#include "mechanics/contact/settings/contact_fields.hpp"

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
                                          {RubbleMode::certified, "certified"},
                                          {RubbleMode::until_struck, "until_struck"}};
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
  v.field(Key{"velocity", "m/s", "Velocity of the held vertices; zero fixes them"}, h.velocity);
  v.field(
      Key{"axes", "",
          "Axes of the mesh's own coordinates along which the vertices are held; empty: all "
          "three. One or two axes need floating_frame, and exclude fracture.relax and criterion "
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
          "Pressure on the boundary faces that lie entirely in the box; positive pushes into the "
          "body; follows its rigid motion"},
      l.pressure);
  v.field(Key{"force", "N",
              "Total force in world axes, shared equally by the vertices in the box; its direction "
              "is constant"},
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
  v.field(Key{"point", "m", "A point of the plane, in the mesh's own coordinates", {}, true},
          p.point);
  v.direction(Key{"normal", "", "Normal of the plane; any length but 0", {}, true}, p.normal);
}

template <class V>
void describe(V& v, CutSettings& c) {
  v.alternative(
      Key{"plane", "", "Cuts the faces between tetrahedra with their centres on its two sides"},
      CutPlane{}, c.faces);
  v.alternative(
      Key{"faces", "",
          "Cuts the faces in this text file, relative to the scene file: three rows of the mesh's "
          "points per line, counted from 0 (as `sunder split --faces`)"},
      FaceList{}, c.faces);
  v.field(Key{"box", "", "Where given, only faces with all three vertices in it"}, c.box);
  v.field(Key{"ball", "", "Where given, only faces with all three vertices in it"}, c.ball);
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
  v.field(
      Key{"reference_volume", "m^3",
          "Volume at which the strength of material, region or field is Weibull's scale", above(0)},
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
  v.field(
      Key{"weibull", "", "Draws each vertex's strength by Weibull's law, for the volume around it"},
      s.weibull);
}

template <class V>
void describe(V& v, UnbreakablePart& u) {
  v.alternative(Key{"region", "", "Name or number of a region; its vertices never split"},
                RegionName{}, u.where);
  v.alternative(Key{"box", "", "Box of vertices that never split"}, RestBox{}, u.where);
}

template <class V>
void describe(V& v, BodySettings& b) {
  v.field(Key{"name", "", "Name of the body in reports"}, b.name);
  v.field(
      Key{"mesh", "",
          "Mesh file with tetrahedra, in any format that `sunder convert` reads, relative to the "
          "scene file"},
      b.mesh);
  v.field(
      Key{"material", "",
          "Material of the body: an object, or a name of `sunder materials`, such as \"glass\""},
      b.material);
  v.field(Key{"translation", "m", "Translation of the mesh, after the rotation"}, b.translation);
  v.field(Key{"rotation", "", "Rotation of the mesh about its origin, before the translation"},
          b.rotation);
  v.field(Key{"velocity", "m/s", "Velocity of the mass centre at the start"}, b.velocity);
  v.field(Key{"spin", "rad/s", "Angular velocity about the mass centre at the start"}, b.spin);
  v.field(Key{"held", "", "Boxes of vertices that are fixed, or moved at a given velocity"},
          b.held);
  v.field(Key{"loads", "", "Boxes in which pressure or force acts on the body"}, b.loads);
  v.field(Key{"cuts", "", "Cracks that exist from the start, closed and without load"}, b.cuts);
  v.field(Key{"strength", "", "Strengths other than the material's (docs/explanation/cracks.md)"},
          b.strength);
  v.field(Key{"unbreakable", "", "Parts that never break"}, b.unbreakable);
  v.field(
      Key{"order", "",
          "Order of the tetrahedra. 1: linear displacement; 2: quadratic, with a node in the "
          "middle "
          "of each edge, for bodies that bend; needs contact by impulses. Left out: 2 for small "
          "thin bodies of few layers (docs/howto/choose.md), else 1",
          between(1, 2)},
      b.order);
  v.field(Key{"rigid", "",
              "Whether the body neither deforms nor breaks: a rigid body, with the inertia of its "
              "lumped vertices; it cannot be held"},
          b.rigid);
}

template <class V>
void describe(V& v, GravitySettings& g) {
  v.field(Key{"acceleration", "m/s^2", "Gravity at the end of its ramp"}, g.acceleration);
  v.field(Key{"ramp_time", "s", "Time over which it is raised linearly; 0: at once", at_least(0)},
          g.ramp_time);
}

template <class V>
void describe(V& v, FractureSettings& f) {
  v.field(Key{"mode", "",
              "off: nothing breaks; all: every vertex over its threshold breaks; budget: at most "
              "max_fans and max_new_pieces per budget_time, the most overstressed first"},
          f.mode);
  v.field(Key{"max_fans", "", "Cracks per budget_time in mode budget", between(1, 4294967295.0)},
          f.max_fans);
  v.field(Key{"max_new_pieces", "",
              "Pieces that may come off per budget_time in mode budget; the crack that reaches the "
              "number is the last",
              between(1, 4294967295.0)},
          f.max_new_pieces);
  v.field(
      Key{"budget_time", "s",
          "Time for one budget, such as a frame, in whole steps; waiting vertices are tested again "
          "in the next; 0: one step",
          at_least(0)},
      f.budget_time);
  v.field(Key{"node_stress", "",
              "Stress of a vertex: mean of the tetrahedra around it weighted by volume, or by mass "
              "(eq. 6, the paper's), or fit: linear fit over two rings, better at surfaces"},
          f.node_stress);
  v.field(Key{"criterion", "",
              "Criterion at crack tips of a material with a toughness. stress: the node stress; "
              "energy: the energy that the crack front would release per area"},
          f.criterion);
  v.field(Key{"crack", "",
              "Crack model. paper: each vertex is cut along its own plane; object: a surface that "
              "keeps its sides and grows along its front; cohesive: the "
              "same, held together until it has taken the material's fracture energy "
              "(docs/explanation/cracks.md)"},
          f.crack);
  v.field(Key{"relax", "",
              "Rings of tetrahedra around each fan in which stresses are computed again within the "
              "step. The load of the crack then passes to its tip at once; 0: none",
              between(0, 1000)},
          f.relax);
  v.field(Key{"test", "",
              "Test of vertices against their threshold; all give the same result. eigenvalues; "
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
  v.field(
      Key{"detection", "",
          "Search for new pieces; all find the same ones. exact: search in lockstep, at the cost "
          "of the smaller side; oracle: walk where the paper's oracle predicts a piece (false "
          "alarms walk too); dirty_counter: walk where three vertices came apart; walk: walk "
          "after every fan"},
      f.detection);
  v.field(
      Key{"face_order", "",
          "Order in which the faces of a fan are unsewn: paper: those with an edge on the surface "
          "first; given: by number"},
      f.face_order);
}

template <class V>
void describe(V& v, LadderSettings& l) {
  v.field(Key{"rigid", "", "Whether pieces in free flight that cannot break move as rigid bodies"},
          l.rigid);
  v.field(Key{"quasi_static", "",
              "Whether supported pieces under slow loads move from equilibrium to equilibrium"},
          l.quasi_static);
  v.field(Key{"sleep", "", "Whether pieces at rest are not stepped until something touches them"},
          l.sleep);
  v.field(Key{"sleep_after", "s", "Time at rest before a piece sleeps", above(0)}, l.sleep_after);
  v.field(
      Key{"rubble",
          "",
          "Motion of pieces that do not break, with their contacts. off: as all others; "
          "certified: as rigid bodies in steps of about 1/240 s, where a bound shows that they "
          "cannot break within the step; until_struck: pieces that came off too, until a blow "
          "could break one (docs/explanation/time_and_contact.md). With node_stress fit only for "
          "single tetrahedra; not with contact.method penalty",
          {},
          false,
          "",
          true},
      l.rubble);
  v.field(
      Key{"declared_rubble", "",
          "Pieces that came off with at most this share of their body's mass never break again; "
          "your choice, not a bound",
          between(0, 1), false, "", true},
      l.declared_rubble);
}

template <class V>
void describe(V& v, TopologySettings& t) {
  v.field(Key{"kernel",
              "",
              "Kernel that holds the volume mesh; both give the same results. lcc: CGAL's "
              "Linear_cell_complex, a 3-map with attributes; dense: rows of corners and neighbours "
              "alone, a twentieth of the memory of the map",
              {},
              false,
              "",
              true},
          t.kernel);
}

template <class V>
void describe(V& v, Scene& s) {
  v.field(Key{"bodies", "", "Breakable bodies, at least one", {}, true}, s.bodies);
  v.field(Key{"obstacles", "", "Ground, walls, balls and other rigid shapes"}, s.obstacles);
  v.field(Key{"gravity", "", "Gravity"}, s.gravity);
  v.field(Key{"time_step", "s", "Length of a step", above(0), false,
              "a strong impact lasts for a few body lengths over the speed of sound"},
          s.integrator.time_step);
  v.field(Key{"duration", "s", "Length of the run", above(0)}, s.duration);
  v.field(
      Key{"model", "",
          "rigid_reference: linear elasticity in one frame per piece, the paper's and the default; "
          "corotational: in one frame per tetrahedron (order 2: per Gauss point), to compare "
          "with; not for floating_frame and modal. Left out: corotational with implicit_euler for "
          "a single slender held body without obstacles"},
      s.integrator.model);
  v.field(
      Key{"isolated", "",
          "Motion of free single tetrahedra. rigid: rigid bodies, which keep their spin; the "
          "paper's "
          "two ways lose it: projection on the rigid shape, or elastic in the frame of their edges "
          "(qr)"},
      s.integrator.isolated);
  v.field(Key{"integrator", "", "Time integration"}, s.integrator);
  v.field(Key{"contact", "", "Contact"}, s.contact);
  v.field(Key{"impact", "", "Sub-steps at impacts (docs/explanation/time_and_contact.md)"},
          s.impact);
  v.field(Key{"energy_ledger", "",
              "Whether work, losses and the residual of every step are added up; without it a step "
              "without contact and cracks takes a tenth less time"},
          s.energy_ledger);
  v.field(Key{"fracture", "", "Cracks: criterion, model and search for pieces"}, s.fracture);
  v.field(Key{"ladder", "",
              "Pieces that may be rigid, quasi-static or asleep "
              "(docs/explanation/time_and_contact.md)"},
          s.ladder);
  v.field(Key{"topology", "", "The bodies' map (docs/explanation/topology.md)"}, s.topology);
  v.field(Key{"display_time_constant", "s",
              "Time constant with which the drawn reference of a new piece approaches its own "
              "(section 3.3); 0: at once",
              at_least(0)},
          s.display_time_constant);
}

}  // namespace sunder::fields
