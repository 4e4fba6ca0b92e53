// SPDX-License-Identifier: MIT
// `sunder suite` from outside: tables, JSON, exit codes, kernels in other processes, exports.
#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

#include "tests/support/program.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder::test;

namespace {

const std::string data = SUNDER_SUITE_DATA;

std::string python(const std::string& adapter) {
  return std::string(SUNDER_PYTHON) + " " + SUNDER_ADAPTERS + "/" + adapter;
}

}  // namespace

TEST_CASE("right kernels end with 0 and a line of totals", "[suite][command]") {
  const Workplace here;
  const Outcome outcome =
      here.run({"suite", "--fixtures", data + "/good", "--kernel", "sunder", "--kernel", "twin"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.out.find("small/figure-5-abc") != std::string::npos);
  CHECK(outcome.out.find("7 fixtures, 2 kernels: ") != std::string::npos);
  CHECK(outcome.out.find(" 0 mismatches") != std::string::npos);
}

TEST_CASE("a mismatch ends with 1, the first wrong number and the steps", "[suite][command]") {
  const Workplace here;
  const Outcome outcome = here.run({"suite", "--fixtures", data + "/wrong", "--kernel", "twin"});
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out.find("in operation 2, after step 2: splits of kind (3, 3)") !=
        std::string::npos);
  CHECK(outcome.out.find("expected 2, answered 1") != std::string::npos);
  CHECK(outcome.out.find("split 0 1 3 from tetrahedron 0") != std::string::npos);
  const Outcome json =
      here.run({"suite", "--fixtures", data + "/wrong", "--kernel", "twin", "--json"});
  CHECK(json.exit_code == 1);
  const auto verdict = json.json()["fixtures"][0]["verdicts"][0];
  CHECK(verdict["result"] == "different");
  CHECK(verdict["mismatch"]["operation"] == 2);
  CHECK(verdict["mismatch"]["expected"] == "2");
  CHECK(verdict["mismatch"]["steps"].size() == 2);
  CHECK(verdict["mismatch"]["steps"][1]["split"]["tetrahedron"] == 0);
}

TEST_CASE("the JSON tells every verdict and the totals", "[suite][command]") {
  const Workplace here;
  const Outcome outcome = here.run({"suite", "small/t*", "--fixtures", data + "/good", "--json"});
  CHECK(outcome.exit_code == 0);
  const auto json = outcome.json();
  CHECK(json["kernels"] == nlohmann::json({"sunder", "dense", "nested", "cgal", "twin"}));
  REQUIRE(json["fixtures"].size() == 1);
  const auto& fixture = json["fixtures"][0];
  CHECK(fixture["fixture"] == "small/two-tetrahedra");
  CHECK(fixture["operations"] == 7);
  CHECK(fixture["steps"] == 6);
  REQUIRE(fixture["verdicts"].size() == 5);
  for (const auto& verdict : fixture["verdicts"]) {
    CHECK(verdict["result"] == "same");
    CHECK(verdict["checks"] > 100);
    CHECK(verdict["microseconds"] > 0);
  }
  CHECK(json["totals"]["mismatches"] == 0);
}

TEST_CASE("a filter is a part of the name or a pattern for it", "[suite][command]") {
  const Workplace here;
  const auto fixtures = [&here](const std::string& filter) {
    return here.run({"suite", filter, "--fixtures", data + "/good", "--kernel", "twin", "--json"})
        .json()["totals"]["fixtures"];
  };
  CHECK(fixtures("") == 7);
  CHECK(fixtures("figure") == 1);
  CHECK(fixtures("small/[mn]*") == 2);
  CHECK(here.run({"suite", "none-such", "--fixtures", data + "/good"}).exit_code == 2);
  CHECK(here.run({"suite", "igure*", "--fixtures", data + "/good"}).exit_code == 2);
}

TEST_CASE("unreadable fixtures end with 3 and the place", "[suite][command]") {
  const Workplace here;
  here.write("bad.json", R"({"name": "bad", "shows": "", "source": "", "cases": [{"name": 1}]})");
  const Outcome outcome = here.run({"suite", "--fixtures", here.path(".")});
  CHECK(outcome.exit_code == 3);
  CHECK(outcome.err.find("bad.json: error: /cases/0 lacks \"body\"") != std::string::npos);
  CHECK(here.run({"suite", "--fixtures", here.path("none")}).exit_code == 3);
}

TEST_CASE("mistakes on the command line end with 2", "[suite][command]") {
  const Workplace here;
  CHECK(here.run({"suite", "--kernels"}).exit_code == 2);
  CHECK(here.run({"suite", "a", "b"}).exit_code == 2);
  CHECK(here.run({"suite", "--export", here.path("x"), "--json"}).exit_code == 2);
  const Outcome none = here.run({"suite", "--fixtures", data + "/good", "--kernel", "exit 7"});
  CHECK(none.exit_code == 2);
  CHECK(none.err.find("exit 7") != std::string::npos);
}

TEST_CASE("a kernel in another process is judged; a liar is caught, and the run goes on",
          "[suite][command]") {
  const Workplace here;
  const auto judged = [&here](const std::string& kernel) {
    return here.run(
        {"suite", "small/[tfvo]*", "--fixtures", data + "/good", "--kernel", kernel, "--json"});
  };
  const Outcome right = judged(python("minimal.py"));
  INFO(right.out << right.err);
  CHECK(right.exit_code == 0);
  CHECK(right.json()["totals"]["mismatches"] == 0);
  CHECK(right.json()["totals"]["fixtures"] == 4);
  for (const char* lie : {"forgets-a-vertex", "forgets-a-separation", "dies", "babbles"}) {
    const Outcome wrong = judged(python("liar.py ") + lie + " 0");
    INFO(lie << ": " << wrong.out << wrong.err);
    CHECK(wrong.exit_code == 1);
    // Only the first two have a split to lie about; the others are judged all the same.
    const auto json = wrong.json();
    REQUIRE(json["fixtures"].size() == 4);
    CHECK(json["fixtures"][0]["verdicts"][0]["mismatch"]["step"] == 1);
    CHECK(json["fixtures"][2]["verdicts"][0]["result"] == "same");
  }
}

TEST_CASE("exported fixtures are meshes and files that judge the same", "[suite][command]") {
  const Workplace here;
  const std::string out = here.path("out");
  const Outcome written = here.run({"suite", "--fixtures", data + "/good", "--export", out});
  CHECK(written.exit_code == 0);
  CHECK(written.out.find("small.two-tetrahedra\n") != std::string::npos);
  const auto mesh = sunder::read_mesh(std::filesystem::path(out) / "small.figure-5-abc.msh");
  REQUIRE(mesh);
  CHECK(mesh->tetrahedra == sunder::suite::kuhn_box({2, 2, 2}).tetrahedra);
  CHECK(here.run({"suite", "--fixtures", out, "--kernel", "sunder"}).exit_code == 0);
  here.write("file", "not a folder");
  CHECK(here.run({"suite", "--fixtures", data + "/good", "--export", here.path("file/x")})
            .exit_code == 4);
}

TEST_CASE("without --fixtures the current folder's are taken, else the source tree's",
          "[suite][command]") {
  const Workplace here;
  const Outcome ours = here.run({"suite", "01-*", "--kernel", "twin"});
  CHECK(ours.exit_code == 0);
  CHECK(ours.out.find("01-one-tetrahedron/") != std::string::npos);
}
