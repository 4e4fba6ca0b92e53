// SPDX-License-Identifier: MIT
// Simulations: steps, runs, pieces, states, actions.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>

#include "apps/output/fragment.hpp"
#include "apps/python/arrays.hpp"
#include "apps/python/bindings.hpp"
#include "apps/python/findings.hpp"
#include "apps/python/stepped.hpp"
#include "apps/scene/scene_hash.hpp"
#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/changes/actions.hpp"
#include "fracture/simulation/changes/bodies.hpp"
#include "fracture/simulation/rows.hpp"
#include "topology/base/fnv1a.hpp"

namespace sunder::python {
namespace {

using Path = std::filesystem::path;

/// Runs `work(sim)` without the interpreter's lock, for one thread at a time.
template <class Work>
auto alone(const Stepped& sim, const Work& work) {
  const InUse use(sim.in_use);
  return unlocked(work);
}

std::string hash_of(const Stepped& sim) {
  return alone(sim, [&] {
    Fnv1a sum;
    sum.add(saved_state(sim.simulation));
    return hex_digits(sum.value);
  });
}

std::unique_ptr<Stepped> restored(Result<Simulation>&& simulation) {
  return std::make_unique<Stepped>(value_of(std::move(simulation)));
}

void refuse_where_recorded(const Stepped& sim) {
  if (!sim.recorder) return;
  throw Refused{{{.code = "run_is_recorded",
                  .text = "a run with files is that of its scene alone",
                  .remedy = "act on a run without a folder"}}};
}

/// A running piece by its row. Throws IndexError.
ComponentId piece_of(const Stepped& sim, std::int64_t id) {
  const auto labels = rows_of(sim.simulation).cell_component;
  const ComponentId piece{static_cast<std::size_t>(id)};
  if (id < 0 || std::ranges::find(labels, piece) == labels.end()) {
    throw py::index_error("there is no piece " + std::to_string(id));
  }
  return piece;
}

py::dict surface(const Stepped& sim, std::int64_t id) {
  const InUse use(sim.in_use);
  const FragmentSurface found = fragment_surface(sim.simulation, piece_of(sim, id));
  py::dict result;
  result["vertices"] = ids<VertexId>(found.vertex);
  result["rest_positions"] = array_of(found.rest_position);
  result["positions"] = array_of(found.position);
  result["triangles"] = copied<std::uint32_t>(std::span(found.triangles), 3);
  py::array_t<bool> is_crack(static_cast<py::ssize_t>(found.is_crack.size()));
  for (std::size_t i = 0; i < found.is_crack.size(); ++i) {
    is_crack.mutable_data()[i] = found.is_crack[i] != 0;
  }
  result["is_crack"] = is_crack;
  return result;
}

/// The history begins again after a change of obstacles or bodies, whose columns it has.
void begin_again(Stepped& sim) {
  sim.history = begin_history(sim.simulation);
  sim.acted = true;
}

BodyChange changed(Stepped& sim, Result<BodyChange>&& change) {
  BodyChange made = value_of(std::move(change));
  begin_again(sim);
  return made;
}

void bind_bodies(py::module_& module, py::class_<Stepped>& type) {
  py::class_<BodyChange>(module, "BodyChange", "A body that came or went, with all of its pieces.")
      .def_readonly("body", &BodyChange::body, "Its row.")
      .def_property_readonly(
          "pieces", [](const BodyChange& c) { return ids<ComponentId>(c.pieces); },
          "int64 (k,): ids of its pieces.")
      .def_readonly("mass", &BodyChange::mass, "kg.")
      .def_readonly("kinetic", &BodyChange::kinetic, "J.")
      .def_readonly("strain", &BodyChange::strain, "J.")
      .def_property_readonly(
          "momentum", [](const BodyChange& c) { return array_of(Vec3(c.momentum.head<3>())); },
          "(3,), kg m/s.")
      .def_property_readonly(
          "angular_momentum",
          [](const BodyChange& c) { return array_of(Vec3(c.momentum.tail<3>())); },
          "(3,), kg m^2/s, about the origin.");
  type.def(
          "_add",
          [](Stepped& sim, const SceneInput& body) {
            refuse_where_recorded(sim);
            refuse_where_viewed(sim);
            return alone(sim, [&] {
              Result<BodyChange> change = add_body(sim.simulation, read_body_input(body));
              for (const Finding& f : change.findings) sim.findings.push_back(f);
              return changed(sim, std::move(change));
            });
          },
          py::arg("body"))
      .def(
          "remove",
          [](Stepped& sim, std::size_t body) {
            refuse_where_recorded(sim);
            refuse_where_viewed(sim);
            return alone(sim, [&] { return changed(sim, remove_body(sim.simulation, body)); });
          },
          py::arg("body"),
          "Removes the body of this row with all of its pieces. Ids of other pieces and rows of "
          "other bodies stay, rows of vertices and tetrahedra close up. The history begins again. "
          "Returns a BodyChange. Raises Error.");
}

void bind_pull(py::class_<Stepped>& type) {
  type.def(
          "pull",
          [](Stepped& sim, std::size_t vertex, const std::array<double, 3>& end) {
            const InUse use(sim.in_use);
            refuse_where_recorded(sim);
            if (auto fault = pull(sim.simulation, VertexId{vertex}, vec3(end))) {
              throw Refused{{*fault}};
            }
          },
          py::arg("vertex"), py::arg("end"),
          "Pulls a vertex to `end`, m, by a damped spring, until `release`. It is not saved.")
      .def(
          "release",
          [](Stepped& sim) {
            const InUse use(sim.in_use);
            release(sim.simulation);
          },
          "Ends a pull.");
}

void bind_actions(py::class_<Stepped>& type) {
  type.def(
          "shoot",
          [](Stepped& sim, const std::array<double, 3>& point,
             const std::array<double, 3>& velocity, double radius, double mass) {
            const InUse use(sim.in_use);
            refuse_where_recorded(sim);
            const auto fault = shoot(sim.simulation, {vec3(point), radius}, vec3(velocity), mass);
            if (fault) throw Refused{{*fault}};
            begin_again(sim);
          },
          py::arg("point"), py::arg("velocity"), py::kw_only(), py::arg("radius"), py::arg("mass"),
          "Adds a free ball: point in m, velocity in m/s, radius in m, mass in kg. The history "
          "begins again with the new obstacle.")
      .def(
          "cut",
          [](Stepped& sim, const std::array<double, 3>& point,
             const std::array<double, 3>& normal) {
            refuse_where_recorded(sim);
            refuse_where_viewed(sim);
            return alone(sim, [&] {
              FanEvent event = value_of(cut(sim.simulation, vec3(point), vec3(normal)));
              sim.acted = true;
              return event;
            });
          },
          py::arg("point"), py::arg("normal"),
          "Parts all pieces along faces near the plane through a point, m. Returns a Fan.");
}

void bind_states(py::class_<Stepped>& type) {
  type.def(
          "save",
          [](const Stepped& sim, const Path& path) {
            refuse_errors(alone(sim, [&] { return save(sim.simulation, path); }));
          },
          py::arg("path"), "Writes the whole state to a file. Raises Error.")
      .def(
          "to_bytes",
          [](const Stepped& sim) {
            return py::bytes(alone(sim, [&] { return saved_state(sim.simulation); }));
          },
          "The whole state as bytes.")
      .def_property_readonly("hash", &hash_of, "Sixteen digits: equal for equal states. O(state).");
}

void bind_steps(py::class_<Stepped>& type) {
  type.def(
          "step",
          [](Stepped& sim) {
            refuse_where_viewed(sim);
            return alone(sim, [&] { return step(sim); });
          },
          "Takes one step and returns its StepReport. Other threads of Python run meanwhile. "
          "Raises Error where the step fails.")
      .def(
          "_open_run",
          [](Stepped& sim, const Path& folder, bool force) {
            alone(sim, [&] { return open_run(sim, folder, force), 0; });
          },
          py::arg("folder"), py::arg("force"))
      .def(
          "_finish_run",
          [](Stepped& sim, bool failed) {
            return alone(sim, [&] {
              const bool at_end = steps_taken(sim.simulation) >= step_count(sim.simulation.scene);
              return finish_run(sim, failed   ? RunEnd::failed
                                     : at_end ? RunEnd::finished
                                              : RunEnd::interrupted);
            });
          },
          py::arg("failed"))
      .def("_history_csv",
           [](const Stepped& sim) { return alone(sim, [&] { return history_text(sim); }); })
      .def_property_readonly(
          "steps_taken",
          [](const Stepped& sim) {
            const InUse use(sim.in_use);
            return steps_taken(sim.simulation);
          },
          "Number of steps since the start.")
      .def_property_readonly(
          "step_count", [](const Stepped& sim) { return step_count(sim.simulation.scene); },
          "Number of steps of the scene.")
      .def_property_readonly(
          "time",
          [](const Stepped& sim) {
            const InUse use(sim.in_use);
            return simulated_time(sim.simulation);
          },
          "s, since the start.")
      .def_readonly("findings", &Stepped::findings,
                    "Warnings and notes about the scene: a list of Finding.");
}

}  // namespace

void bind_simulation(py::module_& module) {
  py::class_<SceneInput>(module, "SceneInput")
      .def(py::init<>())
      .def_readwrite("path", &SceneInput::path)
      .def_readwrite("text", &SceneInput::text)
      .def_readwrite("folder", &SceneInput::folder)
      .def_readwrite("meshes", &SceneInput::meshes)
      .def_readwrite("settings", &SceneInput::settings);
  py::class_<Stepped> type(module, "SimulationBase");
  type.def(py::init([](const SceneInput& input) {
             return unlocked([&] { return std::make_unique<Stepped>(input); });
           }),
           py::arg("scene"))
      .def(py::init([](const py::bytes& state) {
             const std::string bytes = state;
             return unlocked([&] { return restored(restore(bytes)); });
           }),
           py::arg("state"))
      .def(
          py::init([](const Path& path) { return unlocked([&] { return restored(load(path)); }); }),
          py::arg("path"));
  bind_steps(type);
  bind_states(type);
  bind_rows(type);
  bind_actions(type);
  bind_pull(type);
  bind_bodies(module, type);
  type.def(
          "fragments",
          [](const Stepped& sim) { return alone(sim, [&] { return fragments(sim.simulation); }); },
          "All pieces in the order of their ids: a list of Fragment. O(|V| + |T|).")
      .def("surface", &surface, py::arg("piece"),
           "The boundary of a piece: `vertices` (n,), `rest_positions` and `positions` (n, 3) in "
           "m, `triangles` (f, 3) as rows of these, `is_crack` (f,).")
      .def(
          "check_map",
          [](const Stepped& sim) { return alone(sim, [&] { return check_map(sim.simulation); }); },
          "Compares the map and the labels of pieces with all laws. Returns findings.");
}

}  // namespace sunder::python
