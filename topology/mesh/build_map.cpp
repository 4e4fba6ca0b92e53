// SPDX-License-Identifier: MIT
// A map from a surveyed mesh.
#include "topology/mesh/build_map.hpp"

#include "topology/mesh/survey.hpp"

namespace sunder {

Result<VolumeMap> build_map(const TetMesh& mesh, Severity bad_volume, MapKernel kernel) {
  Survey survey = survey_mesh(mesh, bad_volume);
  Result<VolumeMap> result;
  result.findings = std::move(survey.findings);
  if (has_error(result.findings)) return result;
  result.value.emplace(finish_rows(std::move(survey)));
  result.value->set_kernel(kernel);
  return result;
}

}  // namespace sunder
