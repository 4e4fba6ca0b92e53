// SPDX-License-Identifier: MIT
// Plain data as bytes and back by one definition: numbers little endian and of their own width,
// counts as 64 bits, containers and structs member by member.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "topology/base/ids.hpp"

namespace sunder {

/// Makes the result of an overload of `member_names`.
template <class... Name>
constexpr std::array<std::string_view, sizeof...(Name)> names(const Name&... name) {
  return {std::string_view(name)...};
}

/// Calls `visit` with the name of every member of a struct and the member, in their order.
/// Overloads of `member_names(const T*)` give the names. A struct that gains or loses a member does
/// not compile until they, and with them the format, are reviewed.
template <class T, class Visit>
void for_each_member(T& x, Visit visit) {
  constexpr auto called = member_names(static_cast<const T*>(nullptr));
  constexpr std::size_t n = called.size();
  static_assert(n >= 1 && n <= 19);
  const auto all = [&](auto&... member) {
    std::size_t k = 0;
    (visit(called[k++], member), ...);
  };
  if constexpr (n == 1) {
    auto& [a] = x;
    all(a);
  } else if constexpr (n == 2) {
    auto& [a, b] = x;
    all(a, b);
  } else if constexpr (n == 3) {
    auto& [a, b, c] = x;
    all(a, b, c);
  } else if constexpr (n == 4) {
    auto& [a, b, c, d] = x;
    all(a, b, c, d);
  } else if constexpr (n == 5) {
    auto& [a, b, c, d, e] = x;
    all(a, b, c, d, e);
  } else if constexpr (n == 6) {
    auto& [a, b, c, d, e, f] = x;
    all(a, b, c, d, e, f);
  } else if constexpr (n == 7) {
    auto& [a, b, c, d, e, f, g] = x;
    all(a, b, c, d, e, f, g);
  } else if constexpr (n == 8) {
    auto& [a, b, c, d, e, f, g, h] = x;
    all(a, b, c, d, e, f, g, h);
  } else if constexpr (n == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = x;
    all(a, b, c, d, e, f, g, h, i);
  } else if constexpr (n == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = x;
    all(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (n == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = x;
    all(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (n == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = x;
    all(a, b, c, d, e, f, g, h, i, j, k, l);
  } else if constexpr (n == 13) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = x;
    all(a, b, c, d, e, f, g, h, i, j, k, l, m);
  } else if constexpr (n == 14) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o] = x;
    all(a, b, c, d, e, f, g, h, i, j, k, l, m, o);
  } else if constexpr (n == 15) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p] = x;
    all(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p);
  } else if constexpr (n == 16) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q] = x;
    all(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q);
  } else if constexpr (n == 17) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r] = x;
    all(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r);
  } else if constexpr (n == 18) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s] = x;
    all(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s);
  } else {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, t] = x;
    all(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, t);
  }
}

template <class T>
concept Scalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// The type of a number in a file: `long`, and so sizes and indices, has 64 bits on every machine.
template <Scalar T>
using Saved = std::conditional_t<std::is_same_v<T, unsigned long>, std::uint64_t,
                                 std::conditional_t<std::is_same_v<T, long>, std::int64_t, T>>;

/// A number as the bytes of a file, and back: the same call.
template <Scalar T>
T little_endian(T x) {
  if constexpr (std::endian::native == std::endian::big) {
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(x);
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    x = std::bit_cast<T>(bytes);
  }
  return x;
}

/// Appends to `bytes`.
struct StateWriter {
  std::string bytes;

  template <Scalar T>
  void numbers(const T* x, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto number = little_endian(static_cast<Saved<T>>(x[i]));
      bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
  }
  void count(const std::uint64_t& n) { numbers(&n, 1); }
};

/// Takes from the front of `bytes`. A read beyond the end, or a size that claims more than is
/// there, fails; after that nothing is read or allocated any more.
struct StateReader {
  std::string_view bytes;
  bool failed = false;

  template <Scalar T>
  void numbers(T* x, std::size_t count) {
    constexpr std::size_t size = sizeof(Saved<T>);
    if (failed || count > bytes.size() / size) {
      failed = true;
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      std::array<char, size> raw;
      std::memcpy(raw.data(), bytes.data() + i * size, size);
      if constexpr (std::is_same_v<T, bool>) {
        x[i] = raw[0] != 0;
      } else {
        x[i] = static_cast<T>(little_endian(std::bit_cast<Saved<T>>(raw)));
      }
    }
    bytes.remove_prefix(count * size);
  }
  /// A number of things that take at least `least` bytes each.
  void count(std::uint64_t& n, std::size_t least = 1) {
    n = 0;
    numbers(&n, 1);
    failed = failed || n > bytes.size() / least;
    if (failed) n = 0;
  }
};

template <class Archive>
inline constexpr bool is_reader = std::is_same_v<Archive, StateReader>;

/// An archive that writes nothing and gets the place of each number: `enter` with a member's name
/// (whether to go in) or a row, and `leave`.
template <class Archive>
inline constexpr bool is_told_places = requires(Archive& a) {
  a.leave();
};

template <class Archive, class T>
void archive(Archive& a, T& x);

/// A member of a struct by its name.
template <class Archive, class T>
void archive_member(Archive& a, [[maybe_unused]] std::string_view name, T& member) {
  if constexpr (is_told_places<Archive>) {
    if (a.enter(name)) archive(a, member);
    a.leave();
  } else {
    archive(a, member);
  }
}

template <class Archive, class T>
void archive_all(Archive& a, T& container) {
  using Value = typename std::remove_const_t<T>::value_type;
  std::uint64_t n = container.size();
  if constexpr (Scalar<Value>) {
    if constexpr (is_reader<Archive>) {
      a.count(n, sizeof(Saved<Value>));
      container.resize(n);
    } else {
      a.count(n);
    }
    if constexpr (is_told_places<Archive>) {
      a.rows(container.data(), n);
    } else {
      a.numbers(container.data(), n);
    }
  } else if constexpr (is_reader<Archive>) {
    a.count(n);
    container.clear();
    for (std::uint64_t i = 0; i < n && !a.failed; ++i) {
      container.emplace_back();
      archive(a, container.back());
    }
  } else {
    a.count(n);
    if constexpr (is_told_places<Archive>) {
      std::uint64_t row = 0;
      for (auto& value : container) {
        a.enter(row++);
        archive(a, value);
        a.leave();
      }
    } else {
      for (auto& value : container) archive(a, value);
    }
  }
}

template <class Archive, class T>
void archive_dynamic(Archive& a, T& matrix) {
  std::uint64_t rows = static_cast<std::uint64_t>(matrix.rows());
  std::uint64_t columns = static_cast<std::uint64_t>(matrix.cols());
  a.count(rows);
  a.count(columns);
  if constexpr (is_reader<Archive>) {
    using M = std::remove_const_t<T>;
    const bool fits = columns == 0 || rows <= a.bytes.size() / sizeof(double) / columns;
    const bool fixed = M::RowsAtCompileTime != Eigen::Dynamic &&
                       rows != static_cast<std::uint64_t>(M::RowsAtCompileTime);
    const bool narrow = M::ColsAtCompileTime != Eigen::Dynamic &&
                        columns != static_cast<std::uint64_t>(M::ColsAtCompileTime);
    a.failed = a.failed || !fits || fixed || narrow;
    if (a.failed) return;
    matrix.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  }
  a.numbers(matrix.data(), static_cast<std::size_t>(matrix.size()));
}

template <class T>
inline constexpr bool is_id = false;
template <class Tag>
inline constexpr bool is_id<Id<Tag>> = true;
template <class T>
inline constexpr bool is_pair = false;
template <class A, class B>
inline constexpr bool is_pair<std::pair<A, B>> = true;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_unique = false;
template <class T>
inline constexpr bool is_unique<std::unique_ptr<T>> = true;
template <class T>
inline constexpr bool is_variant = false;
template <class... T>
inline constexpr bool is_variant<std::variant<T...>> = true;
template <class T>
inline constexpr bool is_map = false;
template <class K, class V>
inline constexpr bool is_map<std::map<K, V>> = true;

/// The value of a variant by the number of its alternative.
template <class Archive, class T, std::size_t... I>
void archive_variant(Archive& a, T& x, std::index_sequence<I...>) {
  std::uint64_t which = x.index();
  a.count(which);
  const auto one = [&]<std::size_t i>() {
    if (which != i) return;
    if constexpr (is_reader<Archive>) x.template emplace<i>();
    archive(a, std::get<i>(x));
  };
  (one.template operator()<I>(), ...);
  if constexpr (is_reader<Archive>) a.failed = a.failed || which >= sizeof...(I);
}

/// Writes `x` with a `StateWriter`, or reads it with a `StateReader`.
template <class Archive, class T>
void archive(Archive& a, T& x) {
  using V = std::remove_const_t<T>;
  if constexpr (Scalar<V>) {
    a.numbers(&x, 1);
  } else if constexpr (is_id<V>) {
    a.numbers(&x.value, 1);
  } else if constexpr (requires { V::RowsAtCompileTime; }) {
    if constexpr (V::SizeAtCompileTime == Eigen::Dynamic) {
      archive_dynamic(a, x);
    } else {
      a.numbers(x.data(), static_cast<std::size_t>(V::SizeAtCompileTime));
    }
  } else if constexpr (requires { x.coeffs(); }) {
    a.numbers(x.coeffs().data(), 4);
  } else if constexpr (is_pair<V>) {
    archive(a, x.first);
    archive(a, x.second);
  } else if constexpr (is_optional<V> || is_unique<V>) {
    bool has = static_cast<bool>(x);
    archive(a, has);
    if constexpr (is_reader<Archive>) {
      x.reset();
      if constexpr (is_optional<V>) {
        if (has) x.emplace();
      } else {
        if (has) x = std::make_unique<typename V::element_type>();
      }
    }
    if (has) archive(a, *x);
  } else if constexpr (is_variant<V>) {
    archive_variant(a, x, std::make_index_sequence<std::variant_size_v<V>>());
  } else if constexpr (is_map<V>) {
    if constexpr (is_reader<Archive>) {
      std::vector<std::pair<typename V::key_type, typename V::mapped_type>> pairs;
      archive(a, pairs);
      x = V(pairs.begin(), pairs.end());
    } else {
      const std::vector<std::pair<typename V::key_type, typename V::mapped_type>> pairs(x.begin(),
                                                                                        x.end());
      archive(a, pairs);
    }
  } else if constexpr (requires { std::tuple_size<V>::value; }) {
    for (auto& value : x) archive(a, value);
  } else if constexpr (requires(V & v) { v.clear(); }) {
    archive_all(a, x);
  } else if constexpr (requires { archive_struct(a, x); }) {
    archive_struct(a, x);
  } else {
    for_each_member(x,
                    [&](std::string_view name, auto& member) { archive_member(a, name, member); });
  }
}

}  // namespace sunder
