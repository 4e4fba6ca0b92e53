// SPDX-License-Identifier: MIT
// JSON as every file and every --json has it: always valid, whatever bytes a name holds.
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "topology/io/files/printing.hpp"

namespace sunder {

/// The place of the first number that is not finite, which JSON writes as null:
/// "energy.kinetic.end". Nothing where all are.
std::optional<std::string> first_no_number(const nlohmann::ordered_json& json);

/// Prints a value and the end of its line, on standard output where no stream is given.
template <class Json>
void print_json(const Json& json, std::FILE* stream = stdout) {
  write_text(stream, json_text(json) + "\n");
}

}  // namespace sunder
