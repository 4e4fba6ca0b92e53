// SPDX-License-Identifier: MIT
// The parts of the Python module, each added by its source.
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "topology/base/finding.hpp"
#include "topology/kernel/counts.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder::python {

/// A mesh with the findings of its reading. It does not change after it was made, so that arrays
/// over it stay valid.
struct Mesh {
  FileMesh mesh;
  std::vector<Finding> findings;
};

/// Counts as a dictionary with the names of its fields.
pybind11::dict counts_dict(const Counts& counts);

void bind_mesh(pybind11::module_& module);
void bind_map(pybind11::module_& module);
void bind_step_report(pybind11::module_& module);
void bind_simulation(pybind11::module_& module);
void bind_statics(pybind11::module_& module);

}  // namespace sunder::python
