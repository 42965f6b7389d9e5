// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/principal_section.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Of a point between two support points, and of heights.
constexpr double kBetweenRounding = 8.0;

/// Below this many errors, how far inside a point is says nothing.
constexpr double kLeastWithin = 1e3;

/// Of searches that are to be as good as doubles allow.
constexpr double kFinest = 2.0;

/// Of the obstacle, as a function of the third component of a normal.
struct PlaneSample {
  double t, value, slope;
  Vector3d point;
};

/// Of the section, as a function of the second component of a normal.
struct LineSample {
  double t, value, slope;
  Vector2d point;
  double outer;  ///< certainly not below the function
};

/// Between a ball and a point that is as good as within: the point at a height between theirs.
/// Heights are how far both are from it, on either side.
template <class Point>
double withinBetween(const Point& ball, double radius, double of_ball, const Point& other,
                     double of_other, double error, Point& between) {
  const double share = of_other / (of_ball + of_other);
  between = other + share * (ball - other);
  return share * radius - 2.0 * error;
}

Bounds shrunk(const Bounds& interval, double middle, double share) {
  return {middle + share * (interval.lower - middle), middle + share * (interval.upper - middle)};
}

class AxisSearch {
 public:
  explicit AxisSearch(const PrincipalSection& section)
      : section_(section), height_(-static_cast<double>(section.obstacle().offset().y())) {}

  AxisSection run() {
    AxisSection result;
    result.meeting = section_.meeting();
    if (result.meeting != Meeting::inside) return result;
    result.meeting = findPointWithin();
    if (result.meeting != Meeting::inside) return result;
    result.meeting = Meeting::unknown;
    const auto lower = endAlong(-1.0), upper = endAlong(1.0);
    if (!lower || !upper) return result;
    result.outer = {-lower->upper, upper->upper};
    result.inner = {-lower->lower, upper->lower};
    if (!(result.inner.lower <= result.inner.upper)) return result;
    const double middle = within_.point.x();
    result.inner = shrunk(result.inner, middle, 1.0 / (1.0 + error() / within_.distance));
    result.meeting = Meeting::inside;
    return result;
  }

 private:
  double error() const {
    return section_.error() + kBetweenRounding * section_.obstacle().resolution();
  }
  double finest() const { return kFinest * section_.obstacle().resolution(); }

  Meeting findPointWithin() {
    const PointWithin& start = section_.within();
    const double above = start.point.y() - height_;
    const double side = above > 0.0 ? -1.0 : 1.0;
    const auto other = section_.touch({0.0, side}, finest());
    if (!other) return Meeting::unknown;
    if (other->offset + error() < side * height_) return Meeting::none;
    const double beyond = side * (other->point.y() - height_);
    if (!(beyond > 0.0)) return Meeting::unknown;
    within_.distance = withinBetween(start.point, start.distance, std::abs(above), other->point,
                                     beyond, error(), within_.point);
    return within_.distance > kLeastWithin * error() ? Meeting::inside : Meeting::unknown;
  }

  /// Where the line ends towards one side: the last point that is as good as within, and the first
  /// that is certainly outside, both times the sign.
  std::optional<Bounds> endAlong(double sign) const {
    bool failed = false;
    double across = 0.0, bend = 0.0;
    const auto at = [&](double t) {
      const Vector2d direction(sign, t);
      const auto touch = section_.touch(direction, finest(), across, bend);
      if (!touch) {
        failed = true;
        return LineSample{t, 0.0, 0.0, Vector2d::Zero(), kInfinity};
      }
      across = touch->across;
      bend = touch->bend;
      const double above = touch->point.y() - height_;
      return LineSample{t, sign * touch->point.x() + t * above, above, touch->point,
                        touch->offset - t * height_ + error() * (1.0 + std::abs(t))};
    };
    const auto bracket = BracketSearch<LineSample>::run(at, 0.0, 0.0, finest());
    if (!bracket || failed) return std::nullopt;
    const double share = bracket->share();
    const double inside =
        sign * (share * bracket->lower.point.x() + (1.0 - share) * bracket->upper.point.x());
    return Bounds{inside, std::min(bracket->lower.outer, bracket->upper.outer)};
  }

  const PrincipalSection& section_;
  double height_;
  PointWithin within_{Vector2d::Zero(), 0.0};
};

}  // namespace

PrincipalSection::PrincipalSection(const PrincipalObstacle& obstacle)
    : obstacle_(obstacle),
      height_(-static_cast<double>(obstacle.offset().z())),
      error_(obstacle.error() +
             kBetweenRounding * (obstacle.resolution() + kEpsilon * std::abs(height_))),
      meeting_(Meeting::unknown) {
  const BallWithin& ball = obstacle.ball();
  const double above = ball.centre.z() - height_;
  const Vector3d side = (above > 0.0 ? -1.0 : 1.0) * Vector3d::UnitZ();
  const Vector3d other = obstacle.supportPoint(side);
  const double beyond = side.z() * (other.z() - height_);
  if (beyond < -2.0 * error_) meeting_ = Meeting::none;
  if (!(beyond > 0.0)) return;
  Vector3d between;
  within_.distance =
      withinBetween(ball.centre, ball.radius, std::abs(above), other, beyond, error_, between);
  within_.point = between.head<2>();
  if (within_.distance > kLeastWithin * error_) meeting_ = Meeting::inside;
}

std::optional<SectionTouch> PrincipalSection::touch(const Vector2d& direction, double tolerance,
                                                    double across, double bend) const {
  const auto at = [&](double t) {
    const Vector3d point = obstacle_.supportPoint({direction.x(), direction.y(), t});
    const double above = point.z() - height_;
    return PlaneSample{t, direction.dot(point.head<2>()) + t * above, above, point};
  };
  const auto bracket = BracketSearch<PlaneSample>::run(at, across, bend, tolerance);
  if (!bracket) return std::nullopt;
  const PlaneSample &lower = bracket->lower, &upper = bracket->upper;
  const double share = bracket->share();
  const PlaneSample& best = bracket->lowest();
  SectionTouch touch;
  touch.normal = direction;
  touch.point = (share * lower.point + (1.0 - share) * upper.point).head<2>();
  touch.offset = best.value + error_ * (direction.norm() + std::abs(best.t));
  touch.across = best.t;
  touch.bend = upper.t > lower.t ? (upper.slope - lower.slope) / (upper.t - lower.t) : bend;
  return touch;
}

AxisSection axisSection(const PrincipalSection& section) { return AxisSearch(section).run(); }

}  // namespace fcl_prob::detail
