// SPDX-License-Identifier: MIT
// What is wrong with contact settings.
#include <cmath>
#include <string>

#include "mechanics/contact/contact.hpp"

namespace sunder {
namespace {

struct Range {
  const char* key;
  double value;
  double least;
  const char* unit;
};

Finding out_of_range(const Range& range, std::string_view place) {
  Finding f;
  f.code = "bad_contact_setting";
  f.text = std::string(place) + "." + range.key + " is " + std::to_string(range.value) +
           range.unit + ", expected at least " + std::to_string(range.least) + range.unit;
  f.remedy = "give a finite number in that range, or leave the key out for the default";
  return f;
}

}  // namespace

std::vector<Finding> check(const ContactSettings& s, std::string_view place) {
  std::vector<Finding> findings;
  const Range ranges[] = {
      {"friction", s.friction, 0, ""},
      {"compliance", s.compliance, 0, " m/N"},
      {"push_out_speed", s.push_out_speed, 0, " m/s"},
      {"allowed_penetration", s.allowed_penetration, 0, " m"},
      {"max_iterations", static_cast<double>(s.max_iterations), 1, ""},
      {"tolerance", s.tolerance, 0, ""},
      {"max_passes", static_cast<double>(s.max_passes), 1, ""},
      {"max_contacts_per_component", static_cast<double>(s.max_contacts_per_component), 1, ""},
  };
  if (!(s.ball_share > 0 && s.ball_share <= 1)) {
    Finding f;
    f.code = "bad_contact_setting";
    f.text = std::string(place) + ".ball_share is " + std::to_string(s.ball_share) +
             ", expected above 0 and at most 1";
    f.remedy = "1 is the paper's bounding ball; leave the key out for the default";
    findings.push_back(f);
  }
  for (const Range& range : ranges) {
    if (!(std::isfinite(range.value) && range.value >= range.least)) {
      findings.push_back(out_of_range(range, place));
    }
  }
  return findings;
}

}  // namespace sunder
