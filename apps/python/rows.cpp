// SPDX-License-Identifier: MIT
// Columns of a simulation as arrays: copies, since a split moves columns in memory, and views that
// forbid every change as long as they live.
#include "fracture/simulation/rows.hpp"

#include <memory>
#include <string>
#include <utility>

#include "apps/host/engine.hpp"
#include "apps/python/arrays.hpp"
#include "apps/python/findings.hpp"
#include "apps/python/stepped.hpp"

namespace sunder::python {
namespace {

using Type = py::class_<Stepped>;

/// A read-only property of the rows of a simulation that no other thread steps.
template <class Get>
void add(Type& type, const char* name, const char* about, const Get& get) {
  type.def_property_readonly(
      name,
      [get](const Stepped& sim) {
        const InUse use(sim.in_use);
        return get(sim.simulation);
      },
      about);
}

py::array_t<double> of_tensors(std::span<const Mat3> tensors) {
  py::array_t<double> result(
      {static_cast<py::ssize_t>(tensors.size()), py::ssize_t{3}, py::ssize_t{3}});
  static_assert(sizeof(Mat3) == 9 * sizeof(double));
  // Symmetric: the order of its numbers does not matter.
  if (!tensors.empty()) std::memcpy(result.mutable_data(), tensors.data(), tensors.size_bytes());
  return result;
}

/// A column of the C functions.
template <class T>
py::array_t<T> column(const Simulation& s, sunder_column kind, std::size_t width) {
  std::vector<unsigned char> bytes;
  fill_column(bytes, s, kind);
  const auto* numbers = reinterpret_cast<const T*>(bytes.data());
  return copied<T>(std::span<const T>(numbers, bytes.size() / sizeof(T)), width);
}

/// Keeps a simulation alive and unchanged.
struct Lease {
  py::object owner;
  const Stepped& sim;

  explicit Lease(py::object held) : owner(std::move(held)), sim(owner.cast<const Stepped&>()) {
    ++sim.views;
  }
  ~Lease() { --sim.views; }
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;
};

/// A column, with the lease as its owner. Throws IndexError for other names.
py::array column_view(const Simulation& s, const std::string& name, py::handle lease) {
  const SimulationRows rows = rows_of(s);
  if (name == "positions") return view<double>(rows.position, 3, lease);
  if (name == "rest_positions") return view<double>(rows.rest_position, 3, lease);
  if (name == "velocities") return view<double>(rows.velocity, 3, lease);
  if (name == "masses") return view<double>(rows.mass, 0, lease);
  if (name == "strengths") return view<double>(rows.strength, 0, lease);
  if (name == "tetrahedra") return view<std::uint32_t>(map_of(s).corners(), 4, lease);
  throw py::index_error("no column is called " + name +
                        ": positions, rest_positions, velocities, masses, strengths, tetrahedra");
}

py::array leased_view(const py::object& self, const std::string& name) {
  const auto& sim = self.cast<const Stepped&>();
  const InUse use(sim.in_use);
  auto lease = std::make_unique<Lease>(self);
  const py::capsule owner(lease.get(), [](void* held) { delete static_cast<Lease*>(held); });
  lease.release();
  return column_view(sim.simulation, name, owner);
}

}  // namespace

void refuse_where_viewed(const Stepped& sim) {
  if (sim.views == 0) return;
  throw py::buffer_error(
      "views of this simulation are alive, and a change could move its columns: delete them first, "
      "or take the copies, such as `positions`");
}

void bind_rows(Type& type) {
  type.def("view", &leased_view, py::arg("name"),
           "A column without a copy: positions, rest_positions, velocities, masses, strengths or "
           "tetrahedra, with shapes as the properties. It cannot be written to. While it, or an "
           "array over it, is alive, each change of the simulation raises BufferError.");
  add(type, "positions", "float64 (n, 3), m, world. A copy.",
      [](const Simulation& s) { return array_of(rows_of(s).position); });
  add(type, "rest_positions", "float64 (n, 3), m, in the bodies' meshes. A copy.",
      [](const Simulation& s) { return array_of(rows_of(s).rest_position); });
  add(type, "velocities", "float64 (n, 3), m/s. A copy.",
      [](const Simulation& s) { return array_of(rows_of(s).velocity); });
  add(type, "masses", "float64 (n,), kg. A copy.",
      [](const Simulation& s) { return copied<double>(rows_of(s).mass, 0); });
  add(type, "strengths", "float64 (n,), Pa: threshold of the largest principal stress. A copy.",
      [](const Simulation& s) { return copied<double>(rows_of(s).strength, 0); });
  add(type, "vertex_pieces", "int64 (n,): the piece of each vertex. A copy.",
      [](const Simulation& s) { return ids<ComponentId>(rows_of(s).component); });
  add(type, "tetrahedra", "uint32 (t, 4): vertex rows. A split changes them. A copy.",
      [](const Simulation& s) { return copied<std::uint32_t>(map_of(s).corners(), 4); });
  add(type, "pieces", "int64 (t,): the piece of each tetrahedron. A copy.",
      [](const Simulation& s) { return ids<ComponentId>(rows_of(s).cell_component); });
  add(type, "stresses", "float64 (t, 3, 3), Pa, in the axes of the body's mesh. A copy.",
      [](const Simulation& s) { return of_tensors(rows_of(s).cell_stress); });
  add(type, "vertex_stresses", "float64 (n, 3, 3), Pa: means around each vertex. O(|T|).",
      [](const Simulation& s) { return of_tensors(vertex_stress(s)); });
  add(type, "faces", "uint32 (f, 3): boundary faces, counterclockwise from outside. O(|T|).",
      [](const Simulation& s) { return column<std::uint32_t>(s, SUNDER_FACE, 3); });
  add(type, "face_is_crack", "uint32 (f,): 1 for a face of a crack or cut. O(|T|).",
      [](const Simulation& s) { return column<std::uint32_t>(s, SUNDER_FACE_IS_CRACK, 0); });
}

}  // namespace sunder::python
