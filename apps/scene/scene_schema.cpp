// SPDX-License-Identifier: MIT
// The JSON schema of scene files, written from the lists of scene_fields.hpp.
#include "apps/scene/scene_schema.hpp"

#include <fmt/format.h>

#include <concepts>
#include <type_traits>

#include "apps/scene/reading/body_source.hpp"
#include "apps/scene/scene_fields.hpp"
#include "mechanics/state/settings/named_materials.hpp"

namespace sunder {
namespace {

using fields::Key;
using fields::Range;
using nlohmann::ordered_json;

void add_range(ordered_json& schema, const Range& range) {
  if (range.low > -fields::infinity) {
    schema[range.without_low ? "exclusiveMinimum" : "minimum"] = range.low;
  }
  if (range.high < fields::infinity) schema["maximum"] = range.high;
}

ordered_json number_schema(const Range& range) {
  ordered_json schema = {{"type", "number"}};
  add_range(schema, range);
  return schema;
}

ordered_json array_schema(ordered_json items) {
  return {{"type", "array"}, {"items", std::move(items)}};
}

ordered_json vector_schema(const Range& range) {
  ordered_json schema = array_schema(number_schema(range));
  schema["minItems"] = 3;
  schema["maxItems"] = 3;
  return schema;
}

ordered_json three_numbers(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

/// A visitor of scene_fields.hpp that turns a default-constructed struct into an object's schema.
class SchemaWriter {
 public:
  template <class T>
  void field(const Key& key, const T& member) {
    ordered_json schema = schema_of(key, member);
    // An object left out has the defaults of all its keys; keys without a default are then absent.
    if (is_object<T> && !schema.contains("default")) schema["default"] = ordered_json::object();
    put(key, std::move(schema));
  }

  void direction(const Key& key, const Eigen::Vector3d& member) { field(key, member); }

  template <class T, class Variant>
  void alternative(const Key& key, const T& alternative, const Variant&) {
    put(key, schema_of(key, alternative));
    alternatives_.push_back({{"required", {key.name}}});
  }

  ordered_json finish() const {
    ordered_json schema = {{"type", "object"}, {"properties", properties_}};
    if (!required_.empty()) schema["required"] = required_;
    if (!alternatives_.empty()) schema["oneOf"] = alternatives_;
    schema["additionalProperties"] = false;
    return schema;
  }

 private:
  void put(const Key& key, ordered_json schema) {
    std::string text(key.text);
    if (key.chosen) text += ". Left out: chosen by accuracy (docs/howto/choose.md)";
    if (!key.unit.empty()) text += fmt::format(". Unit: {}", key.unit);
    ordered_json described = {{"description", text}};
    described.update(schema);
    if (key.required || key.chosen) described.erase("default");
    if (key.required) required_.emplace_back(key.name);
    properties_[std::string(key.name)] = std::move(described);
  }

  template <class T>
  static constexpr bool is_object = requires(T& t, SchemaWriter& w) {
    fields::describe(w, t);
  };

  static ordered_json with_default(ordered_json schema, ordered_json value) {
    schema["default"] = std::move(value);
    return schema;
  }

  static ordered_json schema_of(const Key& key, double member) {
    return with_default(number_schema(key.range), member);
  }
  static ordered_json schema_of(const Key& key, const std::optional<double>&) {
    return number_schema(key.range);
  }
  static ordered_json schema_of(const Key&, bool member) {
    return with_default({{"type", "boolean"}}, member);
  }
  template <std::integral Integer>
  static ordered_json schema_of(const Key& key, Integer member) {
    ordered_json schema = {{"type", "integer"}};
    add_range(schema, key.range);
    return with_default(std::move(schema), member);
  }
  static ordered_json schema_of(const Key&, const std::string& member) {
    return with_default({{"type", "string"}}, member);
  }
  static ordered_json schema_of(const Key& key, const Eigen::Vector3d& member) {
    return with_default(vector_schema(key.range), three_numbers(member));
  }
  static ordered_json schema_of(const Key& key, const std::vector<double>&) {
    return with_default(array_schema(number_schema(key.range)), ordered_json::array());
  }
  static ordered_json schema_of(const Key& key, const HistorySettings&) {
    return {{"anyOf", {number_schema(key.range), {{"const", "off"}}}}};
  }
  static ordered_json schema_of(const Key&, const TetMesh&) {
    return {{"type", "string"}, {"minLength", 1}};
  }
  static ordered_json schema_of(const Key&, const std::shared_ptr<const SolidSurface>&) {
    return {{"type", "string"}, {"minLength", 1}};
  }
  static ordered_json schema_of(const Key&, const FaceList&) {
    return {{"type", "string"}, {"minLength", 1}};
  }
  static ordered_json schema_of(const Key&, const RegionName&) {
    return {{"type", ordered_json::array({"string", "integer"})}};
  }
  static ordered_json schema_of(const Key&, const Eigen::Quaterniond&) {
    return {{"type", "object"},
            {"properties",
             {{"axis", vector_schema({})},
              {"angle", {{"description", "Unit: degrees"}, {"type", "number"}}}}},
            {"required", {"axis", "angle"}},
            {"additionalProperties", false},
            {"default", {{"axis", {0, 0, 1}}, {"angle", 0}}}};
  }
  template <class E>
  requires std::is_enum_v<E>
  static ordered_json schema_of(const Key&, E member) {
    ordered_json words = ordered_json::array();
    ordered_json own;
    for (const auto& [e, word] : fields::names_of(member)) {
      words.push_back(word);
      if (e == member) own = word;
    }
    return {{"enum", words}, {"default", own}};
  }
  template <class T>
  static ordered_json schema_of(const Key& key, const std::optional<T>&) {
    return schema_of(key, T{});
  }
  template <class T>
  static ordered_json schema_of(const Key& key, const std::vector<T>&) {
    ordered_json schema = array_schema(schema_of(Key{}, T{}));
    if (key.required) schema["minItems"] = 1;
    schema["default"] = ordered_json::array();
    return schema;
  }
  /// An object, or the name of a material.
  static ordered_json schema_of(const Key&, const Material& member) {
    SchemaWriter writer;
    const Key name = fields::material_name_key();
    writer.properties_[std::string(name.name)] = {
        {"description", name.text}, {"type", "string"}, {"enum", material_names()}};
    Material material = member;
    fields::describe(writer, material);
    ordered_json schema = writer.finish();
    schema["type"] = {"object", "string"};
    schema["if"] = {{"type", "string"}};
    schema["then"] = {{"enum", material_names()}};
    return schema;
  }
  /// With a mesh file or a shape.
  static ordered_json schema_of(const Key&, const BodySettings& member) {
    SchemaWriter writer;
    BodySettings body = member;
    fields::describe(writer, body);
    writer.field(fields::shape_key(), std::optional<ShapeSettings>());
    FileScale file;
    fields::describe(writer, file);
    for (const char* key : {"mesh", "shape"}) {
      writer.alternatives_.push_back({{"required", ordered_json::array({key})}});
    }
    return writer.finish();
  }
  static ordered_json schema_of(const Key&, const Solid& member) {
    SchemaWriter writer;
    Solid solid = member;
    fields::describe(writer, solid);
    FileScale file;
    fields::describe(writer, file);
    return writer.finish();
  }
  template <class T>
  requires std::is_class_v<T>
  static ordered_json schema_of(const Key&, const T& member) {
    SchemaWriter writer;
    T settings = member;
    fields::describe(writer, settings);
    return writer.finish();
  }

  ordered_json properties_ = ordered_json::object();
  std::vector<std::string> required_;
  std::vector<ordered_json> alternatives_;
};

}  // namespace

ordered_json scene_schema() {
  SceneFile file;
  SchemaWriter writer;
  fields::describe(writer, file);
  ordered_json schema = {
      {"$schema", "https://json-schema.org/draft/2020-12/schema"},
      {"title", "Scene of Sunder"},
      {"description",
       "A scene for `sunder run`. SI units. Written by `sunder run --schema`; the program knows "
       "exactly these keys and has exactly these defaults."}};
  schema.update(writer.finish());
  return schema;
}

}  // namespace sunder
