// SPDX-License-Identifier: MIT
// Tears one body apart at random, an operation at a time, and judges each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "topology/suite/random/random_run_trial.hpp"

namespace sunder::suite {

/// Operations and their results; steps that only undo and repeat others are not among them.
struct TearCounts {
  std::size_t operations = 0;
  /// Fans with at least one face; those without one; sections of planes; single faces.
  std::size_t fans = 0, empty_fans = 0, planes = 0, single_faces = 0;
  /// Breaks by labels with at least one face; those without one; their groups, each of one to three
  /// cracks with labels given beforehand.
  std::size_t labelled_fans = 0, empty_labelled_fans = 0, crack_groups = 0;
  /// Faces split by all of these, and the cells that came apart there.
  std::size_t faces = 0, vertices = 0, edges = 0;
  /// Faces at which the oracle says yes; that part a component; at which it says no all the same.
  std::size_t alarms = 0, separations = 0, missed = 0;
  /// Faces glued, to stay so or to be split again.
  std::size_t glues = 0;
  /// Questions that had to be refused.
  std::size_t vain = 0;
  /// Operations undone and done again in another order; among them those in all orders.
  std::size_t orders = 0, all_orders = 0;
  /// Bodies taken apart from the beginning on a second kernel, in another order.
  std::size_t replays = 0;
  /// Groups of breaks made again on a second kernel, in another order; the labelled fans in them.
  std::size_t crack_orders = 0, fans_in_other_orders = 0;
};

/// A set of half-faces from which one can be drawn.
class FaceSet {
 public:
  explicit FaceSet(std::size_t half_faces) : at_(half_faces, absent) {}
  std::size_t size() const { return faces_.size(); }
  HalfFaceId operator[](std::size_t i) const { return faces_[i]; }
  /// Needs: it is not there.
  void insert(HalfFaceId face);
  /// Needs: it is there.
  void erase(HalfFaceId face);

 private:
  static constexpr std::uint32_t absent = 0xffffffffU;
  std::vector<HalfFaceId> faces_;
  std::vector<std::uint32_t> at_;  // place in faces_ of each half-face
};

/// A body being torn.
struct Tear {
  Trial trial;
  /// Faces not split, by their lower side; and the two sides of each that is.
  FaceSet whole;
  std::vector<std::array<HalfFaceId, 2>> parted;
  Pace order_pace{.allowance = 32}, replay_pace{.allowance = 16}, crack_pace{.allowance = 2000};
};

Tear begin_tear(Trial trial);

/// The state that all bodies of a family share.
struct TearRun {
  std::mt19937_64 random;
  TearCounts counts;
  /// Of the same kind as the one that bodies are torn on.
  JudgedKernel second;
};

/// One operation drawn at random: mostly the fan of a vertex, sometimes breaks by labels, a single
/// face, a plane, gluing some of the split faces, or an operation that has to be refused.
/// Needs: a face that is whole.
void tear_once(TearRun& run, Tear& tear);

}  // namespace sunder::suite
