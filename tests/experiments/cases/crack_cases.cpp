// SPDX-License-Identifier: MIT
// Meshes graded towards the crack, pre-cut, pulled, solved, and the energy released at their tips.
#include "tests/experiments/cases/crack_cases.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "fracture/algorithms/fracture_plane.hpp"
#include "fracture/energy/energy_release.hpp"
#include "fracture/energy/tip_energy.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "fracture/simulation/statics/statics.hpp"
#include "tests/support/shapes.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::accuracy {
namespace {

constexpr double crack = 1, young = 30e9, sigma = 1e6, eps = 1e-9;

/// Steps from a crack tip outwards over `length`: a few of `h`, then growing.
std::vector<double> steps(double length, double h, int even, double growth) {
  std::vector<double> step;
  double sum = 0, grown = 0;
  for (double s = h; sum < length - eps; sum += step.back()) {
    if (int(step.size()) >= even) grown += s *= growth;
    step.push_back(s);
  }
  const double scale = (length - even * h) / grown;
  for (std::size_t i = std::size_t(even); i < step.size(); ++i) step[i] *= scale;
  return step;
}

/// Coordinates from `centre - below` to `centre + above`, finest at the centre.
std::vector<double> graded(double centre, const std::vector<double>& below,
                           const std::vector<double>& above) {
  std::vector<double> x;
  double at = centre;
  for (double s : below) x.insert(x.begin(), at -= s);
  x.push_back(at = centre);
  for (double s : above) x.push_back(at += s);
  return x;
}

struct Case {
  TetMesh mesh;
  int normal = 1;                            ///< axis along which it is pulled, crack at 0
  double end = 0;                            ///< coordinate of the pulled end; held at - end
  std::function<double(const Vec3&)> along;  ///< distance from where the crack began, m
  double h = 0, nu = 0;
};

Vec3 rest(const VolumeMap& map, VertexId v) {
  const Point& p = map.point(v);
  return {p[0], p[1], p[2]};
}

/// Interior faces on the crack's plane with a centre between two distances.
std::vector<HalfFaceId> faces_between(const VolumeMap& map, const Case& c, double from, double to) {
  std::vector<HalfFaceId> faces;
  for (std::size_t f = 0; f < 4 * map.tetrahedra(); ++f) {
    const HalfFaceId face{f}, other = map.neighbour(face);
    if (other.is_none() || other < face) continue;
    Vec3 centre = Vec3::Zero();
    bool flat = true;
    for (const VertexId v : corners_of_face(map.corners(tetrahedron_of(face)), face)) {
      const Vec3 x = rest(map, v);
      flat = flat && std::abs(x[c.normal]) < eps;
      centre += x / 3;
    }
    if (flat && c.along(centre) > from && c.along(centre) < to) faces.push_back(face);
  }
  return faces;
}

/// The faces of the crack, by points.
FaceList cracked_faces(const Case& c) {
  const VolumeMap map = std::move(*build_map(c.mesh));
  FaceList list;
  for (const HalfFaceId face : faces_between(map, c, -1, crack)) {
    std::array<std::uint32_t, 3>& points = list.points.emplace_back();
    const auto corners = corners_of_face(map.corners(tetrahedron_of(face)), face);
    for (std::size_t k = 0; k < 3; ++k) points[k] = map.point_of_vertex(corners[k]);
  }
  return list;
}

struct Cracked {
  Simulation simulation;
  std::vector<Mat3> node_stress;
};

/// Cut, held, pulled, in equilibrium.
Cracked solved(const Case& c, std::uint32_t order) {
  constexpr double far = 1e3;
  const Vec3 along = Vec3::Unit(c.normal);
  const Vec3 across = Vec3::Ones() - along;
  BodySettings body;
  body.mesh = c.mesh;
  body.material = {.young_modulus = young, .poisson_ratio = c.nu, .toughness = 1};
  body.order = order;
  body.held = {{.minimum = -far * Vec3::Ones(), .maximum = far * across + (eps - c.end) * along}};
  body.loads = {{.minimum = -far * across + (c.end - eps) * along,
                 .maximum = far * Vec3::Ones(),
                 .pressure = -sigma}};
  body.cuts = {{.faces = cracked_faces(c)}};
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.bodies.push_back(std::move(body));
  scene.gravity.acceleration = Vec3::Zero();
  Result<Simulation> simulation = build_statics(std::move(scene));
  if (!simulation) throw std::runtime_error(simulation.findings.front().text);
  Result<Equilibrium> equilibrium = solve_scene(*simulation);
  if (!equilibrium) throw std::runtime_error(equilibrium.findings.front().text);
  return {std::move(*simulation), std::move(equilibrium->node_stress)};
}

/// `release`: closed form over the growth by one element, J/m^2 at `sigma`; `K`: at the tip.
CrackAnswer measured(const Case& c, CrackMesh mesh, double release, double K) {
  Cracked body = solved(c, mesh.order);
  const Cells& cells = body.simulation.state->cells;
  MechanicsState& m = body.simulation.state->mechanics;
  const VolumeMap& map = cells.map;
  CrackAnswer answer{.cells = mesh.cells, .vertices = map.vertices()};
  const std::vector<Vec3> force = node_loads(body.simulation.state->loads, m, 0);
  const ReleaseInput input{cells, m, Vec3::Zero(), force};
  const Vec3 across = Vec3::Unit(c.normal);
  const auto front = faces_between(map, c, crack, crack + c.h);
  const double G = energy_release(input, front, across)->per_area();
  answer.front_release = G / release;
  answer.load_energy = std::sqrt(1 / answer.front_release);

  double tips = 0, threshold = 0;
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    if (map.is_node(VertexId{v})) continue;
    const Vec3& x = m.vertices.rest_position[v];
    if (std::abs(x[c.normal]) > eps || std::abs(c.along(x) - crack) > eps) continue;
    Point normal = {0, 0, 0};
    normal[std::size_t(c.normal)] = 1;
    const auto fan = fan_faces(map, VertexId{v}, normal);
    answer.fan_release += energy_release(input, *fan, across)->per_area() / release;
    const Deformed deformed{m.vertices.displacement, m.elements.stress, m.elements.corner_stress};
    const double G0 = K * K * (1 - c.nu * c.nu) / young;
    const auto energy = [&](TipDomain domain) {
      return tip_energy(cells, m.elements, deformed, VertexId{v}, domain).value_or(0) / G0;
    };
    answer.star_energy += energy(TipDomain::star);
    answer.domain_energy += energy(TipDomain::two_rings);
    answer.most_energy = std::max(answer.most_energy, energy(TipDomain::two_rings));
    const double tension = principal_tension(body.node_stress[v]).value;
    const double strength = vertex_strength(cells, m, VertexId{v}, star(map, VertexId{v}));
    if (tension / strength > answer.tip_stress * sigma / (threshold > 0 ? threshold : 1)) {
      answer.tip_stress = tension / sigma;
      threshold = strength;
    }
    ++tips;
  }
  answer.fan_release /= tips;
  answer.star_energy /= tips;
  answer.domain_energy /= tips;
  // The vertex's threshold is C K_Ic / sqrt(h) with K_Ic = 1.
  answer.load_toughness = threshold * K / (answer.tip_stress * sigma);
  answer.factor = crack_tip_factor(mesh.order) * answer.load_energy / answer.load_toughness;
  return answer;
}

}  // namespace

CrackAnswer edge_crack(CrackMesh mesh) {
  constexpr double width = 4 * crack, half = 6 * crack, s = crack / width;
  Case c{.mesh = {},
         .normal = 1,
         .end = half,
         .along = [](const Vec3& x) { return x.x(); },
         .h = crack / mesh.cells,
         .nu = 0};
  const std::vector<double> away = steps(half, c.h, 4, 1.3);
  const auto x = graded(crack, steps(crack, c.h, 4, 1.3), steps(width - crack, c.h, 4, 1.3));
  const auto y = graded(0, away, away);
  c.mesh = suite::kuhn_box({int(x.size()) - 1, int(y.size()) - 1, 1});
  for (Point& p : c.mesh.points) {
    p = {x[std::size_t(std::lround(p[0]))], y[std::size_t(std::lround(p[1]))], c.h * p[2]};
  }
  const double F = 1.122 - 0.231 * s + 10.55 * s * s - 21.72 * s * s * s + 30.39 * s * s * s * s;
  const double K = F * sigma * std::sqrt(pi * crack);
  // Over one element: K^2 grows with a F^2, to first order.
  const double t = (crack + 0.5 * c.h) / width;
  const double Ft = 1.122 - 0.231 * t + 10.55 * t * t - 21.72 * t * t * t + 30.39 * t * t * t * t;
  return measured(c, mesh, pi * t * width * sigma * sigma * Ft * Ft / young, K);
}

std::vector<CrackAnswer> edge_cracks(const std::vector<int>& cells, std::uint32_t order) {
  std::vector<CrackAnswer> answers;
  for (int n : cells) answers.push_back(edge_crack({n, order}));
  for (CrackAnswer& a : answers) a.load_strength = answers.front().tip_stress / a.tip_stress;
  return answers;
}

CrackAnswer penny_crack(CrackMesh mesh) {
  constexpr double radius = 5 * crack, half = 5 * crack, nu = 0.2;
  constexpr std::size_t around = 32;
  Case c{.mesh = {},
         .normal = 2,
         .end = half,
         .along = [](const Vec3& x) { return std::hypot(x.x(), x.y()); },
         .h = crack / mesh.cells,
         .nu = nu};
  const std::vector<double> away = steps(half, c.h, 2, 1.6);
  auto r = graded(crack, steps(crack, c.h, 2, 1.6), steps(radius - crack, c.h, 2, 1.6));
  r.erase(r.begin());
  Sheet sheet = ring_sheet(around, r.size() - 1);
  std::vector<Vec3> points;
  for (auto ring = r.rbegin(); ring != r.rend(); ++ring) {
    for (std::size_t k = 0; k < around; ++k) {
      const double angle = 2 * pi * double(k) / around;
      points.push_back(*ring * Vec3(std::cos(angle), std::sin(angle), 0));
    }
  }
  for (std::size_t k = 0; k < around; ++k) {
    const std::size_t inner = (r.size() - 1) * around;
    sheet.triangles.push_back({inner + k, inner + (k + 1) % around, points.size()});
  }
  points.push_back(Vec3::Zero());
  sheet.points = points.size();
  std::vector<std::vector<Vec3>> layers;
  for (double z : graded(0, away, away)) {
    layers.push_back(points);
    for (Vec3& x : layers.back()) x.z() = z;
  }
  const Body body = extruded(sheet, layers);
  for (const Vec3& x : body.rest) c.mesh.points.push_back({x.x(), x.y(), x.z()});
  for (const Corners& t : body.corners) {
    c.mesh.tetrahedra.push_back({t[0].value, t[1].value, t[2].value, t[3].value});
  }
  const double outer = crack + c.h;
  const double release = 8 * (1 - nu * nu) * sigma * sigma / (3 * pi * young) *
                         (std::pow(outer, 3) - std::pow(crack, 3)) /
                         (outer * outer - crack * crack);
  return measured(c, mesh, release, 2 * sigma * std::sqrt(crack / pi));
}

}  // namespace sunder::accuracy
