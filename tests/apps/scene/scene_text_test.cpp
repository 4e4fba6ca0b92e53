// SPDX-License-Identifier: MIT
// JSON with lines, `--set`, nearest words.
#include <catch2/catch.hpp>
#include <string>

#include "apps/scene/scene_text.hpp"

using namespace sunder;
using nlohmann::json;

namespace {

SceneText text_of(const std::string& bytes) {
  Result<SceneText> text = parse_scene_text(bytes, "a.json");
  REQUIRE(text);
  return std::move(*text);
}

}  // namespace

TEST_CASE("keys that are given are listed as --set takes them", "[run][scene]") {
  const auto text = parse_scene_text(R"({"a": {"b": 1, "c": {"d": 2}}, "e": [{"f": 3}]})", "");
  REQUIRE(text);
  CHECK(given_keys(text->root) ==
        std::vector<std::string>{"a", "a.b", "a.c", "a.c.d", "e", "e.0.f"});
}

TEST_CASE("every value knows its line", "[run][scene_text]") {
  const SceneText text = text_of("{\n \"a\": {\n\"b\": [1,\n2\n]},\n\n\"c/d\": 3\n}");
  CHECK(text.root == json({{"a", {{"b", {1, 2}}}}, {"c/d", 3}}));
  CHECK(text.line.at("/a") == 2);
  CHECK(text.line.at("/a/b") == 3);
  CHECK(text.line.at("/a/b/0") == 3);
  CHECK(text.line.at("/a/b/1") == 4);
  CHECK(text.line.at("/c~1d") == 7);
}

TEST_CASE("what is not JSON is told with line and column", "[run][scene_text]") {
  struct Case {
    const char* bytes;
    std::size_t line;
    const char* place;
  };
  for (const Case& c : {Case{"", 1, "line 1, column 1"},
                        {"{\n  \"a\": 1,\n}", 3, "line 3, column 1"},
                        {"{\"a\" 1}", 1, "line 1, column 6"},
                        {"{} x", 1, "line 1, column 4"},
                        {"{\"a\": 1e999}", 1, "line 1"},
                        {"\"\xff\"", 1, "line 1"}}) {
    const Result<SceneText> text = parse_scene_text(c.bytes, "a.json");
    INFO(c.bytes);
    REQUIRE_FALSE(text);
    REQUIRE(text.findings.size() == 1);
    const Finding& f = text.findings[0];
    CAPTURE(f.text);
    CHECK(f.code == "syntax_error");
    CHECK(f.file == "a.json");
    CHECK(f.line == c.line);
    CHECK(f.text.find(c.place) == 0);
  }
}

TEST_CASE("a repeated key is an error, and so is each of them", "[run][scene_text]") {
  const Result<SceneText> text =
      parse_scene_text("{\"a\":1,\n\"a\":2,\"b\":{\"c\":1,\n\"c\":2}}", "");
  REQUIRE_FALSE(text);
  REQUIRE(text.findings.size() == 2);
  CHECK(text.findings[0].code == "repeated_key");
  CHECK(text.findings[0].line == 2);
  CHECK(text.findings[1].line == 3);
}

TEST_CASE("brackets without end are refused, not followed", "[run][scene_text]") {
  const Result<SceneText> text = parse_scene_text(std::string(1000000, '['), "");
  REQUIRE_FALSE(text);
  CHECK(text.findings[0].code == "nested_too_deeply");
}

TEST_CASE("a setting changes one value, as JSON or else as text", "[run][scene_text]") {
  SceneText text = text_of("{\"bodies\": [{\"a\": 1}, {\"a\": 2}]}");
  CHECK(apply_setting(text, "bodies.1.a=2.5e6").empty());
  CHECK(apply_setting(text, "bodies.0.b=[1, 2]").empty());
  CHECK(apply_setting(text, "gravity.ramp_time=2").empty());
  CHECK(apply_setting(text, "name=a=b").empty());
  CHECK(apply_setting(text, "on=true").empty());
  CHECK(text.root == json::parse(R"({"bodies": [{"a": 1, "b": [1, 2]}, {"a": 2.5e6}],
                                     "gravity": {"ramp_time": 2}, "name": "a=b", "on": true})"));
  // A value that a setting added stands in no line of the file.
  CHECK(text.line.count("/bodies/1/a") == 0);
  CHECK(text.line.count("/bodies/0/a") == 1);
}

TEST_CASE("a setting that fits nowhere is told", "[run][scene_text]") {
  SceneText text = text_of("{\"bodies\": [{}], \"time_step\": 1}");
  const json before = text.root;
  std::string deep = "a";
  for (int i = 0; i < 100; ++i) deep += ".a";
  for (const std::string& setting :
       {std::string("time_step"), std::string("=1"), std::string("bodies.1.a=1"),
        std::string("bodies.x.a=1"), std::string("time_step.a=1"), deep + "=1"}) {
    INFO(setting);
    const std::vector<Finding> findings = apply_setting(text, setting);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].code == "bad_setting");
    CHECK_FALSE(findings[0].remedy.empty());
  }
  CHECK(text.root == before);
}

TEST_CASE("the nearest word has the least edits, and none is said where all differ",
          "[run][scene_text]") {
  const std::vector<std::string> known = {"density", "young_modulus", "poisson_ratio"};
  CHECK(nearest_word("youngs_modulus", known) == "young_modulus");
  CHECK(nearest_word("densty", known) == "density");
  CHECK(nearest_word("colour", known).empty());
  CHECK(nearest_word("rnu", {"cut", "run"}) == "run");
  CHECK(nearest_word("x", {}).empty());
}
