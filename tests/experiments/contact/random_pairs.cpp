// SPDX-License-Identifier: MIT
// Throws step by step; the judge sees places alone.
#include "tests/experiments/contact/random_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <span>

#include "tests/experiments/contact/contact_judge.hpp"
#include "tests/mechanics/contact/contact_scene.hpp"

namespace sunder::test {
namespace {

/// The places of a scene at one moment.
struct Moment {
  std::vector<Vec3> at;
  std::vector<Pose> frames;
  std::vector<Obstacle> obstacles;
};

Moment moment_of(const ContactScene& scene) {
  Moment now{scene.state.vertices.position, {}, scene.obstacles};
  for (const Component& c : scene.state.components) now.frames.push_back({c.centre, c.orientation});
  return now;
}

/// m
struct Sizes {
  double edge;   ///< the mean edge of the smaller solid, or the radius of a ball
  double reach;  ///< from a mass centre to the farthest corner
};

/// One part of a step, or a part of that.
struct Motion {
  Moment from, to;
};

/// Appends tetrahedra for the judge.
void add_tetrahedra(ContactFrame& frame, std::span<const Corners> tetrahedra) {
  for (const Corners& t : tetrahedra) {
    frame.tetrahedra.push_back({t[0].value, t[1].value, t[2].value, t[3].value});
  }
}

/// Places after a share of a motion. Frames turn evenly, and vertices move evenly in their frames.
ContactFrame frame_at(const Motion& motion, const ContactScene& scene, double part) {
  ContactFrame frame;
  frame.points.resize(motion.from.at.size());
  for (std::size_t v = 0; v < frame.points.size(); ++v) {
    const std::size_t k = scene.state.vertices.component[v].index();
    const Pose &a = motion.from.frames[k], &b = motion.to.frames[k];
    const Vec3 x = a.orientation.conjugate() * (motion.from.at[v] - a.centre);
    const Vec3 y = b.orientation.conjugate() * (motion.to.at[v] - b.centre);
    frame.points[v] = (1 - part) * a.centre + part * b.centre +
                      a.orientation.slerp(part, b.orientation) * ((1 - part) * x + part * y);
  }
  add_tetrahedra(frame, scene.body.corners);
  for (const ComponentId id : scene.state.elements.component) frame.piece.push_back(id.value);
  frame.obstacles = motion.from.obstacles;
  for (std::size_t k = 0; k < frame.obstacles.size(); ++k) {
    Vec3& centre = std::get<Sphere>(frame.obstacles[k].shape).center;
    centre = (1 - part) * centre + part * std::get<Sphere>(motion.to.obstacles[k].shape).center;
  }
  return frame;
}

double turn_of(const Motion& motion) {
  double most = 0;
  for (std::size_t k = 0; k < motion.from.frames.size(); ++k) {
    most = std::max(
        most, motion.from.frames[k].orientation.angularDistance(motion.to.frames[k].orientation));
  }
  return most;
}

/// Parts of a motion between which straight ways of corners leave their arcs by a tenth of the
/// tolerance (m) at most: the judge goes straight from frame to frame.
int parts_of(const Motion& motion, double reach, double tolerance) {
  constexpr double most_turn = 0.05;
  const double turn = turn_of(motion);
  return 1 + static_cast<int>(
                 std::max(turn / most_turn, turn * std::sqrt(reach / (8 * 0.1 * tolerance))));
}

double deepest_of(const FrameOverlaps& overlaps) {
  return std::max(overlaps.pieces.depth, overlaps.obstacles.depth);
}

/// Adds the judgement of one part of a step.
void judge_step(RandomPair& pair, const Motion& motion, const ContactScene& scene,
                const Sizes& sizes) {
  const double edge = sizes.edge, tolerance = 0.02 * edge;
  const int moments = parts_of(motion, sizes.reach, tolerance);
  ContactFrame last = frame_at(motion, scene, 0);
  for (int k = 1; k <= moments; ++k) {
    ContactFrame now = frame_at(motion, scene, double(k) / moments);
    for (const Crossing& c : judge_crossings(last, now, tolerance)) {
      pair.passed = pair.passed || c.passed;
    }
    last = std::move(now);
  }
  pair.last = deepest_of(judge_overlaps(last, edge)) / edge;
  pair.deepest = std::max(pair.deepest, pair.last);
}

double edge_of(const RandomThrow& thrown) {
  if (thrown.ball > 0) return thrown.ball;
  ContactFrame smaller;
  smaller.points = thrown.second.rest;
  add_tetrahedra(smaller, thrown.second.corners);
  return mean_edge(smaller);
}

}  // namespace

RandomPair run_random_pair(std::uint64_t seed) {
  const RandomThrow thrown = draw_throw(seed);
  ContactScene scene = scene_of(thrown);
  RandomPair pair{thrown.figures};
  const Sizes sizes{edge_of(thrown), thrown.reach};
  const double way = pair.speed * pair.time_step;
  constexpr int most_steps = 100, after = 4;
  int left = std::min(most_steps, 2 + static_cast<int>((thrown.gap + 3 * thrown.reach) / way));
  Motion motion{moment_of(scene), {}};
  for (; left > 0; --left) {
    const ContactStepResult result = scene.step_in_parts([&] {
      motion.to = moment_of(scene);
      judge_step(pair, motion, scene, sizes);
      motion.from = std::move(motion.to);
    });
    if (result.report.contacts > 0 && !pair.met) {
      pair.met = true;
      left = std::min(left, after + 1);
    }
  }
  return pair;
}

}  // namespace sunder::test
