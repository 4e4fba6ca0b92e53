// SPDX-License-Identifier: MIT
#include "apps/python/findings.hpp"

#include <pybind11/stl.h>

#include "apps/scene/words.hpp"

namespace sunder::python {
namespace {

/// Raises `sunder.Error`: its text is that of the findings, its attribute `findings` the list.
void raise(const Refused& refused) {
  const py::object type = py::module_::import("sunder._sunder").attr("Error");
  py::object error = type(finding_lines(refused.findings));
  error.attr("findings") = py::cast(refused.findings);
  PyErr_SetObject(type.ptr(), error.ptr());
}

}  // namespace

void bind_findings(py::module_& module) {
  py::class_<Finding>(module, "Finding",
                      "One fault or remark about a file, a mesh or a scene, with its remedy.")
      .def_readonly("code", &Finding::code, "Stable name, such as \"flat_tetrahedron\".")
      .def_property_readonly(
          "severity", [](const Finding& f) { return std::string(to_string(f.severity)); },
          "\"error\", \"warning\" or \"note\".")
      .def_readonly("count", &Finding::count, "Number of cells or places that show it.")
      .def_readonly("ids", &Finding::ids, "The first of these, at most 16: rows from 0.")
      .def_readonly("text", &Finding::text, "The observation, its place and the expected value.")
      .def_readonly("remedy", &Finding::remedy, "The remedy.")
      .def_readonly("file", &Finding::file, "The file with the fault, or an empty string.")
      .def_readonly("line", &Finding::line, "Line counted from 1, or 0.")
      .def("__repr__", [](const Finding& f) {
        return "<sunder.Finding " + std::string(to_string(f.severity)) + " " + f.code + ": " +
               f.text + ">";
      });
  const py::object error = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
      "sunder.Error",
      "An input that cannot be used, or a simulation that failed. `findings` is the list of "
      "reasons, each a Finding with a remedy.",
      PyExc_Exception, nullptr));
  error.attr("findings") = py::list();
  module.attr("Error") = error;
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Refused& refused) {
      raise(refused);
    }
  });
}

}  // namespace sunder::python
