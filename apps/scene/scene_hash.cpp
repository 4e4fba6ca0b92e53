// SPDX-License-Identifier: MIT
// A visitor of scene_fields.hpp that adds up every value.
#include "apps/scene/scene_hash.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <type_traits>
#include <variant>

#include "apps/scene/scene_fields.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"

namespace sunder {
namespace {

using fields::Key;

class SceneHasher {
 public:
  template <class T>
  void field(const Key& key, T& member) {
    // Values that accuracy chose are added under their own keys; both kernels give the same bytes.
    constexpr std::array<std::string_view, 6> no_matter = {"$schema",  "name",   "description",
                                                           "accuracy", "output", "topology"};
    if (std::ranges::find(no_matter, key.name) != no_matter.end()) return;
    add(key.name);
    add(member);
  }
  void direction(const Key& key, Eigen::Vector3d& member) { field(key, member); }
  template <class T, class Variant>
  void alternative(const Key& key, const T&, Variant& member) {
    if (T* chosen = std::get_if<T>(&member)) field(key, *chosen);
  }

  std::uint64_t value() const { return hash_.value; }

 private:
  void add_number(std::uint64_t number) {
    std::array<char, 8> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(number >> 8 * i);
    hash_.add({bytes.data(), bytes.size()});
  }

  void add(std::string_view text) {
    add_number(text.size());
    hash_.add(text);
  }
  void add(std::string& text) { add(std::string_view(text)); }
  void add(Eigen::Vector3d& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  void add(Eigen::Quaterniond& q) {
    for (int i = 0; i < 4; ++i) add(q.coeffs()[i]);
  }
  void add(RegionName& region) { add(region.text); }
  void add(HistorySettings& history) { add(history.interval); }
  void add(FaceList& faces) { add(faces.points); }
  void add(std::shared_ptr<const SolidSurface>& surface) {
    if (!surface) return;
    for (Eigen::Vector3d x : surface->points) add(x);
    for (std::array<std::uint32_t, 3> t : surface->triangles) add(t);
  }
  void add(StrengthSettings& strength) {
    fields::describe(*this, strength);
    add(strength.painted);
  }
  void add(TetMesh& mesh) {
    add(mesh.points);
    add(mesh.tetrahedra);
    add(mesh.region);
    for (auto& [number, name] : mesh.region_name) {
      add_number(static_cast<std::uint64_t>(number));
      add(name);
    }
  }
  template <class T>
  void add(std::optional<T>& member) {
    add_number(member.has_value());
    if (member) add(*member);
  }
  template <class T>
  void add(std::vector<T>& members) {
    add_number(members.size());
    for (T& member : members) add(member);
  }
  template <class T, std::size_t N>
  void add(std::array<T, N>& members) {
    for (T& member : members) add(member);
  }
  template <class T>
  void add(T& member) {
    if constexpr (std::is_floating_point_v<T>) {
      add_number(std::bit_cast<std::uint64_t>(static_cast<double>(member)));
    } else if constexpr (std::is_integral_v<T> || std::is_enum_v<T>) {
      add_number(static_cast<std::uint64_t>(member));
    } else {
      fields::describe(*this, member);
    }
  }

  Fnv1a hash_;
};

}  // namespace

std::string hex_digits(std::uint64_t value) { return fmt::format("{:016x}", value); }

std::string scene_hash(SceneFile file) {
  SceneHasher hasher;
  fields::describe(hasher, file);
  return hex_digits(hasher.value());
}

}  // namespace sunder
