// SPDX-License-Identifier: MIT
// `plates branching|kalthoff|tension [--KEY VALUE ...]`: published plates in which cracks run fast:
// their tips by time, branches and angles, and a picture of where they ran.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

#include "apps/render/image.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/state/living.hpp"
#include "tests/experiments/cases/plates.hpp"

using namespace sunder;
using namespace sunder::accuracy;

namespace {

constexpr const char* usage =
    "plates branching|kalthoff|tension [--cell MM] [--cells kuhn|cross|delaunay] [--seed N]\n"
    "       [--strength MPA] [--rate M/S] [--ramp US] [--frame MM] [--step US]\n"
    "       [--until US] [--free] [--png FILE]\n"
    "Prints the tip of the crack at 50 times: where the released face farthest from the notch is,\n"
    "its speed by a line through 5 us, and branches. --free: plane stress, the faces of the slab free.";

struct Job {
  std::string name;
  PlateChoice choice;
  double until = 0;  // s; 0: the case's
  std::string png;
};

PlateCells cells_of(const std::string& word) {
  if (word == "kuhn") return PlateCells::kuhn;
  if (word == "cross") return PlateCells::cross;
  if (word == "delaunay") return PlateCells::delaunay;
  throw std::invalid_argument("--cells " + word + ": kuhn, cross or delaunay");
}

Job read(int argc, char** argv) {
  if (argc < 2) throw std::invalid_argument("which plate?");
  Job job{.name = argv[1], .choice = {}, .until = 0, .png = {}};
  for (int k = 2; k < argc; ++k) {
    const std::string key = argv[k];
    if (key == "--free") {
      job.choice.plane_strain = false;
      continue;
    }
    if (k + 1 >= argc) throw std::invalid_argument(key + " needs a value");
    const std::string value = argv[++k];
    const double number = std::atof(value.c_str());
    if (key == "--cells") job.choice.cells = cells_of(value);
    else if (key == "--png") job.png = value;
    else if (key == "--ramp") job.choice.ramp = 1e-6 * number;
    else if (key == "--frame") job.choice.frame = 1e-3 * number;
    else if (!(number > 0)) throw std::invalid_argument(key + " " + value + ": a number above 0");
    else if (key == "--cell") job.choice.cell = 1e-3 * number;
    else if (key == "--seed") job.choice.seed = std::uint64_t(number);
    else if (key == "--strength") job.choice.strength = 1e6 * number;
    else if (key == "--rate") job.choice.rate = number;
    else if (key == "--step") job.choice.step = 1e-6 * number;
    else if (key == "--until") job.until = 1e-6 * number;
    else throw std::invalid_argument(key + ": no such key");
  }
  return job;
}

PlateCase plate_of(const Job& job) {
  if (job.name == "branching") return branching_plate(job.choice);
  if (job.name == "kalthoff") return kalthoff_plate(job.choice);
  if (job.name == "tension") return compact_tension(job.choice);
  throw std::invalid_argument(job.name + ": branching, kalthoff or tension");
}

/// The plate from +z, as it is at rest: rim, notch, tied faces in orange, released ones in black.
void draw(const std::string& path, const PlateCase& plate, const std::vector<CrackTrace>& traces) {
  constexpr int margin = 12, longer = 720;
  const double scale = longer / std::max(plate.shape.length, plate.shape.height);
  render::Image image;
  image.width = int(plate.shape.length * scale) + 2 * margin;
  image.height = int(plate.shape.height * scale) + 2 * margin;
  image.rgb.assign(std::size_t(3 * image.width * image.height), 255);
  using Color = std::array<std::uint8_t, 3>;
  const auto line = [&](const Point& a, const Point& b, const Color& color, int thick) {
    const double away = scale * std::hypot(b[0] - a[0], b[1] - a[1]);
    const int n = int(2 * away) + 1;
    for (int k = 0; k <= n; ++k) {
      const double t = double(k) / n;
      const int x = margin + int(scale * (a[0] + t * (b[0] - a[0])));
      const int y = image.height - margin - int(scale * (a[1] + t * (b[1] - a[1])));
      for (int i = 0; i < thick; ++i) {
        for (int j = 0; j < thick; ++j) {
          if (x + i >= image.width || y + j >= image.height) continue;
          std::copy(color.begin(), color.end(),
                    image.rgb.begin() + 3 * ((y + j) * image.width + x + i));
        }
      }
    }
  };
  const double l = plate.shape.length, h = plate.shape.height;
  const Color rim = {120, 120, 120}, tied = {240, 170, 90}, released = {20, 20, 20};
  const Point corner[] = {{0, 0, 0}, {l, 0, 0}, {l, h, 0}, {0, h, 0}};
  for (int k = 0; k < 4; ++k) line(corner[k], corner[(k + 1) % 4], rim, 1);
  line({plate.notch.from, plate.notch.height, 0}, {plate.notch.to, plate.notch.height, 0},
       {60, 90, 170}, 3);
  for (const bool black : {false, true}) {
    for (const CrackTrace& t : traces) {
      if (t.released != black) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        line(t.corners[k], t.corners[(k + 1) % 3], black ? released : tied, 2);
      }
    }
  }
  for (const Finding& f : render::write_png(path, image)) throw std::runtime_error(f.text);
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
    history.push_back(tip_of(crack_traces(sim, plate), plate, report.time));
    const TipPlace& tip = history.back();
    if (history.size() % 3 == 0) {
      std::printf("%10.1f %9.2f %9.2f %9.2f %8.2f %9zu %6.1f %6zu %8zu %6zu\n", 1e6 * tip.time,
                  1e3 * tip.x, 1e3 * tip.y, 1e3 * tip.reach, 1e3 * tip.tied, tip.branches,
                  1e3 * tip.fork, living_components(sim.state->mechanics).size(), sub_steps,
                  stopped);
      std::fflush(stdout);
      if (!job.png.empty()) draw(job.png, plate, crack_traces(sim, plate));
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
  if (started != history.end()) std::printf("; first released face at %.1f us", 1e6 * started->time);
  if (forked != history.end()) {
    // Arms are told apart once they are 2.5 cells from each other: later than the tip was there.
    const auto at_fork =
        std::ranges::find_if(history, [&](const TipPlace& t) { return t.reach >= forked->fork; });
    double before = 0;
    for (auto at = history.begin(); at != at_fork; ++at) {
      before = std::max(before, speeds[std::size_t(at - history.begin())]);
    }
    std::printf("; first fork at %.1f us, arms apart %.1f mm from the notch, where the tip was at "
                "%.1f us, until then %.0f m/s at most",
                1e6 * forked->time, 1e3 * forked->fork, 1e6 * at_fork->time, before);
  }
  const std::vector<CrackTrace> traces = crack_traces(sim, plate);
  const double reach = history.back().reach;
  std::printf("; direction %.1f degrees (whole), %.1f (first third)\n# residual of the energy "
              "ledger over what moved: %.1e; sub-steps %zu, steps stopped short %zu\n",
              crack_angle(traces, plate, 0, reach), crack_angle(traces, plate, 0, reach / 3),
              std::abs(residual) / moved, sub_steps, stopped);
  if (!job.png.empty()) draw(job.png, plate, traces);
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
