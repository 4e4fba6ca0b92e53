// SPDX-License-Identifier: MIT
// What stands behind a `sunder_engine`, and what its functions are made of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "apps/host/sunder.h"
#include "apps/scene/scene_json.hpp"
#include "fracture/algorithms/fan_event.hpp"
#include "fracture/simulation/simulation.hpp"

namespace sunder {

/// A fan as it was made.
struct MadeFan {
  double number = -1;  ///< from 0 since the start, as in events.jsonl; -1: of a cut by hand
  double time = 0;     ///< s, since the start
  FanEvent event;
};

}  // namespace sunder

/// A simulation with what a host does to it, and the memory of the columns it reads.
struct sunder_engine {
  sunder::Simulation simulation;
  sunder_report report{};
  std::string error;
  std::vector<sunder::Finding> findings;  ///< those of `error`
  bool failed = false;
  /// A change that began and did not end, as memory ran out: nothing can be read any more.
  bool torn = false;
  /// Of the last step, and before them the cuts by hand that came before it; and cuts since then.
  std::vector<sunder::MadeFan> fans, cuts;
  std::array<std::vector<unsigned char>, SUNDER_COLUMNS> columns;
  std::string saved;
};

namespace sunder {

/// The engine of a simulation as it is.
std::unique_ptr<sunder_engine> make_engine(Simulation simulation);

/// Reads the scene of an engine.
using SceneReader = std::function<Result<SceneFile>()>;

/// An engine with the scene that `read` gives, or null, with the findings for `sunder_error`. Never
/// throws.
sunder_engine* engine_of(const SceneReader& read) noexcept;

/// Fills the bytes of one column. Needs: column < SUNDER_COLUMNS. O(|V| + |T|).
void fill_column(std::vector<unsigned char>& bytes, const Simulation& simulation,
                 sunder_column column);

class Column;

/// The part of that for contacts and crack fronts. O(|T|).
void fill_marks(Column& column, const Simulation& simulation, sunder_column kind);

/// The same for SUNDER_FAN and SUNDER_FAN_FACE.
void fill_fans(std::vector<unsigned char>& bytes, std::span<const MadeFan> fans,
               sunder_column kind);

/// Stress, principal directions, threshold and fan of a vertex. Needs: vertex < |V|. O(|T|).
void inspect_vertex(sunder_vertex& result, const Simulation& simulation, VertexId vertex);

}  // namespace sunder
