// SPDX-License-Identifier: MIT
// Output of `sunder run`: frames, pictures and their camera. Settings only.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace sunder {

/// The shape of the body in a picture (figure 1 of the paper).
enum class ShownShape {
  /// The rigid reference, the look of a brittle body (section 3.3 of the paper).
  reference,
  /// The deformed mesh.
  deformed,
  /// The deformed mesh as a wireframe over the filled rigid reference.
  both,
};

/// Position of the faces of cracks in pictures.
enum class CrackSurface {
  /// The position in the mesh.
  mesh,
  /// Near the planes of their cracks (`smooth_crack_moves`). Requires: `CrackMode::object` or
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
  /// Number of pictures, spread evenly over the run: 1 shows its end, 2 its start and end, and so
  /// on.
  std::uint32_t count = 0;
  /// Times of further pictures, s.
  std::vector<double> times;
  /// Size, pixels.
  std::uint32_t width = 1280;
  std::uint32_t height = 720;
  ShownShape show = ShownShape::reference;
  /// Empty: chosen from the bodies' start and the ground.
  std::optional<CameraSettings> camera;
};

/// Checkpoints of a run, from which it can continue after an interruption.
struct CheckpointSettings {
  /// Number of steps between checkpoints; 0: not by steps.
  std::uint64_t steps = 0;
  /// Wall time between checkpoints, minutes; 0: not by time. With both 0 nothing is saved.
  double minutes = 10;
  /// Number of checkpoints that are kept, the latest ones; 0: all.
  std::uint32_t keep = 2;
};

/// Time between rows of history.csv.
struct HistorySettings {
  /// s; 0: no rows. Absent: `usual_history_stride` chooses.
  std::optional<double> interval;
};

struct OutputSettings {
  /// Number of VTU frames, spread evenly over the run, including its start and its end; 0: none.
  std::uint32_t frames = 51;
  /// Time between frames, s; above 0 it replaces `frames`.
  double frame_interval = 0;
  /// True: writes another frame at the end of each step with a new impact window, at most one per
  /// 1/240 s.
  bool frames_at_impacts = false;
  CrackSurface crack_surface = CrackSurface::mesh;
  HistorySettings history;
  PictureSettings pictures;
  CheckpointSettings checkpoint;
};

}  // namespace sunder
