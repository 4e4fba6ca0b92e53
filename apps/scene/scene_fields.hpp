// SPDX-License-Identifier: MIT
// Every key of a scene file: name, unit, meaning and range, said once. The reader and the schema
// are two visitors of these lists; defaults are those of the C++ structs.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/scene/output_settings.hpp"
#include "apps/scene/scene_json.hpp"
#include "fracture/simulation/scene.hpp"

namespace sunder::fields {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Numbers that are allowed; each element of a vector is held to it.
struct Range {
  double low = -infinity;
  double high = infinity;
  bool without_low = false;
};
constexpr Range at_least(double low) { return {.low = low}; }
constexpr Range above(double low) { return {.low = low, .without_low = true}; }
constexpr Range between(double low, double high) { return {.low = low, .high = high}; }

/// One key of an object. Without `required` the member's value in a default-constructed struct is
/// the default.
struct Key {
  std::string_view name;
  /// Empty for what has none.
  std::string_view unit;
  /// What it means, for the schema.
  std::string_view text;
  Range range = {};
  bool required = false;
  /// Added to the remedy when the value is refused.
  std::string_view remedy = {};
};

template <class E>
using Names = std::vector<std::pair<E, std::string_view>>;

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
inline const Names<ShownShape>& names_of(ShownShape) {
  static const Names<ShownShape> names = {{ShownShape::reference, "reference"},
                                          {ShownShape::deformed, "deformed"},
                                          {ShownShape::both, "both"}};
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
              above(0), false, "concrete is about 3e6 Pa"},
          m.tensile_strength);
  v.field(
      Key{"toughness", "Pa sqrt(m)",
          "Fracture toughness K_Ic; where given it rules at crack tips in place of the strength",
          above(0), false, "leave it out or give about 1e6 for concrete"},
      m.toughness);
}

template <class V>
void describe(V& v, HeldBox& h) {
  v.field(Key{"minimum", "m", "Lower corner of the box, in the mesh's own coordinates", {}, true},
          h.minimum);
  v.field(Key{"maximum", "m", "Upper corner; the box's surface belongs to it", {}, true},
          h.maximum);
  v.field(Key{"velocity", "m/s", "Velocity the vertices are moved with; zero holds them still"},
          h.velocity);
}

template <class V>
void describe(V& v, LoadBox& l) {
  v.field(Key{"minimum", "m", "Lower corner of the box, in the mesh's own coordinates", {}, true},
          l.minimum);
  v.field(Key{"maximum", "m", "Upper corner; the box's surface belongs to it", {}, true},
          l.maximum);
  v.field(Key{"pressure", "Pa",
              "On the boundary faces that lie in the box whole; positive pushes into the body, and "
              "turns with it"},
          l.pressure);
  v.field(Key{"force", "N",
              "In all, in the world, shared equally by the vertices in the box; keeps its "
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
  v.field(Key{"modulus", "", "Weibull's m: the larger, the less strengths scatter", above(0)},
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
              "Point field of the mesh file (VTU point data, MSH node data): the strength of each "
              "vertex, in place of those of material and regions"},
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
  v.field(Key{"mesh",
              "",
              "File of tetrahedra (MSH, MEDIT or VTU), relative to the scene file",
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
  v.field(Key{"cuts", "", "Cracks that are there from the start, closed and without load"}, b.cuts);
  v.field(Key{"strength", "", "Strengths beside that of the material (docs/strength.md)"},
          b.strength);
  v.field(Key{"unbreakable", "", "Parts whose vertices never split"}, b.unbreakable);
}

template <class V>
void describe(V& v, Plane& p) {
  v.direction(Key{"normal", "", "Out of the solid half-space; any length but 0"}, p.normal);
  v.field(Key{"offset", "m", "Distance from the origin along the normal"}, p.offset);
}
template <class V>
void describe(V& v, Sphere& s) {
  v.field(Key{"center", "m", "Centre"}, s.center);
  v.field(Key{"radius", "m", "Radius", above(0)}, s.radius);
}
template <class V>
void describe(V& v, Box& b) {
  v.field(Key{"center", "m", "Centre"}, b.center);
  v.field(Key{"rotation", "", "Turn of the box's own axes"}, b.orientation);
  v.field(Key{"half_extent", "m", "Half the length of each side", above(0)}, b.half_extent);
}

template <class V>
void describe(V& v, Obstacle& o) {
  v.alternative(Key{"plane", "", "A half-space: ground, wall"}, Plane{}, o.shape);
  v.alternative(Key{"sphere", "", "A ball"}, Sphere{}, o.shape);
  v.alternative(Key{"box", "", "A box"}, Box{}, o.shape);
  v.field(Key{"velocity", "m/s", "Velocity, kept whatever it hits unless there is a mass"},
          o.velocity);
  v.field(Key{"spin", "rad/s", "Angular velocity of a free ball"}, o.spin);
  v.field(Key{"friction", "", "Coulomb's coefficient; two surfaces rub with the mean of theirs",
              at_least(0)},
          o.friction);
  v.field(
      Key{"mass", "kg", "Makes a ball a free projectile that falls and is pushed back", above(0)},
      o.mass);
}

template <class V>
void describe(V& v, GravitySettings& g) {
  v.field(Key{"acceleration", "m/s^2", "Gravity once it is fully raised"}, g.acceleration);
  v.field(Key{"ramp_time", "s", "Time over which it is raised linearly; 0: at once", at_least(0)},
          g.ramp_time);
}

template <class V>
void describe(V& v, RayleighDamping& d) {
  v.field(
      Key{"mass_factor", "1/s", "Damping proportional to mass, on deformation only", at_least(0)},
      d.mass_factor);
  v.field(Key{"stiffness_factor", "s", "Damping proportional to stiffness, on deformation only",
              at_least(0)},
          d.stiffness_factor);
}

template <class V>
void describe(V& v, IntegratorSettings& i) {
  v.field(Key{"method", "",
              "floating_frame: rigid motion apart, the default; implicit_euler: the paper's "
              "baseline, loses spin; verlet: explicit, needs steps of microseconds; broyden, "
              "newton_cg: implicit Euler by iterations; sub_stepped: verlet as often a step as it "
              "takes; modal: every mode exact, small bodies"},
          i.integrator);
  v.field(Key{"rho_infinity", "",
              "Of generalised-alpha: how much of an oscillation too fast for the step is left "
              "after one step; falls to 0 for components whose slowest wave the step does not "
              "resolve",
              between(0, 0.5)},
          i.rho_infinity);
  v.field(Key{"damping", "", "Rayleigh damping"}, i.damping);
  v.field(Key{"euler_frame", "", "Which frame implicit_euler linearises in"}, i.euler_frame);
  v.field(Key{"elastic_force", "",
              "Of broyden, newton_cg, verlet and sub_stepped with the model rigid_reference: "
              "conservative, or "
              "the paper's, which leaves a torque of second order"},
          i.elastic_force);
  v.field(Key{"broyden_start", "",
              "First guess of broyden: the mass matrix (the paper's), or the factor of the step"},
          i.broyden_start);
  v.field(Key{"corotational_solve", "",
              "implicit_euler with the model corotational: reassembled and factored every step, or "
              "prefactored at rest and iterated"},
          i.corotational_solve);
  v.field(Key{"tolerance", "",
              "Of iterations: the step's residual that is good enough, over the one they begin "
              "with",
              Range{.low = 0, .high = 0.1, .without_low = true}},
          i.tolerance);
  v.field(Key{"max_iterations", "",
              "Iterations of broyden, newton_cg (of conjugate gradients) and prefactored; then the "
              "factor takes the step, and the report says so",
              between(1, 1e9)},
          i.max_iterations);
  v.field(
      Key{"max_sub_steps", "", "Sub-steps that sub_stepped may take in a step", between(1, 4e9)},
      i.max_sub_steps);
  v.field(Key{"broyden_memory", "", "Updates that broyden keeps before it begins anew",
              between(1, 1e5)},
          i.broyden_memory);
}

template <class V>
void describe(V& v, FractureSettings& f) {
  v.field(Key{"mode", "",
              "off: nothing breaks; all: every vertex over its threshold; budget: at most max_fans "
              "a step, the most overstressed first"},
          f.mode);
  v.field(Key{"max_fans", "", "Cracks a step in mode budget", between(1, 4294967295.0)},
          f.max_fans);
  v.field(Key{"node_stress", "",
              "Stress of a vertex: mean of the tetrahedra around it weighted by volume, or by mass "
              "(eq. 6, the paper's), or fit: linear fit over two rings, better at surfaces"},
          f.node_stress);
  v.field(Key{"criterion", "",
              "What breaks a crack tip of a material with a toughness: stress: the node stress "
              "there; energy: what the crack's front would release per area"},
          f.criterion);
  v.field(Key{"relax", "",
              "Rings of tetrahedra around each fan whose stresses are solved for again within the "
              "step, so that a crack's tip bears what the crack no longer bears; 0: none",
              between(0, 1000)},
          f.relax);
  v.field(
      Key{"test", "",
          "How vertices are tested against their threshold, with the same answers: eigenvalues; "
          "gershgorin: bound, then eigenvalues (the paper's); exact: leading minors; chain: "
          "bound, then minors"},
      f.test);
  v.field(
      Key{"smallest_piece", "kg",
          "A crack that would part a lighter piece is refused; 0: none is too small", at_least(0)},
      f.smallest_piece);
  v.field(Key{"max_pieces", "",
              "Pieces in the scene; a crack that would make more is refused; 0: no limit",
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
void describe(V& v, ContactSettings& c) {
  v.field(Key{"friction", "", "Coulomb's coefficient of the bodies' own surface", at_least(0)},
          c.friction);
  v.field(Key{"compliance", "m/N", "Give of one contact point; 0: hard", at_least(0)},
          c.compliance);
  v.field(
      Key{"push_out_speed", "m/s",
          "Largest speed at which contacts that begin overlapped are pushed apart", at_least(0)},
      c.push_out_speed);
  v.field(Key{"allowed_penetration", "m", "Depth that is left alone", at_least(0)},
          c.allowed_penetration);
  v.field(Key{"between_pieces", "", "Whether pieces repel each other; obstacles always do"},
          c.between_pieces);
  v.field(Key{"ball_share",
              "",
              "Radius of the ball that stands for a tetrahedron between pieces, as a share of its "
              "bounding ball's; 1 is the paper's",
              {.low = 0, .high = 1, .without_low = true}},
          c.ball_share);
  v.field(Key{"max_iterations", "", "Sweeps of projected Gauss-Seidel a pass", between(1, 1e6)},
          c.max_iterations);
  v.field(Key{"tolerance", "",
              "Largest error of an end-of-step gap, relative to the deepest overlap that the step "
              "would have had without contact",
              above(0)},
          c.tolerance);
  v.field(Key{"max_passes", "", "How often a step may be predicted anew with the impulses found",
              between(1, 100)},
          c.max_passes);
  v.field(Key{"max_contacts_per_component", "",
              "Contacts of one piece in a pass; the deepest are taken, the rest wait",
              between(1, 100000)},
          c.max_contacts_per_component);
}

template <class V>
void describe(V& v, ImpactSettings& i) {
  v.field(Key{"window", "",
              "Whether components that are struck are stepped finely while that lasts; without it "
              "the step decides what breaks on impact"},
          i.window);
  v.field(Key{"fraction", "",
              "Largest sub-step over L/c, the time in which a wave crosses the component",
              Range{.low = 0, .high = 1, .without_low = true}},
          i.fraction);
  v.field(Key{"negligible", "",
              "Part of the tensile strength below which the stress rho c v of a blow is none",
              Range{.low = 0, .high = 1, .without_low = true}},
          i.negligible);
  v.field(Key{"max_sub_steps", "",
              "Sub-steps in one step; the rest of the step is then taken at once, and the report "
              "says so",
              between(1, 1e6)},
          i.max_sub_steps);
}

template <class V>
void describe(V& v, LadderSettings& l) {
  v.field(Key{"rigid", "",
              "Whether components in free flight that cannot break there move as rigid bodies"},
          l.rigid);
  v.field(Key{"quasi_static", "",
              "Whether supported components under slow loads go from equilibrium to equilibrium"},
          l.quasi_static);
  v.field(Key{"sleep", "",
              "Whether components that lie still are left alone until something touches them"},
          l.sleep);
  v.field(Key{"sleep_after", "s", "How long they must have lain still", above(0)}, l.sleep_after);
}

template <class V>
void describe(V& v, CameraSettings& c) {
  v.field(Key{"eye", "m", "Where the camera stands", {}, true}, c.eye);
  v.field(Key{"target", "m", "What it looks at", {}, true}, c.target);
  v.field(Key{"field_of_view", "degrees", "Vertical opening angle", between(1, 170)},
          c.field_of_view);
}

template <class V>
void describe(V& v, PictureSettings& p) {
  v.field(Key{"count", "", "Pictures spread evenly over the run with its end; 0 draws none",
              between(0, 10000)},
          p.count);
  v.field(Key{"times", "s", "Further moments to draw", at_least(0)}, p.times);
  v.field(Key{"width", "pixels", "Width", between(16, 8192)}, p.width);
  v.field(Key{"height", "pixels", "Height", between(16, 8192)}, p.height);
  v.field(Key{"show", "",
              "reference: the rigid reference; deformed: the mesh itself; both: the deformed mesh "
              "as wires over the filled reference (figure 1)"},
          p.show);
  v.field(Key{"camera", "", "A fixed camera; absent: one that sees the start and the ground"},
          p.camera);
}

template <class V>
void describe(V& v, OutputSettings& o) {
  v.field(Key{"frames", "", "VTU frames spread evenly over the run with start and end; 0: none",
              between(0, 1000000)},
          o.frames);
  v.field(Key{"frame_interval", "s", "Time between frames; above 0 it rules instead of frames",
              at_least(0)},
          o.frame_interval);
  v.field(Key{"pictures", "", "Pictures drawn without a display"}, o.pictures);
}

template <class V>
void describe(V& v, SceneFile& s) {
  v.field(Key{"$schema", "", "The schema, for editors; not read"}, s.schema);
  v.field(Key{"name", "", "What reports call the scene"}, s.scene.name);
  v.field(Key{"description", "", "What happens and why the numbers are what they are"},
          s.description);
  v.field(Key{"bodies", "", "Breakable bodies, at least one", {}, true}, s.scene.bodies);
  v.field(Key{"obstacles", "", "What bodies run into"}, s.scene.obstacles);
  v.field(Key{"gravity", "", "Gravity"}, s.scene.gravity);
  v.field(Key{"time_step", "s", "Length of a step", above(0), false,
              "a strong blow lives for a few body lengths over the speed of sound"},
          s.scene.time_step);
  v.field(Key{"duration", "s", "Length of the run", above(0)}, s.scene.duration);
  v.field(Key{"model", "",
              "rigid_reference: linear in the frame of each piece, the paper's and the default; "
              "corotational: in a frame of each tetrahedron's own, the paper's comparison, not for "
              "floating_frame and modal"},
          s.scene.integrator.model);
  v.field(Key{"isolated", "",
              "Free single tetrahedra: rigid bodies, which keep their spin; or, as the paper has "
              "them, by projection on the rigid shape or elastic in the frame of their edges (qr), "
              "which lose it"},
          s.scene.integrator.isolated);
  v.field(Key{"integrator", "", "How time is integrated"}, s.scene.integrator);
  v.field(Key{"contact", "", "How contact is solved"}, s.scene.contact);
  v.field(Key{"impact", "", "How blows are stepped (docs/impact.md)"}, s.scene.impact);
  v.field(
      Key{"energy_ledger", "",
          "Whether works, losses and the residual of every step are added up; without it a step "
          "in which nothing else happens is a tenth shorter"},
      s.scene.energy_ledger);
  v.field(Key{"fracture", "", "What breaks and how it is found"}, s.scene.fracture);
  v.field(Key{"ladder", "", "How little of a component's motion is computed (docs/ladder.md)"},
          s.scene.ladder);
  v.field(
      Key{"display_time_constant", "s",
          "In which the drawn reference of a new piece goes to its own (section 3.3); 0: at once",
          at_least(0)},
      s.scene.display_time_constant);
  v.field(Key{"output", "", "What a run writes"}, s.output);
}

}  // namespace sunder::fields
