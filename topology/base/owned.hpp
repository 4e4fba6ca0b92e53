// SPDX-License-Identifier: MIT
// A member whose type the reader of a header need not know.
#pragma once

#include <memory>
#include <utility>

namespace sunder {

/// Owns one `T` and is const where it is; `T` may be incomplete where this is only held.
template <class T>
class Owned {
 public:
  Owned() = default;
  explicit Owned(std::unique_ptr<T> value) : value_(std::move(value)) {}
  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }
  T* operator->() { return value_.get(); }
  const T* operator->() const { return value_.get(); }

 private:
  std::unique_ptr<T> value_;
};

}  // namespace sunder
