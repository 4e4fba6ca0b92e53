// SPDX-License-Identifier: MIT
// Values of a column as bytes, one after the other.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <vector>

#include "mechanics/state/vec3.hpp"

namespace sunder {

/// Appends values to bytes.
class Column {
 public:
  explicit Column(std::vector<unsigned char>& bytes) : bytes_(bytes) { bytes_.clear(); }

  template <class T>
  void add(T value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(T));
    std::memcpy(&bytes_[at], &value, sizeof(T));
  }
  template <class... T>
  void add_floats(T... values) {
    (add(static_cast<float>(values)), ...);
  }
  void add_floats(const Vec3& v) { add_floats(v[0], v[1], v[2]); }
  void add_pose(const Vec3& centre, const Eigen::Quaterniond& q) {
    add_floats(centre);
    add_floats(0, q.x(), q.y(), q.z(), q.w());
  }
  void add_doubles(std::initializer_list<double> values) {
    for (const double value : values) add(value);
  }

 private:
  std::vector<unsigned char>& bytes_;
};

}  // namespace sunder
