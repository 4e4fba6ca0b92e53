// SPDX-License-Identifier: MIT
// The report of a step and the pieces of a simulation, as Python reads them.
#include <pybind11/stl.h>

#include "apps/output/fragment.hpp"
#include "apps/python/arrays.hpp"
#include "apps/python/bindings.hpp"
#include "fracture/simulation/step_report.hpp"

namespace sunder::python {
namespace {

py::dict energy_of(const StepReport& report) {
  const EnergyLedger& e = report.energy;
  py::dict energy;
  energy["kinetic"] = e.kinetic;
  energy["strain"] = e.strain;
  energy["gravity"] = e.gravity;
  energy["loads"] = e.loads;
  energy["contact"] = e.contact;
  energy["friction"] = e.friction;
  energy["supports"] = e.supports;
  energy["cracks"] = e.cracks;
  energy["numerical"] = e.numerical;
  energy["residual"] = e.residual;
  return energy;
}

py::object id_or_none(ComponentId id) {
  return id.is_none() ? py::object(py::none()) : py::object(py::int_(id.value));
}

void bind_fan(py::module_& module) {
  py::class_<FanEvent>(module, "Fan", "A vertex that broke, and the faces that it split.")
      .def_property_readonly(
          "vertex", [](const FanEvent& f) { return f.vertex.value; }, "Row of the vertex.")
      .def_readonly("point", &FanEvent::point, "Row of the mesh's point.")
      .def_property_readonly(
          "rest_position", [](const FanEvent& f) { return array_of(f.rest_position); },
          "(3,), m, in the body's mesh.")
      .def_property_readonly(
          "normal", [](const FanEvent& f) { return array_of(f.normal); },
          "(3,), unit length, in the body's mesh.")
      .def_readonly("stress", &FanEvent::stress, "Largest principal stress, Pa.")
      .def_readonly("strength", &FanEvent::strength, "Threshold that it reached, Pa.")
      .def_property_readonly(
          "faces", [](const FanEvent& f) { return f.faces.size(); }, "Number of faces that split.")
      .def_property_readonly(
          "created", [](const FanEvent& f) { return f.components.created; },
          "Number of pieces that came off.");
}

void bind_fragment(py::module_& module) {
  py::class_<Fragment>(module, "Fragment", "One connected piece at one time.")
      .def_property_readonly(
          "id", [](const Fragment& f) { return f.id.value; }, "Row of the piece, never used again.")
      .def_readonly("body", &Fragment::body, "Row of its body in the scene.")
      .def_readonly("tetrahedra", &Fragment::tetrahedra, "Number of tetrahedra.")
      .def_readonly("vertices", &Fragment::vertices, "Number of vertices.")
      .def_readonly("mass", &Fragment::mass, "kg.")
      .def_readonly("volume", &Fragment::volume, "m^3, at rest.")
      .def_readonly("surface", &Fragment::surface, "m^2, of all boundary faces at rest.")
      .def_readonly("crack_area", &Fragment::crack_area, "m^2, of faces from cracks.")
      .def_property_readonly(
          "parent", [](const Fragment& f) { return id_or_none(f.parent); },
          "The piece that it came off, or None.")
      .def_readonly("birth_step", &Fragment::birth_step, "Step in which it came off, or 0.")
      .def_property_readonly(
          "center", [](const Fragment& f) { return array_of(f.center); },
          "(3,), m, world: mass centre.")
      .def_property_readonly(
          "velocity", [](const Fragment& f) { return array_of(f.velocity); }, "(3,), m/s.")
      .def_property_readonly(
          "spin", [](const Fragment& f) { return array_of(f.spin); }, "(3,), rad/s.")
      .def_property_readonly(
          "inertia", [](const Fragment& f) { return array_of(f.inertia); },
          "(3, 3), kg m^2, about the mass centre, world axes.");
}

}  // namespace

void bind_step_report(py::module_& module) {
  bind_fan(module);
  bind_fragment(module);
  py::class_<StepReport>(module, "StepReport", "Report of one step.")
      .def_readonly("step", &StepReport::step, "Number of steps since the start.")
      .def_readonly("time", &StepReport::time, "s, at the end of the step.")
      .def_readonly("pieces", &StepReport::components, "Number of pieces.")
      .def_property_readonly(
          "new_pieces", [](const StepReport& r) { return ids<ComponentId>(r.new_components); },
          "int64 (k,): ids of pieces that came off.")
      .def_property_readonly(
          "fans", [](const StepReport& r) { return r.fracture.fans; }, "List of Fan, in order.")
      .def_property_readonly(
          "contacts", [](const StepReport& r) { return r.contact.contacts; },
          "Number of contacts with an impulse.")
      .def_readonly("parts", &StepReport::parts, "Parts of the step, above 1 after an impact.")
      .def_property_readonly("energy", &energy_of,
                             "J: changes, works and losses of the step, by name.")
      .def_property_readonly(
          "stage_ms",
          [](const StepReport& r) {
            py::dict times;
            for (std::size_t i = 0; i < r.stage_ms.size(); ++i) {
              times[py::str(std::string(stage_names[i]))] = r.stage_ms[i];
            }
            return times;
          },
          "ms of wall time by stage.")
      .def("__repr__", [](const StepReport& r) {
        return "<sunder.StepReport of step " + std::to_string(r.step) + ": " +
               std::to_string(r.fracture.fans.size()) + " fans, " + std::to_string(r.components) +
               " pieces>";
      });
}

}  // namespace sunder::python
