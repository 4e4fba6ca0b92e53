// SPDX-License-Identifier: MIT
// Materials that have a name, with the sources of their numbers.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mechanics/state/settings/material.hpp"

namespace sunder {

/// A typical member of a class of materials. Samples differ: strengths by half, moduli by a fifth.
struct NamedMaterial {
  std::string_view name;     ///< one word, in lower case
  std::string_view meaning;  ///< the kind that the numbers are of
  Material material;         ///< with a toughness, from which the fracture energy follows
  double friction = 0;       ///< Coulomb's coefficient on a rough floor
  double weibull = 0;        ///< Weibull's modulus of strengths
  /// Tables, data sheets and abstracts that were read, with the range of their numbers (E in GPa,
  /// strength in MPa, toughness in MPa sqrt(m)). Numbers that none of them has are typical ones.
  std::string_view source;
};

/// All of them, in the order of their names.
std::span<const NamedMaterial> named_materials();

/// Their names, in the same order.
std::vector<std::string> material_names();

/// The material of a name, or null. Capitals count as small letters, "-" and " " as "_".
const NamedMaterial* find_material(std::string_view name);

}  // namespace sunder
