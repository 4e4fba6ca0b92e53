// SPDX-License-Identifier: MIT
#include "apps/python/arrays.hpp"

namespace sunder::python {

Array<std::int64_t> integers(const py::object& numbers, const char* name) {
  const py::array array = py::array::ensure(numbers);
  if (!array) throw py::value_error(std::string(name) + " must be an array");
  const char kind = array.dtype().kind();
  if (array.size() > 0 && kind != 'i' && kind != 'u') {
    throw py::value_error(std::string(name) + " must be whole numbers");
  }
  return Array<std::int64_t>::ensure(array);
}

Vec3 vec3(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

py::array_t<double> array_of(const Vec3& v) {
  return copied<double>(std::span<const double>(v.data(), 3), 0);
}

py::array_t<double> array_of(const Mat3& m) {
  py::array_t<double> result({3, 3});
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.mutable_at(i, j) = m(i, j);
  }
  return result;
}

py::array_t<double> array_of(std::span<const Vec3> rows) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return copied<double>(rows, 3);
}

}  // namespace sunder::python
