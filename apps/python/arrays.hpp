// SPDX-License-Identifier: MIT
// Rows of the library as NumPy arrays, and back.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "mechanics/state/vec3.hpp"
#include "topology/base/ids.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder::python {

namespace py = pybind11;

template <class T>
using Array = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// A new array (rows, columns), or (rows,) with `columns` 0, of the numbers of `values`, copied.
/// Requires: Value is `columns` (or 1) numbers of type T and nothing else.
template <class T, class Value>
py::array_t<T> copied(std::span<const Value> values, std::size_t columns) {
  const std::size_t width = columns == 0 ? 1 : columns;
  std::vector<py::ssize_t> shape{
      static_cast<py::ssize_t>(values.size() * sizeof(Value) / (width * sizeof(T)))};
  if (columns != 0) shape.push_back(static_cast<py::ssize_t>(columns));
  py::array_t<T> result(shape);
  if (!values.empty()) std::memcpy(result.mutable_data(), values.data(), values.size_bytes());
  return result;
}

/// An array over numbers that `owner` holds, without a copy. It cannot be written to and keeps
/// `owner` alive. Requires: numbers that stay where they are as long as `owner` lives.
template <class T, class Value>
py::array_t<T> view(std::span<const Value> values, std::size_t columns, py::handle owner) {
  const std::size_t width = columns == 0 ? 1 : columns;
  std::vector<py::ssize_t> shape{
      static_cast<py::ssize_t>(values.size() * sizeof(Value) / (width * sizeof(T)))};
  if (columns != 0) shape.push_back(static_cast<py::ssize_t>(columns));
  py::array_t<T> result(shape, reinterpret_cast<const T*>(values.data()), owner);
  result.attr("flags").attr("writeable") = false;
  return result;
}

/// Ids as integers of 64 bits, -1 for none().
template <class Id>
py::array_t<std::int64_t> ids(std::span<const Id> values) {
  py::array_t<std::int64_t> result(static_cast<py::ssize_t>(values.size()));
  std::int64_t* out = result.mutable_data();
  for (const Id id : values) *out++ = id.is_none() ? -1 : static_cast<std::int64_t>(id.value);
  return result;
}

/// Rows of `width` numbers. Throws ValueError, with `name`, where the array has another shape.
template <class T>
const T* rows_of(const Array<T>& array, std::size_t width, const char* name) {
  if (array.ndim() != 2 || array.shape(1) != static_cast<py::ssize_t>(width)) {
    throw py::value_error(std::string(name) + " must have the shape (n, " + std::to_string(width) +
                          ")");
  }
  return array.data();
}

/// Whole numbers of an array or a list. Throws ValueError, with `name`, for numbers that a cast
/// would change.
Array<std::int64_t> integers(const py::object& numbers, const char* name);

Vec3 vec3(const std::array<double, 3>& v);
py::array_t<double> array_of(const Vec3& v);
py::array_t<double> array_of(const Mat3& m);
/// (n, 3).
py::array_t<double> array_of(std::span<const Vec3> rows);

}  // namespace sunder::python
