// SPDX-License-Identifier: MIT
// Fixture files: the document, its cases, their bodies, and a folder of them.
#include "topology/suite/fixture.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "topology/io/mesh_file.hpp"
#include "topology/suite/fixture_json.hpp"
#include "topology/suite/shapes.hpp"

namespace sunder::suite {
namespace {

using nlohmann::json;

Finding file_finding(const std::string& code, const std::filesystem::path& path,
                     const std::string& text, const std::string& remedy) {
  return {.code = code, .ids = {}, .text = text, .remedy = remedy, .file = path.string()};
}

/// The document; keys that stand twice in one object are complaints, since one of them is lost.
json parse(const std::string& bytes, JsonFile& file) {
  std::vector<std::set<std::string>> keys;
  const auto watch = [&keys, &file](int, json::parse_event_t event, json& value) {
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second) {
      file.findings.push_back(
          file_finding("bad_fixture", file.path,
                       "the key " + value.dump() + " stands twice in one object", "keep one"));
    }
    return true;
  };
  try {
    return json::parse(bytes, watch);
  } catch (const json::exception& error) {
    file.findings.push_back(
        file_finding("bad_fixture", file.path, error.what(), "correct the JSON at this place"));
    return nullptr;
  }
}

/// Names become files on --export.
bool read_name(const JsonAt& at, std::string& name) {
  if (!read(at, name)) return false;
  const bool fine = !name.empty() && name.front() != '.' &&
                    std::all_of(name.begin(), name.end(), [](unsigned char c) {
                      return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
                    });
  return fine || expect(at, "a name of letters, digits, '-', '_' and '.'");
}

bool read_box(const JsonAt& at, TetMesh& body) {
  std::array<std::uint32_t, 3> cells;
  if (!read(at, cells)) return false;
  constexpr std::uint32_t most = 200;
  for (const std::uint32_t n : cells) {
    if (n == 0 || n > most) return expect(at, "three numbers of cells from 1 to 200");
  }
  body = kuhn_box(
      {static_cast<int>(cells[0]), static_cast<int>(cells[1]), static_cast<int>(cells[2])});
  return true;
}

bool read_mesh_file(const JsonAt& at, TetMesh& body) {
  std::string name;
  if (!read(at, name)) return false;
  Result<TetMesh> mesh = read_mesh(at.file->path.parent_path() / name);
  if (mesh) {
    body = {.points = std::move(mesh->points), .tetrahedra = std::move(mesh->tetrahedra)};
    return true;
  }
  for (Finding& f : mesh.findings) at.file->findings.push_back(std::move(f));
  return complain(at, "names a mesh that cannot be read");
}

bool read_body(const JsonAt& at, TetMesh& body) {
  if (at.value->is_object() && at.value->contains("kuhn_box")) {
    return is_object_of(at, {"kuhn_box"}) && read_box(*member(at, "kuhn_box"), body);
  }
  if (at.value->is_object() && at.value->contains("mesh")) {
    return is_object_of(at, {"mesh"}) && read_mesh_file(*member(at, "mesh"), body);
  }
  const bool fine = is_object_of(at, {"points", "tetrahedra"});
  return fine && read_member(at, "points", body.points) &&
         read_member(at, "tetrahedra", body.tetrahedra);
}

bool read_operations(const JsonAt& at, Fixture& fixture) {
  if (!at.value->is_array()) return expect(at, "an array");
  if (fixture.refused && !at.value->empty()) {
    return complain(at, "stands there though the body is refused");
  }
  fixture.operations.resize(at.value->size());
  bool fine = true;
  for (std::size_t i = 0; i < fixture.operations.size(); ++i) {
    fine = read(element(at, i), fixture.body, fixture.operations[i]) && fine;
  }
  return fine;
}

bool read_case(const JsonAt& at, Fixture& fixture) {
  if (!is_object_of(
          at, {"name", "body", "findings"},
          {"shows", "refused", "file_cells", "built", "operations", "known_differences"})) {
    return false;
  }
  std::string name;
  bool fine = read_name(*member(at, "name"), name);
  fixture.name += "/" + name;
  fine = read_member(at, "shows", fixture.shows) && fine;
  fine = read_member(at, "findings", fixture.findings) && fine;
  fine = read_member(at, "refused", fixture.refused) && fine;
  fine = read_member(at, "file_cells", fixture.file_cells) && fine;
  fine = read_member(at, "known_differences", fixture.known_differences) && fine;
  std::sort(fixture.findings.begin(), fixture.findings.end());
  const auto built = member(at, "built");
  if (built && fixture.refused) fine = complain(*built, "stands there though the body is refused");
  fine = read_member(at, "built", fixture.built) && fine;
  if (!read_body(*member(at, "body"), fixture.body)) return false;
  const auto operations = member(at, "operations");
  return (!operations || read_operations(*operations, fixture)) && fine;
}

std::vector<Fixture> read_document(const JsonAt& at) {
  std::vector<Fixture> fixtures;
  if (!is_object_of(at, {"name", "shows", "source", "cases"}, {"$schema"})) return {};
  Fixture common;
  if (!read_name(*member(at, "name"), common.name) || !read_member(at, "shows", common.shows) ||
      !read_member(at, "source", common.source)) {
    return {};
  }
  const JsonAt cases = *member(at, "cases");
  if (!cases.value->is_array() || cases.value->empty()) {
    expect(cases, "an array of at least one case");
    return {};
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < cases.value->size(); ++i) {
    Fixture& fixture = fixtures.emplace_back(common);
    const JsonAt place = element(cases, i);
    if (read_case(place, fixture) && !names.insert(fixture.name).second) {
      complain(place, "has the name of an earlier case: " + fixture.name);
    }
  }
  return fixtures;
}

}  // namespace

Result<std::vector<Fixture>> read_fixtures(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path)) {
    return file_finding("cannot_open", path, "the fixture file cannot be read",
                        "name a JSON file of fixtures");
  }
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  JsonFile file{path, {}};
  const json document = parse(bytes, file);
  Result<std::vector<Fixture>> fixtures;
  if (file.findings.empty()) fixtures.value = read_document({&document, &file});
  if (!file.findings.empty()) fixtures.value.reset();
  fixtures.findings = std::move(file.findings);
  return fixtures;
}

Result<std::vector<Fixture>> read_fixture_folder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code reason;
  for (const auto& entry : std::filesystem::directory_iterator(folder, reason)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() != ".json" || path.stem().extension() == ".schema") continue;
    files.push_back(path);
  }
  if (reason) {
    return file_finding("cannot_open", folder, "the folder cannot be read: " + reason.message(),
                        "name a folder of fixture files");
  }
  if (files.empty()) {
    return file_finding("no_fixture", folder, "the folder holds no fixture file (*.json)",
                        "name a folder of fixture files");
  }
  std::sort(files.begin(), files.end());
  Result<std::vector<Fixture>> all = std::vector<Fixture>{};
  std::set<std::string> names;
  for (const std::filesystem::path& file : files) {
    Result<std::vector<Fixture>> some = read_fixtures(file);
    for (Finding& f : some.findings) all.findings.push_back(std::move(f));
    if (!some) continue;
    for (Fixture& fixture : *some) {
      if (!names.insert(fixture.name).second) {
        all.findings.push_back(file_finding(
            "bad_fixture", file, "the fixture " + fixture.name + " stands in an earlier file, too",
            "rename one of them"));
      }
      all->push_back(std::move(fixture));
    }
  }
  if (has_error(all.findings)) all.value.reset();
  return all;
}

}  // namespace sunder::suite
