// SPDX-License-Identifier: MIT
// Settings of contact and impacts that follow from mesh, material, speeds and the accuracy of a
// run.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fracture/scene/scene.hpp"

namespace sunder {

/// Accuracy of a run.
enum class Accuracy {
  preview,    ///< rough result in the least time
  good,       ///< the settings that the charts recommend (docs/lab/defaults.md)
  reference,  ///< for comparison with good, at several times its time
};

/// A setting that the library chose.
struct Choice {
  /// Key as in scene files: "contact.max_passes".
  std::string key;
  /// Value as in a scene file: "1".
  std::string value;
  /// Reason, for users.
  std::string reason;
};

/// The keys that `choose_settings` can set, in its order.
std::vector<std::string_view> chosen_keys();

/// Sets each of `chosen_keys` that `given` does not name, in that order, and returns the values
/// with reasons. A second call gives the same. With penalty contact the keys of contact and
/// activity levels stay, and without impact windows those of impacts stay. A scene set up in C++
/// keeps the values of the structs unless this function is called. First come `model` and
/// `integrator.method`, if no key of the integrator is given: a single constrained body gets a
/// frame per tetrahedron if it is so slender that one frame would add half as much strain again.
/// Last comes `bodies.N.order`: 2 for bodies that bend too little with linear tetrahedra, if the
/// cost is acceptable. O(n log n) in the tetrahedra. Requires: a scene and meshes without errors.
std::vector<Choice> choose_settings(Scene& scene, Accuracy accuracy,
                                    std::span<const std::string> given);

}  // namespace sunder
