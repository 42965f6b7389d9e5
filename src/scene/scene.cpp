// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/scene.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/number_text.h"
#include "convex/resolved_part.h"
#include "fcl_prob/exceptions.h"
#include "scene/band_margin.h"
#include "scene/closest_approach.h"
#include "scene/turning_margin.h"

namespace fcl_prob::detail {
namespace {

// Whitening stretches the objects by this ratio at most where the frame is turned: a long stretch
// that is not along an axis would make their bounding boxes useless.
constexpr double kMostStretched = 30.0;

// Products of three whitened lengths have to be finite.
constexpr double kMostWhitened = 1e100;

void requireFitting(const GaussianDisplacement& displacement, double size) {
  if (displacement.rank() == 0) return;
  const double least = displacement.standardDeviations()[displacement.rank() - 1];
  if (size <= kMostWhitened * least) return;
  throw InvalidDistribution("a truncated displacement of a standard deviation of " +
                            numberText(least) + " m, of objects of " + numberText(size) +
                            " m: less than 1e-100 of them");
}

// The objects with the bands of the request among their motions.
class BandedPair {
 public:
  /// \param moved  as of detail::whiten()
  BandedPair(const PartitionObject& a, const PartitionObject& b, const ProbabilityRequest& request,
             double moved)
      : a_(a), b_(b), request_(request), moved_(moved), swept_(a.isSwept() || b.isSwept()) {
    if (!request.hasBand() && !swept_) return;
    if (a.motion || b.motion) throw InvalidRequest("bands around shapes that turn at random");
    if (request.hasBand() && swept_) throw InvalidRequest("bands around shapes that are swept");
    if (swept_) return;
    of_a_.ball = std::max(request.band_a.outward, request.band_a.inward);
    of_b_.ball = std::max(request.band_b.outward, request.band_b.inward);
    a_.motion = &of_a_;
    b_.motion = &of_b_;
  }

  BandedPair(const BandedPair&) = delete;
  BandedPair& operator=(const BandedPair&) = delete;

  void whiten(const Whitening& whitening, WhitenedPair& pair) const {
    detail::whiten(a_, b_, whitening, pair, moved_);
    const Eigen::Matrix3d& w = whitening.matrix();
    if (swept_) pair.band = std::make_shared<const BandMargin>(a_, b_, w);
    pair.turning.reset();
    const bool turns = (a_.motion || b_.motion) && !request_.hasBand() && !swept_ &&
                       (!a_.motion || a_.tree->isMesh()) && (!b_.motion || b_.tree->isMesh());
    if (turns) pair.turning = std::make_shared<const TurningMargin>(a_, b_, w);
    if (!request_.hasBand()) return;
    pair.band =
        std::make_shared<const BandMargin>(request_.band_a.outward + request_.band_b.outward,
                                           request_.band_a.inward + request_.band_b.inward, w);
  }

 private:
  PartitionObject a_;
  PartitionObject b_;
  const ProbabilityRequest& request_;
  double moved_;
  bool swept_;
  PointMotion of_a_;
  PointMotion of_b_;
};

// Where an object can be taken whole, estimates and decisions take hardly longer than the search.
Care careFor(const PartitionObject& a, const PartitionObject& b,
             const GaussianDisplacement& displacement, const ProbabilityRequest& request) {
  const bool is_quick = request.method == ProbabilityMethod::estimate || request.threshold;
  if (!is_quick || !wholeBodyOf(a, b, displacement)) return Care::full;
  return Care::rough;
}

}  // namespace

QueryScene::QueryScene(const PartitionObject& a, const PartitionObject& b,
                       const GaussianDisplacement& displacement, const ProbabilityRequest& request,
                       bool all_axes)
    : a_(a), b_(b), displacement_(displacement) {
  placeFrame(request, all_axes);
  if (a.hasSolid() || b.hasSolid()) {
    solids_ = std::make_unique<const SolidContact>(a, b, whitening_, pair_);
  }
  if (const auto whole = wholeBodyOf(a, b, displacement_)) whole_body_.emplace(*whole);
}

void QueryScene::placeFrame(const ProbabilityRequest& request, bool all_axes) {
  const double unit = std::max({a_.tree->radius(), b_.tree->radius(), 1e-150});
  if (all_axes) requireFitting(displacement_, unit);
  const ResolvedPart resolved =
      all_axes ? ResolvedPart{displacement_} : resolvedPart(displacement_, unit);
  displacement_ = resolved.displacement;
  whitening_ = Whitening(displacement_, unit);
  const BandedPair banded(a_, b_, request, resolved.left_out);
  banded.whiten(whitening_, pair_);
  const int rank = displacement_.rank();
  const Eigen::Vector3d& sigma = displacement_.standardDeviations();
  if (rank < 2 || sigma[0] > kMostStretched * sigma[rank - 1]) return;
  const Care care = careFor(a_, b_, displacement_, request);
  whitening_ = whitening_.rotatedTo(closestApproach(pair_, rank, care));
  banded.whiten(whitening_, pair_);
}

}  // namespace fcl_prob::detail
