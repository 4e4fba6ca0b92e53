// SPDX-License-Identifier: MIT
#include "apps/scene/words.hpp"

#include <catch2/catch.hpp>

using namespace sunder;

TEST_CASE("lists of numbers are whole or nothing", "[scene][words]") {
  CHECK(numbers_of("1,-2.5,3e2", 3) == std::vector<double>{1, -2.5, 300});
  CHECK_FALSE(numbers_of("1,2", 3));
  CHECK_FALSE(numbers_of("1,2,3,4", 3));
  CHECK_FALSE(numbers_of("1,,3", 3));
  CHECK_FALSE(numbers_of("1,2,x", 3));
}

TEST_CASE("a finding is told in two lines, and in JSON", "[scene][words]") {
  Finding finding;
  finding.code = "flat_tetrahedron";
  finding.text = "Two tetrahedra have no volume.";
  finding.remedy = "Mend the mesh.";
  finding.ids = {4, 9};
  finding.count = 2;
  finding.file = "a.msh";
  finding.line = 7;
  const std::string lines = finding_lines({finding});
  CHECK(lines.starts_with("a.msh:7: error: Two tetrahedra have no volume. [flat_tetrahedron"));
  CHECK(std::count(lines.begin(), lines.end(), '\n') == 2);
  CHECK(lines.find("Mend the mesh.") != std::string::npos);
  CHECK(finding_lines({finding}, true).starts_with("a.msh:7: \033[1;31merror:\033[0m Two"));
  finding.severity = Severity::warning;
  CHECK(finding_lines({finding}, true).find("\033[1;33mwarning:\033[0m Two") != std::string::npos);
  finding.severity = Severity::note;
  CHECK(finding_lines({finding}, true).find('\033') == std::string::npos);
  const nlohmann::ordered_json json = findings_json({finding});
  CHECK(json[0]["code"] == "flat_tetrahedron");
  CHECK(json[0]["ids"] == std::vector<int>{4, 9});
  CHECK(json[0]["line"] == 7);
}
