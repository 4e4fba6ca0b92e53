// SPDX-License-Identifier: MIT
// The rules between keys of a scene.
#include "fracture/scene/check_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fracture/scene/cohesive_settings.hpp"
#include "fracture/strength/draw_strength.hpp"
#include "fracture/strength/held_boxes.hpp"
#include "mechanics/state/step_status.hpp"
#include "topology/base/ids.hpp"

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

/// Whether the middle of an edge lies in the box: a node of bodies of order 2.
bool has_middle(const TetMesh& mesh, const HeldBox& box) {
  const Eigen::AlignedBox3d inside(box.minimum, box.maximum);
  const auto at = [&](std::uint32_t p) { return Eigen::Vector3d(mesh.points[p].data()); };
  return std::ranges::any_of(mesh.tetrahedra, [&](const auto& corners) {
    return std::ranges::any_of(edge_ends, [&](const auto& ends) {
      const std::uint32_t a = corners[static_cast<std::size_t>(ends[0])];
      const std::uint32_t b = corners[static_cast<std::size_t>(ends[1])];
      if (a >= mesh.points.size() || b >= mesh.points.size()) return false;
      return inside.contains(0.5 * (at(a) + at(b)));
    });
  });
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
void check_boxes(fields::SettingsCheck& check, const BodySettings& body,
                 const std::vector<Box>& boxes, const char* key, const char* code) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!is_ordered(boxes[i]) || has_vertex(body.mesh, boxes[i])) continue;
    if constexpr (std::is_same_v<Box, HeldBox>) {
      if (body.order == 2 && has_middle(body.mesh, boxes[i])) continue;
    }
    check.add(code, fmt::format("{}.{}", key, i), "contains no vertex of the mesh",
              "give the box in the mesh's own coordinates, m, before it is turned and moved");
  }
}

/// A prescribed velocity moves a vertex along the axes on which it is held.
void check_axes(fields::SettingsCheck& check, const BodySettings& body) {
  for (std::size_t i = 0; i < body.held.size(); ++i) {
    const Vec3 own = body.rotation.conjugate() * body.held[i].velocity;
    const AxisSet axes = axes_of(body.held[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double along = std::abs(own[static_cast<Eigen::Index>(axis)]);
      if (axes[axis] || !(along > 1e-9 * own.norm())) continue;
      check.add("velocity_not_held", fmt::format("held.{}.velocity", i),
                fmt::format("moves vertices along {}, along which they are free", "xyz"[axis]),
                "name the axis in \"axes\", or leave the velocity along it out");
    }
  }
}

/// Vertices held along some axes only: refuses features that do not support them.
void check_partial(fields::SettingsCheck& check, const Scene& scene) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (std::ranges::none_of(scene.bodies[b].held, is_partial)) continue;
    const auto refuse = [&](bool is_wrong, const char* what) {
      if (!is_wrong) return;
      check.add("axes_not_supported", fmt::format("bodies.{}.held", b),
                fmt::format("holds vertices along some axes only, which {} cannot do", what),
                "leave it out, or leave \"axes\" out of the boxes");
    };
    refuse(scene.integrator.integrator != Integrator::floating_frame,
           "an integrator other than floating_frame");
    refuse(scene.contact.method == ContactMethod::penalty, "contact.method penalty");
    refuse(scene.fracture.relax > 0, "fracture.relax");
    refuse(scene.fracture.criterion == FractureCriterion::energy, "fracture.criterion energy");
  }
}

/// The paper's springs push at the centres of balls alone, and at all bodies in every step; rubble
/// has a clock of its own.
void check_penalty(fields::SettingsCheck& check, const Scene& scene) {
  if (scene.contact.method != ContactMethod::penalty) return;
  if (scene.ladder.rubble != RubbleMode::off) {
    check.add("rubble_not_supported", "ladder.rubble",
              "is certified, which contact.method penalty cannot have",
              "leave it out, or set contact.method to impulses");
  }
  for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
    const Obstacle& obstacle = scene.obstacles[k];
    if (!obstacle.mass || std::holds_alternative<Sphere>(obstacle.shape)) continue;
    check.add("free_not_supported", fmt::format("obstacles.{}.mass", k),
              "is given, but with contact.method penalty only spheres move freely",
              "leave the mass out, make it a sphere, or set contact.method to impulses");
  }
}

bool has_second_order(const Scene& scene) {
  return std::ranges::any_of(scene.bodies, [](const BodySettings& b) { return b.order == 2; });
}

/// Coordinates so large, in themselves or compared with the mesh, that rounding loses its cells, or
/// that squares of volumes and inertia leave the real numbers.
void check_size(fields::SettingsCheck& check, const BodySettings& body) {
  constexpr double largest = 1e20;
  constexpr double smallest = 1e-20;
  constexpr double most_sizes = 1e10;  // a cell of a millionth of the body has some digits left
  Eigen::AlignedBox3d box;
  for (const auto& corners : body.mesh.tetrahedra) {
    for (const std::uint32_t p : corners) {
      if (p < body.mesh.points.size()) box.extend(Eigen::Vector3d(body.mesh.points[p].data()));
    }
  }
  if (box.isEmpty()) return;
  const double size = box.sizes().maxCoeff();
  const double far = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  if (!(far <= largest && size >= smallest)) {
    check.add(
        "mesh_size", "mesh",
        fmt::format("is {:.3g} m large, up to {:.3g} m from its origin; allowed are {:.0e} to "
                    "{:.0e} m",
                    size, far, smallest, largest),
        "scale the mesh: lengths are m");
  } else if (far > most_sizes * size) {
    check.add(
        "too_far", "mesh",
        fmt::format("is {:.3g} m large and {:.3g} m from its origin: rounding loses its cells",
                    size, far),
        "move the mesh to its origin");
  } else if (body.translation.cwiseAbs().maxCoeff() > most_sizes * size) {
    check.add("too_far", "translation",
              fmt::format("moves a mesh of {:.3g} m by {:.3g} m: rounding loses its cells", size,
                          body.translation.norm()),
              fmt::format("stay within {:.0e} times the size of the mesh", most_sizes));
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

std::vector<SettingFinding> second_order_findings(const Scene& scene) {
  std::vector<SettingFinding> findings;
  if (!has_second_order(scene)) return findings;
  fields::SettingsCheck check("", findings);
  const auto refuse = [&](bool is_wrong, const char* key, const char* what, const char* remedy) {
    if (!is_wrong) return;
    check.add("second_order_in_motion", key,
              fmt::format("is {}, which bodies of order 2 cannot have", what), remedy);
  };
  refuse(scene.integrator.isolated != IsolatedTetrahedra::rigid, "isolated",
         scene.integrator.isolated == IsolatedTetrahedra::qr ? "qr" : "projection",
         "leave it out: single tetrahedra are rigid bodies");
  refuse(scene.contact.method == ContactMethod::penalty, "contact.method", "penalty",
         "take impulses, or leave the bodies' order out");
  return findings;
}

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
  if (body.rigid && !body.held.empty()) {
    check.add("rigid_and_held", "rigid", "is true, but the body is held: a rigid body is free",
              "leave rigid or held out; a rigid body with a given motion can be an obstacle");
  }
  if (body.rigid && body.order != 1) {
    check.add("rigid_and_order", "order", "is 2, but the body is rigid: nothing of it bends",
              "leave rigid or order out");
  }
  if (body.mesh.tetrahedra.empty()) return;
  check_size(check, body);
  check_boxes(check, body, body.held, "held", "nothing_held");
  check_boxes(check, body, body.loads, "loads", "nothing_loaded");
  check_axes(check, body);
  check_unbreakable_boxes(check, body);
  check_strength(check, body);
}

void check_together(fields::SettingsCheck& check, const Scene& scene) {
  if (scene.bodies.empty()) {
    check.add("no_body", "bodies", "is empty", "give at least one body");
  }
  check_cohesive(check, scene);
  check_penalty(check, scene);
  check_partial(check, scene);
  if (has_second_order(scene) && scene.fracture.node_stress == NodeStress::fit) {
    check.add("fit_of_second_order", "fracture.node_stress",
              "is fit, which is for tetrahedra of first order",
              "leave it out: of second order the stresses at the nodes are averaged");
  }
  const double steps = scene.duration / scene.integrator.time_step;
  if (scene.integrator.time_step > 0 && steps > most_steps()) {
    check.add("too_many_steps", "time_step",
              fmt::format("is {} s: {:.3g} steps for a duration of {} s; allowed are {:.6g}",
                          scene.integrator.time_step, steps, scene.duration, most_steps()),
              "take a longer step or a shorter duration");
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const double turn = scene.bodies[b].spin.norm() * scene.integrator.time_step;
    if (!(turn > longest_turn)) continue;
    check.add(
        "spun_too_far", "time_step",
        fmt::format("is {} s: bodies.{}.spin turns the body by {:.3g} rad per step, and up to "
                    "{:.0f} rad are followed",
                    scene.integrator.time_step, b, turn, longest_turn),
        fmt::format("take a time_step below {:.3g} s", M_PI / scene.bodies[b].spin.norm()));
    break;
  }
}

}  // namespace sunder
