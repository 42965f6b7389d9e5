// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/plan_notes.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "base/number_text.h"
#include "geometry/geometry_kind.h"

namespace fcl_prob::detail {
namespace {

// What is taken for wrong units: millimetres for metres are 1,000.
constexpr double kFarOff = 1e3;
constexpr double kFarBelow = 1e4;

double lengthOf(const PreparedGeometry& mesh) { return mesh.localBox().sizes().maxCoeff(); }

std::string metres(double length) {
  std::ostringstream text;
  text << std::setprecision(2) << length << " m";
  return text.str();
}

}  // namespace

void noteTolerance(const ProbabilityRequest& request, ProbabilityResult& result) {
  if (result.status != ProbabilityStatus::converged) return;
  double width = 0.0, allowed = 0.0;
  std::string what = "interval";
  if (result.confidence_interval) {
    width = 0.5 * result.confidence_interval->width();
    allowed = request.relative_tolerance * result.confidence_interval->upper;
  } else if (request.method == ProbabilityMethod::estimate && result.estimate) {
    what = "standard error";
    width = result.standard_error.value_or(0.0);
    allowed = request.relative_tolerance * *result.estimate;
  } else if (result.lower && result.upper) {
    width = *result.upper - *result.lower;
    allowed = request.relative_tolerance * *result.upper;
  }
  if (!(width > allowed)) return;
  result.plan.push_back(
      "stopped at the absolute tolerance " + numberText(request.absolute_tolerance) + ": the " +
      what + " is wider than the relative tolerance " + numberText(request.relative_tolerance) +
      " allows; make the absolute one smaller for a rare event");
}

std::optional<std::string> sizeNote(const PreparedGeometry& a, const PreparedGeometry& b,
                                    const GaussianDisplacement& displacement) {
  const auto isMesh = [](const PreparedGeometry& each) {
    return kindOf(each.geometry()) == GeometryKind::mesh;
  };
  if (displacement.rank() == 0 || !isMesh(a) || !isMesh(b)) return std::nullopt;
  const double of_a = lengthOf(a), of_b = lengthOf(b);
  const double longer = std::max(of_a, of_b), shorter = std::min(of_a, of_b);
  const double deviation = displacement.standardDeviations()[0];
  const std::string lengths = "A is " + metres(of_a) + " long, B " + metres(of_b);
  if (longer >= kFarOff * shorter) return lengths + ": are both in metres?";
  if (deviation >= kFarOff * longer || kFarBelow * deviation <= longer) {
    return lengths + ", the largest deviation " + metres(deviation) + ": are all in metres?";
  }
  return std::nullopt;
}

}  // namespace fcl_prob::detail
