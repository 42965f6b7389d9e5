// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/state_screen.h"

#include <algorithm>
#include <numeric>

#include "base/budget.h"
#include "base/rounded_sum.h"
#include "base/until_no.h"
#include "fcl_prob/combined_bounds.h"
#include "robot/obstacle_answer.h"

namespace fcl_prob::detail {
namespace {

/// Of the threshold: a bound by balls that is smaller is not looked at more closely.
constexpr double kNegligible = 1e-4;

/// Of the threshold: where bodies that stay may have less of P, it is not worth while to know what
/// they have.
constexpr double kWorthKnowing = 0.1;

std::optional<bool> sideOf(const Bounds& known, double threshold) {
  if (known.upper < threshold) return true;
  return known.lower > threshold ? std::make_optional(false) : std::nullopt;
}

}  // namespace

StateScreen::StateScreen(const RobotAmongObstacles& among, const Eigen::VectorXd& values,
                         const std::vector<Eigen::Index>& moving)
    : StateScreen(among) {
  if (is_usable_) fixed_.emplace(among, values, moving);
}

StateScreen::StateScreen(const RobotAmongObstacles& among) : among_(among) {
  const auto have_hulls = [](const PreparedGeometries& geometries) {
    return std::all_of(geometries.begin(), geometries.end(),
                       [](const auto& geometry) { return geometry->hasRootBody(); });
  };
  is_usable_ = have_hulls(among.geometries());
  for (std::size_t j = 0; j < among.obstacles().size(); ++j) {
    const Obstacle& obstacle = among.obstacles()[j];
    is_usable_ = is_usable_ && have_hulls(among.preparedObstacle(j).geometries()) &&
                 obstacle.over_time.empty() &&
                 std::holds_alternative<GaussianDisplacement>(obstacle.displacement);
  }
  if (!is_usable_) return;
  for (std::size_t j = 0; j < among.obstacles().size(); ++j) {
    const Displacement& displacement = among.obstacles()[j].displacement;
    of_bodies_.push_back(std::get<GaussianDisplacement>(displacement).reversed());
  }
}

StateScreen::Screened StateScreen::screened(const Eigen::VectorXd& values,
                                            const ProbabilityRequest& request) const {
  if (!is_usable_)
    return {std::nullopt, std::vector<Bounds>(among_.obstacles().size(), {0.0, 1.0})};
  const double threshold = *request.threshold;
  const std::vector<fcl::Transform3d> poses = among_.robot().poses(values);
  const Near near = nearOf(poses, kNegligible * threshold);
  double far = 0.0;
  for (const double of_one : near.far) far = sumAbove(far, of_one);
  const auto told = sideOf(boundsOfAny(near.bodies, far, threshold, request.contact), threshold);
  if (told) return {told, {}};
  std::vector<Bounds> known = knownOf(near, fixed_ && fixed_->areAmong(poses), request);
  return {sideOf(anyOfIndependent(known), threshold), std::move(known)};
}

std::vector<Bounds> StateScreen::knownOf(const Near& near, bool stay,
                                         const ProbabilityRequest& request) const {
  std::vector<double> moving, fixed;
  for (const BodyBounds& one : near.bodies) {
    moving.push_back(one.sum([&](std::size_t i) { return !stay || !fixed_->contains(i); }));
    fixed.push_back(one.sum([&](std::size_t i) { return stay && fixed_->contains(i); }));
  }
  const double of_fixed = std::accumulate(fixed.begin(), fixed.end(), 0.0);
  std::optional<std::vector<Bounds>> exactly;
  if (stay && of_fixed > kWorthKnowing * *request.threshold) exactly = fixed_->bounds(request);
  std::vector<Bounds> known;
  for (std::size_t j = 0; j < moving.size(); ++j) {
    const Bounds of_stay = exactly ? (*exactly)[j] : Bounds{0.0, fixed[j]};
    const double others = sumAbove(moving[j], near.far[j]);
    known.push_back({of_stay.lower, std::min(1.0, sumAbove(of_stay.upper, others))});
  }
  return known;
}

Decision StateScreen::decision(const Eigen::VectorXd& values,
                               const ProbabilityRequest& request) const {
  const ProbabilityRequest of_call = ofOneCall(request);
  const Budget budget(of_call);
  Screened screened = this->screened(values, of_call);
  if (screened.is_below) return *screened.is_below ? Decision::below : Decision::above;
  const auto placed = among_.relativeTo({values}, -1);
  const auto ask = [&](std::size_t i, const ProbabilityRequest& of_one) {
    FarBodies far;
    return among_.ask(i, placed[i], of_one, far);
  };
  return anyOfAsked(std::move(screened.known), budget.withTimeLeft(), ask).decision;
}

StateScreen::Near StateScreen::nearOf(const std::vector<fcl::Transform3d>& poses,
                                      double negligible) const {
  Near near;
  for (std::size_t j = 0; j < among_.obstacles().size(); ++j) {
    const Obstacle& obstacle = among_.obstacles()[j];
    const PreparedObstacle& prepared = among_.preparedObstacle(j);
    const Ball around = prepared.around().placed(obstacle.pose);
    std::vector<PlacedBody> bodies;
    double far = 0.0;
    for (const std::size_t i : among_.bodiesOf(j)) {
      const double upper =
          farContactUpper(among_.balls()[i].placed(poses[i]), around, obstacle.displacement);
      if (upper > negligible) {
        bodies.push_back({i, poses[i]});
      } else {
        far = sumAbove(far, upper);
      }
    }
    near.far.push_back(far);
    near.bodies.emplace_back(among_.prepared(), bodies, prepared, obstacle.pose, of_bodies_[j]);
  }
  return near;
}

}  // namespace fcl_prob::detail
