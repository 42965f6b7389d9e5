// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/parts_bounds.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "base/number_text.h"
#include "bounds/convex_bound.h"
#include "bounds/pair_bounds.h"
#include "convex/pair_obstacle.h"
#include "decomposition/intersection_mass.h"
#include "decomposition/overlap_samples.h"
#include "exact/convex_pair_mass.h"
#include "fcl_prob/exceptions.h"
#include "geometry/validation.h"

namespace fcl_prob {
namespace {

using namespace detail;

/// Pairs whose bound is below this part of the largest count with the bound.
constexpr double kWorthTheMass = 1e-4;

/// An intersection is computed if it seems to be more than this part of the heaviest pair.
constexpr double kWorthTheIntersection = 1e-3;

/// Pairs at most among which intersections are looked for.
constexpr std::size_t kMostObstacles = 128;

/// Pairs at most in the set for the bound from below.
constexpr std::size_t kMostDisjoint = 8;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// The axis-aligned box of a body in its own frame.
ConvexBody boxAround(const ConvexBody& body) {
  Eigen::AlignedBox3d box;
  for (int k = 0; k < 3; ++k) {
    for (const double sign : {-1.0, 1.0}) {
      box.extend(body.supportPoint(sign * Eigen::Vector3d::Unit(k)));
    }
  }
  const Eigen::Vector3d padding =
      Eigen::Vector3d::Constant(16.0 * kEpsilon * body.set().size() + body.set().slack());
  return ConvexBody(fcl::AABBd(box.min() - padding, box.max() + padding));
}

std::vector<ConvexBody> boxesAround(const std::vector<ConvexBody>& bodies) {
  std::vector<ConvexBody> boxes;
  for (const ConvexBody& body : bodies) boxes.push_back(boxAround(body));
  return boxes;
}

struct PartPair {
  std::size_t a;
  std::size_t b;
  double bound;               ///< ConvexPCD
  Eigen::Vector3d direction;  ///< from the mean towards the C-obstacle, whitened
};

struct Query {
  const std::vector<ConvexBody>& a;
  const fcl::Transform3d& pose_a;
  const std::vector<ConvexBody>& b;
  const fcl::Transform3d& pose_b;
  const GaussianDisplacement& displacement;
  const PartsBoundsRequest& request;

  PairFrame frame(const PartPair& pair) const {
    return pairFrame(a[pair.a], pose_a, b[pair.b], pose_b, displacement);
  }
};

class Sums {
 public:
  explicit Sums(const Query& query) : query_(query) {}

  PartsBoundsResult result() {
    findPairs();
    weighPairs();
    result_.pairs = masses_.size();
    result_.sum = raised(sum_);
    double lower = heaviest();
    double upper = result_.sum;
    if (masses_.size() > 1 && query_.displacement.rank() == 3) {
      chooseAmong();
      upper = std::min(upper, hunter());
      lower = std::max(lower, bonferroni());
    }
    result_.any = {std::clamp(lower, 0.0, 1.0), std::clamp(upper, 0.0, 1.0)};
    result_.any.upper = std::max(result_.any.lower, result_.any.upper);
    return result_;
  }

 private:
  bool interrupted() {
    if (!isDue(query_.request.interruption)) return false;
    result_.complete = false;
    return true;
  }

  /// A pair of which no more than a bound is known.
  void addUnweighed(double bound) {
    sum_ += bound;
    result_.largest = std::max(result_.largest, bound);
  }

  double raised(double sum) const {
    return sum * (1.0 + 2.0 * kEpsilon * static_cast<double>(query_.a.size() * query_.b.size()));
  }

  /// Those that are not negligible; the others are added up. Boxes say of most that they are.
  void findPairs() {
    const std::vector<ConvexBody> boxes_a = boxesAround(query_.a);
    const std::vector<ConvexBody> boxes_b = boxesAround(query_.b);
    const double negligible =
        query_.request.negligible / static_cast<double>(query_.a.size() * query_.b.size());
    for (std::size_t i = 0; i < query_.a.size(); ++i) {
      for (std::size_t j = 0; j < query_.b.size(); ++j) {
        const double of_boxes = fcl_prob::convexPcd(boxes_a[i], query_.pose_a, boxes_b[j],
                                                    query_.pose_b, query_.displacement)
                                    .least;
        if (of_boxes <= negligible) {
          addUnweighed(of_boxes);
          continue;
        }
        const ConvexPcdBounds bounds =
            detail::convexPcd(query_.a[i], query_.pose_a, query_.b[j], query_.pose_b,
                              query_.displacement, query_.request.interruption);
        pairs_.push_back({i, j, std::min(of_boxes, bounds.least), bounds.direction});
      }
    }
    std::stable_sort(pairs_.begin(), pairs_.end(),
                     [](const PartPair& p, const PartPair& q) { return p.bound > q.bound; });
  }

  void weighPairs() {
    for (const PartPair& pair : pairs_) {
      if (pair.bound < kWorthTheMass * pairs_.front().bound || interrupted()) {
        addUnweighed(pair.bound);
        continue;
      }
      Bounds mass =
          detail::convexPairMass(query_.a[pair.a], query_.pose_a, query_.b[pair.b], query_.pose_b,
                                 query_.displacement, query_.request.interruption);
      mass.upper = std::min(mass.upper, pair.bound);
      masses_.push_back(mass);
      sum_ += mass.upper;
      result_.largest = std::max(result_.largest, mass.upper);
    }
  }

  double heaviest() const {
    double lower = 0.0;
    for (const Bounds& mass : masses_) lower = std::max(lower, mass.lower);
    return lower;
  }

  /// Builds the obstacles and samples what they have in common.
  void chooseAmong() {
    const std::size_t count = std::min(masses_.size(), kMostObstacles);
    for (std::size_t i = 0; i < count && !interrupted(); ++i) {
      obstacles_.push_back(obstacleOf(pairs_[i]));
    }
    overlaps_ = sampledOverlaps(obstacles_, centreOf(pairs_.front()));
  }

  std::optional<KnownObstacle> obstacleOf(const PartPair& pair) const {
    const PairFrame frame = query_.frame(pair);
    const PairObstacle obstacle(frame, query_.a[pair.a].set(), query_.b[pair.b].set());
    if (!obstacle->isPolytope() || !frame.fits) return std::nullopt;
    ObstacleScratch scratch;
    const EnclosingFaces enclosing = obstacle->outerFaces(scratch);
    if (enclosing.only_box || !scratch.faces.closed()) return std::nullopt;
    return KnownObstacle(std::move(scratch.faces), frame.whitened(enclosing.error).norm());
  }

  /// Where the heaviest pair is likeliest to touch.
  Eigen::Vector3d centreOf(const PartPair& pair) const {
    const PairFrame frame = query_.frame(pair);
    const PairObstacle obstacle(frame, query_.a[pair.a].set(), query_.b[pair.b].set());
    if (pair.direction.isZero()) return Eigen::Vector3d::Zero();
    return std::max(0.0, -obstacle->support(-pair.direction)) * pair.direction;
  }

  const Bounds& common(std::size_t i, std::size_t j) {
    const auto key = std::minmax(i, j);
    const auto known = common_.find(key);
    if (known != common_.end()) return known->second;
    ++result_.intersections;
    Bounds mass = intersectionMass(*obstacles_[key.first], *obstacles_[key.second]);
    mass.upper = std::min({mass.upper, masses_[i].upper, masses_[j].upper});
    return common_[key] = mass;
  }

  bool worthIt(double overlap) {
    return overlap > kWorthTheIntersection * masses_.front().upper && !interrupted();
  }

  double hunter() {
    double twice = 0.0;
    for (const auto& [i, j] : heaviestTree(overlaps_)) {
      if (worthIt(overlaps_[i][j])) twice += common(i, j).lower;
    }
    const double less = twice * (1.0 - 2.0 * kEpsilon * static_cast<double>(masses_.size()));
    return raised(sum_) - less + 4.0 * kEpsilon * sum_;
  }

  /// Pairs are taken in, in the order of their masses, as long as that seems to add something.
  double bonferroni() {
    std::vector<std::size_t> chosen;
    double sum = 0.0;
    double best = 0.0;
    for (std::size_t i = 0; i < obstacles_.size() && chosen.size() < kMostDisjoint; ++i) {
      if (!obstacles_[i]) continue;
      double gain = masses_[i].lower;
      for (const std::size_t j : chosen) gain -= overlaps_[i][j];
      if (!worthIt(gain)) continue;
      sum += masses_[i].lower;
      for (const std::size_t j : chosen) sum -= common(i, j).upper;
      chosen.push_back(i);
      best = std::max(best, sum - 64.0 * kEpsilon * sum_);
    }
    return best;
  }

  const Query query_;
  PartsBoundsResult result_;
  std::vector<PartPair> pairs_;  // heaviest first
  std::vector<Bounds> masses_;   // of the first of them
  double sum_ = 0.0;             // of the bounds or masses of all pairs
  std::vector<std::optional<KnownObstacle>> obstacles_;
  std::vector<std::vector<double>> overlaps_;
  std::map<std::pair<std::size_t, std::size_t>, Bounds> common_;
};

std::vector<ConvexBody> bodiesOf(const ConvexParts& parts) {
  std::vector<ConvexBody> bodies;
  for (std::size_t i = 0; i < parts.size(); ++i) bodies.push_back(parts.body(i));
  return bodies;
}

}  // namespace

PartsBoundsResult partsBounds(const std::vector<ConvexBody>& a, const fcl::Transform3d& pose_a,
                              const std::vector<ConvexBody>& b, const fcl::Transform3d& pose_b,
                              const GaussianDisplacement& displacement,
                              const PartsBoundsRequest& request) {
  validatePose(pose_a, "pose of A");
  validatePose(pose_b, "pose of B");
  if (a.empty() || b.empty()) throw InvalidGeometry("bounds of parts: one object has no parts");
  if (!(request.negligible >= 0.0)) {
    throw InvalidRequest("negligible is " + numberText(request.negligible) +
                         ", must be at least 0");
  }
  return Sums({a, pose_a, b, pose_b, displacement, request}).result();
}

PartsBoundsResult partsBounds(const ConvexParts& a, const fcl::Transform3d& pose_a,
                              const ConvexParts& b, const fcl::Transform3d& pose_b,
                              const GaussianDisplacement& displacement,
                              const PartsBoundsRequest& request) {
  return partsBounds(bodiesOf(a), pose_a, bodiesOf(b), pose_b, displacement, request);
}

}  // namespace fcl_prob
