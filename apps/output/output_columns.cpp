// SPDX-License-Identifier: MIT
// Columns of tables and frames, and the list of all files.
#include "apps/output/output_columns.hpp"

namespace sunder {
namespace {

constexpr OutputColumn fragments_list[] = {
    {"component", "", "Number of the piece, as in `component` of the frames."},
    {"body", "", "Row of its body in the scene."},
    {"tetrahedra", "", "Number of its tetrahedra."},
    {"vertices", "", "Number of its vertices, copies on crack faces counted each."},
    {"mass", "kg", "Mass."},
    {"volume", "m^3", "Volume at rest."},
    {"center_x", "m", "Mass centre, x."},
    {"center_y", "m", "Mass centre, y."},
    {"center_z", "m", "Mass centre, z."},
    {"velocity_x", "m/s", "Velocity of the mass centre, x."},
    {"velocity_y", "m/s", "Velocity of the mass centre, y."},
    {"velocity_z", "m/s", "Velocity of the mass centre, z."},
    {"spin_x", "rad/s", "Angular velocity of the rigid motion with the same angular momentum, x."},
    {"spin_y", "rad/s", "The same, y."},
    {"spin_z", "rad/s", "The same, z."},
    {"inertia_xx", "kg m^2", "Inertia of the solid about its mass centre, world axes, xx."},
    {"inertia_yy", "kg m^2", "The same, yy."},
    {"inertia_zz", "kg m^2", "The same, zz."},
    {"inertia_xy", "kg m^2", "The same, xy."},
    {"inertia_yz", "kg m^2", "The same, yz."},
    {"inertia_xz", "kg m^2", "The same, xz."},
    {"surface", "m^2", "Area of all boundary faces at rest."},
    {"crack_area", "m^2", "The part of `surface` that cracks and initial cuts made."},
    {"crack_projected", "m^2", "`crack_area` with each face projected on the plane of its crack."},
    {"parent", "", "Number of the piece from which it separated; empty for pieces of the start."},
    {"birth_step", "", "Step in which it separated; 0 for pieces of the start."},
};

constexpr OutputColumn cracks_list[] = {
    {"fan", "", "Number of the fan, as in `events.jsonl`."},
    {"time", "s", "Time of the fan."},
    {"area", "m^2", "Area of its faces at rest."},
    {"projected_area", "m^2", "Area of its faces, projected on its plane."},
    {"energy", "J", "Energy that the body lost as the fan opened."},
    {"energy_per_area", "J/m^2", "`energy` over `projected_area`."},
};

constexpr OutputColumn obstacles_list[] = {
    {"time", "s", "Time of the frame."},
    {"obstacle", "", "Row of the obstacle in the scene."},
    {"center_x", "m", "Mass centre, x."},
    {"center_y", "m", "Mass centre, y."},
    {"center_z", "m", "Mass centre, z."},
    {"orientation_w", "", "Unit quaternion from the obstacle's axes to the world's, w."},
    {"orientation_x", "", "The same, x."},
    {"orientation_y", "", "The same, y."},
    {"orientation_z", "", "The same, z."},
    {"velocity_x", "m/s", "Velocity of the mass centre, x."},
    {"velocity_y", "m/s", "Velocity of the mass centre, y."},
    {"velocity_z", "m/s", "Velocity of the mass centre, z."},
    {"spin_x", "rad/s", "Angular velocity, x."},
    {"spin_y", "rad/s", "Angular velocity, y."},
    {"spin_z", "rad/s", "Angular velocity, z."},
};

constexpr OutputColumn frame_points[] = {
    {"displacement", "m", "Position minus rigid reference, in world axes."},
    {"velocity", "m/s", "Velocity."},
    {"node_stress", "Pa", "Stress in world axes: XX, YY, ZZ, XY, YZ, XZ."},
    {"largest_principal_stress", "Pa", "Largest principal value of `node_stress`."},
    {"crack_move", "m", "Move that brings a crack face near the plane of its crack, for drawing.",
     "`output.crack_surface` is `smooth`"},
};

constexpr const char* with_labels = "`fracture.crack` is `object` or `cohesive`";

constexpr OutputColumn frame_cells[] = {
    {"component", "", "Number of the piece."},
    {"body", "", "Row of the body in the scene."},
    {"region", "", "Region of the mesh file, 0 without regions."},
    {"crack", "", "Newest crack that decided the side of the cell, -1 for none.", with_labels},
    {"crack_side", "", "Side of that crack: 1, -1, or 0 without a crack.", with_labels},
};

}  // namespace

std::span<const OutputColumn> fragment_columns() { return fragments_list; }
std::span<const OutputColumn> crack_columns() { return cracks_list; }
std::span<const OutputColumn> obstacle_columns() { return obstacles_list; }

std::vector<OutputFile> output_files() {
  return {
      {"frames.pvd", "", "List of all frames with their times, for ParaView.", {}},
      {"frames/*.vtu", "points", "Deformed bodies, one row per node.", frame_points},
      {"frames/*.vtu", "cells", "Deformed bodies, one row per tetrahedron.", frame_cells},
      {"report.json", "", "Counts, times, momentum, energy, settings and warnings of the run.",
       report_keys()},
      {"fragments.csv", "", "One line per piece at the end of the run, largest mass first.",
       fragment_columns()},
      {"cracks.csv", "", "One line per fan that has opened, in the order of the fans.",
       crack_columns()},
      {"obstacles.csv", "", "One line per free obstacle and frame. Other scenes have no such file.",
       obstacle_columns()},
      {"history.csv", "",
       "One line per step or per `output.history`. B, L, H and K stand for rows of `bodies`, "
       "`loads`, `held` and `obstacles`.",
       history_columns()},
      {"events.jsonl", "first line", "Format, program and scene of the log.", event_head_keys()},
      {"events.jsonl", "line per fan", "One fan, with the faces that it split.", event_fan_keys()},
      {"events.jsonl", "line per release",
       "Faces of cohesive cracks that lost their ties together.", event_release_keys()},
      {"events.jsonl", "last line", "End of the run.", event_end_keys()},
      {"picture_*.png", "", "Pictures, with `--png` or the scene's `output.pictures`.", {}},
      {"checkpoints/*.checkpoint", "", "Saved states from which `--resume` continues the run.", {}},
  };
}

std::string csv_heading(std::span<const OutputColumn> columns) {
  std::string text;
  for (const OutputColumn& column : columns) {
    if (!text.empty()) text += ',';
    text += column.name;
  }
  return text + "\r\n";
}

}  // namespace sunder
