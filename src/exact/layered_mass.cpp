// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/layered_mass.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "convex/pair_obstacle.h"
#include "geometry/exact_sum.h"
#include "mass/log_concave_integral.h"

namespace fcl_prob::detail {
namespace {

/// The least ratio of deviations.
constexpr double kFlatRatio = 200.0;

/// Places of the first sections, in deviations: beyond the outermost there is 4e-11 of the mass.
constexpr double kFirstPlace = 6.5;

/// About what three sections leave of their bend in the width; more of them the less, by the square
/// of their number.
constexpr double kWidthOfBend = 0.4;

/// A width as near to that of sections is not worth another one.
constexpr double kBesideSections = 1.3;

/// A shift is rounded to ε of itself, and its section is moved by that, along the axis and across
/// it: what moves by d deviations weighs exp(-40 d) of itself or more.
constexpr double kShiftRounding = 4.0 * kEpsilon;
constexpr double kFarthestPoint = 40.0;

/// Of a position that comes in two doubles.
constexpr double kSplitRounding = 0x1p-61;

class LayeredMass {
 public:
  LayeredMass(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
              const GaussianDisplacement& displacement, const SectionMass& section_mass)
      : pose_a_(pose_a),
        pose_b_(pose_b),
        last_(displacement.rank() - 1),
        across_(displacement.withoutLastAxis()),
        step_(displacement.standardDeviations()[last_] * displacement.axes().col(last_)),
        section_mass_(section_mass),
        place_error_(placePoses(displacement)),
        integral_(place_error_) {}

  Bounds run(const LayeredEffort& effort) {
    for (const double z : {0.0, -kFirstPlace, kFirstPlace}) {
      if (!addSection(z)) return {0.0, 1.0};
    }
    Bounds mass = integral_.bounds();
    const double asked = 3.0 * std::sqrt(kWidthOfBend * integral_.mostBend() / effort.width);
    if (asked > effort.most_sections) return mass;
    const double enough = std::max(effort.width, kBesideSections * widest_);
    for (int count = 3; count < effort.most_sections; ++count) {
      if (mass.width() <= enough * mass.upper) break;
      const double z = integral_.widest();
      if (std::abs(z) > LogConcaveIntegral::kFarthestPlace || !addSection(z)) break;
      mass = integral_.bounds();
    }
    return mass;
  }

 private:
  /// All that is added to the mean of a section has to be exact: so the mean goes to the poses. How
  /// far sections may be from where they are said to be, in deviations.
  double placePoses(const GaussianDisplacement& displacement) {
    ExactPosition offset;
    offset.add(pose_b_.translation());
    offset.add(pose_a_.translation(), -1.0);
    offset.add(displacement.mean(), -1.0);
    const LongVector place = offset.value();
    const Eigen::Vector3d rounded = place.cast<double>();
    pose_b_.translation() = rounded;
    pose_a_.translation() = -(place - rounded.cast<long double>()).cast<double>();
    return kShiftRounding * LogConcaveIntegral::kFarthestPlace +
           kSplitRounding * rounded.norm() / displacement.standardDeviations()[last_];
  }

  bool addSection(double z) {
    const Bounds mass = section_mass_(pose_a_, pose_b_, across_.withMean(step_ * z));
    if (!(mass.lower > 0.0) || !(mass.width() < 0.01 * mass.upper)) return false;
    widest_ = std::max(widest_, mass.width() / mass.upper);
    const double shifted = 2.0 * kFarthestPoint * place_error_;
    integral_.add(z, {mass.lower * (1.0 - shifted), mass.upper * (1.0 + shifted)});
    return true;
  }

  fcl::Transform3d pose_a_, pose_b_;
  int last_;
  GaussianDisplacement across_;
  Eigen::Vector3d step_;
  const SectionMass& section_mass_;
  double place_error_;
  LogConcaveIntegral integral_;
  double widest_ = 0.0;
};

}  // namespace

bool isFlat(const GaussianDisplacement& displacement) {
  const Eigen::Vector3d& deviations = displacement.standardDeviations();
  return displacement.rank() == 3 && deviations[0] > kFlatRatio * deviations[2];
}

Bounds layeredMass(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                   const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement,
                   const SectionMass& section_mass, const LayeredEffort& effort) {
  const PairFrame frame = pairFrame(a, pose_a, b, pose_b, displacement);
  if (!frame.fits) return {0.0, 1.0};
  const PairObstacle obstacle(frame, a.set(), b.set());
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(frame.rank - 1);
  if (obstacle->support(axis) < kFirstPlace || obstacle->support(-axis) < kFirstPlace) {
    return {0.0, 1.0};
  }
  return LayeredMass(pose_a, pose_b, displacement, section_mass).run(effort);
}

}  // namespace fcl_prob::detail
