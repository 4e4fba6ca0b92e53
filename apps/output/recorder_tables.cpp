// SPDX-License-Identifier: MIT
// Fragments, cracks and VTU frames from the state of a simulation.
#include "apps/output/recorder_tables.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

#include "fracture/algorithms/threshold_test.hpp"
#include "topology/io/vtu/vtu.hpp"
#include "topology/kernel/kernel.hpp"

namespace sunder {
namespace {

/// VTK's order of a symmetric tensor.
std::array<double, 6> six(const Mat3& m) {
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2)};
}

/// Sum of m r r^T over a solid tetrahedron with corners `r`.
Mat3 second_moment(const std::array<Vec3, 4>& r, double mass) {
  Vec3 sum = Vec3::Zero();
  Mat3 squares = Mat3::Zero();
  for (const Vec3& corner : r) {
    sum += corner;
    squares += corner * corner.transpose();
  }
  return mass / 20 * (squares + sum * sum.transpose());
}

Mat3 inertia_of(const Mat3& moment) { return moment.trace() * Mat3::Identity() - moment; }

/// The rigid spin with the angular momentum of the component's vertices about `center`.
Vec3 spin_of(const Component& component, const VertexColumns& v, const Fragment& f) {
  Vec3 L = Vec3::Zero();
  Mat3 moment = Mat3::Zero();
  for (const VertexId i : component.vertices) {
    const Vec3 r = v.position[i.index()] - f.center;
    L += v.mass[i.index()] * r.cross(v.velocity[i.index()] - f.velocity);
    moment += v.mass[i.index()] * r * r.transpose();
  }
  return inertia_of(moment).ldlt().solve(L);
}

/// Adds the boundary faces of one tetrahedron.
void add_surface(Fragment& f, const Cells& cells, TetId t) {
  for (int place = 0; place < 4; ++place) {
    const HalfFaceId face = half_face(t, place);
    if (!cells.map.neighbour(face).is_none()) continue;
    const double area = rest_area_vector(cells, face).norm();
    f.surface += area;
    if (is_crack_face(cells, face)) f.crack_area += area;
  }
}

Fragment fragment(const Component& component, const Cells& cells, const MechanicsState& mechanics) {
  const VertexColumns& v = mechanics.vertices;
  Fragment f;
  f.id = component.id;
  f.tetrahedra = component.tetrahedra.size();
  f.vertices = component.vertices.size();
  for (const VertexId i : component.vertices) {
    f.mass += v.mass[i.index()];
    f.center += v.mass[i.index()] * v.position[i.index()];
    f.velocity += v.mass[i.index()] * v.velocity[i.index()];
  }
  f.center /= f.mass;
  f.velocity /= f.mass;
  f.spin = spin_of(component, v, f);
  Mat3 moment = Mat3::Zero();
  for (const TetId t : component.tetrahedra) {
    f.volume += mechanics.elements.rest_volume[t.index()];
    add_surface(f, cells, t);
    std::array<Vec3, 4> r;
    for (std::size_t a = 0; a < 4; ++a) {
      r[a] = v.position[cells.map.corners(t)[a].index()] - f.center;
    }
    moment += second_moment(r, mechanics.elements.mass[t.index()]);
  }
  f.inertia = inertia_of(moment);
  return f;
}

}  // namespace

Origins origins(std::span<const BodySettings> bodies) {
  Origins result;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const TetMesh& mesh = bodies[b].mesh;
    result.body.resize(result.body.size() + mesh.tetrahedra.size(), static_cast<std::int32_t>(b));
    result.region.insert(result.region.end(), mesh.region.begin(), mesh.region.end());
    result.region.resize(result.body.size(), 0);
  }
  return result;
}

std::vector<Fragment> fragments(const Cells& cells, const MechanicsState& mechanics,
                                const Origins& origins, std::span<const std::uint64_t> birth) {
  std::vector<Fragment> all;
  for (const Component& component : mechanics.components) {
    if (component.tetrahedra.empty()) continue;
    all.push_back(fragment(component, cells, mechanics));
    const std::size_t id = component.id.index();
    all.back().parent = cells.labels.parent[id];
    if (id < birth.size()) all.back().birth_step = birth[id];
    all.back().body = origins.body[component.tetrahedra.front().index()];
  }
  return all;
}

std::string fragments_csv(std::vector<Fragment> fragments) {
  std::ranges::stable_sort(fragments, std::greater<>(), &Fragment::mass);
  std::string text =
      "component,body,tetrahedra,vertices,mass,volume,center_x,center_y,center_z,velocity_x,"
      "velocity_y,velocity_z,spin_x,spin_y,spin_z,inertia_xx,inertia_yy,inertia_zz,inertia_xy,"
      "inertia_yz,inertia_xz,surface,crack_area,parent,birth_step\r\n";
  for (const Fragment& f : fragments) {
    text += fmt::format("{},{},{},{},{},{}", f.id.value, f.body, f.tetrahedra, f.vertices, f.mass,
                        f.volume);
    for (const Vec3* v : {&f.center, &f.velocity, &f.spin}) {
      text += fmt::format(",{},{},{}", (*v)[0], (*v)[1], (*v)[2]);
    }
    text += fmt::format(",{},{},{},", fmt::join(six(f.inertia), ","), f.surface, f.crack_area);
    if (!f.parent.is_none()) text += fmt::format("{}", f.parent.value);
    text += fmt::format(",{}\r\n", f.birth_step);
  }
  return text;
}

std::string cracks_csv(std::vector<CrackEnergy> cracks) {
  std::ranges::sort(cracks, {}, &CrackEnergy::fan);
  std::string text = "fan,time,area,energy,energy_per_area\r\n";
  for (const CrackEnergy& c : cracks) {
    text += fmt::format("{},{},{},{},{}\r\n", c.fan, c.time, c.area, c.energy,
                        c.area > 0 ? c.energy / c.area : 0);
  }
  return text;
}

std::vector<Finding> write_frame(const std::filesystem::path& path, const Cells& cells,
                                 const MechanicsState& mechanics, const Origins& origins,
                                 std::span<const Mat3> node_stress) {
  const VertexColumns& v = mechanics.vertices;
  std::vector<Vec3> displacement(v.size());
  std::vector<double> stress, largest;
  stress.reserve(6 * v.size());
  largest.reserve(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Component& component = mechanics.components[v.component[i].index()];
    const Mat3 R = component.orientation.toRotationMatrix();
    displacement[i] = R * v.displacement[i];
    const Mat3 world = R * node_stress[i] * R.transpose();
    for (const double s : six(world)) stress.push_back(s);
    largest.push_back(largest_principal_stress(node_stress[i]));
  }
  TetMesh mesh;
  mesh.points.resize(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    mesh.points[i] = {v.position[i][0], v.position[i][1], v.position[i][2]};
  }
  std::vector<std::uint32_t> component;
  component.reserve(cells.map.tetrahedra());
  mesh.tetrahedra.reserve(cells.map.tetrahedra());
  for (const std::array<VertexId, 4>& c : cells.map.corners()) {
    mesh.tetrahedra.push_back({c[0].value, c[1].value, c[2].value, c[3].value});
    component.push_back(cells.labels.of_tetrahedron[component.size()].value);
  }
  const std::array point_data = {
      vector_column("displacement", displacement), vector_column("velocity", v.velocity),
      NamedColumn{"node_stress", std::span<const double>(stress), 6},
      NamedColumn{"largest_principal_stress", std::span<const double>(largest)}};
  const std::array cell_data = {
      NamedColumn{"component", std::span<const std::uint32_t>(component)},
      NamedColumn{"body", std::span<const std::int32_t>(origins.body)},
      NamedColumn{"region", std::span<const std::int32_t>(origins.region)}};
  return write_vtu(path, mesh, point_data, cell_data);
}

}  // namespace sunder
