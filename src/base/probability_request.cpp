// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/probability_request.h"

#include <array>
#include <cmath>
#include <sstream>
#include <string>

#include "base/refuse_band.h"
#include "fcl_prob/exceptions.h"

namespace fcl_prob {
namespace {

struct NamedMethod {
  ProbabilityMethod method;
  const char* name;
};

constexpr std::array<NamedMethod, 9> kMethods = {{
    {ProbabilityMethod::automatic, "auto"},
    {ProbabilityMethod::interval, "interval"},
    {ProbabilityMethod::estimate, "estimate"},
    {ProbabilityMethod::exact, "exact"},
    {ProbabilityMethod::convex_pcd, "convex-pcd"},
    {ProbabilityMethod::general_pcd, "general-pcd"},
    {ProbabilityMethod::general_pcd_min, "general-pcd-min"},
    {ProbabilityMethod::monte_carlo, "monte-carlo"},
    {ProbabilityMethod::rare_event, "rare-event"},
}};

[[noreturn]] void refuse(const char* field, double value, const char* range) {
  std::ostringstream out;
  out << field << " is " << value << ", must be " << range;
  throw InvalidRequest(out.str());
}

void requireTolerance(const char* field, double value) {
  if (!std::isfinite(value) || value < 0.0) refuse(field, value, "finite and not negative");
}

void validateTolerances(const ProbabilityRequest& request) {
  requireTolerance("relative_tolerance", request.relative_tolerance);
  requireTolerance("absolute_tolerance", request.absolute_tolerance);
  if (request.relative_tolerance == 0.0 && request.absolute_tolerance == 0.0) {
    throw InvalidRequest("relative_tolerance and absolute_tolerance are both 0");
  }
}

void validateLimits(const ProbabilityRequest& request) {
  if (request.time_limit && !(*request.time_limit > 0.0)) {
    refuse("time_limit", *request.time_limit, "positive (seconds)");
  }
  if (request.max_cells == 0) refuse("max_cells", 0.0, "at least 1");
  if (request.max_memory == 0) refuse("max_memory", 0.0, "at least 1 (byte)");
  if (request.samples == 0) refuse("samples", 0.0, "at least 1");
  if (request.threads == 0) refuse("threads", 0.0, "at least 1");
}

void validateBand(const std::string& name, const Band& band) {
  // Sums of a few of them must not overflow.
  constexpr double kWidest = 1e100;
  const auto require = [&](const char* side, double value) {
    if (value >= 0.0 && value <= kWidest) return;
    refuse((name + side).c_str(), value, "finite and not negative (metres)");
  };
  require(".outward", band.outward);
  require(".inward", band.inward);
}

void validateBands(const ProbabilityRequest& request) {
  validateBand("band_a", request.band_a);
  validateBand("band_b", request.band_b);
  const bool known = request.method == ProbabilityMethod::automatic ||
                     request.method == ProbabilityMethod::interval;
  if (!request.hasBand() || known) return;
  throw InvalidRequest("method " + toString(request.method) +
                       " knows no bands around the shapes: interval does");
}

}  // namespace

void validateRequest(const ProbabilityRequest& request) {
  toString(request.method);
  if (request.contact == ContactMeaning::contained) {
    throw InvalidRequest("contact = contained: asked of pairs of objects only");
  }
  if (request.contact != ContactMeaning::fcl && request.contact != ContactMeaning::solid) {
    refuse("contact", static_cast<double>(request.contact), "one of ContactMeaning");
  }
  validateTolerances(request);
  if (request.threshold && !(*request.threshold >= 0.0 && *request.threshold <= 1.0)) {
    refuse("threshold", *request.threshold, "a probability, from 0 to 1");
  }
  if (!(request.confidence > 0.0 && request.confidence < 1.0)) {
    refuse("confidence", request.confidence, "between 0 and 1, both excluded");
  }
  validateLimits(request);
  validateBands(request);
}

void detail::refuseBand(const ProbabilityRequest& request, const std::string& by) {
  if (request.hasBand()) throw InvalidRequest("bands around the shapes: not for " + by);
}

std::string toString(ProbabilityMethod method) {
  for (const NamedMethod& named : kMethods) {
    if (named.method == method) return named.name;
  }
  throw InvalidRequest("method is " + std::to_string(static_cast<int>(method)) +
                       ", not one of ProbabilityMethod");
}

std::optional<ProbabilityMethod> methodFromString(const std::string& name) {
  for (const NamedMethod& named : kMethods) {
    if (name == named.name) return named.method;
  }
  return std::nullopt;
}

std::vector<std::string> methodNames() {
  std::vector<std::string> names;
  for (const NamedMethod& named : kMethods) names.emplace_back(named.name);
  return names;
}

}  // namespace fcl_prob
