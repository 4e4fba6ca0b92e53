// SPDX-License-Identifier: MIT
// Scenes of files, where there are any.
#include "apps/host/engine.hpp"

sunder_engine* sunder_open(const char* path, const char* const* settings, uint32_t setting_count) {
  return sunder::engine_of([=] {
    const std::vector<std::string> changes(settings, settings + setting_count);
    return sunder::read_scene(path, changes);
  });
}
