// SPDX-License-Identifier: MIT
// The findings of `check` about a damaged map, for its tests.
#pragma once

#include <algorithm>

#include "tests/support/built.hpp"

namespace sunder::test {

using Ids = std::vector<std::int64_t>;

/// One finding, with this rule for its text, and the first of these rows.
inline void require_only(const std::vector<Finding>& findings, const std::string& rule,
                         const Ids& ids) {
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].code == "map_damaged");
  CHECK(findings[0].severity == Severity::error);
  CHECK(findings[0].remedy.starts_with("report this"));
  CHECK(findings[0].text == rule);
  CHECK(findings[0].count == ids.size());
  CHECK(findings[0].ids ==
        Ids(ids.begin(), ids.begin() + std::min<std::ptrdiff_t>(16, std::ssize(ids))));
}

/// Among the findings is one with this rule for its text, and these rows.
inline void require_among(const std::vector<Finding>& findings, const std::string& rule,
                          const Ids& ids) {
  for (const Finding& f : findings) {
    if (f.text == rule) return require_only({f}, rule, ids);
  }
  FAIL("nobody says: " << rule);
}

inline std::int64_t id(HalfFaceId f) { return f.value; }

inline Ids sorted(Ids ids) {
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace sunder::test
