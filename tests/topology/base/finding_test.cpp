// SPDX-License-Identifier: MIT
// Findings: words of their severities, errors among them, values with them.
#include "topology/base/finding.hpp"

#include <catch2/catch.hpp>

using namespace sunder;

TEST_CASE("each severity has its word", "[topology][finding]") {
  std::vector<std::string> words;
  for (const Severity s : {Severity::note, Severity::warning, Severity::error}) {
    words.emplace_back(to_string(s));
  }
  CHECK(words == std::vector<std::string>{"note", "warning", "error"});
}

TEST_CASE("a finding is one error, of no line, unless it says otherwise", "[topology][finding]") {
  const Finding f;
  CHECK(f.severity == Severity::error);
  CHECK(f.count == 1);
  CHECK(f.line == 0);
}

TEST_CASE("an error is found wherever it stands among findings", "[topology][finding]") {
  const Finding note{.severity = Severity::note}, warning{.severity = Severity::warning}, error;
  CHECK_FALSE(has_error({}));
  CHECK_FALSE(has_error({note, warning}));
  CHECK(has_error({note, error}));
  CHECK(has_error({error, warning}));
}

TEST_CASE("a result is its value or the reasons why there is none", "[topology][finding]") {
  Result<std::string> value(std::string("three"));
  REQUIRE(value);
  CHECK(*value == "three");
  CHECK(value->size() == 5);
  const Result<std::string> same = value;
  CHECK(*same == "three");
  CHECK(same->size() == 5);
  const Result<std::string> none(Finding{.code = "none"});
  CHECK_FALSE(none);
  REQUIRE(none.findings.size() == 1);
  CHECK(none.findings[0].code == "none");
}
