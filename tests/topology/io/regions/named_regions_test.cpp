// SPDX-License-Identifier: MIT
// Regions that a format knows by words: the words, the numbers they get, the separate list.
#include "topology/io/regions/named_regions.hpp"

#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::io;

TEST_CASE("names become words of letters, digits, _ and -", "[io][named_regions]") {
  RegionNames names;
  names[3] = {{1, "core"},
              {2, "outer shell"},
              {3, "7up"},
              {4, ""},
              {5, "region_9"},
              {6,
               "Stra\xc3\x9f"
               "e"}};
  const RegionNames words = region_words(names);
  CHECK(words[3].at(1) == "core");
  CHECK(words[3].at(2) == "outer_shell");
  CHECK(words[3].at(3) == "name_7up");
  CHECK(words[3].at(4) == "name_");
  CHECK(words[3].at(5) == "name_region_9");
  CHECK(words[3].at(6) == "Stra__e");
  CHECK(word_of_region(words, 3, 2) == "outer_shell");
  CHECK(word_of_region(words, 3, 70) == "region_70");
  CHECK(word_of_region(words, 2, -1) == "region_-1");
}

TEST_CASE("words are distinct whatever the names, and never too long", "[io][named_regions]") {
  RegionNames names;
  names[3] = {{1, "a b"}, {2, "A_B"}, {3, "a_b_2"}, {4, "a-b"}};
  names[1] = {{1, "region"}, {2, "Region"}, {3, "region"}};
  names[2] = {{1, "a_b"}, {2, std::string(200, 'x')}, {3, std::string(300, 'x')}};
  for (int i = 0; i < 3000; ++i) names[0].emplace(i, i % 2 == 0 ? "same" : "same_2");
  std::set<std::string> seen;
  for (const auto& of_dimension : region_words(names)) {
    for (const auto& [region, word] : of_dimension) {
      CHECK(word.size() <= 80);
      CHECK(seen.insert(lower_case(word)).second);
    }
  }
  CHECK(seen.size() == 3010);
  for (const char* number : {"region_2", "region_3"}) CHECK_FALSE(seen.contains(number));
  CHECK(region_words(names)[3].at(2) == "A_B_2");
}

TEST_CASE("words get the smallest free numbers in their order", "[io][named_regions]") {
  WordList list;
  std::vector<std::int32_t> region;
  for (const char* word : {"shell", "region_1", "SHELL", "core", "REGION_-4", "region_07"}) {
    region.push_back(place_of_word(list, word));
  }
  region.push_back(-1);
  place_of_word(list, "region_2");  // no cell has it
  std::map<std::int32_t, std::string> names;
  number_regions(region, list, names);
  CHECK(region == std::vector<std::int32_t>{2, 1, 2, 3, -4, 4, 0});
  CHECK(names == std::map<std::int32_t, std::string>{{2, "shell"}, {3, "core"}, {4, "region_07"}});
  std::vector<std::int32_t> none = {-1, -1};
  number_regions(none, list, names);
  CHECK(none.empty());
}

TEST_CASE("the list beside gives back numbers and names", "[io][named_regions]") {
  const unsigned seed = Catch::rngSeed() != 0 ? Catch::rngSeed() : 20261121;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  constexpr const char* spellings[] = {"a", "a b", "a_b", "A B", "region_3", "", "1", "x y z"};
  for (int round = 0; round < 200; ++round) {
    FileMesh mesh;
    for (std::size_t d = 2; d < 4; ++d) {
      for (std::size_t n = random() % 8; n > 0; --n) {
        mesh.region_name[d][static_cast<std::int32_t>(random() % 12) - 2] =
            spellings[random() % std::size(spellings)];
      }
    }
    const auto random_regions = [&](auto& cells) {
      cells.corners.resize(1 + random() % 12);
      for (std::size_t i = 0; i < cells.corners.size(); ++i) {
        cells.region.push_back(static_cast<std::int32_t>(random() % 14) - 2);
      }
    };
    random_regions(mesh.triangles);
    random_regions(mesh.tetrahedra);
    // The words that a format keeps of it, and the mesh that is read from them.
    FileMesh read = mesh;
    read.region_name = {};
    const RegionNames words = region_words(mesh.region_name);
    for_each_cell_list(read, [&](auto& cells, int dimension) {
      WordList list;
      for (std::int32_t& r : cells.region) {
        r = place_of_word(list, word_of_region(words, dimension, r));
      }
      number_regions(cells.region, list, read.region_name[static_cast<std::size_t>(dimension)]);
    });
    match_names(read, mesh.region_name);
    CHECK(read == mesh);
  }
}

TEST_CASE("words that the list beside does not know keep off its numbers", "[io][named_regions]") {
  FileMesh mesh;
  mesh.tetrahedra.corners.resize(4);
  mesh.tetrahedra.region = {1, 2, 3, 1};
  mesh.region_name[3] = {{1, "new"}, {2, "Old_One"}};
  RegionNames names;
  names[3] = {{1, "old one"}, {9, "unused"}};
  match_names(mesh, names);
  CHECK(mesh.tetrahedra.region == std::vector<std::int32_t>{2, 1, 3, 2});
  CHECK(mesh.region_name[3] ==
        std::map<std::int32_t, std::string>{{1, "old one"}, {2, "new"}, {9, "unused"}});
}
