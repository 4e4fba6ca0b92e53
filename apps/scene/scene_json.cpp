// SPDX-License-Identifier: MIT
// The reader of scene files: visits the lists of scene_fields.hpp, collecting every finding.
#include "apps/scene/scene_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <type_traits>

#include "apps/scene/check_output.hpp"
#include "apps/scene/scene_fields.hpp"
#include "apps/scene/scene_meshes.hpp"
#include "apps/scene/scene_notes.hpp"
#include "apps/scene/scene_paint.hpp"
#include "apps/scene/scene_text.hpp"
#include "fracture/scene/check_scene.hpp"
#include "topology/base/elementary.hpp"
#include "topology/base/whole_number.hpp"

namespace sunder {
namespace {

using fields::Key;
using nlohmann::json;

/// The inputs for reading any value of a scene, and the findings.
struct Context {
  const SceneText& text;
  const SceneFiles& files;
  std::vector<Finding>& findings;

  /// Line of a value, or of the nearest one around it that the file has.
  std::size_t line_of(std::string pointer) const {
    for (;;) {
      const auto found = text.line.find(pointer);
      if (found != text.line.end()) return found->second;
      if (pointer.empty()) return 0;
      pointer.erase(pointer.rfind('/'));
    }
  }

  void add(const std::string& code, const std::string& pointer, const std::string& what,
           const std::string& remedy) const {
    const std::string place = pointer.empty() ? "the scene" : dotted(pointer);
    findings.push_back({.code = code,
                        .ids = {},
                        .text = fmt::format("{} {}", place, what),
                        .remedy = remedy,
                        .file = text.file,
                        .line = line_of(pointer)});
  }

  /// The same with the line of its place.
  void add(Finding finding, const std::string& pointer) const {
    finding.file = text.file;
    finding.line = line_of(pointer);
    findings.push_back(std::move(finding));
  }

  void wrong_type(const json& value, const std::string& pointer, const char* wanted) const {
    add("wrong_type", pointer, fmt::format("is {}; {} is wanted", shown(value), wanted),
        fmt::format("give {}", wanted));
  }
};

/// Reads one number; false after a finding.
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

template <std::integral Integer>
void read(const Context& c, const Key& key, const json& value, const std::string& at,
          Integer& member) {
  double number = 0;
  if (!value.is_number() || std::floor(value.get<double>()) != value.get<double>()) {
    c.wrong_type(value, at, "a whole number");
  } else if (read_number(c, key, value, at, number)) {
    member = whole_number<Integer>(number);
  }
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

/// Reads a direction: a vector of any length but 0, which is given length 1.
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

/// A type that one of the functions above reads; every other is an enum, a list or an object.
template <class T>
concept Plain = requires(const Context& c, const Key& k, const json& j, T& t) {
  read(c, k, j, std::string(), t);
};

/// A visitor of scene_fields.hpp that fills its members from one JSON object.
class ObjectReader {
 public:
  ObjectReader(const Context& context, const json& object, std::string pointer)
      : context_(context), object_(object), pointer_(std::move(pointer)) {}

  template <class T>
  void field(const Key& key, T& member) {
    if (const json* value = find(key)) visit(key, *value, at(key), member);
  }

  void direction(const Key& key, Eigen::Vector3d& member) {
    if (const json* value = find(key)) read_direction(context_, key, *value, at(key), member);
  }

  template <class T, class Variant>
  void alternative(const Key& key, T alternative, Variant& member) {
    alternatives_.emplace_back(key.name);
    if (const json* value = find(key)) {
      visit(key, *value, at(key), alternative);
      member = alternative;
      ++alternatives_found_;
    }
  }

  /// Reports keys that no field asked for, and alternatives that are not there once.
  void finish() const {
    for (const auto& [name, value] : object_.items()) {
      if (std::ranges::find(known_, name) != known_.end()) continue;
      const std::string nearest = nearest_word(name, known_);
      context_.add("unknown_key", at_name(name), "is not a key of a scene",
                   nearest.empty() ? fmt::format("known here: {}", fmt::join(known_, ", "))
                                   : fmt::format("did you mean {}? Known here: {}", nearest,
                                                 fmt::join(known_, ", ")));
    }
    if (!alternatives_.empty() && alternatives_found_ != 1) {
      context_.add(
          "missing_key", pointer_,
          fmt::format("has {} of the keys {}", alternatives_found_, fmt::join(alternatives_, ", ")),
          "give exactly one of them");
    }
  }

 private:
  std::string at_name(std::string_view n) const {
    return pointer_ + "/" + pointer_token(std::string(n));
  }
  std::string at(const Key& key) const { return at_name(key.name); }

  const json* find(const Key& key) {
    known_.emplace_back(key.name);
    const auto value = object_.find(std::string(key.name));
    if (value != object_.end()) return &*value;
    if (key.required) {
      context_.add("missing_key", pointer_, fmt::format("has no key {}", key.name),
                   fmt::format("add \"{}\": {}", key.name, key.text));
    }
    return nullptr;
  }

  template <Plain T>
  void visit(const Key& key, const json& value, const std::string& pointer, T& member) {
    read(context_, key, value, pointer, member);
  }

  template <class E>
  requires std::is_enum_v<E>
  void visit(const Key&, const json& value, const std::string& pointer, E& member) {
    std::vector<std::string> words;
    for (const auto& [e, word] : fields::names_of(member)) {
      words.emplace_back(word);
      if (value == word) {
        member = e;
        return;
      }
    }
    const std::string nearest =
        value.is_string() ? nearest_word(value.get<std::string>(), words) : std::string();
    context_.add("unknown_name", pointer,
                 fmt::format("is {}; allowed are {}", shown(value), fmt::join(words, ", ")),
                 nearest.empty() ? "give one of them" : fmt::format("did you mean {}?", nearest));
  }

  void visit(const Key& key, const json& value, const std::string& pointer,
             Eigen::Quaterniond& member) {
    struct AxisAngle {
      Eigen::Vector3d axis = {0, 0, 1};
      double angle = 0;
    } turn;
    if (!value.is_object()) return context_.wrong_type(value, pointer, "{\"axis\", \"angle\"}");
    ObjectReader reader(context_, value, pointer);
    reader.direction(Key{"axis", "", "", {}, true}, turn.axis);
    reader.field(Key{"angle", "degrees", "", key.range, true}, turn.angle);
    reader.finish();
    const double half = turn.angle * EIGEN_PI / 360;
    member.w() = cosine(half);
    member.vec() = sine(half) * turn.axis;
  }

  template <class T>
  void visit(const Key& key, const json& value, const std::string& pointer,
             std::optional<T>& member) {
    member.emplace();
    visit(key, value, pointer, *member);
  }

  template <class T>
  void visit(const Key& key, const json& value, const std::string& pointer,
             std::vector<T>& member) {
    if (!value.is_array()) return context_.wrong_type(value, pointer, "an array [...]");
    member.resize(value.size());
    for (std::size_t i = 0; i < value.size(); ++i) {
      visit(key, value[i], pointer + "/" + std::to_string(i), member[i]);
    }
  }

  template <class T>
  requires(std::is_class_v<T> && !Plain<T>) void visit(const Key&, const json& value,
                                                       const std::string& pointer, T& member) {
    if (!value.is_object()) return context_.wrong_type(value, pointer, "an object {...}");
    ObjectReader reader(context_, value, pointer);
    fields::describe(reader, member);
    reader.finish();
  }

  const Context& context_;
  const json& object_;
  std::string pointer_;
  std::vector<std::string> known_, alternatives_;
  int alternatives_found_ = 0;
};

/// Adds faults of the scene as a whole. Values refused while reading have their default by now.
void add_findings(const Context& c, std::vector<SettingFinding> found) {
  const std::size_t read = c.findings.size();
  for (SettingFinding& f : found) {
    // Where reading failed the setting is the default: of that nothing more is to be said.
    const auto is_of_place = [&](const Finding& said) {
      return !f.place.empty() &&
             (said.text.starts_with(f.place + " ") || said.text.starts_with(f.place + "."));
    };
    if (std::any_of(c.findings.begin(), c.findings.begin() + static_cast<std::ptrdiff_t>(read),
                    is_of_place)) {
      continue;
    }
    // That the key is missing has been said.
    if (f.finding.code == "no_body" && !c.text.root.contains("bodies")) continue;
    std::string pointer = f.place.empty() ? "" : "/" + f.place;
    std::ranges::replace(pointer, '.', '/');
    c.add(std::move(f.finding), pointer);
  }
}

Result<SceneFile> read_whole(const SceneBytes& scene, const SceneFiles& files,
                             std::span<const std::string> settings) {
  Result<SceneText> text = parse_scene_text(scene.text, scene.name);
  Result<SceneFile> result;
  result.findings = std::move(text.findings);
  if (!text) return result;
  for (const std::string& setting : settings) {
    for (Finding& f : apply_setting(*text, setting)) result.findings.push_back(std::move(f));
  }
  const Context context{*text, files, result.findings};
  if (!text->root.is_object()) {
    context.wrong_type(text->root, "", "an object {...}");
    return result;
  }
  SceneFile file;
  ObjectReader reader(context, text->root, "");
  fields::describe(reader, file);
  reader.finish();
  for (Finding& f : paint_strengths(file.scene, *text, files)) {
    result.findings.push_back(std::move(f));
  }
  add_findings(context, check_scene(file.scene));
  add_findings(context, check_output(file.output, file.scene));
  if (file.scene.name.empty()) file.scene.name = std::filesystem::path(scene.name).stem().string();
  if (has_error(result.findings)) return result;
  file.choices = choose_settings(file.scene, file.accuracy, given_keys(text->root));
  for (Finding& f : scene_notes(*text, file)) result.findings.push_back(std::move(f));
  result.value = std::move(file);
  return result;
}

}  // namespace

Result<SceneFile> read_scene(const SceneBytes& scene, const SceneFiles& files,
                             std::span<const std::string> settings) {
  Result<SceneFile> result = read_whole(scene, files, settings);
  make_plain(result.findings);
  return result;
}

}  // namespace sunder
