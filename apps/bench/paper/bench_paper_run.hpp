// SPDX-License-Identifier: MIT
// One run of a scene for `sunder bench paper`: the cost of every step, its fans, and samples.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

struct PaperRunSettings {
  std::filesystem::path scene;
  /// `dotted.path=value` each, as `sunder run --set` takes them.
  std::vector<std::string> changes;
  /// The run ends after so many steps, if the scene's duration does not end it before.
  std::uint64_t steps = 0;
  /// Every how many steps stresses are kept; 0: never.
  std::uint64_t sample_every = 0;
};

/// Node stresses (Pa) of the vertices that were tested in a step, and their thresholds.
struct StressSample {
  std::vector<Mat3> stress;
  std::vector<double> strength;
};

/// The same positions seen by both models: node stresses, weighted by mass.
struct ModelSample {
  double largest = 0, largest_corotational = 0;  ///< principal stress over all vertices, Pa
  /// Median of corotational over rigid reference, over the vertices above half of the largest.
  double ratio = 0;
  /// Elastic forces of the largest component, evaluated once: in its frame (the paper's form), and
  /// with a frame for each tetrahedron; us.
  double force_us = 0, corotational_force_us = 0;
};

/// A fan as it was cut, to be cut again on a fresh body.
struct RecordedFan {
  VertexId vertex;
  Vec3 normal = Vec3::Zero();
  /// Whether it was decided on the same state as the one before.
  bool same_round = false;
};

/// Counts of table 3.
struct PaperCounts {
  std::size_t tested = 0, suspects = 0, reached = 0;  ///< vertices
  /// Vertices over their threshold that waited with an empty fan and were not tested again.
  std::size_t still_empty = 0;
  std::size_t fans = 0, faces = 0;
  /// Fans with a new component, fans that the oracle pointed at, those of them that had one.
  std::size_t separated = 0, predicted = 0, predicted_rightly = 0;
  /// Faces with all three vertices split, and components that came of all fans.
  std::size_t predicted_faces = 0, created = 0;
};

struct PaperRun {
  std::size_t tetrahedra = 0, vertices = 0;  ///< at the start
  /// This thread's own time of each step, which other programs hardly change; ms.
  std::vector<double> step_ms;
  std::vector<std::uint32_t> step_fans;
  /// Of each step: wall time of the stages fracture and rebuild, and of all stages; ms.
  std::vector<double> fracture_ms, stages_ms;
  PaperCounts counts;
  /// Steps in which a component's iterations were given up, and the factor took over.
  std::size_t given_up = 0;
  /// Largest principal node stress of the whole run, Pa.
  double peak_stress = 0;
  std::size_t pieces = 0, single_tetrahedra = 0;  ///< at the end
  std::vector<RecordedFan> fans;
  std::vector<StressSample> stress_samples;
  std::vector<ModelSample> model_samples;
  /// Why it did not reach its last step; empty where it did.
  std::string failure;
};

/// Builds the scene with its changes. Errors: those of `read_scene` and `build_simulation`.
Result<Simulation> paper_simulation(const PaperRunSettings& settings);

/// Runs it. A step that fails ends the run, and `failure` says why. Samples are taken between steps
/// and do not count in their times.
Result<PaperRun> run_paper_scene(const PaperRunSettings& settings);

}  // namespace sunder
