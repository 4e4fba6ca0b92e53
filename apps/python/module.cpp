// SPDX-License-Identifier: MIT
// The compiled part of the Python module; sunder/__init__.py shows it to users.
#include <pybind11/pybind11.h>

#include <sunder/version.hpp>

#include "apps/python/bindings.hpp"
#include "apps/python/findings.hpp"

PYBIND11_MODULE(_sunder, module) {
  module.doc() = "Compiled part of sunder.";
  module.attr("__version__") = SUNDER_VERSION;
  sunder::python::bind_findings(module);
  sunder::python::bind_mesh(module);
  sunder::python::bind_map(module);
  sunder::python::bind_step_report(module);
  sunder::python::bind_simulation(module);
  sunder::python::bind_statics(module);
}
