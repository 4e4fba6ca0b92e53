// SPDX-License-Identifier: MIT
// Releases of ties in an event log: read back, refused, left.
#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/scene/scene_hash.hpp"
#include "apps/sunder/run/replay.hpp"
#include "tests/support/replay_log.hpp"

namespace fs = std::filesystem;
using namespace sunder;
using namespace sunder::test;
using nlohmann::json;
using nlohmann::ordered_json;

TEST_CASE("releases are held to their places, and to what the replay releases", "[run][replay]") {
  json scene = struck_scene();
  scene["duration"] = 0.001;
  scene["fracture"] = {{"crack", "cohesive"}};
  scene["bodies"][0]["material"]["fracture_energy"] = 3;
  const Place place = place_of(scene);
  REQUIRE(run(place, "a").exit_code == 0);
  const fs::path log = place.path() / "a/events.jsonl", other = place.path() / "other.jsonl";
  std::vector<std::size_t> releases;  // rows
  const std::vector<std::string> good = lines_of(log);
  for (std::size_t k = 1; k < good.size(); ++k) {
    if (json::parse(good[k]).contains("release")) releases.push_back(k);
  }
  REQUIRE(releases.size() > 5);
  CHECK(json::parse(good.back())["releases"] == releases.size());
  const SceneFile file = *read_scene(place.scene);
  const ReplayedScene told{scene_hash(file), step_count(file.scene)};
  using Lines = std::vector<ordered_json>;
  const auto refused = [&](const std::function<void(Lines&)>& change, const std::string& words) {
    forge(log, other, change);
    const Result<Replay> replay = read_replay(other, told);
    REQUIRE(!replay);
    INFO(replay.findings[0].text);
    CHECK(replay.findings[0].code == "bad_event_log");
    CHECK(replay.findings[0].text.find(words) != std::string::npos);
  };
  const std::size_t row = releases[3];
  refused([&](Lines& l) { l.erase(l.begin() + static_cast<std::ptrdiff_t>(row)); },
          "release 3 is due");
  refused([&](Lines& l) { l.back()["releases"] = 1; }, "says releases 1");
  refused([&](Lines& l) { l[row].erase("part"); }, "\"part\"");
  refused([&](Lines& l) { l[row]["step"] = 0; }, "comes before");
  // Faults that no reader can see are found by the replay, with their line.
  forge(log, other, [&](Lines& l) { l[row]["faces"][0]["energy"] = 1; });
  const Outcome o = run(place, "b", "--replay " + other.string());
  INFO(o.text());
  CHECK(o.exit_code == 6);
  CHECK(o.text().find(":" + std::to_string(row + 1)) != std::string::npos);
}
