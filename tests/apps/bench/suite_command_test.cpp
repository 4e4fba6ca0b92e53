// SPDX-License-Identifier: MIT
// `sunder suite` from outside: tables, JSON, exit codes, kernels in other processes, exports.
#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/support/program.hpp"

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
  CHECK(outcome.out.find("9 fixtures, 2 kernels: ") != std::string::npos);
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
  CHECK(fixtures("") == 9);
  CHECK(fixtures("figure") == 1);
  CHECK(fixtures("small/[mn]*") == 2);
  CHECK(here.run({"suite", "none-such", "--fixtures", data + "/good"}).exit_code == 2);
  CHECK(here.run({"suite", "igure*", "--fixtures", data + "/good"}).exit_code == 2);
}

TEST_CASE("a filter may stand behind --kernel, which takes one kernel per use",
          "[suite][command]") {
  const Workplace here;
  for (const std::vector<std::string> last :
       {std::vector<std::string>{"--kernel", "twin", "small/[mn]*"},
        {"--kernel", "sunder", "--kernel", "twin", "small/[mn]*"}}) {
    std::vector<std::string> words = {"suite", "--fixtures", data + "/good", "--json"};
    words.insert(words.end(), last.begin(), last.end());
    const Outcome outcome = here.run(words);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.json()["totals"]["fixtures"] == 2);
    CHECK(outcome.json()["kernels"].size() == last.size() / 2);
  }
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
  for (const char* other : {"--json", "--fail-fast"}) {
    CHECK(here.run({"suite", "--export", here.path("x.tar.gz"), other}).exit_code == 2);
  }
  CHECK(here.run({"suite", "--random", "10", "--fail-fast"}).exit_code == 2);
  CHECK(here.run({"suite", "--random", "10", "--junit", here.path("x.xml")}).exit_code == 2);
  const Outcome none = here.run({"suite", "--fixtures", data + "/good", "--kernel", "exit 7"});
  CHECK(none.exit_code == 2);
  CHECK(none.err.find("exit 7") != std::string::npos);
}

TEST_CASE("a kernel in another process is judged, a liar is caught, and the run goes on",
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

TEST_CASE(
    "a run with --fail-fast ends after the first fixture with a mismatch, and says what is left",
    "[suite][command]") {
  const Workplace here;
  const std::string liar = python("liar.py forgets-a-vertex 0");
  const Outcome table =
      here.run({"suite", "--fixtures", data + "/good", "--kernel", liar, "--fail-fast"});
  CHECK(table.exit_code == 1);
  CHECK(table.out.find("ended at a mismatch, 8 fixtures not judged; 1 fixture,") !=
        std::string::npos);
  const auto json =
      here.run({"suite", "--fixtures", data + "/good", "--kernel", liar, "--fail-fast", "--json"})
          .json();
  CHECK(json["fixtures"].size() == 1);
  CHECK(json["totals"]["not_judged"] == 8);
  const Outcome right = here.run(
      {"suite", "--fixtures", data + "/good", "--kernel", "twin", "--fail-fast", "--json"});
  CHECK(right.exit_code == 0);
  CHECK(right.json()["totals"]["not_judged"] == 0);
}

TEST_CASE("a kernel that is always silent has its time three times and is asked no more",
          "[suite][command]") {
  const Workplace here;
  const auto answers = [&here](const std::string& kernel) {
    const Outcome outcome =
        here.run({"suite", "--fixtures", data + "/good", "--kernel",
                  "read q; echo hello 1 stub; " + kernel, "--timeout", "1", "--json"});
    CHECK(outcome.exit_code == 1);
    std::vector<std::string> texts;
    const auto json = outcome.json();
    for (const auto& fixture : json["fixtures"]) {
      texts.push_back(fixture["verdicts"][0]["mismatch"]["answered"]);
      if (texts.back().find("no answer within 1 s") == std::string::npos) continue;
      CHECK(fixture["verdicts"][0]["microseconds"] > 900000);  // the time it was waited for
    }
    REQUIRE(texts.size() == 9);
    return texts;
  };
  const auto said = [](const std::string& text, const std::string& part) {
    INFO(text);
    return text.find(part) != std::string::npos;
  };
  const std::vector<std::string> silent = answers("sleep 1000");
  for (std::size_t row = 0; row < 3; ++row) CHECK(said(silent[row], "no answer within 1 s"));
  for (std::size_t row = 3; row < 9; ++row) CHECK(said(silent[row], "not asked: "));
  // One that dies between is asked about every fixture; dying costs no time.
  const std::vector<std::string> now_and_then =
      answers("read a b c; [ $c = 48 ] && sleep 1000; exit 3");
  CHECK(said(now_and_then[0], "ended with exit code 3"));
  CHECK(said(now_and_then[1], "no answer within 1 s"));
  CHECK(said(now_and_then[6], "ended with exit code 3"));
}

TEST_CASE("a program that says no hello is no kernel, and --timeout is a time",
          "[suite][command]") {
  const Workplace here;
  CHECK(here.run({"suite", "--kernel", "read q; sleep 1000", "--timeout", "0.2"}).exit_code == 2);
  for (const char* bad : {"0", "-1", "nan", "inf", "soon", "1e9"}) {
    CHECK(here.run({"suite", "--timeout", bad}).exit_code == 2);
  }
}

TEST_CASE("a JUnit file has a testsuite a kernel and a testcase a fixture", "[suite][command]") {
  const Workplace here;
  const auto junit = [&here](const std::vector<std::string>& more, int exit_code) {
    std::vector<std::string> words = {"suite", "--junit", here.path("suite.xml"), "--fixtures"};
    words.insert(words.end(), more.begin(), more.end());
    CHECK(here.run(words).exit_code == exit_code);
    std::ifstream file(here.path("suite.xml"));
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++n;
    return n;
  };
  const std::string right = junit({data + "/good", "--kernel", "sunder", "--kernel", "twin"}, 0);
  CHECK(count(right, "<testsuite ") == 2);
  CHECK(count(right, "<testcase ") == 18);
  CHECK(count(right, " tests=\"9\" failures=\"0\" errors=\"0\" ") == 2);
  CHECK(count(right, "<testcase classname=\"sunder.small\" name=\"two-tetrahedra\"") == 1);
  const std::string known = junit({SUNDER_SUITE_FIXTURES, "19-*", "--kernel", "cgal"}, 0);
  CHECK(count(known, " failures=\"0\" errors=\"0\" skipped=\"1\"") == 1);
  CHECK(count(known, "<skipped message=\"known difference: CGAL's map") == 1);
  const std::string wrong = junit({data + "/wrong", "--kernel", "twin"}, 1);
  CHECK(count(wrong, " failures=\"1\" errors=\"0\"") == 1);
  CHECK(count(wrong, "<failure type=\"mismatch\" message=\"splits of kind (3, 3)") == 1);
  CHECK(count(wrong, "split 0 1 3 from tetrahedron 0") == 1);
  const std::string lost =
      junit({data + "/good", "--kernel",
             "read q; echo hello 1 a\\<b\\&c; read q; printf '<\\001\"&>\\377\\n'; exit 3"},
            1);
  CHECK(count(lost, "<error type=\"lost\"") == 9);
  CHECK(count(lost, "<testsuite name=\"a&lt;b&amp;c\"") == 1);
  CHECK(std::all_of(lost.begin(), lost.end(),
                    [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
  CHECK(here.run({"suite", "01-*", "--kernel", "twin", "--junit", here.path("no/such/x.xml")})
            .exit_code == 4);
}

TEST_CASE("an export is one archive, and mistakes write none", "[suite][command]") {
  const Workplace here;
  const std::string archive = here.path("suite.tar.gz");
  const Outcome written = here.run({"suite", "--fixtures", data + "/good", "--export", archive});
  CHECK(written.exit_code == 0);
  CHECK(written.out.find("suite.tar.gz: 9 fixtures\n") != std::string::npos);
  CHECK(here.run({"suite", "--fixtures", data + "/good", "--export", here.path("folder")})
            .exit_code == 2);
  CHECK(here.run({"suite", "--fixtures", data + "/good", "--export", here.path("no/such/x.tar.gz")})
            .exit_code == 4);
  const Outcome untrue =
      here.run({"suite", "--fixtures", data + "/wrong", "--export", here.path("wrong.tar.gz")});
  CHECK(untrue.exit_code == 1);
  CHECK(untrue.err.find("is not true of its body") != std::string::npos);
  CHECK(here.names() == std::vector<std::string>{"suite.tar.gz"});
}

TEST_CASE("without --fixtures the current folder's are taken, else the source tree's",
          "[suite][command]") {
  const Workplace here;
  const Outcome ours = here.run({"suite", "01-*", "--kernel", "twin"});
  CHECK(ours.exit_code == 0);
  CHECK(ours.out.find("01-one-tetrahedron/") != std::string::npos);
}
