// SPDX-License-Identifier: MIT
// Fans of an earlier run, made again at the same place and time: the basis of a replay.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fracture/breaking/break_vertices.hpp"

namespace sunder {

/// One search for fractures of a run: its step, from 1, and which of the step's searches, from 0.
struct SearchPlace {
  std::uint64_t step = 0;
  std::uint32_t part = 0;
  friend auto operator<=>(const SearchPlace&, const SearchPlace&) = default;
};

/// A fan to be made: where in the run, and along which plane.
struct ScriptedFan {
  SearchPlace place;
  /// Fans of one round of a search were decided on the same state (`FanEvent::round`).
  std::uint32_t round = 0;
  VertexId vertex;
  Vec3 normal = Vec3::Zero();  ///< rest frame, of length 1
  double stress = 0;           ///< Pa, only noted in the event
  double strength = 0;         ///< Pa, only noted, with the criterion `energy`: stresses made it
  /// With `CrackMode::object`, as in `FanEvent`.
  CrackId crack;
  Vec3 anchor = Vec3::Zero();
  std::vector<CrackLabel> labels;
};

/// A fan of the script that cannot be made.
struct ScriptDeparture {
  std::size_t fan = 0;  ///< its row
  std::string reason;
};

/// The fans of a whole run in the order in which they were made.
struct FanScript {
  std::vector<ScriptedFan> fans;
  std::size_t next = 0;  ///< the first that was not made yet
  std::optional<ScriptDeparture> departure;
};

/// Makes the fans that the script has for the search at `place`, without any threshold test, and
/// moves the script on; gives their events. Round by round, the faces of all fans follow from their
/// vertices and normals before any of them is split, as in `break_vertices`. Limits on pieces are
/// not tested again. Stops at the first fan that does not fit, and reports it in
/// `script.departure`: its search has passed, its vertex is not there, or its plane parts nothing.
/// The caller compares the split faces with those of the earlier run.
/// `untested`: s, as in `break_vertices`.
/// Needs: calls in the order of the run, one for every search. Cost: that of the fans.
std::vector<FanEvent> make_fans(BreakableBody body, const FractureSettings& settings,
                                FanScript& script, SearchPlace place, ComponentScratch& scratch,
                                double untested, const FanWatch& watch = {});

}  // namespace sunder
