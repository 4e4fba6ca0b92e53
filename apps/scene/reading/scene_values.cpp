// SPDX-License-Identifier: MIT
#include "apps/scene/reading/scene_values.hpp"

#include <fmt/format.h>

#include "apps/scene/scene_meshes.hpp"

namespace sunder::reading {
namespace {

/// The errors of a file that a value names; without a line of its own each stands at the scene's.
void add_of_file(const Context& c, std::vector<Finding> found, const std::string& at,
                 const std::string& name) {
  for (Finding& f : found) {
    if (f.severity != Severity::error) continue;
    f.text = fmt::format("{} ({}): {}", dotted(at), name, f.text);
    if (f.line == 0) {
      f.file = c.text.file;
      f.line = c.line_of(at);
    }
    c.findings.push_back(std::move(f));
  }
}

}  // namespace

std::size_t Context::line_of(std::string pointer) const {
  for (;;) {
    const auto found = text.line.find(pointer);
    if (found != text.line.end()) return found->second;
    if (pointer.empty()) return 0;
    pointer.erase(pointer.rfind('/'));
  }
}

void Context::add(const std::string& code, const std::string& pointer, const std::string& what,
                  const std::string& remedy) const {
  const std::string place = pointer.empty() ? "the scene" : dotted(pointer);
  findings.push_back({.code = code,
                      .ids = {},
                      .text = fmt::format("{} {}", place, what),
                      .remedy = remedy,
                      .file = text.file,
                      .line = line_of(pointer)});
}

void Context::add(Finding finding, const std::string& pointer) const {
  finding.file = text.file;
  finding.line = line_of(pointer);
  findings.push_back(std::move(finding));
}

void Context::wrong_type(const json& value, const std::string& pointer, const char* wanted) const {
  add("wrong_type", pointer, fmt::format("is {}; {} is wanted", shown(value), wanted),
      fmt::format("give {}", wanted));
}

bool read_number(const Context& c, const Key& key, const json& value, const std::string& at,
                 double& number) {
  if (!value.is_number()) {
    c.wrong_type(value, at, "a number");
    return false;
  }
  number = value.get<double>();
  if (fields::is_allowed(number, key.range)) return true;
  c.add(fields::out_of_range(key, dotted(at), shown(value), number), at);
  return false;
}

void read(const Context& c, const Key& key, const json& value, const std::string& at,
          double& member) {
  double number = 0;
  if (read_number(c, key, value, at, number)) member = number;
}

void read(const Context& c, const Key&, const json& value, const std::string& at, bool& member) {
  if (value.is_boolean()) {
    member = value.get<bool>();
  } else {
    c.wrong_type(value, at, "true or false");
  }
}

void read(const Context& c, const Key&, const json& value, const std::string& at,
          std::string& member) {
  if (value.is_string()) {
    member = value.get<std::string>();
  } else {
    c.wrong_type(value, at, "a text");
  }
}

void read(const Context& c, const Key& key, const json& value, const std::string& at,
          Eigen::Vector3d& member) {
  if (!value.is_array() || value.size() != 3) {
    c.wrong_type(value, at, "an array of three numbers");
    return;
  }
  Eigen::Vector3d v = member;
  bool fine = true;
  for (int i = 0; i < 3; ++i) {
    fine &=
        read_number(c, key, value[static_cast<std::size_t>(i)], at + "/" + std::to_string(i), v[i]);
  }
  if (fine) member = v;
}

void read_direction(const Context& c, const Key& key, const json& value, const std::string& at,
                    Eigen::Vector3d& member) {
  const std::size_t before = c.findings.size();
  Eigen::Vector3d v = member;
  read(c, key, value, at, v);
  if (c.findings.size() != before) return;
  if (const double length = v.stableNorm(); length > 0) {
    member = v / length;
  } else {
    c.add("zero_direction", at, "is [0, 0, 0], which points nowhere",
          "give three numbers that are not all 0");
  }
}

void read(const Context& c, const Key&, const json& value, const std::string& at, TetMesh& member) {
  if (!value.is_string()) return c.wrong_type(value, at, "the name of a mesh file");
  add_of_file(c, read_body_mesh(member, c.files, value), at, value);
}

void read(const Context& c, const Key&, const json& value, const std::string& at,
          std::shared_ptr<const SolidSurface>& member) {
  if (!value.is_string()) return c.wrong_type(value, at, "the name of a surface file");
  add_of_file(c, read_solid(member, c.files, value), at, value);
}

void read(const Context& c, const Key&, const json& value, const std::string& at,
          FaceList& member) {
  if (!value.is_string()) return c.wrong_type(value, at, "the name of a file of faces");
  auto faces = c.files.faces(value.get<std::string>());
  for (Finding& f : faces.findings) {
    f.text = fmt::format("{} ({}): {}", dotted(at), value.get<std::string>(), f.text);
    c.findings.push_back(std::move(f));
  }
  if (faces) member = {value.get<std::string>(), std::move(*faces)};
}

void read(const Context& c, const Key&, const json& value, const std::string& at,
          RegionName& member) {
  if (value.is_string()) {
    member.text = value.get<std::string>();
  } else if (value.is_number_integer()) {
    member.text = value.dump();
  } else {
    c.wrong_type(value, at, "the name or the number of a region");
  }
}

void read(const Context& c, const Key& key, const json& value, const std::string& at,
          HistorySettings& member) {
  if (value != "off" && !value.is_number()) return c.wrong_type(value, at, "a number or \"off\"");
  double number = 0;
  if (value == "off" || read_number(c, key, value, at, number)) member.interval = number;
}

}  // namespace sunder::reading
