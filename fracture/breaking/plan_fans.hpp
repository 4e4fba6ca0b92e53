// SPDX-License-Identifier: MIT
// The search of one `break_vertices` and the fans of one tie; not for others to include.
#pragma once

#include <queue>
#include <span>
#include <vector>

#include "fracture/breaking/break_vertices.hpp"
#include "fracture/breaking/choose_crack.hpp"

namespace sunder {

/// A vertex that reaches its threshold: those by which a crack grows come first, then the most
/// overstressed.
struct BreakCandidate {
  double overstress = 0;  // largest principal stress / threshold
  VertexId vertex;
  bool grows = false;  // with `CrackMode::object`

  friend bool operator<(const BreakCandidate& a, const BreakCandidate& b) {
    if (a.grows != b.grows) return b.grows;
    if (a.overstress != b.overstress) return a.overstress < b.overstress;
    return a.vertex > b.vertex;
  }
};

/// One call at work.
struct FractureWork {
  BreakableBody body;
  const FractureSettings& settings;
  FractureScratch& scratch;
  const FanWatch& watch;
  ElementStress elements;
  FractureReport report = {};
  std::size_t under_way = 0;  // `first_under_way`
  double untested = 0;        // s
  std::size_t pieces_before = 0;
  std::priority_queue<BreakCandidate> queue = {};

  const Mat3& stress(VertexId v) const { return scratch.node_stress.value[v.index()]; }
  double strength(VertexId v) const { return body.cells.strength[v.index()]; }
  ThresholdAnswer test(VertexId v) const { return test_threshold(stress(v), strength(v)); }
  bool has_objects() const { return settings.crack != CrackMode::paper; }
  void tell(VertexId v) const {
    if (watch) watch(v);
  }
};

/// Measures the node stress of one vertex again.
void measure(FractureWork& work, VertexId v);

/// From now on the vertex waits until its stress changes.
void hold(FractureWork& work, VertexId v);

/// The crack of a vertex on the state as it is.
CrackChoice crack_of(const FractureWork& work, const VertexStar& v,
                     const PrincipalTension& tension);

/// Fans of the tied candidates on the state as it is; none for those that wait or cannot break.
std::vector<PlannedFan> plan_fans(FractureWork& work, std::span<const VertexId> tied);

}  // namespace sunder
