// SPDX-License-Identifier: MIT
// Findings as Python's exceptions, and calls without the interpreter's lock.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <utility>
#include <vector>

#include "topology/base/finding.hpp"

namespace sunder::python {

namespace py = pybind11;

/// Becomes Python's `sunder.Error` with these findings.
struct Refused {
  std::vector<Finding> findings;
};

/// Adds `Finding`, `Error` and their translation.
void bind_findings(py::module_& module);

/// Runs `work` without the interpreter's lock. `work` touches no object of Python.
template <class Work>
auto unlocked(const Work& work) {
  const py::gil_scoped_release release;
  return work();
}

/// The value of a result. Throws Refused with its findings where there is none.
template <class T>
T value_of(Result<T>&& result) {
  if (!result) throw Refused{std::move(result.findings)};
  return std::move(*result);
}

/// Throws Refused where one of the findings is an error.
inline void refuse_errors(const std::vector<Finding>& findings) {
  if (has_error(findings)) throw Refused{findings};
}

/// One user of an object at a time, because long calls leave Python's other threads running.
/// Throws std::runtime_error (RuntimeError) where another thread uses the object.
class InUse {
 public:
  explicit InUse(std::atomic<bool>& flag) : flag_(flag) {
    if (flag_.exchange(true)) {
      throw std::runtime_error("another thread uses this object; one thread at a time may");
    }
  }
  ~InUse() { flag_ = false; }
  InUse(const InUse&) = delete;
  InUse& operator=(const InUse&) = delete;

 private:
  std::atomic<bool>& flag_;
};

}  // namespace sunder::python
