// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/groups_answer.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/budget.h"
#include "base/ladder.h"
#include "base/wings.h"
#include "bounds/convex_bound.h"
#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/parts_bounds.h"
#include "query/partition.h"
#include "query/single_collide.h"

namespace fcl_prob::detail {
namespace {

/// Of the threshold: what may be left out of the sums that decide it.
constexpr double kNegligible = 1e-6;

/// Of the time limit, for a first sum of bounds that is seldom the answer.
constexpr double kShareOfRootBounds = 0.1;

constexpr const char* kCollided = "nothing is random, and cells cannot tell: as fcl::collide says";

/// Two groups, one question.
class GroupsAnswer {
 public:
  GroupsAnswer(const PlacedGroups& groups, const GaussianDisplacement& displacement,
               const ProbabilityRequest& request, const BallTruncation* ball)
      : groups_(groups),
        displacement_(displacement),
        request_(request),
        ball_(ball),
        budget_(request),
        known_(request),
        placed_a_(groups.a, groups.poses_a, request.contact),
        placed_b_(groups.b, groups.poses_b, request.contact) {}

  ProbabilityResult answer() {
    climb(kLadder, *this, known_, rungs_);
    result_.plan = planOf(rungs_);
    result_.plan.insert(result_.plan.begin(), groups_.note);
    result_.statistics.rungs = std::move(rungs_);
    return std::move(result_);
  }

 private:
  bool isEstimate() const { return request_.method == ProbabilityMethod::estimate; }

  // The sum over all pairs, of which each is bounded by its root volumes.
  const char* whyNotFar() const;
  Climbed sumRootBounds();

  // Sums and products of masses of pairs of convex members, which may decide a threshold.
  const char* whyNotByPairs() const;
  Climbed decideByPairs();

  Climbed divide();

  // Without a displacement, where cells cannot tell: what fcl::collide says, as for pairs.
  bool isStillUnknown() const;
  Climbed collideAll();

  static const std::vector<Rung<GroupsAnswer>> kLadder;

  const PlacedGroups& groups_;
  const GaussianDisplacement& displacement_;
  const ProbabilityRequest& request_;
  const BallTruncation* ball_;
  Budget budget_;
  Known known_;
  PlacedGroup placed_a_;
  PlacedGroup placed_b_;
  std::vector<RungRecord> rungs_;
  ProbabilityResult result_;
};

const std::vector<Rung<GroupsAnswer>> GroupsAnswer::kLadder{
    {"root volumes", [](const GroupsAnswer& q) { return q.whyNotFar(); },
     &GroupsAnswer::sumRootBounds},
    {"pairs", [](const GroupsAnswer& q) { return q.whyNotByPairs(); },
     &GroupsAnswer::decideByPairs},
    {"partition", nullptr, &GroupsAnswer::divide, true},
    {"one fcl::collide", [](const GroupsAnswer& q) { return unless(q.isStillUnknown()); },
     &GroupsAnswer::collideAll, true},
};

const char* GroupsAnswer::whyNotFar() const {
  if (isEstimate()) return "";
  if (request_.gradient) return "a bound from above has no gradient";
  if (request_.hasBand()) return "they are of shapes without bands";
  return groups_.a.haveRootBodies() && groups_.b.haveRootBodies() ? nullptr
                                                                  : "a member has no root volume";
}

Climbed GroupsAnswer::sumRootBounds() {
  Budget limits(request_, kShareOfRootBounds);
  // A larger sum ends no query.
  const double useful = request_.threshold.value_or(request_.absolute_tolerance);
  std::vector<Bounds> pairs;
  double sum = 0.0;
  for (std::size_t i = 0; i < groups_.poses_a.size(); ++i) {
    for (std::size_t j = 0; j < groups_.poses_b.size(); ++j) {
      const double bound = convexPcd(groups_.a.members()[i]->rootBody(), groups_.poses_a[i],
                                     groups_.b.members()[j]->rootBody(), groups_.poses_b[j],
                                     displacement_, limits.interruption())
                               .least;
      sum += bound;
      if (sum > useful) return {false, "the sum of their bounds decides nothing"};
      if (limits.stopped()) return {false, "their share of the time was over"};
      pairs.push_back({0.0, bound});
    }
  }
  known_.narrow({0.0, anyOf(pairs).upper});
  const auto status = known_.satisfied();
  if (!status) return {false, "the sum of their bounds decides nothing"};
  result_.method = ProbabilityMethod::interval;
  known_.tell(result_);
  result_.status = *status;
  return {true, "far apart: stopped at the sum of the bounds of all pairs"};
}

// Convex members in one place, as the parts of a mesh are. Bounds of whole members are of contact,
// not of contact within an ellipsoid.
const char* GroupsAnswer::whyNotByPairs() const {
  if (!kHasDecomposition || !request_.threshold || isEstimate()) return "";
  if (ball_ || request_.hasBand() || request_.gradient) {
    return "masses of pairs know no bands, truncation or gradient";
  }
  const bool are_convex = groups_.a.areConvex() && groups_.b.areConvex();
  if (!are_convex) return "not all members are convex";
  return groups_.a.onePlace(groups_.poses_a) && groups_.b.onePlace(groups_.poses_b)
             ? nullptr
             : "the members are not in one place";
}

Climbed GroupsAnswer::decideByPairs() {
  if constexpr (!kHasDecomposition) {
    return {false, ""};
  } else {
    Budget limits(request_);
    PartsBoundsRequest parts;
    parts.negligible = kNegligible * *request_.threshold;
    parts.interruption = limits.interruption();
    const PartsBoundsResult bounds =
        partsBounds(groups_.a.bodies(), *groups_.a.onePlace(groups_.poses_a), groups_.b.bodies(),
                    *groups_.b.onePlace(groups_.poses_b), displacement_, parts);
    if (!isDecided(decisionOf(bounds.any, request_))) {
      return {false, "bounds on pairs of convex members decide nothing"};
    }
    known_.narrow(bounds.any);
    result_.method = ProbabilityMethod::interval;
    result_.lower = bounds.any.lower;
    result_.upper = bounds.any.upper;
    result_.status = ProbabilityStatus::decided;
    result_.decision = decisionOf(bounds.any, request_);
    result_.statistics.leaf_pairs = bounds.pairs;
    return {true, "decided by Hunter's and Bonferroni's bounds on pairs of convex members"};
  }
}

Climbed GroupsAnswer::divide() {
  placed_a_.boundBy(placed_b_.object(), displacement_);
  placed_b_.boundBy(placed_a_.object(), displacement_);
  result_ = partitionProbability(placed_a_.object(), placed_b_.object(), displacement_,
                                 budget_.withTimeLeft(), ball_);
  const auto& rungs = result_.statistics.rungs;
  rungs_.insert(rungs_.end(), rungs.begin(), rungs.end());
  known_.narrow(result_);
  result_.lower = known_.interval().lower;
  result_.upper = known_.interval().upper;
  const std::string note = noteOf(result_);
  return {!isStillUnknown(), note.empty() ? "one for the union of their pairs" : note};
}

bool GroupsAnswer::isStillUnknown() const {
  return displacement_.rank() == 0 && !request_.hasBand() && *result_.lower < *result_.upper;
}

Climbed GroupsAnswer::collideAll() {
  for (std::size_t i = 0; i < groups_.poses_a.size(); ++i) {
    for (std::size_t j = 0; j < groups_.poses_b.size(); ++j) {
      result_ = singleCollide(groups_.a.members()[i]->geometry(), groups_.poses_a[i],
                              groups_.b.members()[j]->geometry(), groups_.poses_b[j],
                              displacement_.mean(), request_);
      if (*result_.upper > 0.0) return {true, kCollided};
    }
  }
  return {true, kCollided};
}

}  // namespace

ProbabilityResult groupsAnswer(const PlacedGroups& groups, const GaussianDisplacement& displacement,
                               const ProbabilityRequest& request, const BallTruncation* ball) {
  return GroupsAnswer(groups, displacement, request, ball).answer();
}

}  // namespace fcl_prob::detail
