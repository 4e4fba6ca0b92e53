// SPDX-License-Identifier: MIT
// Entities for MSH: the cells' own, or substitutes.
#include "topology/io/msh/msh_entities.hpp"

#include <map>

namespace sunder::io {
namespace {

/// The lists of one dimension that have cells.
std::vector<CellKind> kinds_of(const FileMesh& mesh, int dimension) {
  std::vector<CellKind> kinds;
  for (const CellKind kind : all_cell_kinds) {
    if (traits_of(kind).dimension == dimension && rows_of(mesh, kind).count > 0) {
      kinds.push_back(kind);
    }
  }
  return kinds;
}

bool have_one_group(const FileMesh& mesh, const std::vector<CellKind>& kinds,
                    const MshEntities& entities) {
  std::map<std::int32_t, std::int32_t> group;
  for (const CellKind kind : kinds) {
    const std::vector<std::int32_t>& region = columns_of(mesh, kind).region;
    const std::vector<std::int32_t>& entity = entities.of[index_of(kind)];
    for (std::size_t i = 0; i < entity.size(); ++i) {
      // Runs of one entity are long.
      if (i > 0 && entity[i] == entity[i - 1] && (region.empty() || region[i] == region[i - 1])) {
        continue;
      }
      const std::int32_t own = region.empty() ? 0 : region[i];
      if (group.emplace(entity[i], own).first->second != own) return false;
    }
  }
  return true;
}

}  // namespace

MshEntities msh_entities(const FileMesh& mesh, int version) {
  MshEntities entities;
  for (int d = 0; d <= 3; ++d) {
    const std::vector<CellKind> kinds = kinds_of(mesh, d);
    bool has_labels = false;
    for (const CellKind kind : kinds) {
      const CellColumns& cells = columns_of(mesh, kind);
      has_labels = has_labels || !cells.region.empty() || !cells.entity.empty();
    }
    const std::int32_t nothing = has_labels && version >= 40 ? 0 : 1;
    for (const CellKind kind : kinds) {
      const CellColumns& cells = columns_of(mesh, kind);
      entities.of[index_of(kind)] =
          !cells.entity.empty()   ? cells.entity
          : !cells.region.empty() ? cells.region
                                  : std::vector<std::int32_t>(rows_of(mesh, kind).count, nothing);
    }
    if (version < 40 || have_one_group(mesh, kinds, entities)) continue;
    for (const CellKind kind : kinds) {
      const CellColumns& cells = columns_of(mesh, kind);
      std::vector<std::int32_t>& entity = entities.of[index_of(kind)];
      entity = cells.region.empty() ? std::vector<std::int32_t>(entity.size(), 0) : cells.region;
      if (!cells.entity.empty() && cells.entity != entity) entities.lost += entity.size();
    }
  }
  return entities;
}

}  // namespace sunder::io
