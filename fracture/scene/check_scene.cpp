// SPDX-License-Identifier: MIT
// The rules between keys of a scene.
#include "fracture/scene/check_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fracture/strength/draw_strength.hpp"
#include "fracture/scene/cohesive_settings.hpp"

namespace sunder {
namespace {

template <class Box>
bool is_ordered(const Box& box) {
  return (box.minimum.array() <= box.maximum.array()).all();
}

template <class Box>
void check_order(fields::SettingsCheck& check, const Box& box) {
  if (is_ordered(box) || !box.minimum.allFinite() || !box.maximum.allFinite()) return;
  check.add("bad_box", "", "has a minimum above its maximum", "exchange them where they are");
}

/// Whether a vertex of the mesh, a point that a tetrahedron uses, lies in the box.
template <class Box>
bool has_vertex(const TetMesh& mesh, const Box& box) {
  const Eigen::AlignedBox3d inside(box.minimum, box.maximum);
  return std::ranges::any_of(mesh.tetrahedra, [&](const auto& corners) {
    return std::ranges::any_of(corners, [&](std::uint32_t p) {
      if (p >= mesh.points.size()) return false;
      const Point& x = mesh.points[p];
      return inside.contains(Eigen::Vector3d(x[0], x[1], x[2]));
    });
  });
}

template <class Box>
void check_boxes(fields::SettingsCheck& check, const TetMesh& mesh, const std::vector<Box>& boxes,
                 const char* key, const char* code) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!is_ordered(boxes[i]) || has_vertex(mesh, boxes[i])) continue;
    check.add(code, fmt::format("{}.{}", key, i), "contains no vertex of the mesh",
              "give the box in the mesh's own coordinates, m, before it is turned and moved");
  }
}

void check_unbreakable_boxes(fields::SettingsCheck& check, const BodySettings& body) {
  for (std::size_t i = 0; i < body.unbreakable.size(); ++i) {
    const auto* box = std::get_if<RestBox>(&body.unbreakable[i].where);
    if (box == nullptr || !is_ordered(*box) || has_vertex(body.mesh, *box)) continue;
    check.add("nothing_unbreakable", fmt::format("unbreakable.{}.box", i),
              "contains no vertex of the mesh", "give the box in the mesh's own coordinates, m");
  }
}

}  // namespace

std::vector<SettingFinding> check_scene(const Scene& scene) { return setting_findings(scene, ""); }

void check_together(fields::SettingsCheck& check, const HeldBox& box) { check_order(check, box); }
void check_together(fields::SettingsCheck& check, const RestBox& box) { check_order(check, box); }

void check_together(fields::SettingsCheck& check, const LoadBox& box) {
  check_order(check, box);
  if (box.pressure == 0 && box.force.isZero(0)) {
    check.add("no_load", "", "has neither a pressure nor a force",
              "give \"pressure\" in Pa or \"force\" in N");
  }
}

void check_together(fields::SettingsCheck& check, const BodySettings& body) {
  if (body.mesh.tetrahedra.empty()) return;
  check_boxes(check, body.mesh, body.held, "held", "nothing_held");
  check_boxes(check, body.mesh, body.loads, "loads", "nothing_loaded");
  check_unbreakable_boxes(check, body);
  check_strength(check, body);
}

void check_together(fields::SettingsCheck& check, const Scene& scene) {
  if (scene.bodies.empty()) {
    check.add("no_body", "bodies", "is empty", "give at least one body");
  }
  check_cohesive(check, scene);
  constexpr double most_steps = 1e9;
  const double steps = scene.duration / scene.integrator.time_step;
  if (scene.integrator.time_step > 0 && steps > most_steps) {
    check.add("too_many_steps", "time_step",
              fmt::format("is {} s: {:.3g} steps for a duration of {} s; allowed are {:.0e}",
                          scene.integrator.time_step, steps, scene.duration, most_steps),
              "take a longer step or a shorter duration");
  }
}

}  // namespace sunder
