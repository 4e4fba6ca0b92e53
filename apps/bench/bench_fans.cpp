// SPDX-License-Identifier: MIT
// Fans at random vertices, and the measurements at each.
#include "apps/bench/bench_fans.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <random>

#include "apps/bench/clock.hpp"
#include "topology/base/assert.hpp"
#include "topology/kernel/components.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/kernel/invariants.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder {
namespace {

using suite::below;
using suite::unit;

std::vector<HalfFaceId> shuffled_interior(const VolumeMap& map, std::mt19937_64& random) {
  std::vector<HalfFaceId> faces;
  for (std::size_t i = 0; i < 4 * map.tetrahedra(); ++i) {
    const HalfFaceId f{i}, across = map.neighbour(f);
    if (!across.is_none() && f < across) faces.push_back(below(random, 2) == 0 ? f : across);
  }
  for (std::size_t i = faces.size(); i > 1; --i) std::swap(faces[i - 1], faces[below(random, i)]);
  return faces;
}

/// Evenly spread over the sphere.
Point random_direction(std::mt19937_64& random) {
  while (true) {
    const Point n = {2 * unit(random) - 1, 2 * unit(random) - 1, 2 * unit(random) - 1};
    const double square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    if (square > 0.01 && square <= 1) return n;
  }
}

/// Fans that are not empty, each at a vertex of the next interior face of a random list. `split`
/// has to split all faces it is given. Ends when no face is left or `split` says false. The same
/// seed gives the same fans.
template <class Split>
void random_fans(const VolumeMap& map, std::uint64_t seed, const Split& split) {
  std::mt19937_64 random(seed);
  for (const HalfFaceId face : shuffled_interior(map, random)) {
    while (!map.neighbour(face).is_none()) {
      const std::size_t place = (place_of(face) + 1 + below(random, 3)) % 4;
      const VertexId v = map.corners(tetrahedron_of(face))[place];
      auto fan = fan_faces(map, v, random_direction(random));
      if (fan->empty()) continue;
      if (!split(*fan)) return;
    }
  }
}

struct QuietFan {
  double find = 0, split = 0, components = 0;
  std::size_t faces = 0, visited = 0;
};

/// Splits one fan of an intact body, and glues it again.
QuietFan quiet_fan(VolumeMap& map, VertexId vertex, Components& labels, ComponentScratch& scratch) {
  QuietFan fan;
  const double start = wall_us();
  const auto faces = fan_faces(map, vertex, {0.3, 0.5, 1});
  const double found = wall_us();
  std::vector<FaceSplit> splits;
  splits.reserve(faces->size());
  for (const HalfFaceId f : *faces) splits.push_back(split_face(map, f));
  const double split = wall_us();
  const ComponentUpdate update = update_components(map, splits, Detection::exact, labels, scratch);
  fan.components = wall_us() - split;
  fan.split = split - found;
  fan.find = found - start;
  fan.faces = splits.size();
  fan.visited = update.visited;
  for (const FaceSplit& s : splits) fan.visited += s.visited;
  SUNDER_ASSERT(update.created == 0, "a fan deep inside parts nothing");
  for (std::size_t i = splits.size(); i-- > 0;) {
    glue_face(map, splits[i].face, splits[i].opposite);
  }
  return fan;
}

constexpr std::array<Detection, 4> ways = {Detection::walk, Detection::dirty_counter,
                                           Detection::oracle, Detection::exact};
constexpr std::array<const char*, 4> way_names = {"walk", "dirty_counter", "oracle", "exact"};

/// One fan at which all ways were measured.
struct SearchSample {
  bool parted = false;
  std::array<std::size_t, 4> visited = {0, 0, 0, 0};
  std::array<std::vector<double>, 4> us;
};

std::vector<FaceSplit> split_faces_of(VolumeMap& map, std::span<const HalfFaceId> faces) {
  std::vector<FaceSplit> splits;
  for (const HalfFaceId f : faces) splits.push_back(split_face(map, f));
  return splits;
}

/// The largest part keeps the id.
bool is_halved(const Components& labels) {
  return 2 * labels.size[0] <= labels.of_tetrahedron.size();
}

std::size_t fans_until_halved(VolumeMap map, std::uint64_t seed) {
  Components labels = label_components(map);
  ComponentScratch scratch;
  std::size_t fans = 0;
  random_fans(map, seed, [&](std::span<const HalfFaceId> faces) {
    update_components(map, split_faces_of(map, faces), Detection::exact, labels, scratch);
    ++fans;
    return !is_halved(labels);
  });
  return fans;
}

/// One run for one way (a row of `ways`): at every `stride`-th fan it is timed, at the others the
/// labels follow by the exact search. A run for each, so that all meet the body in the same state
/// of the caches.
void run_searches(VolumeMap map, std::uint64_t seed, std::size_t way,
                  std::vector<SearchSample>& samples, std::size_t stride) {
  Components labels = label_components(map);
  ComponentScratch scratch;
  std::size_t fan = 0;
  random_fans(map, seed, [&](std::span<const HalfFaceId> faces) {
    const std::vector<FaceSplit> splits = split_faces_of(map, faces);
    const bool measured = fan % stride == 0;
    const double start = wall_us();
    const ComponentUpdate update =
        update_components(map, splits, measured ? ways[way] : Detection::exact, labels, scratch);
    const double us = wall_us() - start;
    if (measured) {
      if (samples.size() <= fan / stride) samples.emplace_back();
      SearchSample& sample = samples[fan / stride];
      sample.us[way].push_back(us);
      sample.visited[way] = update.visited;
      sample.parted = update.created > 0;
    }
    ++fan;
    return !is_halved(labels);
  });
}

void add_searches(bool parted, std::span<const SearchSample> samples, const FigureSink& add) {
  const std::string prefix = parted ? "search_parted_" : "search_kept_";
  const auto count = static_cast<double>(std::count_if(
      samples.begin(), samples.end(), [&](const auto& s) { return s.parted == parted; }));
  add(prefix + "fans", count);
  if (count == 0) return;
  for (std::size_t way = 0; way < ways.size(); ++way) {
    double us = 0, visited = 0;
    for (const SearchSample& s : samples) {
      if (s.parted != parted) continue;
      us += median(s.us[way]);
      visited += static_cast<double>(s.visited[way]);
    }
    add(prefix + "us_" + way_names[way], us / count);
    add(prefix + "visited_" + way_names[way], visited / count);
  }
}

/// Yes and true yes, by fan and by face.
struct OracleCount {
  std::size_t fans = 0, fans_parting = 0, fans_yes = 0;
  std::size_t faces_yes = 0, faces_true = 0;

  void add_fan(std::size_t yes, std::size_t parted) {
    ++fans;
    fans_yes += yes > 0 ? 1 : 0;
    fans_parting += parted > 0 ? 1 : 0;
    faces_yes += yes;
    faces_true += parted;
  }
};

/// Per cent; a fan that parts a component has a yes, for the oracle never misses.
double fan_efficiency(const OracleCount& c) {
  return 100 * static_cast<double>(c.fans_parting) / static_cast<double>(c.fans_yes);
}
double face_efficiency(const OracleCount& c) {
  return 100 * static_cast<double>(c.faces_true) / static_cast<double>(c.faces_yes);
}

/// Counts of the oracle's answers from the first fan on. `early`: up to a tenth of the interior
/// faces. `as_paper`: beyond that, until 55 per cent of all fans have parted a component, which is
/// the paper's share. `whole`: up to the last fan.
struct OracleRun {
  std::size_t faces = 0;
  OracleCount early, as_paper, whole;
};

OracleRun run_oracle(VolumeMap map, FaceOrder order, std::uint64_t seed) {
  Components labels = label_components(map);
  ComponentScratch scratch;
  const std::size_t interior = random_faces(map, seed).size();
  OracleRun run;
  random_fans(map, seed, [&](const std::vector<HalfFaceId>& faces) {
    std::vector<HalfFaceId> ordered = faces;
    order_faces(map, order, ordered);
    std::size_t yes = 0, parted = 0;
    for (const HalfFaceId f : ordered) {
      const FaceSplit split = split_face(map, f);
      const ComponentUpdate update =
          update_components(map, std::span(&split, 1), Detection::exact, labels, scratch);
      yes += update.predicted;
      parted += update.created;
    }
    run.faces += faces.size();
    run.whole.add_fan(yes, parted);
    if (10 * run.faces <= interior) {
      run.early = run.as_paper = run.whole;
    } else if (100 * run.as_paper.fans_parting < 55 * run.as_paper.fans) {
      run.as_paper = run.whole;
    }
    return true;
  });
  return run;
}

}  // namespace

std::vector<HalfFaceId> random_faces(const VolumeMap& map, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  return shuffled_interior(map, random);
}

void measure_quiet_fans(VolumeMap map, int cells, std::uint64_t seed, const FigureSink& add) {
  std::mt19937_64 random(seed);
  Components labels = label_components(map);
  ComponentScratch scratch;
  std::vector<double> find, split, components, total, faces, visited;
  const auto inner = [&] { return 2 + static_cast<int>(below(random, cells - 3)); };
  for (int i = 0; i < 200; ++i) {
    const int x = inner(), y = inner(), z = inner();
    const VertexId vertex{suite::grid_point({cells, cells, cells}, x, y, z)};
    const QuietFan fan = quiet_fan(map, vertex, labels, scratch);
    find.push_back(fan.find);
    split.push_back(fan.split);
    components.push_back(fan.components);
    total.push_back(fan.split + fan.components);
    faces.push_back(static_cast<double>(fan.faces));
    visited.push_back(static_cast<double>(fan.visited));
  }
  add("quiet_faces", median(faces));
  add("quiet_visited", median(visited));
  add("quiet_find", median(find));
  add("quiet_split", median(split));
  add("quiet_components", median(components));
  add("quiet_total", median(total));
}

void measure_searches(const VolumeMap& map, int runs, std::uint64_t seed, const FigureSink& add) {
  // Three of the four ways may walk the whole body at a fan.
  const std::size_t most = std::clamp<std::size_t>(24'000'000 / map.tetrahedra(), 1, 400);
  const std::size_t stride = 1 + fans_until_halved(map, seed) / most;
  std::vector<SearchSample> samples;
  for (int run = 0; run < runs; ++run) {
    for (std::size_t way = 0; way < ways.size(); ++way) {
      run_searches(map, seed, way, samples, stride);
    }
  }
  add_searches(false, samples, add);
  add_searches(true, samples, add);
}

void measure_oracle(const VolumeMap& map, std::uint64_t seed, const FigureSink& add) {
  const auto number = [](std::size_t n) { return static_cast<double>(n); };
  add("oracle_betti_1", static_cast<double>((*count_cells(map).betti)[1]));
  for (const FaceOrder order : {FaceOrder::given, FaceOrder::paper}) {
    const OracleRun run = run_oracle(map, order, seed);
    const std::string prefix = order == FaceOrder::given ? "oracle_given_" : "oracle_paper_";
    add(prefix + "fans", number(run.whole.fans));
    add(prefix + "fans_parting", number(run.whole.fans_parting));
    add(prefix + "fans_yes", number(run.whole.fans_yes));
    add(prefix + "fan_efficiency", fan_efficiency(run.whole));
    if (run.early.fans_yes > 0) add(prefix + "fan_efficiency_early", fan_efficiency(run.early));
    if (run.as_paper.fans_yes > 0) add(prefix + "fan_efficiency_55", fan_efficiency(run.as_paper));
    add(prefix + "faces_yes", number(run.whole.faces_yes));
    add(prefix + "faces_false", number(run.whole.faces_yes - run.whole.faces_true));
    add(prefix + "face_efficiency", face_efficiency(run.whole));
    if (run.early.faces_yes > 0) add(prefix + "face_efficiency_early", face_efficiency(run.early));
  }
}

}  // namespace sunder
