// SPDX-License-Identifier: MIT
// Counters of reports as JSON, and back.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "topology/base/counters.hpp"

namespace sunder {

/// The counters of a report that have a name, by it.
template <class Report>
nlohmann::ordered_json counters_json(const Report& report) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for_each_counter<Report>([&](const auto& counter) {
    if (!counter.name.empty()) json[std::string(counter.name)] = report.*counter.member;
  });
  return json;
}

/// The same read; false where one is missing or no count.
template <class Report>
bool read_counters(Report& report, const nlohmann::ordered_json& json) {
  if (!json.is_object()) return false;
  bool complete = true;
  for_each_counter<Report>([&](const auto& counter) {
    const auto value = json.find(std::string(counter.name));
    complete = complete && value != json.end() && value->is_number_unsigned();
    if (complete) value->get_to(report.*counter.member);
  });
  return complete;
}

}  // namespace sunder
