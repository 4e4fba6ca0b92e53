// SPDX-License-Identifier: MIT
// Settings that choose themselves: those of contact and impacts that follow from mesh, material and
// speeds once a user has said how exact a run should be.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fracture/scene/scene.hpp"

namespace sunder {

/// How exact a run should be.
enum class Accuracy {
  preview,    ///< what roughly happens, for the least time
  good,       ///< the settings that the charts recommend (docs/lab/defaults.md)
  reference,  ///< what others are held against: several times the time of good
};

/// A setting that was chosen.
struct Choice {
  /// As scene files have it: "contact.max_passes".
  std::string key;
  /// As a scene file would say it: "1".
  std::string value;
  /// Why, as a user may read it.
  std::string reason;
};

/// The keys that `choose_settings` looks after, in its order.
std::vector<std::string_view> chosen_keys();

/// Sets each of `chosen_keys` that `given` does not name, in that order, and says to what and why;
/// chosen again from what it made it is the same. With contact by penalty the keys of contact and of
/// the ladder, and without impact windows those of impacts, are left alone. A scene set up in C++ has the values of
/// the structs unless this is called. Before them, `model` and `integrator.method` where nothing of the
/// integrator is given: frames for the tetrahedra of a single held body so slender that one frame would
/// show half as much strain again. Last, `bodies.N.order` of bodies whose bending linear tetrahedra
/// would show too little of: 2 where it helps and can be paid for, each with its Choice.
/// O(n log n) in the tetrahedra. Needs: a scene and meshes without errors.
std::vector<Choice> choose_settings(Scene& scene, Accuracy accuracy,
                                    std::span<const std::string> given);

}  // namespace sunder
