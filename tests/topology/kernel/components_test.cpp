// SPDX-License-Identifier: MIT
// Components: ids, which part keeps one, and four ways to find separations that agree.
#include <map>
#include <random>

#include "tests/support/built.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// From the one that visits most to the one that visits least.
constexpr std::array<Detection, 4> all_ways = {Detection::walk, Detection::dirty_counter,
                                               Detection::oracle, Detection::exact};

/// The splits of a plane's section, in order.
std::vector<FaceSplit> cut_plane(VolumeMap& map, const CuttingPlane& plane) {
  const Result<std::vector<HalfFaceId>> faces = plane_faces(map, plane);
  REQUIRE(faces);
  std::vector<FaceSplit> splits;
  for (const HalfFaceId f : *faces) splits.push_back(split_face(map, f));
  return splits;
}

/// Labels are a partition into the true components, with right sizes.
void require_true(const VolumeMap& map, const Components& labels) {
  const Components walked = label_components(map);
  std::map<ComponentId, ComponentId> match;
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
    const auto [it, fresh] = match.emplace(walked.of_tetrahedron[t], labels.of_tetrahedron[t]);
    REQUIRE(it->second == labels.of_tetrahedron[t]);
    for (const VertexId v : map.corners(TetId{t})) {
      REQUIRE(labels.of_vertex[v.index()] == labels.of_tetrahedron[t]);
    }
  }
  std::size_t members = 0;
  for (const auto& [a, b] : match) {
    REQUIRE(walked.size[a.index()] == labels.size[b.index()]);
    members += labels.size[b.index()];
  }
  REQUIRE(members == map.tetrahedra());  // so no two share an id
}

bool same(const Components& a, const Components& b) {
  return a.of_tetrahedron == b.of_tetrahedron && a.of_vertex == b.of_vertex && a.size == b.size &&
         a.parent == b.parent;
}

}  // namespace

TEST_CASE("the first labels follow the lowest tetrahedra", "[topology][components]") {
  const VolumeMap map =
      built(side_by_side(one_tetrahedron(), side_by_side(two_tetrahedra(), one_tetrahedron())));
  const Components labels = label_components(map);
  CHECK(labels.of_tetrahedron ==
        std::vector<ComponentId>{ComponentId{0}, ComponentId{1}, ComponentId{1}, ComponentId{2}});
  CHECK(labels.size == std::vector<std::size_t>{1, 2, 1});
  CHECK(labels.parent == std::vector<ComponentId>(3));
}

TEST_CASE("the largest part keeps the id, and on a tie the one with the lowest tetrahedron",
          "[topology][components]") {
  for (const Detection detection : all_ways) {
    for (const double at : {1.5, 2.5, 2.0, 3.1}) {
      INFO("cut at " << at);
      VolumeMap map = built(kuhn_box({4, 1, 1}));
      Components labels = label_components(map);
      ComponentScratch scratch;
      const auto splits = cut_plane(map, {{1, 0, 0}, at});
      const auto update = update_components(map, splits, detection, labels, scratch);
      CHECK(update.created == 1);
      CHECK(update.first_new == ComponentId{1});
      require_true(map, labels);
      CHECK(labels.parent[1] == ComponentId{0});
      const bool tie = labels.size[0] == labels.size[1];
      CHECK(labels.size[0] >= labels.size[1]);
      CHECK(tie == (at == 2.0));
      if (tie) CHECK(labels.of_tetrahedron[0] == ComponentId{0});
    }
  }
}

TEST_CASE("parts of one change get ids in the order of their lowest tetrahedra",
          "[topology][components]") {
  VolumeMap map = built(kuhn_box({7, 1, 1}));
  Components labels = label_components(map);
  ComponentScratch scratch;
  std::vector<FaceSplit> splits;
  for (const double at : {6.0, 1.0, 2.0}) {
    for (const FaceSplit& s : cut_plane(map, {{1, 0, 0}, at})) splits.push_back(s);
  }
  const auto update = update_components(map, splits, Detection::exact, labels, scratch);
  CHECK(update.created == 3);
  require_true(map, labels);
  // Pieces of 1, 1, 4 and 1 cubes along x: the third keeps id 0.
  const auto cube = [&labels](std::size_t i) { return labels.of_tetrahedron[6 * i]; };
  CHECK(cube(0) == ComponentId{1});
  CHECK(cube(1) == ComponentId{2});
  CHECK(cube(3) == ComponentId{0});
  CHECK(cube(6) == ComponentId{3});
}

TEST_CASE("fixture 24: a ring cut at both ends in one step is labelled exactly once",
          "[topology][components][fixture]") {
  for (const Detection detection : all_ways) {
    VolumeMap map = built(ring({5, 5, 2}));
    Components labels = label_components(map);
    ComponentScratch scratch;
    const auto splits = cut_plane(map, {{0, 1, 0}, 2.5});
    const auto update = update_components(map, splits, detection, labels, scratch);
    CHECK(update.created == 1);
    CHECK(labels.size.size() == 2);
    require_true(map, labels);
  }
}

TEST_CASE("several bodies can come apart in one update", "[topology][components]") {
  VolumeMap map =
      built(side_by_side(kuhn_box({3, 1, 1}), side_by_side(kuhn_box({3, 1, 1}), ring({3, 3, 1}))));
  Components labels = label_components(map);
  ComponentScratch scratch;
  // The ring's section only opens it; both bars lose their last cube.
  std::vector<FaceSplit> splits;
  for (const double at : {2.0, 6.0, 9.5}) {
    for (const FaceSplit& s : cut_plane(map, {{1, 0, 0}, at})) splits.push_back(s);
  }
  const auto update = update_components(map, splits, Detection::exact, labels, scratch);
  require_true(map, labels);
  CHECK(update.created == count_cells(map).components - 3);
  CHECK(labels.parent[3] == ComponentId{0});
  CHECK(labels.parent[4] == ComponentId{1});
}

TEST_CASE("all four ways give the same labels, after every face, fan or batch",
          "[topology][components]") {
  const std::uint64_t seed = 21;
  INFO("seed " << seed);
  for (const std::size_t batch : {1U, 7U, 40U}) {
    std::mt19937_64 random(seed);
    for (const NamedMesh& shape : all_shapes()) {
      INFO(shape.name << ", " << batch << " at a time");
      VolumeMap map = built(shape.mesh);
      const Components whole = label_components(map);
      std::array<Components, 4> labels = {whole, whole, whole, whole};
      std::array<ComponentScratch, 4> scratch;
      std::vector<HalfFaceId> faces = interior_faces(map);
      std::array<std::size_t, 4> visited = {0, 0, 0, 0};
      while (!faces.empty()) {
        std::vector<FaceSplit> splits;
        while (!faces.empty() && splits.size() < batch) {
          std::swap(faces[below(random, faces.size())], faces.back());
          splits.push_back(split_face(map, faces.back()));
          faces.pop_back();
        }
        for (std::size_t i = 0; i < all_ways.size(); ++i) {
          visited[i] += update_components(map, splits, all_ways[i], labels[i], scratch[i]).visited;
          REQUIRE(same(labels[0], labels[i]));
        }
        require_true(map, labels[3]);
      }
      for (std::size_t i = 1; i < visited.size(); ++i) CHECK(visited[i] <= visited[i - 1]);
    }
  }
}

TEST_CASE("a small piece costs the small piece to find", "[topology][components]") {
  VolumeMap map = built(kuhn_box({40, 2, 2}));
  Components labels = label_components(map);
  ComponentScratch scratch;
  const auto splits = cut_plane(map, {{1, 0, 0}, 1.0});
  const auto update = update_components(map, splits, Detection::exact, labels, scratch);
  CHECK(update.created == 1);
  CHECK(labels.size[1] == 24);
  // Both fronts advance alike until the small one is done: twice its size, and the fronts' width.
  CHECK(update.visited <= 4 * labels.size[1]);
  require_true(map, labels);
}

TEST_CASE("the dirty counter walks when three vertices came apart, at whichever faces",
          "[topology][components]") {
  // Fixture 9, figure 5: in the order c, b, a every face parts one vertex and the oracle says no;
  // the fan has parted three.
  VolumeMap map = built(kuhn_box({2, 2, 2}));
  const Components whole = label_components(map);
  std::vector<FaceSplit> fan;
  for (const std::array<std::uint32_t, 3>& f :
       {std::array<std::uint32_t, 3>{4, 7, 17}, {4, 14, 17}, {1, 4, 14}}) {
    fan.push_back(split_on(map, f));
    CHECK(split_count(fan.back()) == SplitCount{1, 2});
  }
  const auto visited = [&](std::size_t faces, Detection detection) {
    Components labels = whole;
    ComponentScratch scratch;
    const auto update =
        update_components(map, std::span(fan).first(faces), detection, labels, scratch);
    CHECK(update.created == 0);
    return update.visited;
  };
  CHECK(visited(2, Detection::dirty_counter) == 0);
  CHECK(visited(3, Detection::dirty_counter) == map.tetrahedra());
  CHECK(visited(3, Detection::oracle) == 0);
  CHECK(visited(1, Detection::walk) == map.tetrahedra());
}

TEST_CASE("a body that the dirty counter passes over does not hide the next",
          "[topology][components]") {
  // Two boxes: of the first one face opens, the second falls in two.
  VolumeMap map = built(kuhn_box({4, 2, 2}));
  Components labels = label_components(map);
  ComponentScratch scratch;
  update_components(map, cut_plane(map, {{1, 0, 0}, 2.0}), Detection::exact, labels, scratch);
  REQUIRE(labels.size.size() == 2);
  const auto lies_in = [&](const FaceSplit& s, std::size_t body) {
    return labels.of_tetrahedron[tetrahedron_of(s.face).index()] == ComponentId{body};
  };
  std::vector<FaceSplit> splits = {split_face(map, (*plane_faces(map, {{1, 0, 0}, 1.0}))[0])};
  for (const FaceSplit& s : cut_plane(map, {{1, 0, 0}, 3.0})) splits.push_back(s);
  REQUIRE((lies_in(splits.front(), 0) && lies_in(splits.back(), 1)));
  CHECK(update_components(map, splits, Detection::dirty_counter, labels, scratch).created == 1);
  require_true(map, labels);
}

TEST_CASE("an update visits as many tetrahedra in whatever order its faces were split",
          "[topology][components]") {
  VolumeMap map = built(kuhn_box({5, 4, 3}));
  const Components whole = label_components(map);
  std::vector<FaceSplit> splits = cut_plane(map, {{1, 0, 0}, 2.0});
  for (const FaceSplit& s : cut_plane(map, {{0, 1, 0}, 1.0})) splits.push_back(s);
  std::mt19937 random(5);
  const auto visited = [&](std::span<const FaceSplit> given) {
    Components labels = whole;
    ComponentScratch scratch;
    return update_components(map, given, Detection::exact, labels, scratch).visited;
  };
  // A few faces of a crack that does not close, and all.
  for (const std::size_t count : {std::size_t{6}, splits.size()}) {
    std::vector<FaceSplit> some(splits.begin(),
                                splits.begin() + static_cast<std::ptrdiff_t>(count));
    const std::size_t expected = visited(some);
    for (int order = 0; order < 20; ++order) {
      std::ranges::shuffle(some, random);
      CHECK(visited(some) == expected);
    }
  }
}

TEST_CASE("a part that closes first is not therefore the smaller one", "[topology][components]") {
  // Many sources grow the large part at once, one source the small part: the large one may close
  // while the small one still grows, and must keep the id all the same.
  VolumeMap map = built(kuhn_box({6, 4, 4}));
  Components labels = label_components(map);
  ComponentScratch scratch;
  std::vector<FaceSplit> splits;
  for (const double at : {4.0, 4.5}) {
    for (const FaceSplit& s : cut_plane(map, {{1, 0, 0}, at})) splits.push_back(s);
  }
  update_components(map, splits, Detection::exact, labels, scratch);
  require_true(map, labels);
  CHECK(*std::max_element(labels.size.begin(), labels.size.end()) == labels.size[0]);
}

TEST_CASE("nothing to do is done quickly", "[topology][components]") {
  VolumeMap map = built(kuhn_box({2, 2, 2}));
  Components labels = label_components(map);
  const Components before = labels;
  ComponentScratch scratch;
  const auto update = update_components(map, {}, Detection::exact, labels, scratch);
  CHECK(update.visited == 0);
  CHECK(update.created == 0);
  CHECK(same(labels, before));
  const FaceSplit refused = split_face(map, HalfFaceId{[&map] {
                                         std::size_t i = 0;
                                         while (!map.neighbour(HalfFaceId{i}).is_none()) ++i;
                                         return i;
                                       }()});
  CHECK(update_components(map, std::span(&refused, 1), Detection::walk, labels, scratch).visited ==
        0);
}

TEST_CASE("one scratch serves maps of different sizes in turn", "[topology][components]") {
  ComponentScratch scratch;
  for (const int n : {4, 2, 6, 2}) {
    VolumeMap map = built(kuhn_box({n, 1, 1}));
    Components labels = label_components(map);
    const auto splits = cut_plane(map, {{1, 0, 0}, 1.0});
    update_components(map, splits, Detection::exact, labels, scratch);
    require_true(map, labels);
  }
}

TEST_CASE("marks of searches begin anew when their numbers come to an end",
          "[topology][components]") {
  VolumeMap map = built(kuhn_box({3, 1, 1}));
  Components labels = label_components(map);
  ComponentScratch scratch;
  const auto first = cut_plane(map, {{1, 0, 0}, 1.0});
  update_components(map, first, Detection::exact, labels, scratch);
  std::ranges::fill(scratch.stamp, 0U);  // as if none had been met for 2^32 searches
  scratch.now = ~0U;
  const auto second = cut_plane(map, {{1, 0, 0}, 2.0});
  CHECK(update_components(map, second, Detection::exact, labels, scratch).created == 1);
  require_true(map, labels);
}

TEST_CASE("two ways of four ask the oracle, and an update tells its first new id",
          "[topology][components]") {
  CHECK_FALSE(asks_oracle(Detection::walk));
  CHECK_FALSE(asks_oracle(Detection::dirty_counter));
  CHECK(asks_oracle(Detection::oracle));
  CHECK(asks_oracle(Detection::exact));
  VolumeMap map = built(kuhn_box({3, 1, 1}));
  Components labels = label_components(map);
  ComponentScratch scratch;
  for (const std::size_t at : {1, 2}) {
    const auto splits = cut_plane(map, {{1, 0, 0}, static_cast<double>(at)});
    const auto update = update_components(map, splits, Detection::exact, labels, scratch);
    CHECK(update.first_new == ComponentId{at});
    CHECK(update.created == 1);
  }
}

TEST_CASE("after the first updates the working memory does not grow", "[topology][components]") {
  VolumeMap map = built(kuhn_box({12, 2, 2}));
  Components labels = label_components(map);
  ComponentScratch scratch;
  const auto capacities = [&scratch] {
    return std::array<std::size_t, 7>{scratch.stamp.capacity(),  scratch.owner.capacity(),
                                      scratch.next.capacity(),   scratch.parts.capacity(),
                                      scratch.live.capacity(),   scratch.closed.capacity(),
                                      scratch.sources.capacity()};
  };
  const auto warm_up = cut_plane(map, {{1, 0, 0}, 6.0});
  update_components(map, warm_up, Detection::walk, labels, scratch);
  const auto held = capacities();
  for (int at = 1; at < 12; ++at) {
    const auto splits = cut_plane(map, {{1, 0, 0}, static_cast<double>(at)});
    update_components(map, splits, Detection::exact, labels, scratch);
    CHECK(capacities() == held);
  }
}
