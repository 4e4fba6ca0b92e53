// SPDX-License-Identifier: MIT
// Labels of components after random changes of random bodies, compared with a twin that floods the
// body again and gives ids by the rule alone.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "tests/support/random_meshes.hpp"
#include "topology/kernel/components.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/mesh/build_map.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

constexpr std::array ways = {Detection::walk, Detection::dirty_counter, Detection::oracle,
                             Detection::exact};

/// Tetrahedra that hang together, each set by its lowest.
std::vector<std::size_t> flooded(const VolumeMap& map) {
  std::vector<std::size_t> low(map.tetrahedra());
  for (std::size_t t = 0; t < low.size(); ++t) low[t] = t;
  for (bool changes = true; changes;) {
    changes = false;
    for (std::size_t f = 0; f < 4 * low.size(); ++f) {
      const HalfFaceId across = map.neighbour(HalfFaceId{f});
      if (across.is_none() || low[across.index() / 4] >= low[f / 4]) continue;
      low[f / 4] = low[across.index() / 4];
      changes = true;
    }
  }
  return low;
}

/// Labels as `Components` promises them.
struct Twin {
  std::vector<std::size_t> label, size;
  std::vector<std::optional<std::size_t>> parent;

  explicit Twin(const VolumeMap& map) {
    std::map<std::size_t, std::size_t> id;
    for (const std::size_t low : flooded(map)) {
      const auto [at, is_new] = id.emplace(low, size.size());
      if (is_new) size.push_back(0), parent.emplace_back();
      ++size[at->second];
      label.push_back(at->second);
    }
  }

  /// After a change: of each component the largest part keeps the id, of equals the first; the
  /// others get new ones in the order of their lowest tetrahedra. Gives how many are new.
  std::size_t follow(const VolumeMap& map) {
    const std::vector<std::size_t> low = flooded(map);
    std::map<std::size_t, std::map<std::size_t, std::vector<std::size_t>>> parts;
    for (std::size_t t = 0; t < low.size(); ++t) parts[label[t]][low[t]].push_back(t);
    const std::size_t before = size.size();
    for (const auto& [old, own] : parts) {
      std::size_t largest = own.begin()->first;
      for (const auto& [first, rows] : own) {
        if (rows.size() > own.at(largest).size()) largest = first;
      }
      for (const auto& [first, rows] : own) {
        if (first == largest) continue;
        for (const std::size_t t : rows) label[t] = size.size();
        size[old] -= rows.size();
        size.push_back(rows.size());
        parent.emplace_back(old);
      }
    }
    return size.size() - before;
  }
};

/// How many tetrahedra the search of an update has to look at; `label`: the components before it.
/// In each component, parts grow from both sides of its suspect faces, in the order of their
/// tetrahedra. They grow by one tetrahedron each in turn, until at most one part grows (exact) or
/// none. That one grows to its end if the rest that no part closed may not be the largest.
std::size_t looked_at(const VolumeMap& map, std::span<const FaceSplit> splits, Detection way,
                      const std::vector<std::size_t>& label) {
  std::map<std::size_t, std::set<std::size_t>> sources;
  std::map<std::size_t, int> parted;
  for (const FaceSplit& split : splits) {
    if (!split.did || (asks_oracle(way) && split.vertex_count < 3)) continue;
    const std::size_t a = split.face.index() / 4, b = split.opposite.index() / 4;
    sources[label[a]].insert({a, b});
    parted[label[a]] += split.vertex_count;
  }
  struct Part {
    std::vector<std::size_t> todo;
    std::size_t looked = 0, found = 1;
    bool grows = true, is_closed = false;
  };
  std::size_t visited = 0;
  for (const auto& [component, begins] : sources) {
    if (way == Detection::dirty_counter && parted[component] < 3) continue;
    std::vector<Part> parts;
    std::map<std::size_t, std::size_t> owner;
    for (const std::size_t t : begins) {
      owner[t] = parts.size();
      parts.emplace_back().todo = {t};
    }
    const auto growing = [&] { return std::ranges::count(parts, true, &Part::grows); };
    const auto step = [&](std::size_t i) {
      Part& part = parts[i];
      if (part.looked == part.todo.size()) {
        part.grows = false, part.is_closed = true;
        return;
      }
      const std::size_t t = part.todo[part.looked++];
      for (std::size_t f = 4 * t; f < 4 * t + 4; ++f) {
        const HalfFaceId across = map.neighbour(HalfFaceId{f});
        if (across.is_none()) continue;
        const auto [at, is_new] = owner.emplace(across.index() / 4, i);
        if (is_new) part.todo.push_back(at->first), ++part.found;
        if (at->second == i) continue;
        Part& joins = parts[at->second];
        for (std::size_t k = joins.looked; k < joins.todo.size(); ++k)
          part.todo.push_back(joins.todo[k]);
        part.found += joins.found;
        joins.grows = false;
        for (const std::size_t gone = at->second; auto& [tetrahedron, of] : owner) {
          if (of == gone) of = i;
        }
      }
    };
    const auto run = [&](std::ptrdiff_t enough) {
      while (growing() > enough) {
        for (std::size_t i = 0; i < parts.size(); ++i) {
          if (parts[i].grows && growing() > enough) step(i);
        }
      }
    };
    run(way == Detection::exact ? 1 : 0);
    auto rest = static_cast<std::size_t>(std::ranges::count(label, component));
    for (const Part& p : parts) rest -= p.is_closed ? p.found : 0;
    const auto may_be_largest = [&](const Part& p) { return p.is_closed && p.found >= rest; };
    if (std::ranges::any_of(parts, may_be_largest)) run(0);
    visited += owner.size();
  }
  return visited;
}

void require_same(const VolumeMap& map, const Components& labels, const Twin& twin) {
  REQUIRE(labels.size == twin.size);
  REQUIRE(labels.parent.size() == twin.parent.size());
  for (std::size_t id = 0; id < twin.parent.size(); ++id) {
    const auto& parent = twin.parent[id];
    REQUIRE(labels.parent[id] == (parent ? ComponentId{*parent} : ComponentId::none()));
  }
  REQUIRE(labels.of_tetrahedron.size() == twin.label.size());
  std::map<VertexId, std::size_t> at;
  for (std::size_t t = 0; t < twin.label.size(); ++t) {
    REQUIRE(labels.of_tetrahedron[t] == ComponentId{twin.label[t]});
    for (const VertexId v : map.corners(TetId{t})) at[v] = twin.label[t];
  }
  REQUIRE(labels.of_vertex.size() == map.vertices());
  for (const auto& [v, id] : at) REQUIRE(labels.of_vertex[v.index()] == ComponentId{id});
}

/// A few faces, a fan or a section.
std::vector<HalfFaceId> some_faces(const VolumeMap& map, Random& random) {
  Point normal{2 * unit(random) - 1, 2 * unit(random) - 1, 2 * unit(random) - 1};
  const std::size_t which = below(random, 4);
  if (which == 0) return *plane_faces(map, {normal, 2 * unit(random) - 0.5});
  std::vector<HalfFaceId> faces;
  if (which == 1) {
    const auto fan = fan_faces(map, VertexId{below(random, map.vertices())}, normal);
    if (fan) faces = *fan;
    return faces;
  }
  const std::size_t all = 4 * map.tetrahedra();
  for (std::size_t i = 1 + below(random, which == 2 ? 3 : all); i > 0; --i) {
    faces.emplace_back(below(random, all));
  }
  return faces;
}

}  // namespace

TEST_CASE("components are labelled by the rule, whatever comes apart at once and in whatever order",
          "[topology][components]") {
  const std::uint64_t seed = 20261125;
  INFO("seed " << seed);
  Random random(seed);
  std::size_t separations = 0;
  std::array<ComponentScratch, 4> scratch;  // one for bodies of all sizes
  for (int round = 0; round < 60; ++round) {
    INFO("round " << round);
    const TetMesh mesh = body(random);
    if (mesh.tetrahedra.empty() || mesh.tetrahedra.size() > 400) continue;
    auto map = build_map(mesh, Severity::warning, MapKernel::dense);
    if (!map) continue;
    Twin twin(*map);
    std::array<Components, 4> labels;
    for (Components& l : labels) l = label_components(*map);
    require_same(*map, labels[0], twin);
    for (int step = 0; step < 5; ++step) {
      std::vector<FaceSplit> splits;
      std::size_t predicted = 0;
      for (const HalfFaceId f : some_faces(*map, random)) {
        splits.push_back(split_face(*map, f));
        predicted += splits.back().did && splits.back().vertex_count == 3 ? 1 : 0;
      }
      const ComponentId first_new{twin.size.size()};
      const std::vector<std::size_t> label = twin.label;
      const std::size_t created = twin.follow(*map);
      separations += created;
      for (std::size_t i = 0; i < ways.size(); ++i) {
        const ComponentUpdate update =
            update_components(*map, splits, ways[i], labels[i], scratch[i]);
        CHECK(update.created == created);
        CHECK(update.first_new == first_new);
        CHECK(update.predicted == predicted);
        CHECK(update.visited == looked_at(*map, splits, ways[i], label));
        require_same(*map, labels[i], twin);
      }
    }
  }
  CHECK(separations > 1000);
}

TEST_CASE("a row cut at two places is searched until at most one part may be the largest",
          "[topology][components]") {
  // The part between the cuts grows from both of its ends, and closes while the last is half met.
  for (std::uint32_t i = 3; i < 20; ++i) {
    for (std::uint32_t j = i + 1; j < 20; ++j) {
      INFO("cut at points " << i << " and " << j);
      auto map = build_map(suite::open_fan(18), Severity::warning, MapKernel::dense);
      REQUIRE(map);
      Twin twin(*map);
      Components labels = label_components(*map);
      ComponentScratch scratch;
      const std::vector<std::array<std::uint32_t, 3>> cuts = {{0, 1, i}, {0, 1, j}};
      std::vector<FaceSplit> splits;
      for (const HalfFaceId f : find_faces(*map, std::span(cuts))) {
        splits.push_back(split_face(*map, f));
      }
      const std::vector<std::size_t> label = twin.label;
      CHECK(twin.follow(*map) == 2);
      const ComponentUpdate update =
          update_components(*map, splits, Detection::exact, labels, scratch);
      CHECK(update.visited == looked_at(*map, splits, Detection::exact, label));
      require_same(*map, labels, twin);
    }
  }
}
