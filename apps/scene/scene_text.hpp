// SPDX-License-Identifier: MIT
// JSON text with the line of every value, and `--set` changes on it; knows nothing of scenes.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "topology/base/finding.hpp"

namespace sunder {

/// A JSON document that still knows where its values stood.
struct SceneText {
  nlohmann::json root;
  /// The file's name, for findings; empty where there is no file.
  std::string file;
  /// Line (from 1) of each value by its JSON pointer ("/bodies/0/mesh"); the values that
  /// `apply_setting` put in have none.
  std::map<std::string, std::size_t> line;
};

/// Reads JSON (RFC 8259: no comments, no trailing commas), keeping lines. Errors as findings with
/// line and column: `syntax_error`, `repeated_key` (every one of them), `nested_too_deeply` (more
/// than 64 levels, which no scene needs).
Result<SceneText> parse_scene_text(std::string_view bytes, const std::string& file);

/// Changes one value: `setting` is `dotted.path=value`, as in `gravity.ramp_time=2` or
/// `bodies.0.material.density=2400`. Numbers in the path are rows of arrays and must exist; objects
/// on the way are made where absent. The value is read as JSON, and as plain text where it is none.
/// Errors: `bad_setting`. Whether the key is known is the reader's affair.
std::vector<Finding> apply_setting(SceneText& text, const std::string& setting);

/// Keys that a document gives, in and outside of objects, as `--set` takes them: "contact",
/// "contact.friction", "bodies.0.order".
std::vector<std::string> given_keys(const nlohmann::json& root);

/// JSON pointer as people write it in `--set`: "/bodies/0/mesh" gives "bodies.0.mesh".
std::string dotted(const std::string& pointer);

/// One key of a JSON pointer with `~` and `/` escaped.
std::string pointer_token(const std::string& key);

/// The word of `known` with the smallest edit distance to `word` (the first of equals), or empty
/// where even that one changes more than half of `word`. Two swapped neighbours are one change.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

/// A JSON value in at most about 60 characters, for messages.
std::string shown(const nlohmann::json& value);

/// Findings as a terminal can show them: names of files and keys may hold anything, and control
/// bytes become \x1b and so on.
void make_plain(std::vector<Finding>& findings);

}  // namespace sunder
