// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "slopes.h"

#include <array>
#include <cmath>
#include <sstream>

#include "ask.h"

namespace fcl_prob_audit {
namespace {

using namespace fcl_prob;

/// Slopes to either side, and what the bounds of P leave open of them.
struct Slopes {
  double ahead, behind, open;

  double middle() const { return 0.5 * (ahead + behind); }
};

std::optional<Slopes> slopesAt(const Scene& scene, int axis, double step) {
  std::array<Bounds, 3> at;
  for (int i = 0; i < 3; ++i) {
    Scene moved = scene;
    moved.request.gradient = false;
    moved.request.threshold.reset();
    moved.request.relative_tolerance = 1e-6;
    for (Displacement& displacement : moved.displacements) {
      displacement.mean[axis] += (i - 1) * step;
    }
    const Answer answer = ask(moved);
    if (!answer || !answer.result->lower || !answer.result->upper) return std::nullopt;
    at[static_cast<std::size_t>(i)] = {*answer.result->lower, *answer.result->upper};
  }
  const double open = (at[0].width() + at[1].width() + at[2].width()) / step;
  return Slopes{(at[2].middle() - at[1].middle()) / step, (at[1].middle() - at[0].middle()) / step,
                open};
}

/// Whether P comes in intervals that are narrow enough for differences.
bool isNarrow(const ProbabilityResult& result) {
  return result.lower && result.upper && *result.upper - *result.lower < 1e-3;
}

}  // namespace

std::optional<std::string> slopesOutside(const Scene& scene, const ProbabilityResult& result) {
  double size = 0.0;
  for (const Member& member : scene.a) size = std::max(size, extentOf(member.shape));
  for (const Displacement& displacement : scene.displacements) {
    if (displacement.rotated) return std::nullopt;
    size = std::min(size, displacement.sigma.maxCoeff());
  }
  const double step = 1e-2 * size;
  double largest = 0.0;
  for (const Displacement& displacement : scene.displacements) {
    largest = std::max(largest, displacement.mean.cwiseAbs().maxCoeff());
  }
  // Steps that rounding of the mean would change are no use.
  if (!(step > 1e-9 * largest) || !(step > 0.0) || !isNarrow(result)) return std::nullopt;
  for (int axis = 0; axis < 3; ++axis) {
    const auto coarse = slopesAt(scene, axis, step);
    if (!coarse) return std::nullopt;
    const double lower = (*result.gradient_lower)[axis], upper = (*result.gradient_upper)[axis];
    const double outside = std::max(lower - coarse->middle(), coarse->middle() - upper);
    if (!(outside > 2.0 * coarse->open)) continue;
    const auto fine = slopesAt(scene, axis, 0.5 * step);
    if (!fine) return std::nullopt;
    const double bend = std::abs(coarse->ahead - coarse->behind) +
                        std::abs(fine->ahead - fine->behind) +
                        std::abs(fine->middle() - coarse->middle());
    if (!(outside > 4.0 * bend + 2.0 * fine->open)) continue;
    std::ostringstream out;
    out.precision(12);
    out << "component " << axis << ": slope " << fine->middle() << " by a step of " << 0.5 * step;
    return out.str();
  }
  return std::nullopt;
}

}  // namespace fcl_prob_audit
