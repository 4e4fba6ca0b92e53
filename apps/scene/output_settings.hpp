// SPDX-License-Identifier: MIT
// What `sunder run` writes of a run: frames, pictures and their camera. Settings only.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace sunder {

/// Which shape of the body a picture shows (figure 1).
enum class ShownShape {
  /// The rigid reference: what a brittle body looks like (section 3.3).
  reference,
  /// The deformed mesh.
  deformed,
  /// The deformed mesh as a wireframe over the filled rigid reference.
  both,
};

/// Where pictures show the faces of cracks.
enum class CrackSurface {
  /// Where the mesh has them.
  mesh,
  /// Near the planes of their cracks (`smooth_crack_moves`). Needs `CrackMode::object` or
  /// `CrackMode::cohesive`.
  smooth,
};

/// A fixed camera.
struct CameraSettings {
  Eigen::Vector3d eye = {1, -2, 1};
  Eigen::Vector3d target = {0, 0, 0};
  /// Vertical opening angle, degrees.
  double field_of_view = 35;
};

struct PictureSettings {
  /// Spread evenly over the run: 1 shows its end, 2 start and end, and so on.
  std::uint32_t count = 0;
  /// Further moments, s.
  std::vector<double> times;
  /// Pixels.
  std::uint32_t width = 1280;
  std::uint32_t height = 720;
  ShownShape show = ShownShape::reference;
  /// Absent: found from the bodies' start and the ground.
  std::optional<CameraSettings> camera;
};

/// When a run is saved on its way, so that it can go on after an end that nobody wanted.
struct CheckpointSettings {
  /// After every so many steps; 0: not by steps.
  std::uint64_t steps = 0;
  /// After every so many minutes on the wall; 0: not by time. With both 0 nothing is saved.
  double minutes = 10;
  /// The latest so many stay; 0: all.
  std::uint32_t keep = 2;
};

/// Time between rows of history.csv.
struct HistorySettings {
  /// s; 0: no rows. Absent: `usual_history_stride` chooses.
  std::optional<double> interval;
};

struct OutputSettings {
  /// VTU frames, spread evenly over the run with its start and its end; 0 writes none.
  std::uint32_t frames = 51;
  /// Time between frames, s; above 0 it is used instead of `frames`.
  double frame_interval = 0;
  /// A frame more at the end of steps in which a blow opens a window, no two within 1/240 s.
  bool frames_at_impacts = false;
  CrackSurface crack_surface = CrackSurface::mesh;
  HistorySettings history;
  PictureSettings pictures;
  CheckpointSettings checkpoint;
};

}  // namespace sunder
