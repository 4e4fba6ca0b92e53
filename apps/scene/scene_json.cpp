// SPDX-License-Identifier: MIT
// The reader of scene files: visits the lists of scene_fields.hpp, collecting every finding.
#include "apps/scene/scene_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "apps/scene/check_output.hpp"
#include "apps/scene/reading/material_names.hpp"
#include "apps/scene/reading/scene_values.hpp"
#include "apps/scene/reading/take_source.hpp"
#include "apps/scene/scene_fields.hpp"
#include "apps/scene/scene_notes.hpp"
#include "apps/scene/scene_paint.hpp"
#include "apps/scene/scene_text.hpp"
#include "fracture/scene/check_scene.hpp"
#include "topology/base/elementary.hpp"

namespace sunder {
namespace {

using nlohmann::json;
using reading::Context;
using reading::Key;
using reading::Plain;

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
    if (const json* value = find(key))
      reading::read_direction(context_, key, *value, at(key), member);
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
    reading::read(context_, key, value, pointer, member);
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

  /// A named material is where the other keys start from.
  void visit(const Key&, const json& value, const std::string& pointer, Material& member) {
    if (!value.is_object()) {
      return context_.wrong_type(value, pointer, "the name of a material or an object {...}");
    }
    ObjectReader reader(context_, value, pointer);
    std::string name;
    reader.field(fields::material_name_key(), name);
    if (value.contains("name") && value["name"].is_string())
      reading::start_from_name(context_, name, value, pointer, member);
    fields::describe(reader, member);
    reader.finish();
  }

  /// The mesh of a body is that of its shape, or the file's in metres.
  void visit(const Key&, const json& value, const std::string& pointer, BodySettings& member) {
    if (!value.is_object()) return context_.wrong_type(value, pointer, "an object {...}");
    ObjectReader reader(context_, value, pointer);
    reading::BodySource source;
    reader.field(fields::shape_key(), source.shape);
    fields::describe(reader, source.file);
    fields::describe(reader, member);
    reader.finish();
    reading::take_source(context_, source, value, pointer, member.mesh);
  }

  /// The surface of a solid obstacle, in metres.
  void visit(const Key&, const json& value, const std::string& pointer, Solid& member) {
    if (!value.is_object()) return context_.wrong_type(value, pointer, "an object {...}");
    ObjectReader reader(context_, value, pointer);
    FileScale scale;
    fields::describe(reader, scale);
    fields::describe(reader, member);
    reader.finish();
    reading::take_scale(context_, scale, pointer, member.surface);
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

Result<SceneText> text_with(const SceneBytes& scene, std::span<const std::string> settings) {
  Result<SceneText> text = parse_scene_text(scene.text, scene.name);
  if (!text) return text;
  reading::write_names_out(*text);  // so that a setting changes a key of a named material
  for (const std::string& setting : settings) {
    for (Finding& f : apply_setting(*text, setting)) text.findings.push_back(std::move(f));
  }
  reading::write_names_out(*text);
  return text;
}

Result<SceneFile> read_whole(const SceneBytes& scene, const SceneFiles& files,
                             std::span<const std::string> settings) {
  Result<SceneText> text = text_with(scene, settings);
  Result<SceneFile> result;
  result.findings = std::move(text.findings);
  if (!text) return result;
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

Result<BodySettings> read_one_body(const SceneBytes& body, const SceneFiles& files,
                                   std::span<const std::string> settings) {
  const std::string scene = fmt::format("{{\"bodies\": [{}]}}", body.text);
  Result<SceneText> text = text_with({scene, body.name}, settings);
  Result<BodySettings> result;
  result.findings = std::move(text.findings);
  if (!text) return result;
  const json& root = text->root;
  if (root.size() != 1 || root["bodies"].size() != 1) {
    result.findings.push_back({.code = "not_one_body",
                               .text = "it is more or less than one body",
                               .remedy = "give one object {...}, as in \"bodies\" of a scene",
                               .file = body.name});
    return result;
  }
  const Context context{*text, files, result.findings};
  Scene alone;
  ObjectReader reader(context, root, "");
  reader.field(Key{"bodies", "", "", {}, true}, alone.bodies);
  reader.finish();
  for (Finding& f : paint_strengths(alone, *text, files)) result.findings.push_back(std::move(f));
  if (!has_error(result.findings)) result.value = std::move(alone.bodies.front());
  return result;
}

}  // namespace

Result<BodySettings> read_body(const SceneBytes& body, const SceneFiles& files,
                               std::span<const std::string> settings) {
  Result<BodySettings> result = read_one_body(body, files, settings);
  make_plain(result.findings);
  return result;
}

Result<SceneFile> read_scene(const SceneBytes& scene, const SceneFiles& files,
                             std::span<const std::string> settings) {
  Result<SceneFile> result = read_whole(scene, files, settings);
  make_plain(result.findings);
  return result;
}

}  // namespace sunder
