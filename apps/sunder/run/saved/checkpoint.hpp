// SPDX-License-Identifier: MIT
// A run as a file: all that it needs to go on as if it had never stopped.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/history.hpp"
#include "apps/output/tables.hpp"
#include "apps/scene/scene_json.hpp"
#include "apps/sunder/run/report/recorder_report.hpp"
#include "topology/io/vtu/vtu.hpp"

namespace sunder {

/// Format of the files below; raised whenever their content besides the saved state changes.
inline constexpr std::uint32_t checkpoint_format = 7;

/// The record of a run so far.
struct RunRecord {
  RunStatistics statistics;
  std::vector<PvdFrame> frames;
  std::vector<ObstacleMotion> obstacles;  ///< of every frame
  History history;
  std::uint64_t pictures = 0;
  std::optional<std::uint64_t> last_frame, last_picture;  ///< their steps
  /// Bytes of events.jsonl.
  std::uint64_t log_bytes = 0;
};

/// A run between two steps.
struct Checkpoint {
  /// The content of the scene file. Its `scene` stands in the simulation alone.
  SceneFile file;
  RunRecord record;
  Simulation simulation;
};

/// A run as the bytes of a file: "SunderCp", format (4 bytes), checksum (FNV-1a, 8) of all that
/// follows, length (8) and bytes of the record, and the saved state (saved_state.hpp).
struct CheckpointBytes {
  std::uint64_t step = 0;
  std::string bytes;
};
CheckpointBytes checkpoint_bytes(const SceneFile& file, const RunRecord& record,
                                 const Simulation& simulation);

/// Writes them as checkpoints/step_0000000120.checkpoint in the run's folder. The file is on the
/// disk when this returns; older ones beyond `keep` (0: none) are removed then. Needs: the folder
/// checkpoints. Errors: cannot_write.
std::vector<Finding> write_checkpoint(const std::filesystem::path& folder,
                                      const CheckpointBytes& checkpoint, std::uint32_t keep);

/// The latest whole checkpoint of a folder, of those not after step `until`. Warnings: one that is
/// damaged and passed over. Errors: no_checkpoint, other_version, cannot_open.
Result<Checkpoint> read_checkpoint(const std::filesystem::path& folder,
                                   std::optional<std::uint64_t> until = {});

}  // namespace sunder
