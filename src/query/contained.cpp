// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/contained.h"

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <utility>

#include "base/constants.h"
#include "base/decision.h"
#include "base/refuse_band.h"
#include "base/statistics.h"
#include "base/until_no.h"
#include "convex/support_shape.h"
#include "fcl_prob/exceptions.h"
#include "geometry/geometry_kind.h"
#include "geometry/occupancy.h"
#include "geometry/outer_mesh.h"
#include "geometry/validation.h"
#include "query/parts_loop.h"

namespace fcl_prob::detail {
namespace {

/// Far more than rotating and adding up coordinates rounds, as a share of them.
constexpr double kWidthRounding = 1e-12;

/// Both are asked so often at the most, each time for what the last answers tell is needed: first
/// for no more than this, of their own.
constexpr int kMostAsked = 4;
constexpr double kFirstTolerance = 0.1;

/// Of an interval that does not decide, and of what is allowed: what either may leave open next.
constexpr double kShareOfWidth = 0.25;
constexpr double kShareOfTolerance = 0.45;

bool isMesh(const PreparedGeometry& geometry) {
  return kindOf(geometry.geometry()) == GeometryKind::mesh;
}

[[noreturn]] void refuse(const char* name, const std::string& what) {
  throw UnsupportedGeometry(std::string("contact = contained: object ") + name + " is " + what);
}

/// Of several, some may be within B and others not, or B's be around a cavity that is within A.
void requireOnePiece(const PreparedGeometry& geometry, const char* name) {
  if (!isMesh(geometry)) return;
  const auto pieces = geometry.solid(ContactMeaning::solid)->partPoints().size();
  if (pieces != 1) refuse(name, "in " + std::to_string(pieces) + " pieces, not in one");
}

ContainedPair::Prepared surfaceOf(ContainedPair::Prepared b) {
  if (isMesh(*b)) return b;
  const fcl::NODE_TYPE type = b->geometry().getNodeType();
  if (type != fcl::GEOM_BOX && type != fcl::GEOM_CONVEX) {
    refuse("B", "a " + nodeTypeName(type) + ", not a closed mesh, a Box or a Convex");
  }
  const auto faces =
      buildModel<fcl::OBBRSSd>(outerMesh(b->geometry(), {0.0, Eigen::Vector3d::Zero(), 0.0}));
  copyOccupancy(b->geometry(), *faces);
  return std::make_shared<const PreparedGeometry>(faces, "object B");
}

/// How far an object reaches along each axis of the world, from one side to the other.
using Widths = std::array<Bounds, 3>;

Widths widthsOf(const PreparedGeometry& geometry, const fcl::Transform3d& pose) {
  const Eigen::Matrix3d& turn = pose.linear();
  Eigen::Vector3d lowest = Eigen::Vector3d::Constant(kInfinity), highest = -lowest;
  double size = 0.0;
  if (isMesh(geometry)) {
    const MeshView mesh = meshView(geometry.geometry());
    for (int v = 0; v < mesh.vertex_count; ++v) {
      const Eigen::Vector3d turned = turn * mesh.vertices[v];
      lowest = lowest.cwiseMin(turned);
      highest = highest.cwiseMax(turned);
      size = std::max(size, mesh.vertices[v].norm());
    }
  } else {
    const SupportShape shape = supportShape(geometry.geometry());
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d along = turn.row(k).transpose();
      lowest[k] = -shape.supportValue(-along);
      highest[k] = shape.supportValue(along);
    }
    size = shape.radius();
  }
  const double rounding = kWidthRounding * size;
  Widths widths;
  for (int k = 0; k < 3; ++k) {
    const double width = highest[k] - lowest[k];
    widths[static_cast<std::size_t>(k)] = {width - rounding, width + rounding};
  }
  return widths;
}

/// Certainly, along some axis.
bool isWider(const Widths& one, const Widths& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (one[k].lower > other[k].upper) return true;
  }
  return false;
}

void validate(const ProbabilityRequest& request) {
  refuseBand(request, "contact = contained");
  if (request.method == ProbabilityMethod::automatic ||
      request.method == ProbabilityMethod::interval ||
      request.method == ProbabilityMethod::estimate) {
    return;
  }
  throw InvalidRequest("contact = contained: method " + toString(request.method) +
                       " does not tell it: interval and estimate do");
}

ProbabilityResult never(const ProbabilityRequest& request) {
  ProbabilityResult result;
  result.lower = result.upper = 0.0;
  if (request.method == ProbabilityMethod::estimate) result.estimate = result.standard_error = 0.0;
  result.status = ProbabilityStatus::exact;
  result.decision = decisionOf({0.0, 0.0}, request);
  result.plan.push_back("A reaches further than B along an axis, and is never within it");
  return result;
}

/// What two answers tell of the difference of what they estimate. The same random numbers may be in
/// both: their errors are added, whatever they have to do with each other.
void takeEstimates(const ProbabilityResult& overlap, const ProbabilityResult& touch,
                   ProbabilityResult& result) {
  if (!overlap.estimate || !touch.estimate) return;
  const double most = result.upper.value_or(1.0);
  result.estimate =
      std::clamp(*overlap.estimate - *touch.estimate, result.lower.value_or(0.0), most);
  result.standard_error = *overlap.standard_error + *touch.standard_error;
}

void takeGradients(const ProbabilityResult& overlap, const ProbabilityResult& touch,
                   ProbabilityResult& result) {
  if (!overlap.gradient || !touch.gradient) return;
  result.gradient = *overlap.gradient - *touch.gradient;
  if (overlap.gradient_lower && touch.gradient_lower) {
    const Eigen::Vector3d lower = *overlap.gradient_lower - *touch.gradient_upper;
    const Eigen::Vector3d upper = *overlap.gradient_upper - *touch.gradient_lower;
    // Each is rounded by half an ulp of itself.
    result.gradient_lower = lower - kEpsilon * lower.cwiseAbs();
    result.gradient_upper = upper + kEpsilon * upper.cwiseAbs();
  }
  if (overlap.gradient_standard_error && touch.gradient_standard_error) {
    result.gradient_standard_error =
        *overlap.gradient_standard_error + *touch.gradient_standard_error;
  }
}

double errorOf(const PartsLoop& loop) {
  double error = 0.0;
  for (const auto& answer : loop.answers()) {
    error += answer && answer->standard_error ? *answer->standard_error : kInfinity;
  }
  return error;
}

/// What the difference of both may be off by, by what they estimate so far.
double toleranceOf(const ProbabilityRequest& request, const PartsLoop& loop) {
  const auto& [overlap, touch] = std::tie(loop.answers()[0], loop.answers()[1]);
  if (!overlap || !touch || !overlap->estimate || !touch->estimate) return 0.0;
  return request.toleranceAt(std::max(0.0, *overlap->estimate - *touch->estimate));
}

/// What either may leave open for the request to be satisfied, as far as the answers tell; 0 where
/// nothing more is wanted.
double mayBeOpen(const ProbabilityRequest& request, const Bounds& now, const PartsLoop& loop) {
  if (request.method == ProbabilityMethod::estimate) {
    const double allowed = toleranceOf(request, loop);
    return errorOf(loop) <= allowed ? 0.0 : 0.5 * allowed;
  }
  if (satisfied(now, request)) return 0.0;
  if (request.threshold) return kShareOfWidth * now.width();
  return kShareOfTolerance * request.toleranceAt(now.upper);
}

void narrow(const ProbabilityRequest& request, const PartsLoop::Combine& combine, PartsLoop& loop) {
  ProbabilityRequest of_part = request;
  of_part.threshold.reset();
  const bool estimates = request.method == ProbabilityMethod::estimate;
  if (!estimates) {
    of_part.relative_tolerance = std::max(of_part.relative_tolerance, kFirstTolerance);
  }
  loop.askEach([&](std::size_t) { return std::optional(of_part); });
  of_part.relative_tolerance = 0.0;
  for (int asked = 1; asked < kMostAsked && !loop.isOut(); ++asked) {
    const double most = mayBeOpen(request, combine(loop.bounds()), loop);
    if (!(most > 0.0)) return;
    of_part.absolute_tolerance = most;
    loop.askEach([&](std::size_t part) -> std::optional<ProbabilityRequest> {
      const auto& answer = loop.answers()[part];
      const double open = estimates ? *answer->standard_error : loop.bounds()[part].width();
      if (open <= most) return std::nullopt;
      return of_part;
    });
  }
  if (estimates) return;
  while (!satisfied(combine(loop.bounds()), request) && loop.narrowWidest(of_part)) continue;
}

/// \param is_difference  else P is only known to be no more than that: nothing is estimated
ProbabilityResult told(const ProbabilityRequest& request, const Bounds& interval,
                       bool is_difference, PartsLoop& loop) {
  ProbabilityResult result;
  const bool estimates = request.method == ProbabilityMethod::estimate;
  result.method = estimates ? ProbabilityMethod::estimate : ProbabilityMethod::interval;
  result.lower = interval.lower;
  result.upper = interval.upper;
  result.decision = decisionOf(interval, request);
  const auto limit = loop.isOut() ? loop.out() : ProbabilityStatus::resolution_limit;
  const auto& [overlap, touch] = std::tie(loop.answers()[0], loop.answers()[1]);
  if (is_difference && overlap && touch) {
    takeEstimates(*overlap, *touch, result);
    takeGradients(*overlap, *touch, result);
  }
  const bool is_estimated = result.estimate && errorOf(loop) <= toleranceOf(request, loop);
  result.status =
      is_estimated ? ProbabilityStatus::converged : satisfied(interval, request).value_or(*limit);
  for (const auto& answer : loop.answers()) {
    if (!answer) continue;
    addStatistics(answer->statistics, result.statistics);
    result.plan.insert(result.plan.end(), answer->plan.begin(), answer->plan.end());
  }
  result.plan.push_back("contained: P that the solids overlap, less P that their surfaces meet");
  return result;
}

}  // namespace

ContainedPair::ContainedPair(Prepared a, const fcl::Transform3d& pose_a, Prepared b,
                             const fcl::Transform3d& pose_b)
    : a_(std::move(a)), b_(surfaceOf(std::move(b))) {
  validatePose(pose_a, "object A");
  validatePose(pose_b, "object B");
  if (!isMesh(*a_) && !a_->isConvex()) {
    refuse("A", "a " + nodeTypeName(a_->geometry().getNodeType()) + ", not a mesh or convex");
  }
  requireOnePiece(*a_, "A");
  requireOnePiece(*b_, "B");
  const Widths of_a = widthsOf(*a_, pose_a), of_b = widthsOf(*b_, pose_b);
  is_too_large_ = isWider(of_a, of_b);
  holds_no_other_ = isWider(of_b, of_a);
}

/// Of overlap less touch, rounded outwards: a difference by no more than half an ulp of itself, and
/// not at all where nothing is taken away.
Bounds ContainedPair::difference(const Bounds& overlap, const Bounds& touch) const {
  const auto less = [](double one, double other, double sign) {
    return other > 0.0 ? (one - other) * (1.0 + sign * kEpsilon) : one;
  };
  return {holds_no_other_ ? std::max(0.0, less(overlap.lower, touch.upper, -1.0)) : 0.0,
          std::clamp(less(overlap.upper, touch.lower, 1.0), 0.0, overlap.upper)};
}

ProbabilityResult ContainedPair::answer(const ProbabilityRequest& request, const Ask& ask) const {
  validate(request);
  if (is_too_large_) return never(request);
  const PairQuery pair(a_, b_);
  const PartsLoop::Ask ask_part = [&](std::size_t part, const ProbabilityRequest& of_part) {
    ProbabilityRequest contact = of_part;
    contact.contact = part == 0 ? ContactMeaning::solid : ContactMeaning::fcl;
    return ask(pair, contact);
  };
  const PartsLoop::Combine combine = [this](const std::vector<Bounds>& parts) {
    return difference(parts[0], parts[1]);
  };
  PartsLoop loop(request, ask_part, combine, {{0.0, 1.0}, {0.0, 1.0}});
  narrow(request, combine, loop);
  return told(request, combine(loop.bounds()), holds_no_other_, loop);
}

ProbabilityResult PairQuery::answerContained(const fcl::Transform3d& pose_a,
                                             const fcl::Transform3d& pose_b,
                                             const Displacement& displacement,
                                             const ProbabilityRequest& request) const {
  ProbabilityRequest of_contact = ofOneCall(request);
  of_contact.contact = ContactMeaning::fcl;
  validateRequest(of_contact);
  const ContainedPair pair(a_, pose_a, b_, pose_b);
  return pair.answer(of_contact, [&](const PairQuery& query, const ProbabilityRequest& of_part) {
    const auto answer = [&](const auto& one) { return query.answer(pose_a, pose_b, one, of_part); };
    return std::visit(answer, displacement);
  });
}

}  // namespace fcl_prob::detail
