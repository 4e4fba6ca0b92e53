// SPDX-License-Identifier: MIT
// A look at every number of a JSON value.
#include "apps/scene/json_text.hpp"

#include <cmath>

namespace sunder {

std::optional<std::string> first_no_number(const nlohmann::ordered_json& json) {
  if (json.is_number_float() && !std::isfinite(json.get<double>())) return "";
  if (!json.is_structured()) return std::nullopt;
  for (const auto& [key, value] : json.items()) {  // of arrays the keys are rows
    const std::optional<std::string> inner = first_no_number(value);
    if (inner) return inner->empty() ? key : key + "." + *inner;
  }
  return std::nullopt;
}

}  // namespace sunder
