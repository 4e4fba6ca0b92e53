// SPDX-License-Identifier: MIT
// `rubble_session SCENE.json SECONDS ACTIONS SEED [key=value...]`: somebody plays with a scene
// through the C functions: balls shot, vertices pulled for half a second, plane cuts, all at
// random. Prints the cost of frames of 1/60 s, and whether all numbers are numbers, no mass is
// lost, memory is flat.
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/host/sunder.h"

namespace {

using Place = std::array<double, 3>;

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

double thread_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// MB that are resident.
double memory() {
  std::ifstream in("/proc/self/statm");
  double all = 0, resident = 0;
  in >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

sunder_engine* open_scene(const std::filesystem::path& path,
                          const std::vector<const char*>& settings) {
  const std::string text = bytes_of(path), name = path.string();
  std::vector<std::string> names, contents;
  const auto json = nlohmann::json::parse(text);
  for (const auto& body : json["bodies"]) {
    names.push_back(body["mesh"]);
    contents.push_back(bytes_of(path.parent_path() / names.back()));
  }
  std::vector<sunder_file> files;
  for (std::size_t i = 0; i < names.size(); ++i) {
    files.push_back({names[i].c_str(), contents[i].data(), contents[i].size()});
  }
  sunder_scene scene{};
  scene.size = sizeof scene;
  scene.text = text.data();
  scene.text_size = text.size();
  scene.name = name.c_str();
  scene.files = files.data();
  scene.file_count = static_cast<std::uint32_t>(files.size());
  scene.settings = settings.data();
  scene.setting_count = static_cast<std::uint32_t>(settings.size());
  return sunder_create(&scene);
}

/// A column as floats; valid until the next call.
std::vector<float> floats(sunder_engine* engine, sunder_column column) {
  sunder_span span{};
  if (sunder_read(engine, column, &span) != 0) return {};
  const auto* first = static_cast<const float*>(span.bytes);
  return {first, first + span.size / sizeof(float)};
}

/// Somebody's hand.
struct Player {
  sunder_engine* engine;
  std::mt19937_64 random;
  double size = 0;                    ///< m, of the scene at its start
  double release = -1;                ///< s, when the spring ends; below 0: there is none
  std::array<std::size_t, 3> done{};  ///< shots, pulls, cuts
  std::size_t refused = 0;

  double between(double a, double b) {
    return a + (b - a) * static_cast<double>(random() >> 11) * 0x1p-53;
  }

  sunder_action action(sunder_action_kind kind) const {
    sunder_action result{};
    result.size = sizeof result;
    result.kind = static_cast<std::uint32_t>(kind);
    return result;
  }

  /// A vertex and its place.
  std::pair<std::uint32_t, Place> target() {
    const std::vector<float> at = floats(engine, SUNDER_POSITION);
    const auto row = static_cast<std::uint32_t>(random() % (at.size() / 3));
    return {row, {at[3 * row], at[3 * row + 1], at[3 * row + 2]}};
  }

  void act(const sunder_action& a, std::size_t kind) {
    if (sunder_act(engine, &a) == 0) {
      ++done[kind];
    } else {
      ++refused;
    }
  }

  /// A ball from above at a vertex.
  void shoot() {
    sunder_action a = action(SUNDER_SHOOT);
    const Place at = target().second;
    const double turn = between(0, 6.283), steep = between(0.2, 1.4), speed = between(1, 10);
    const Place out = {std::cos(steep) * std::cos(turn), std::cos(steep) * std::sin(turn),
                       std::sin(steep)};
    for (std::size_t k = 0; k < 3; ++k) {
      a.point[k] = at[k] + size * out[k];
      a.vector[k] = -speed * out[k];
    }
    a.radius = size * between(0.01, 0.04);
    a.mass = 4.19 * 2700 * a.radius * a.radius * a.radius;
    act(a, 0);
  }

  void pull(double time) {
    sunder_action a = action(SUNDER_PULL);
    const auto [row, at] = target();
    a.vertex = row;
    for (std::size_t k = 0; k < 3; ++k) a.point[k] = at[k] + size * between(-0.3, 0.3);
    a.point[2] = std::max(a.point[2], 0.1 * size);
    act(a, 1);
    release = time + 0.5;
  }

  void cut() {
    sunder_action a = action(SUNDER_CUT);
    const Place at = target().second;
    for (std::size_t k = 0; k < 3; ++k) {
      a.point[k] = at[k];
      a.vector[k] = between(-1, 1);
    }
    act(a, 2);
  }

  /// Half are shots, three in ten pulls, the rest cuts.
  void play(double time) {
    const double kind = between(0, 1);
    if (kind < 0.5) return shoot();
    if (kind < 0.8) return pull(time);
    cut();
  }

  void let_go(double time) {
    if (release < 0 || time < release) return;
    const sunder_action a = action(SUNDER_RELEASE);
    sunder_act(engine, &a);
    release = -1;
  }
};

double mass_of(sunder_engine* engine) {
  double sum = 0;
  const std::vector<float> centres = floats(engine, SUNDER_REST_CENTRE);
  for (std::size_t k = 3; k < centres.size(); k += 4) sum += static_cast<double>(centres[k]);
  return sum;
}

bool all_numbers(sunder_engine* engine) {
  for (const sunder_column column : {SUNDER_POSITION, SUNDER_SPEED}) {
    for (const float x : floats(engine, column)) {
      if (!std::isfinite(x)) return false;
    }
  }
  return true;
}

double size_of(sunder_engine* engine) {
  Place low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};
  const std::vector<float> at = floats(engine, SUNDER_POSITION);
  for (std::size_t k = 0; k < at.size(); ++k) {
    low[k % 3] = std::min(low[k % 3], static_cast<double>(at[k]));
    high[k % 3] = std::max(high[k % 3], static_cast<double>(at[k]));
  }
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

void print_histogram(std::vector<double> frames) {
  std::puts("frames of 1/60 s, ms of the thread below:");
  std::size_t from = 0;
  std::ranges::sort(frames);
  for (const double limit : {1., 2., 4., 8., 16., 33., 66., 133., 266., 533., 1066., 1e99}) {
    const auto end =
        static_cast<std::size_t>(std::ranges::lower_bound(frames, limit) - frames.begin());
    std::printf("%g: %zu\n", limit, end - from);
    from = end;
  }
  const auto part = [&](double p) {
    return frames[static_cast<std::size_t>(p * static_cast<double>(frames.size() - 1))];
  };
  std::printf("p50 %.2f, p99 %.1f, worst %.1f\n", part(0.5), part(0.99), frames.back());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fputs("usage: rubble_session SCENE.json SECONDS ACTIONS SEED [key=value...]\n", stderr);
    return 2;
  }
  const double seconds = std::atof(argv[2]), actions = std::atof(argv[3]);
  sunder_engine* engine = open_scene(argv[1], {argv + 5, argv + argc});
  if (engine == nullptr) return std::fprintf(stderr, "%s", sunder_error(nullptr)), 4;
  Player player{engine, std::mt19937_64(std::strtoull(argv[4], nullptr, 10)), size_of(engine)};
  sunder_report report{};
  report.size = sizeof report;
  sunder_last_report(engine, &report);
  const double mass = mass_of(engine), start = memory();
  std::printf("mass %.6g kg, memory %.1f MB, step %g s\n", mass, start, report.time_step);
  std::puts("time,pieces,ms so far,memory MB,mass over that at the start less 1");
  std::vector<double> frames;
  double spent = 0;
  std::size_t acted = 0;
  const double every = seconds / actions;
  const auto count = static_cast<std::size_t>(std::lround(60 * seconds));
  for (std::size_t frame = 0; frame < count; ++frame) {
    const double time = static_cast<double>(frame) / 60;
    while (static_cast<double>(acted) * every <= time) {
      player.play(time);
      ++acted;
    }
    player.let_go(time);
    const double before = thread_ms();
    int failed = 0;
    while (failed == 0 &&
           report.time + 0.5 * report.time_step < static_cast<double>(frame + 1) / 60) {
      failed = sunder_step(engine, &report);
    }
    frames.push_back(thread_ms() - before);
    spent += frames.back();
    if (failed != 0 || !all_numbers(engine)) {
      std::printf("failed at %.4f s: %s\n", report.time,
                  failed ? sunder_error(engine) : "not a number");
      return 5;
    }
    if ((frame + 1) % 1800 == 0 || frame + 1 == count) {
      std::printf("%.1f,%u,%.0f,%.1f,%.2g\n", report.time, report.pieces, spent, memory(),
                  mass_of(engine) / mass - 1);
      std::fflush(stdout);
    }
  }
  std::printf("shots %zu, pulls %zu, cuts %zu, refused %zu; fans %llu; memory %+.1f MB\n",
              player.done[0], player.done[1], player.done[2], player.refused,
              static_cast<unsigned long long>(report.fans_total), memory() - start);
  print_histogram(std::move(frames));
  sunder_destroy(engine);
}
