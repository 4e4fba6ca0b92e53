// SPDX-License-Identifier: MIT
// Fixture files: reading, refusals and their places, and writing.
#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "topology/suite/fixtures/fixture.hpp"
#include "topology/suite/fixtures/fixture_json_write.hpp"
#include "topology/suite/judge/judge_truth.hpp"

using namespace sunder;
using namespace sunder::suite;
using nlohmann::json;

namespace {

const std::filesystem::path data = SUNDER_SUITE_DATA;

std::vector<Fixture> good() {
  Result<std::vector<Fixture>> fixtures = read_fixtures(data / "good" / "small.json");
  for (const Finding& f : fixtures.findings) UNSCOPED_INFO(f.text);
  REQUIRE(fixtures);
  return std::move(*fixtures);
}

/// The same as a document that can stand anywhere.
json good_json() {
  std::ifstream in(data / "good" / "small.json");
  json document = json::parse(in);
  document["cases"][4]["body"]["mesh"] = (data / "../../../../meshes/two_tets.msh").string();
  return document;
}

/// A file in a folder of its own, gone at the end.
struct FileOfOwn {
  std::filesystem::path folder, path;
  explicit FileOfOwn(const std::string& bytes) {
    std::string name = (std::filesystem::temp_directory_path() / "sunder-suite-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    folder = name;
    path = folder / "some.json";
    std::ofstream(path, std::ios::binary) << bytes;
  }
  ~FileOfOwn() { std::filesystem::remove_all(folder); }
  FileOfOwn(const FileOfOwn&) = delete;
  FileOfOwn& operator=(const FileOfOwn&) = delete;
};

/// The findings about a document; all must name it, or the mesh it names.
std::vector<std::string> complaints(const std::string& bytes) {
  const FileOfOwn file(bytes);
  const Result<std::vector<Fixture>> fixtures = read_fixtures(file.path);
  CHECK(fixtures.value.has_value() == fixtures.findings.empty());
  std::vector<std::string> texts;
  for (const Finding& f : fixtures.findings) {
    CHECK(f.severity == Severity::error);
    CHECK((f.file.find("some.json") != std::string::npos || f.code == "cannot_open"));
    CHECK_FALSE(f.remedy.empty());
    texts.push_back(f.text);
  }
  return texts;
}

bool has(const std::vector<std::string>& texts, const std::string& part) {
  for (const std::string& text : texts) {
    UNSCOPED_INFO(text);
    if (text.find(part) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a fixture file gives its cases with bodies, operations and expectations",
          "[suite][fixture]") {
  const std::vector<Fixture> fixtures = good();
  REQUIRE(fixtures.size() == 9);
  const Fixture& two = fixtures[0];
  CHECK(two.name == "small/two-tetrahedra");
  CHECK(two.shows == "one face, cut, glued, cut again");
  CHECK(two.source == "tests/suite");
  CHECK(two.body.points.size() == 5);
  CHECK(two.body.tetrahedra[1] == std::array<std::uint32_t, 4>{1, 0, 2, 4});
  CHECK(two.file_cells == std::array<std::size_t, 3>{5, 9, 7});
  CHECK(two.built.counts->boundary_faces == 6);
  CHECK(two.built.euler_characteristic == 1);
  CHECK(two.built.betti_mod.at(3) == BettiNumbers{1, 0, 0, 0});
  CHECK(two.built.homology->torsion[1].empty());
  CHECK(two.built.orientable == true);
  REQUIRE(two.operations.size() == 7);
  const Expected& after = two.operations[0].after;
  CHECK(after.splits->front().edges.size() == 3);
  CHECK(after.tally->at({3, 3}) == 1);
  CHECK(std::get<FaceSide>(std::get<SplitFace>(two.operations[1].operation).face) ==
        FaceSide{1, 4});
  CHECK_FALSE(two.operations[1].after.splits->front().did);
  CHECK(std::get<std::array<FaceSide, 2>>(
            std::get<GlueFace>(two.operations[4].operation).face)[1] == FaceSide{0, 3});
  CHECK(std::get<Shatter>(two.operations[5].operation).order == Shatter::Order::falling);
  CHECK(std::get<Shatter>(two.operations[6].operation).seed == 7);

  CHECK(fixtures[1].shows == "every kind of body, operation and expectation");
  CHECK(fixtures[1].body.tetrahedra.size() == 48);
  CHECK(fixtures[1].operations[1].after.homology->betti == BettiNumbers{1, 1, 0, 0});
  const auto& fan = std::get<SplitFan>(fixtures[1].operations[5].operation);
  CHECK(std::get<CornerAt>(fan.vertex) == CornerAt{0, 0});
  CHECK(std::get<SplitPlane>(fixtures[1].operations[6 + 0].operation).plane.offset == -2);
  CHECK(fixtures[2].findings == std::vector<std::string>{"pinched_vertex"});
  CHECK(fixtures[3].refused);
  CHECK(std::isnan(fixtures[3].body.points[2][1]));
  CHECK(fixtures[4].body.tetrahedra.size() == 2);
  CHECK(fixtures[5].known_differences[0].counts->edges == 12);
  using enum CrackSide;
  REQUIRE(fixtures[6].cracks.size() == 2);
  CHECK(fixtures[6].cracks[0] ==
        CrackSides{positive, negative, positive, negative, none, negative});
  CHECK(std::get<BreakPoint>(fixtures[6].operations[1].operation).sides == fixtures[6].cracks[1]);
  CHECK(fixtures[7].body.tetrahedra[63] == std::array<std::uint32_t, 4>{0, 1, 65, 2});
  CHECK(fixtures[7].body.points[2 + 17] == Point{-1, 15, 0});
  CHECK(fixtures[8].body.points.size() == 39);
  CHECK(fixtures[8].body.tetrahedra[71] == std::array<std::uint32_t, 4>{0, 1, 3, 38});
  CHECK(fixtures[8].body.points[2] == Point{0, 0, 9});
}

TEST_CASE("a wrong value is refused with its place and what was expected", "[suite][fixture]") {
  struct Wrong {
    const char* at;
    json value;
    const char* said;
  };
  const std::vector<Wrong> wrong = {
      {"/name", 3, "/name is 3; a text was expected"},
      {"/name", "../up", "a name of letters"},
      {"/extra", 1, "/extra is not a known key; known here: name, shows, source, cases, $schema"},
      {"/cases", json::array(), "/cases is an array of 0; an array of at least one case"},
      {"/cases/0", "case", "/cases/0 is \"case\"; an object was expected"},
      {"/cases/1/name", "two-tetrahedra", "/cases/1 has the name of an earlier case"},
      {"/cases/0/body/points/3", json::array({1, 2}),
       "/cases/0/body/points/3 is an array of 2; an array of 3 was expected"},
      {"/cases/0/body/points/3/1", "x", "/cases/0/body/points/3/1 is \"x\"; a number was expected"},
      {"/cases/0/body/tetrahedra/1/0", -1, "is -1; a row counted from 0 was expected"},
      {"/cases/0/body/tetrahedra/1/0", 4294967296, "is 4294967296; a row counted from 0"},
      {"/cases/0/body/tetrahedra/1/0", 1.5, "is 1.5; a row counted from 0"},
      {"/cases/0/body/regions", 1, "/cases/0/body/regions is not a known key"},
      {"/cases/1/body/kuhn_box", json::array({0, 1, 1}), "three numbers of cells from 1 to 200"},
      {"/cases/7/body/edge_ring", 66, "edge_ring is 66; a multiple of 4 up to 1000000"},
      {"/cases/7/body/edge_ring", 0, "edge_ring is 0; a multiple of 4 up to 1000000"},
      {"/cases/8/body/vertex_star", 68, "vertex_star is 68; a multiple of 8 up to 1000000"},
      {"/cases/8/body/vertex_star", 1000008, "is 1000008; a multiple of 8 up to 1000000"},
      {"/cases/8/body/edge_ring", 64, "/cases/8/body/vertex_star is not a known key"},
      {"/cases/4/body/mesh", "nothing.msh", "/cases/4/body/mesh names a mesh that cannot be read"},
      {"/cases/0/findings/0", 1, "/cases/0/findings/0 is 1; a text"},
      {"/cases/0/refused", 1, "/cases/0/refused is 1; true or false"},
      {"/cases/0/refused", true, "/cases/0/operations stands there though the body is refused"},
      {"/cases/3/built", json::object(), "/cases/3/built stands there though the body is refused"},
      {"/cases/0/built/counts/cells", 1, "/cases/0/built/counts/cells is not a known key"},
      {"/cases/0/built/betti/Z", json::array({1, 0, 0, 0}), "betti/Z is not a field GF(p)"},
      {"/cases/0/built/betti/GF(4)", json::array({1, 0, 0, 0}), "GF(4) is not a field"},
      {"/cases/0/built/homology/torsion/1", 2, "/torsion/1 is 2; an array was expected"},
      {"/cases/0/built/orientable", "yes", "true or false was expected"},
      {"/cases/0/operations/0/split", json::array({0, 3, 4}), "split is no face of the body"},
      {"/cases/0/operations/0/split", json::array({0, 1, 1}), "split is no face of the body"},
      {"/cases/0/operations/0/glue", json::array({0, 1, 2}), "is not exactly one of split, glue"},
      {"/cases/0/operations/1/split/tetrahedron", 2, "names tetrahedron 2 of 2"},
      {"/cases/0/operations/1/split/opposite", 3, "point 3, which is no corner of tetrahedron 1"},
      {"/cases/0/operations/2/glue", json::array({0, 1, 3}), "glue is a boundary face"},
      {"/cases/0/operations/4/glue/0/opposite", 2, "two sides that do not have the same three"},
      {"/cases/0/operations/5/shatter", "up", R"(is "up"; "rising", "falling" or {"seed": n})"},
      {"/cases/0/operations/0/after/tally/3,4", 1, "3,4 is not \"s_v,s_e\""},
      {"/cases/0/operations/0/after/splits/0/oracle", true, "splits/0/oracle is not a known key"},
      {"/cases/0/operations/1/after/splits/0/refused", false, "is refused, or has vertices"},
      {"/cases/1/operations/3/fan/normal", json::array({0, 0, 0}), "normal is no direction"},
      {"/cases/1/operations/3/fan/normal/0", nullptr, "normal is no direction"},
      {"/cases/1/operations/3/fan/point", 27, "fan names point 27, which is no corner of any"},
      {"/cases/1/operations/6/plane/offset", nullptr, "offset is null; a finite number"},
      {"/cases/6/operations/0/break/point", 8, "break names point 8, which is no corner of any"},
      {"/cases/6/operations/1/break/crack", 2, "break names crack 2 of 2"},
      {"/cases/6/operations/1/break/normal", 2, "break/normal is not a known key"},
      {"/cases/6/cracks/0/positive/1", 6, "cracks/0/positive names tetrahedron 6 of 6"},
      {"/cases/6/cracks/0/negative/1", 2, "names tetrahedron 2, which has a side already"},
      {"/cases/6/cracks/0/negative", 2, "cracks/0/negative is 2; an array was expected"},
      {"/cases/3/cracks", json::array({1}), "/cases/3/cracks stands there though the body is"},
      {"/cases/5/known_differences/0/counts/edges", -3, "a whole number from 0 was expected"},
  };
  for (const Wrong& w : wrong) {
    json document = good_json();
    REQUIRE(complaints(document.dump()).empty());
    document[json::json_pointer(w.at)] = w.value;
    INFO(w.at << " = " << w.value);
    CHECK(has(complaints(document.dump()), w.said));
  }
}

TEST_CASE("a missing key, a repeated key and broken JSON are told", "[suite][fixture]") {
  json document = good_json();
  document["cases"][0].erase("findings");
  CHECK(has(complaints(document.dump()), "/cases/0 lacks \"findings\""));
  CHECK(has(complaints(R"({"name": "a", "name": "b"})"), "\"name\" stands twice"));
  CHECK(has(complaints(R"({"name": "a",)"), "parse error at line 1"));
  CHECK(has(complaints(""), "parse error"));
  CHECK(has(complaints("[]"), "the document is an array of 0; an object was expected"));
  for (const char* more : {"", "]"}) {  // not closed, too
    std::string deep = R"({"name": )" + std::string(60'000, '[');
    for (int k = 0; k < 60'000; ++k) deep += more;
    CHECK_FALSE(complaints(deep + "}").empty());
  }
  CHECK(has(complaints(std::string(100, '[') + std::string(100, ']')), "64 levels of nesting"));
}

TEST_CASE("all complaints of a file come at once", "[suite][fixture]") {
  json document = good_json();
  document["cases"][0]["body"]["points"][0][0] = "x";
  document["cases"][0]["body"]["points"][4][2] = "y";
  document["cases"][1]["wrong"] = 1;
  const std::vector<std::string> texts = complaints(document.dump());
  CHECK(has(texts, "/cases/0/body/points/0/0"));
  CHECK(has(texts, "/cases/0/body/points/4/2"));
  CHECK(has(texts, "/cases/1/wrong"));
}

TEST_CASE("a folder gives its files in order, and the schema is none of them", "[suite][fixture]") {
  const FileOfOwn file(good_json().dump());
  const auto code_of = [](const std::filesystem::path& folder) {
    const auto fixtures = read_fixture_folder(folder);
    return fixtures ? std::string("fine") : fixtures.findings.at(0).code;
  };
  json first = good_json();
  first["name"] = "first";
  json second = first;
  second["name"] = "second";
  std::ofstream(file.folder / "2.json") << second.dump();
  std::ofstream(file.folder / "1.json") << first.dump();
  std::ofstream(file.folder / "fixture.schema.json") << "{}";
  std::ofstream(file.folder / "notes.txt") << "no JSON";
  std::filesystem::remove(file.path);
  const auto fixtures = read_fixture_folder(file.folder);
  REQUIRE(fixtures);
  REQUIRE(fixtures->size() == 18);
  CHECK(fixtures->front().name == "first/two-tetrahedra");
  CHECK(fixtures->back().name == "second/star");
  std::ofstream(file.folder / "3.json") << second.dump();
  CHECK(code_of(file.folder) == "bad_fixture");
  CHECK(code_of(file.folder / "none") == "cannot_open");
  std::filesystem::create_directory(file.folder / "empty");
  CHECK(code_of(file.folder / "empty") == "no_fixture");
}

TEST_CASE("a fixture written out in steps is read again and means the same", "[suite][fixture]") {
  for (const Fixture& fixture : good()) {
    INFO(fixture.name);
    const Truth truth = truth_of(fixture);
    REQUIRE_FALSE(truth.checks.first);
    const FileOfOwn file(fixture_json(fixture, truth));
    const auto again = read_fixtures(file.path);
    for (const Finding& f : again.findings) UNSCOPED_INFO(f.text);
    REQUIRE(again);
    const Fixture& copy = again->front();
    CHECK(copy.name == fixture.name);
    CHECK(copy.findings == fixture.findings);
    CHECK(copy.body.tetrahedra == fixture.body.tetrahedra);
    CHECK(copy.body.points.size() == fixture.body.points.size());
    const Truth same = truth_of(copy);
    CHECK_FALSE(same.checks.first);
    std::vector<Step> steps, same_steps;
    for (const auto& o : truth.operations) {
      for (const auto& s : o.steps) steps.push_back(s.step);
    }
    for (const auto& o : same.operations) {
      for (const auto& s : o.steps) same_steps.push_back(s.step);
    }
    CHECK(steps == same_steps);
    if (!truth.is_body) continue;
    CHECK(same.built.counts == truth.built.counts);
    CHECK(copy.built.betti_mod == fixture.built.betti_mod);
  }
}

TEST_CASE("a run becomes a fixture that repeats it, refused bodies too", "[suite][fixture]") {
  const std::vector<Fixture> fixtures = good();
  const std::vector<Step> steps = {{Step::Kind::split, {0, 3}, {}},
                                   {Step::Kind::glue, {1, 4}, {0, 3}}};
  const FileOfOwn file(fixture_json(fixtures[0].body, steps, {"found", "what it shows", "seed 3"}));
  const auto again = read_fixtures(file.path);
  REQUIRE(again);
  CHECK(again->front().name == "found/steps");
  CHECK(again->front().operations.size() == 2);
  CHECK(again->front().operations[0].after.splits->front().separated);
  const FileOfOwn refused(fixture_json(fixtures[3].body, steps, {"bad", "", ""}));
  REQUIRE(read_fixtures(refused.path));
  CHECK(read_fixtures(refused.path)->front().refused);
}
