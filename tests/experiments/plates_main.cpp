// SPDX-License-Identifier: MIT
// `plates branching|kalthoff|tension [--KEY VALUE ...]`: published plates in which cracks run fast:
// their tips by time, branches and angles, and a table of when each crack face opened, for
// plates.py to draw.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/state/living.hpp"
#include "tests/experiments/cases/plates.hpp"

using namespace sunder;
using namespace sunder::accuracy;

namespace {

constexpr const char* usage =
    "plates branching|kalthoff|tension [--cell MM] [--cells kuhn|cross|delaunay] [--seed N]\n"
    "       [--strength MPA] [--rate M/S] [--ramp US] [--frame MM] [--step US]\n"
    "       [--until US] [--free] [--csv FILE]\n"
    "Prints the tip of the crack at 50 times: where the released face farthest from the notch is,\n"
    "its speed by a line through 5 us, and branches. --free: plane stress, the faces of the slab "
    "free.";

struct Job {
  std::string name;
  PlateChoice choice;
  double until = 0;  // s; 0: the case's
  std::string csv;
};

PlateCells cells_of(const std::string& word) {
  if (word == "kuhn") return PlateCells::kuhn;
  if (word == "cross") return PlateCells::cross;
  if (word == "delaunay") return PlateCells::delaunay;
  throw std::invalid_argument("--cells " + word + ": kuhn, cross or delaunay");
}

Job read(int argc, char** argv) {
  if (argc < 2) throw std::invalid_argument("which plate?");
  Job job{.name = argv[1], .choice = {}, .until = 0, .csv = {}};
  for (int k = 2; k < argc; ++k) {
    const std::string key = argv[k];
    if (key == "--free") {
      job.choice.plane_strain = false;
      continue;
    }
    if (k + 1 >= argc) throw std::invalid_argument(key + " needs a value");
    const std::string value = argv[++k];
    const double number = std::atof(value.c_str());
    if (key == "--cells")
      job.choice.cells = cells_of(value);
    else if (key == "--csv")
      job.csv = value;
    else if (key == "--ramp")
      job.choice.ramp = 1e-6 * number;
    else if (key == "--frame")
      job.choice.frame = 1e-3 * number;
    else if (!(number > 0))
      throw std::invalid_argument(key + " " + value + ": a number above 0");
    else if (key == "--cell")
      job.choice.cell = 1e-3 * number;
    else if (key == "--seed")
      job.choice.seed = std::uint64_t(number);
    else if (key == "--strength")
      job.choice.strength = 1e6 * number;
    else if (key == "--rate")
      job.choice.rate = number;
    else if (key == "--step")
      job.choice.step = 1e-6 * number;
    else if (key == "--until")
      job.until = 1e-6 * number;
    else
      throw std::invalid_argument(key + ": no such key");
  }
  return job;
}

PlateCase plate_of(const Job& job) {
  if (job.name == "branching") return branching_plate(job.choice);
  if (job.name == "kalthoff") return kalthoff_plate(job.choice);
  if (job.name == "tension") return compact_tension(job.choice);
  throw std::invalid_argument(job.name + ": branching, kalthoff or tension");
}

/// When a crack face was first seen tied and released, s; negative: not yet.
struct FaceHistory {
  CrackTrace trace;
  double tied = -1, released = -1;
};

/// Crack faces by their middles at rest, in micrometres.
using FaceHistories = std::map<std::pair<long, long>, FaceHistory>;

void record(FaceHistories& faces, const std::vector<CrackTrace>& traces, double time) {
  for (const CrackTrace& trace : traces) {
    FaceHistory& face = faces[{std::lround(1e6 * trace.x), std::lround(1e6 * trace.y)}];
    face.trace = trace;
    double& first = trace.released ? face.released : face.tied;
    if (first < 0) first = time;
  }
}

/// The plate as plates.py draws it: its shape, its notch, and each crack face as a line along its
/// longest edge seen from +z, at rest.
void write_csv(const std::string& path, const Job& job, const PlateCase& plate,
               const FaceHistories& faces, double time) {
  std::ofstream file(path);
  file << "# " << job.name << ", " << 1e3 * plate.shape.length << " x " << 1e3 * plate.shape.height
       << " mm, cells of " << 1e3 * plate.shape.cell << " mm, notch " << 1e3 * plate.notch.from
       << " to " << 1e3 * plate.notch.to << " at " << 1e3 * plate.notch.height << " mm, to "
       << 1e6 * time << " us\nx0_mm,y0_mm,x1_mm,y1_mm,tied_us,released_us\n";
  for (const auto& [middle, face] : faces) {
    std::size_t longest = 0;
    const auto along = [&](std::size_t k) {
      const Point &a = face.trace.corners[k], &b = face.trace.corners[(k + 1) % 3];
      return std::hypot(b[0] - a[0], b[1] - a[1]);
    };
    for (std::size_t k = 1; k < 3; ++k) {
      if (along(k) > along(longest)) longest = k;
    }
    const Point &a = face.trace.corners[longest], &b = face.trace.corners[(longest + 1) % 3];
    file << 1e3 * a[0] << ',' << 1e3 * a[1] << ',' << 1e3 * b[0] << ',' << 1e3 * b[1] << ','
         << 1e6 * face.tied << ',' << 1e6 * face.released << '\n';
  }
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

void run(const Job& job) {
  const PlateCase plate = plate_of(job);
  auto built = build_simulation(plate.scene);
  for (const Finding& f : built.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
  if (!built) throw std::runtime_error("the scene cannot be built");
  Simulation sim = std::move(*built);
  std::printf("# %s: %zu tetrahedra\n", job.name.c_str(), sim.state->cells.map.tetrahedra());
  std::printf("# %8s %9s %9s %9s %8s %9s %6s %6s %8s %6s\n", "t, us", "x, mm", "y, mm", "reach",
              "tied", "branches", "fork", "pieces", "sub-steps", "stops");
  std::vector<TipPlace> history;
  FaceHistories faces;
  double residual = 0, moved = 0;
  std::size_t sub_steps = 0, stopped = 0;
  const double until = job.until > 0 ? job.until : plate.duration;
  double next = 0;
  while (simulated_time(sim) < until * (1 - 1e-9)) {
    const StepReport report = advance(sim);
    if (report.status.outcome != StepOutcome::fine) throw std::runtime_error("the run failed");
    residual += report.energy.residual;
    moved += report.energy.moved;
    sub_steps += report.impact.sub_steps;
    stopped += report.impact.stopped;
    if (report.time < next * (1 - 1e-9)) continue;
    const std::vector<CrackTrace> seen = crack_traces(sim, plate);
    record(faces, seen, report.time);
    history.push_back(tip_of(seen, plate, report.time));
    const TipPlace& tip = history.back();
    if (history.size() % 3 == 0) {
      std::printf("%10.1f %9.2f %9.2f %9.2f %8.2f %9zu %6.1f %6zu %8zu %6zu\n", 1e6 * tip.time,
                  1e3 * tip.x, 1e3 * tip.y, 1e3 * tip.reach, 1e3 * tip.tied, tip.branches,
                  1e3 * tip.fork, living_components(sim.state->mechanics).size(), sub_steps,
                  stopped);
      std::fflush(stdout);
    }
    next = report.time + until / 150;
  }
  const std::vector<double> speeds = tip_speeds(history);
  std::printf("# speed of the tip, m/s, by us:");
  double fastest = 0;
  for (std::size_t k = 0; k < history.size(); ++k) {
    if (history[k].reach > 0) std::printf(" %.0f:%.0f", 1e6 * history[k].time, speeds[k]);
    fastest = std::max(fastest, speeds[k]);
  }
  const auto started = std::ranges::find_if(history, [](const TipPlace& t) { return t.reach > 0; });
  const auto forked = std::ranges::find_if(history, [](const TipPlace& t) { return t.fork > 0; });
  std::printf("\n# fastest %.0f m/s", fastest);
  if (started != history.end())
    std::printf("; first released face at %.1f us", 1e6 * started->time);
  if (forked != history.end()) {
    // Arms are distinguished once they are 2.5 cells from each other: later than the tip was there.
    const auto at_fork =
        std::ranges::find_if(history, [&](const TipPlace& t) { return t.reach >= forked->fork; });
    double before = 0;
    for (auto at = history.begin(); at != at_fork; ++at) {
      before = std::max(before, speeds[std::size_t(at - history.begin())]);
    }
    std::printf(
        "; first fork at %.1f us, arms apart %.1f mm from the notch, where the tip was at "
        "%.1f us, until then %.0f m/s at most",
        1e6 * forked->time, 1e3 * forked->fork, 1e6 * at_fork->time, before);
  }
  const std::vector<CrackTrace> traces = crack_traces(sim, plate);
  record(faces, traces, simulated_time(sim));
  const double reach = history.back().reach;
  std::printf(
      "; direction %.1f degrees (whole), %.1f (first third)\n# residual of the energy "
      "ledger over what moved: %.1e; sub-steps %zu, steps stopped short %zu\n",
      crack_angle(traces, plate, 0, reach), crack_angle(traces, plate, 0, reach / 3),
      std::abs(residual) / moved, sub_steps, stopped);
  if (!job.csv.empty()) write_csv(job.csv, job, plate, faces, simulated_time(sim));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(read(argc, argv));
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s\n%s\n", error.what(), usage);
    return 2;
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 5;
  }
}
