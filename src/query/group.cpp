// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/group.h"

#include <algorithm>
#include <optional>
#include <string>

#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/parts_bounds.h"
#include "geometry/occupancy.h"
#include "geometry/validation.h"
#include "narrowphase/convex_pair_mass.h"
#include "partition/motion_flux.h"
#include "partition/partition.h"
#include "partition/without_contact.h"
#include "query/call_budget.h"
#include "query/member_group.h"
#include "query/mixture_query.h"
#include "query/motion_gradient.h"
#include "query/octree_cells.h"
#include "query/request_limits.h"
#include "query/single_collide.h"
#include "query/tolerance_note.h"
#include "query/truncation.h"

namespace fcl_prob {
namespace {

using Poses = std::vector<fcl::Transform3d>;
using detail::PreparedGeometry;

/// Of the threshold: what may be left out of the sums that decide it.
constexpr double kNegligible = 1e-6;

/// One union of pieces must do for all pairs of members.
void requireAlike(const detail::MemberGroup& group, const detail::MemberGroup& others) {
  if (!others.hasOcTree()) return;
  for (const PreparedGeometry* member : group.members()) {
    if (!detail::isAlikeBesideOcTrees(member->geometry())) {
      throw UnsupportedGeometry(detail::nodeTypeName(member->geometry().getNodeType()) +
                                " both occupied and free in a group that meets an octree: "
                                "fcl::collide leaves it out there and nowhere else");
    }
    for (const PreparedGeometry* other : others.members()) {
      detail::requireDistinctCells(*member, *other);
    }
  }
}

/// Of the time limit, for a first sum of bounds that is seldom the answer.
constexpr double kShareOfRootBounds = 0.1;

void requireMethod(const ProbabilityRequest& request) {
  switch (request.method) {
    case ProbabilityMethod::automatic:
    case ProbabilityMethod::interval:
    case ProbabilityMethod::estimate:
      return;
    default:
      throw UnsupportedGeometry("method " + toString(request.method) +
                                " cannot handle groups of several geometries");
  }
}

}  // namespace

struct GroupQuery::Implementation {
  detail::MemberGroup a;
  detail::MemberGroup b;
  std::optional<PreparedQuery> single;

  Implementation(const Geometries& group_a, const Geometries& group_b)
      : a(group_a, "group A"), b(group_b, "group B") {
    if (group_a.size() == 1 && group_b.size() == 1)
      single.emplace(group_a[0], group_b[0]);
    else if (a.anyUnbounded() && b.anyUnbounded()) {
      throw UnsupportedGeometry("both groups have unbounded members");
    } else {
      requireAlike(a, b);
      requireAlike(b, a);
    }
  }

  /// \throws InvalidRequest, InvalidPose, UnsupportedGeometry
  void validate(const Poses& poses_a, const Poses& poses_b,
                const ProbabilityRequest& request) const {
    validateRequest(request);
    a.validate(poses_a);
    b.validate(poses_b);
    if (!single) requireMethod(request);
  }

  /// \param ball  null: the displacement is not truncated; else the request is that of meeting and
  /// being within it
  ProbabilityResult answer(const Poses& poses_a, const Poses& poses_b,
                           const GaussianDisplacement& displacement,
                           const ProbabilityRequest& request,
                           const detail::BallTruncation* ball = nullptr) const {
    if (a.isEmpty() || b.isEmpty()) return detail::withoutContact(request, note());
    const detail::CallBudget budget(request);
    detail::PlacedGroup placed_a(a, poses_a, request.contact);
    detail::PlacedGroup placed_b(b, poses_b, request.contact);
    if (request.hasBand() && (a.anyUnbounded() || b.anyUnbounded())) {
      throw UnsupportedGeometry("a group with unbounded members knows no bands around its shapes");
    }
    const double most = sumOfRootBounds(poses_a, poses_b, displacement, request);
    if (auto far = intervalOfSum(most, request)) return *far;
    // Those bounds are of contact, not of contact within an ellipsoid.
    if (!ball && !request.hasBand()) {
      if (auto decided = decidedByPairs(poses_a, poses_b, displacement, request)) return *decided;
    }
    // At most one of the two has unbounded members.
    placed_a.boundBy(placed_b.object(), displacement);
    placed_b.boundBy(placed_a.object(), displacement);
    ProbabilityResult result =
        detail::partitionProbability(placed_a.object(), placed_b.object(), displacement,
                                     detail::withTimeLeft(request, budget), ball);
    if (displacement.rank() == 0 && !request.hasBand() && *result.lower < *result.upper) {
      return collided(poses_a, poses_b, displacement.mean(), request);
    }
    result.upper = std::max(*result.lower, std::min(*result.upper, most));
    result.plan.insert(result.plan.begin(), note());
    return result;
  }

  MotionGradient gradient(const Poses& poses_a, const Poses& poses_b,
                          const GaussianDisplacement& displacement,
                          const MemberVelocities& velocities,
                          const MotionGradientRequest& request) const {
    a.validate(poses_a);
    b.validate(poses_b);
    detail::validateVelocities(velocities, a.members().size());
    detail::validateGradient(request);
    if (displacement.rank() == 0) {
      throw InvalidRequest("a displacement of rank 0 has no gradient: P is 0 or 1");
    }
    if (a.isEmpty() || b.isEmpty()) return detail::withoutGradient(velocities[0].cols());
    detail::PlacedGroup placed_a(a, poses_a, request.contact);
    detail::PlacedGroup placed_b(b, poses_b, request.contact);
    placed_a.boundBy(placed_b.object(), displacement);
    placed_b.boundBy(placed_a.object(), displacement);
    MemberVelocities of_parts;
    for (const std::size_t i : a.bounded()) of_parts.push_back(velocities[i]);
    for (const std::size_t i : a.unbounded()) of_parts.push_back(velocities[i]);
    return detail::gradientFrom(detail::motionFlux(
        placed_a.object(), placed_b.object(), displacement, of_parts, detail::drawsOf(request)));
  }

 private:
  /// Without a displacement, where the partition cannot tell: what fcl::collide says, as for pairs.
  ProbabilityResult collided(const Poses& poses_a, const Poses& poses_b,
                             const Eigen::Vector3d& moved,
                             const ProbabilityRequest& request) const {
    ProbabilityResult result;
    for (std::size_t i = 0; i < poses_a.size(); ++i) {
      for (std::size_t j = 0; j < poses_b.size(); ++j) {
        result = detail::singleCollide(a.members()[i]->geometry(), poses_a[i],
                                       b.members()[j]->geometry(), poses_b[j], moved, request);
        if (*result.upper > 0.0) return result;
      }
    }
    return result;
  }

  /// Bound on the sum over all pairs, 1 where there is none that is of use.
  double sumOfRootBounds(const Poses& poses_a, const Poses& poses_b,
                         const GaussianDisplacement& displacement,
                         const ProbabilityRequest& request) const {
    const bool wanted =
        !request.gradient && !request.hasBand() && request.method != ProbabilityMethod::estimate;
    if (!wanted || !a.haveRootBodies() || !b.haveRootBodies()) return 1.0;
    detail::RequestLimits limits(request, kShareOfRootBounds);
    // A larger sum ends no query.
    const double useful = std::max(request.absolute_tolerance, request.threshold.value_or(0.0));
    std::vector<Bounds> pairs;
    double sum = 0.0;
    for (std::size_t i = 0; i < poses_a.size(); ++i) {
      for (std::size_t j = 0; j < poses_b.size(); ++j) {
        const double bound =
            detail::convexPcd(a.members()[i]->rootBody(), poses_a[i], b.members()[j]->rootBody(),
                              poses_b[j], displacement, limits.interruption())
                .least;
        sum += bound;
        if (sum > useful || limits.reason()) return 1.0;
        pairs.push_back({0.0, bound});
      }
    }
    return anyOf(pairs).upper;
  }

  /// Convex members in one place, as the parts of a mesh are: sums of masses may decide the
  /// threshold, and no partition is begun.
  std::optional<ProbabilityResult> decidedByPairs(const Poses& poses_a, const Poses& poses_b,
                                                  const GaussianDisplacement& displacement,
                                                  const ProbabilityRequest& request) const {
    if (!request.threshold || request.gradient || request.method == ProbabilityMethod::estimate) {
      return std::nullopt;
    }
    if (!a.isConvexInOnePlace(poses_a) || !b.isConvexInOnePlace(poses_b)) return std::nullopt;
    if (a.leftOut() + b.leftOut() > 0) return std::nullopt;
    detail::RequestLimits limits(request);
    PartsBoundsRequest parts;
    parts.negligible = kNegligible * *request.threshold;
    parts.interruption = limits.interruption();
    const PartsBoundsResult bounds =
        partsBounds(a.bodies(), poses_a[0], b.bodies(), poses_b[0], displacement, parts);
    const Decision decision = detail::decisionOf(bounds.any, request);
    if (decision != Decision::below && decision != Decision::above) return std::nullopt;
    ProbabilityResult result;
    result.method = ProbabilityMethod::interval;
    result.lower = bounds.any.lower;
    result.upper = bounds.any.upper;
    result.status = ProbabilityStatus::decided;
    result.decision = decision;
    result.statistics.leaf_pairs = bounds.pairs;
    result.plan.push_back("decided by Hunter's and Bonferroni's bounds on pairs of convex members");
    return result;
  }

  static std::optional<ProbabilityResult> intervalOfSum(double most,
                                                        const ProbabilityRequest& request) {
    const bool decided = request.threshold && most < *request.threshold;
    const double tolerance = request.toleranceAt(most);
    if (!decided && most > tolerance) return std::nullopt;
    ProbabilityResult result;
    result.method = ProbabilityMethod::interval;
    result.lower = 0.0;
    result.upper = most;
    result.status = decided ? ProbabilityStatus::decided : ProbabilityStatus::converged;
    result.decision = detail::decisionOf({0.0, most}, request);
    result.plan.push_back("far apart: stopped at the sum of the bounds of all pairs");
    return result;
  }

  std::string note() const {
    const std::size_t left_out = a.leftOut() + b.leftOut();
    return "groups of " + std::to_string(a.members().size()) + " and " +
           std::to_string(b.members().size()) +
           (left_out > 0
                ? " (" + std::to_string(left_out) + " left out, as fcl::collide does: not occupied)"
                : "") +
           ": one partition for the union of their pairs";
  }
};

GroupQuery::GroupQuery(Geometries group_a, Geometries group_b)
    : implementation_(std::make_unique<Implementation>(group_a, group_b)) {}

GroupQuery::~GroupQuery() = default;
GroupQuery::GroupQuery(GroupQuery&&) noexcept = default;
GroupQuery& GroupQuery::operator=(GroupQuery&&) noexcept = default;

double GroupQuery::collisionProbability(const std::vector<fcl::Transform3d>& poses_a,
                                        const std::vector<fcl::Transform3d>& poses_b,
                                        const GaussianDisplacement& displacement,
                                        const ProbabilityRequest& request,
                                        ProbabilityResult& result) const {
  implementation_->validate(poses_a, poses_b, request);
  if (implementation_->single) {
    return implementation_->single->collisionProbability(poses_a[0], poses_b[0], displacement,
                                                         request, result);
  }
  result = implementation_->answer(poses_a, poses_b, displacement, request);
  detail::noteTolerance(request, result);
  return result.probability();
}

MotionGradient GroupQuery::motionGradient(const std::vector<fcl::Transform3d>& poses_a,
                                          const std::vector<fcl::Transform3d>& poses_b,
                                          const GaussianDisplacement& displacement,
                                          const MemberVelocities& velocities,
                                          const MotionGradientRequest& request) const {
  return implementation_->gradient(poses_a, poses_b, displacement, velocities, request);
}

double collisionProbability(const GroupQuery& query, const std::vector<fcl::Transform3d>& poses_a,
                            const std::vector<fcl::Transform3d>& poses_b,
                            const GaussianMixture& displacement, const ProbabilityRequest& request,
                            ProbabilityResult& result) {
  const GroupQuery::Implementation& group = *query.implementation_;
  group.validate(poses_a, poses_b, request);
  if (group.single) {
    return collisionProbability(*group.single, poses_a[0], poses_b[0], displacement, request,
                                result);
  }
  result = detail::mixtureProbability(
      displacement, request,
      [&](const GaussianDisplacement& component, const ProbabilityRequest& of_component) {
        return group.answer(poses_a, poses_b, component, of_component);
      });
  return result.probability();
}

double collisionProbability(const GroupQuery& query, const std::vector<fcl::Transform3d>& poses_a,
                            const std::vector<fcl::Transform3d>& poses_b,
                            const TruncatedGaussian& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result) {
  const GroupQuery::Implementation& group = *query.implementation_;
  group.validate(poses_a, poses_b, request);
  if (group.single) {
    return collisionProbability(*group.single, poses_a[0], poses_b[0], displacement, request,
                                result);
  }
  const detail::TruncatedQuery truncated(displacement, request);
  ProbabilityResult answered;
  if (truncated.isWhole()) {
    answered =
        group.answer(poses_a, poses_b, displacement.gaussian(), truncated.requestOfContact());
    truncated.ofContact(answered);
  } else {
    answered = group.answer(poses_a, poses_b, displacement.gaussian(), truncated.requestOfJoint(),
                            &truncated.ball());
    truncated.ofJoint(answered);
  }
  detail::noteTolerance(request, answered);
  result = std::move(answered);
  return result.probability();
}

double collisionProbability(const std::vector<const fcl::CollisionObjectd*>& group_a,
                            const std::vector<const fcl::CollisionObjectd*>& group_b,
                            const GaussianDisplacement& displacement,
                            const ProbabilityRequest& request, ProbabilityResult& result) {
  const auto split = [](const std::vector<const fcl::CollisionObjectd*>& objects,
                        const std::string& name, Poses& poses) {
    GroupQuery::Geometries geometries;
    for (const fcl::CollisionObjectd* object : objects) {
      if (object == nullptr) throw InvalidGeometry("an object of " + name + " is null");
      geometries.push_back(object->collisionGeometry());
      poses.push_back(object->getTransform());
    }
    return geometries;
  };
  Poses poses_a, poses_b;
  GroupQuery::Geometries a = split(group_a, "group A", poses_a);
  GroupQuery::Geometries b = split(group_b, "group B", poses_b);
  return GroupQuery(std::move(a), std::move(b))
      .collisionProbability(poses_a, poses_b, displacement, request, result);
}

}  // namespace fcl_prob
