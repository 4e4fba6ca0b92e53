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

TEST_CASE("warnings of one kind about many bodies are printed once", "[scene][words]") {
  std::vector<Finding> findings;
  const auto add = [&](const char* code, const std::string& text, Severity severity) {
    findings.push_back({.code = code, .severity = severity, .text = text, .remedy = "Do this."});
  };
  for (const int body : {7, 0, 1, 2, 3, 4, 5, 6, 8, 11}) {
    add("slender_body", "bodies." + std::to_string(body) + ".mesh is " + std::to_string(20 + body),
        Severity::warning);
    add("no_windows", "bodies." + std::to_string(body) + " has none", Severity::note);
  }
  add("slender_body", "bodies.0.other is 3", Severity::warning);
  add("odd_unit", "obstacles.0.mass is 1", Severity::warning);
  add("odd_unit", "obstacles.3.mass is 2", Severity::warning);
  for (const char* text : {"bodies.0.mesh is bad", "bodies.1.mesh is bad"}) {
    add("bad", text, Severity::error);
  }
  add("flat", "Two tetrahedra", Severity::warning);
  add("flat", "Two tetrahedra", Severity::warning);
  const std::string remedy = "  Do this.\n";
  CHECK(finding_lines(findings) ==
        "warning: bodies.7.mesh is 27; also bodies.0.mesh, bodies.1.mesh, bodies.2.mesh and "
        "6 more bodies [slender_body, 10 times]\n" +
            remedy +
            "note: bodies.7 has none; also bodies.0, bodies.1, bodies.2 and 6 more bodies "
            "[no_windows, 10 times]\n" +
            remedy + "warning: bodies.0.other is 3 [slender_body]\n" + remedy +
            "warning: obstacles.0.mass is 1; also obstacles.3.mass [odd_unit, 2 times]\n" + remedy +
            "error: bodies.0.mesh is bad [bad]\n" + remedy + "error: bodies.1.mesh is bad [bad]\n" +
            remedy + "warning: Two tetrahedra [flat]\n" + remedy +
            "warning: Two tetrahedra [flat]\n" + remedy);
  // Lists for machines keep all.
  CHECK(findings_json(findings).size() == findings.size());
}
