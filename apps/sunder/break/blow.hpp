// SPDX-License-Identifier: MIT
// Scenes in which one object is dropped, thrown, struck, pressed or bent.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/sunder/break/quantity.hpp"
#include "mechanics/state/settings/named_materials.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// Which end of a file's axes is up.
enum class UpAxis { x, minus_x, y, minus_y, z, minus_z };

/// Brings a mesh to metres, turns `up` to +z, and sets it on z = 0 with the middle of its box above
/// the origin. Only points that tetrahedra use count. `metres`: per unit of the mesh, > 0.
void set_down(TetMesh& mesh, double metres, UpAxis up);

/// The ways to break an object.
enum class BlowKind { drop, hurl, strike, press, bend };

/// How the object is broken; SI units.
struct Blow {
  BlowKind kind = BlowKind::drop;
  double height = 1;   ///< of a drop, m
  double speed = 0.5;  ///< of a throw, a press or a bend, m/s
  ThrownBall ball;     ///< of a strike; of steel
  double tilt = 0;     ///< of a drop, degrees about x
};

/// The object in a scene.
struct BrokenThing {
  std::string name;
  /// The mesh's file, relative to the scene.
  std::string file;
  const TetMesh& mesh;  ///< as `set_down` leaves it
  const NamedMaterial& material;
};

/// Times of a scene, s; absent: chosen from size and speed.
struct BreakTimes {
  std::optional<double> step, duration;
};

/// Frames of a run: one a step where the step is the usual one, for 3 s of film.
inline constexpr int film_frames = 76;

/// The scene, as `sunder run` reads it. A drop starts just above the ground with the speed of its
/// fall. A ball comes along the object's thinnest side. A press is two plates. A bend holds both
/// ends of the longest side and drives its middle.
nlohmann::ordered_json break_scene(const BrokenThing& thing, const Blow& blow,
                                   const BreakTimes& times, bool with_pictures);

/// The blow in words: "dropped from 1 m".
std::string blow_words(const Blow& blow);

}  // namespace sunder
