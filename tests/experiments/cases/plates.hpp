// SPDX-License-Identifier: MIT
// Published plates in which cracks run fast, with cracks that take energy: scenes, and measurements
// of their cracks.
#pragma once

#include <string>
#include <vector>

#include "fracture/scene/scene.hpp"
#include "fracture/simulation/simulation.hpp"
#include "tests/experiments/cases/plate_mesh.hpp"

namespace sunder::accuracy {

/// A published test, its mesh chosen.
struct PlateCase {
  Scene scene;
  PlateShape shape;
  PlateLine notch;      ///< its tip is the end inside the plate
  double duration = 0;  ///< s
};

/// Choices for a case; zero or none: the published value.
struct PlateChoice {
  double cell = 0;  ///< m
  PlateCells cells = PlateCells::kuhn;
  std::uint64_t seed = 1;
  double strength = 0;       ///< Pa
  double rate = 0;           ///< m/s: speed of the striking or pulling body
  double ramp = -1;          ///< s over which that speed is raised; negative: the case's
  double frame = -1;         ///< m: how deep the arms of tension are held; negative: the case's
  double step = 0;           ///< s
  bool plane_strain = true;  ///< false: the slab's faces are free, as they always are in tension
};

/// A plate 100 x 40 mm with a notch to its middle, pulled apart by 1 MPa on its long edges from the
/// first instant [Song, Wang and Belytschko 2008; Borden et al. 2012].
PlateCase branching_plate(const PlateChoice& choice);

/// The half above the plane of symmetry of a steel plate with two notches, struck between them at
/// 16.5 m/s [Kalthoff and Winkler 1988; Kalthoff 2000]: y = 0 is the plane of symmetry, the struck
/// edge x = 0, y < 25 mm.
PlateCase kalthoff_plate(const PlateChoice& choice);

/// A compact tension specimen of concrete with a notch that is opened at a constant speed [Ozbolt,
/// Bosnjak and Sola 2013]; measures from memory.
PlateCase compact_tension(const PlateChoice& choice);

/// A crack face seen along z.
struct CrackTrace {
  double x = 0, y = 0;             ///< m, its middle at rest
  std::array<Point, 3> corners{};  ///< m, at rest
  bool released = false;           ///< else tied
};

/// New crack faces (of each pair one), the notch's left out.
std::vector<CrackTrace> crack_traces(const Simulation& sim, const PlateCase& plate);

/// Released faces that hang together with the notch's tip: each no more than two and a half cells
/// from the next.
std::vector<CrackTrace> main_crack(const std::vector<CrackTrace>& traces, const PlateCase& plate);

/// Where a crack's tip is, and how many branches there are behind it.
struct TipPlace {
  double time = 0;           ///< s
  double x = 0, y = 0;       ///< m, of the released face farthest from the notch's tip
  double reach = 0;          ///< m, its distance from there; 0: none is released
  double tied = 0;           ///< m, the same of the farthest face that is tied
  std::size_t branches = 0;  ///< most groups of released faces on one circle about the notch's tip
  double fork = 0;           ///< m, radius of the smallest circle with two groups or more; 0: none
};

/// The tip of the main crack now. Two of its faces on a ring two cells wide are of one group when
/// no more than two and a half cells apart, over others between them.
TipPlace tip_of(const std::vector<CrackTrace>& traces, const PlateCase& plate, double time);

/// Speed of the tip about each place, m/s: slope of the line through those within 2.5 us.
std::vector<double> tip_speeds(const std::vector<TipPlace>& history);

/// Direction of the main crack by a line from the notch's tip through its faces that are `from` to
/// `to` (m) away from there: degrees from the notch's line, positive towards +y.
double crack_angle(const std::vector<CrackTrace>& traces, const PlateCase& plate, double from,
                   double to);

}  // namespace sunder::accuracy
