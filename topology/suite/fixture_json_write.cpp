// SPDX-License-Identifier: MIT
// JSON of fixtures: short lines, doubles in their shortest exact form.
#include "topology/suite/fixture_json_write.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "topology/check.hpp"
#include "topology/suite/steps.hpp"

namespace sunder::suite {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const CellCounts& c) {
  return {{"vertices", c.vertices},
          {"edges", c.edges},
          {"faces", c.faces},
          {"tetrahedra", c.tetrahedra},
          {"components", c.components},
          {"boundary_faces", c.boundary_faces},
          {"boundary_sheets", c.boundary_sheets}};
}

ordered_json json_of(const SplitAnswer& s) {
  if (!s.did) return {{"refused", true}};
  return {{"vertices", s.vertices}, {"edges", s.edges}, {"separated", s.separated}};
}

ordered_json json_of(const FaceSide& side) {
  return {{"tetrahedron", side.tetrahedron}, {"opposite", side.opposite}};
}

/// What is expected at a moment: the fixture's own, and the twin's counts.
ordered_json json_of(const Expected& expected, const Moment* moment) {
  ordered_json json = ordered_json::object();
  if (moment != nullptr) {
    json["counts"] = json_of(moment->counts);
    json["euler_characteristic"] = euler_characteristic(moment->counts);
  }
  for (const auto& [prime, betti] : expected.betti_mod) {
    json["betti"]["GF(" + std::to_string(prime) + ")"] = betti;
  }
  if (expected.homology) {
    json["homology"] = {{"betti", expected.homology->betti},
                        {"torsion", expected.homology->torsion}};
  }
  if (expected.orientable) json["orientable"] = *expected.orientable;
  return json;
}

ordered_json json_of(const KnownDifference& known) {
  ordered_json json = {{"kernel", known.kernel}, {"why", known.why}};
  if (known.counts) json["counts"] = json_of(*known.counts);
  return json;
}

/// A list with several items a line.
template <class Row>
std::string lines_of(const std::vector<Row>& rows, const std::string& indent) {
  std::string text = "[", line;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string item = ordered_json(rows[i]).dump() + (i + 1 < rows.size() ? "," : "");
    if (line.size() + item.size() > 90) text += "\n" + indent + line, line.clear();
    line += (line.empty() ? "" : " ") + item;
  }
  return text + (line.empty() ? "" : "\n" + indent + line) + "]";
}

ordered_json json_of(const TrueStep& step) {
  if (step.step.kind == Step::Kind::split) return {{"split", json_of(step.step.a)}};
  return {{"glue", {json_of(step.step.a), json_of(step.step.b)}}};
}

/// One line a step.
std::string operations_text(const Fixture& fixture, const Truth& truth) {
  std::string text;
  for (std::size_t row = 0; row < truth.operations.size(); ++row) {
    const TrueOperation& operation = truth.operations[row];
    for (std::size_t i = 0; i < operation.steps.size(); ++i) {
      const TrueStep& step = operation.steps[i];
      const bool last = i + 1 == operation.steps.size();
      const auto& moment = last && operation.after ? operation.after : step.after;
      ordered_json after =
          json_of(last ? fixture.operations[row].after : Expected{}, moment ? &*moment : nullptr);
      if (step.step.kind == Step::Kind::split) {
        after["splits"] = ordered_json::array({json_of(step.split)});
      }
      ordered_json json = json_of(step);
      json["after"] = std::move(after);
      text += (text.empty() ? "\n        " : ",\n        ") + json.dump();
    }
  }
  return "[" + text + "]";
}

std::string member_text(const char* key, const ordered_json& value) {
  return ",\n      \"" + std::string(key) + "\": " + value.dump();
}

std::string case_text(const Fixture& fixture, const Truth& truth, const std::string& name) {
  std::string text = "    {\n      \"name\": " + ordered_json(name).dump();
  text +=
      ",\n      \"body\": {\n        \"points\": " + lines_of(fixture.body.points, "          ");
  text += ",\n        \"tetrahedra\": " + lines_of(fixture.body.tetrahedra, "          ") + "}";
  text += member_text("findings", fixture.findings);
  if (fixture.refused) text += member_text("refused", true);
  if (fixture.file_cells) text += member_text("file_cells", *fixture.file_cells);
  if (!fixture.refused) {
    text += member_text("built", json_of(fixture.built, &truth.built));
    text += ",\n      \"operations\": " + operations_text(fixture, truth);
  }
  if (!fixture.known_differences.empty()) {
    ordered_json list = ordered_json::array();
    for (const KnownDifference& known : fixture.known_differences) list.push_back(json_of(known));
    text += member_text("known_differences", list);
  }
  return text + "\n    }";
}

}  // namespace

std::string fixture_json(const Fixture& fixture, const Truth& truth) {
  const std::size_t slash = fixture.name.find('/');
  const std::string file = fixture.name.substr(0, slash);
  const std::string name = slash == std::string::npos ? "steps" : fixture.name.substr(slash + 1);
  return "{\n  \"name\": " + ordered_json(file).dump() +
         ",\n  \"shows\": " + ordered_json(fixture.shows).dump() +
         ",\n  \"source\": " + ordered_json(fixture.source).dump() + ",\n  \"cases\": [\n" +
         case_text(fixture, truth, name) + "\n  ]\n}\n";
}

std::string fixture_json(const TetMesh& body, std::span<const Step> steps, const RunName& name) {
  Fixture fixture{
      .name = name.name + "/steps", .shows = name.shows, .source = name.source, .body = body};
  for (const Finding& f : check_mesh(body, Severity::warning)) {
    fixture.findings.push_back(f.code);
    fixture.refused |= f.severity == Severity::error;
  }
  std::sort(fixture.findings.begin(), fixture.findings.end());
  if (!fixture.refused) {
    for (const Step& step : steps) fixture.operations.push_back({operation_of(step), {}});
  }
  return fixture_json(fixture, truth_of(fixture));
}

}  // namespace sunder::suite
