// SPDX-License-Identifier: MIT
// A member with a type that readers of a header need not know.
#pragma once

#include <memory>
#include <utility>

#include "topology/base/misuse.hpp"

namespace sunder {

/// Owns one `T`, with the constness of the owner. `T` may be incomplete in code that only holds it.
/// Access to an empty or moved-from owner throws Misuse.
template <class T>
class Owned {
 public:
  Owned() = default;
  explicit Owned(std::unique_ptr<T> value) : value_(std::move(value)) {}
  T& operator*() { return *there(); }
  const T& operator*() const { return *there(); }
  T* operator->() { return there(); }
  const T* operator->() const { return there(); }

 private:
  T* there() const {
    require(value_ != nullptr, "the simulation is empty: it was moved from, or never built");
    return value_.get();
  }

  std::unique_ptr<T> value_;
};

}  // namespace sunder
