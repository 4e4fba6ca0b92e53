// SPDX-License-Identifier: MIT
// Check of the integrator's settings.
#include "mechanics/state/settings.hpp"

#include <cmath>
#include <cstdio>
#include <string>

namespace sunder {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

Finding refused(const char* code, std::string text, const char* remedy) {
  Finding finding;
  finding.code = code;
  finding.text = std::move(text);
  finding.remedy = remedy;
  return finding;
}

/// What only some integrators or models take.
std::vector<Finding> check_baseline(const IntegratorSettings& settings, const std::string& at) {
  std::vector<Finding> findings;
  const bool corotational = settings.model == ElasticModel::corotational;
  const bool damped = settings.damping.mass_factor != 0 || settings.damping.stiffness_factor != 0;
  const bool takes_damping = settings.integrator == Integrator::floating_frame ||
                             (settings.integrator == Integrator::implicit_euler && !corotational);
  if (damped && !takes_damping) {
    findings.push_back(refused(
        "damping_not_supported",
        at + ".damping is set, but only floating_frame and, with the model rigid_reference, "
             "implicit_euler have any.",
        "Leave the damping out, or use floating_frame."));
  }
  if (corotational && is_floating(settings.integrator)) {
    findings.push_back(refused("model_not_supported",
                               "model is corotational, but " + at +
                                   ".method moves bodies in one frame, which is the model "
                                   "rigid_reference.",
                               "Take the method implicit_euler, or leave the model out."));
  }
  if (!(settings.tolerance > 0 && settings.tolerance <= 0.1)) {
    findings.push_back(refused(
        "bad_tolerance",
        at + ".tolerance is " + number(settings.tolerance) + "; allowed is above 0 up to 0.1.",
        "Leave it out: 1e-6."));
  }
  if (settings.max_iterations < 1 || settings.broyden_memory < 1 || settings.max_sub_steps < 1) {
    findings.push_back(refused(
        "bad_iterations",
        at + ".max_iterations, " + at + ".broyden_memory and " + at + ".max_sub_steps begin at 1.",
        "Leave them out."));
  }
  return findings;
}

}  // namespace

std::vector<Finding> check(const IntegratorSettings& settings, std::string_view place) {
  std::vector<Finding> findings;
  const std::string at(place);
  // Written so that a NaN fails each test.
  if (!(settings.time_step > 0 && std::isfinite(settings.time_step))) {
    findings.push_back(refused("bad_time_step",
                               at + ".time_step is " + number(settings.time_step) +
                                   "; allowed is a finite number above 0 s.",
                               "Start with 1e-3 s."));
  }
  if (!(settings.rho_infinity >= 0 && settings.rho_infinity <= 0.5)) {
    findings.push_back(
        refused("bad_rho_infinity",
                at + ".rho_infinity is " + number(settings.rho_infinity) + "; allowed is 0 to 0.5.",
                "Leave it out: 0 does not ring."));
  }
  const auto need_damping = [&](const char* key, double value, const char* unit) {
    if (value >= 0 && std::isfinite(value)) return;
    findings.push_back(refused("bad_damping",
                               at + ".damping." + key + " is " + number(value) +
                                   "; allowed is a finite number from 0 " + unit + " on.",
                               "Leave it out for no damping."));
  };
  need_damping("mass_factor", settings.damping.mass_factor, "1/s");
  need_damping("stiffness_factor", settings.damping.stiffness_factor, "s");
  for (Finding& f : check_baseline(settings, at)) findings.push_back(std::move(f));
  return findings;
}

}  // namespace sunder
