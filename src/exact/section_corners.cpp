// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/section_corners.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/constants.h"
#include "mass/exact_hull.h"

namespace fcl_prob::detail {
namespace {

using Eigen::Vector2d;

/// Corners are on a grid, on which turns are decided exactly; they are below 2² in size.
constexpr double kCornerGrid = 0x1p-50;
constexpr double kMostCorner = 4.0;

/// By how much lines are moved outwards, and what corners have to be beyond them.
constexpr double kLineMargin = 64.0 * kEpsilon;
constexpr double kCornerMargin = 16.0 * kEpsilon;

Vector2d onGrid(const Vector2d& p) {
  return {std::nearbyint(p.x() / kCornerGrid) * kCornerGrid,
          std::nearbyint(p.y() / kCornerGrid) * kCornerGrid};
}

/// Whether a closed polygon goes once around a point, every turn as seen from there to the left:
/// then it is the boundary of what it encloses.
bool goesOnceAround(const Polygon2& corners, const Vector2d& centre) {
  int rounds = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2d &p = corners[k], &q = corners[(k + 1) % corners.size()];
    if (!turnsLeft(centre, p, q)) return false;
    if (p.y() < centre.y() && q.y() >= centre.y()) ++rounds;
  }
  return rounds == 1;
}

bool isInRange(const Polygon2& corners) {
  return std::all_of(corners.begin(), corners.end(),
                     [](const Vector2d& p) { return p.cwiseAbs().maxCoeff() < kMostCorner; });
}

/// Leaves out what does not turn to the left around the centre.
Polygon2 turningLeft(const Polygon2& points, const Vector2d& centre) {
  Polygon2 kept;
  for (const Vector2d& p : points) {
    if (kept.empty() || turnsLeft(centre, kept.back(), p)) kept.push_back(p);
  }
  while (kept.size() > 1 && !turnsLeft(centre, kept.back(), kept.front())) kept.pop_back();
  return kept;
}

/// The polygon that lines around a section leave. Lines that neighbours make superfluous (by
/// rounding) are left out; what is found has its sides beyond those that are kept.
class OuterPolygon {
 public:
  OuterPolygon(std::vector<const SectionTouch*> lines, const Vector2d& centre)
      : lines_(std::move(lines)), centre_(centre) {}

  /// Nothing if there is none.
  Polygon2 corners() {
    for (int pass = 0; pass < kMostPasses; ++pass) {
      if (lines_.size() < 3) return {};
      findCorners();
      const std::size_t count = lines_.size();
      std::vector<const SectionTouch*> kept;
      bool was_dropped = false;
      for (std::size_t k = 0; k < count; ++k) {
        // Of two neighbours only one at a time.
        const bool drop = !was_dropped && !isSide(k);
        if (!drop) kept.push_back(lines_[k]);
        was_dropped = drop;
      }
      if (kept.size() == count) return corners_;
      lines_ = std::move(kept);
    }
    return {};
  }

 private:
  static constexpr int kMostPasses = 100;

  void findCorners() {
    corners_.clear();
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      corners_.push_back(onGrid(apexOf(*lines_[k], *lines_[(k + 1) % lines_.size()], kLineMargin)));
    }
  }

  /// From the corner before a line to the one after it.
  bool isSide(std::size_t k) const {
    const SectionTouch& line = *lines_[k];
    const Vector2d& from = corners_[(k + corners_.size() - 1) % corners_.size()];
    const Vector2d& to = corners_[k];
    const auto isBeyond = [&](const Vector2d& p) {
      return line.normal.dot(p) >= line.offset + kCornerMargin;
    };
    return turnsLeft(centre_, from, to) && isBeyond(from) && isBeyond(to);
  }

  std::vector<const SectionTouch*> lines_;
  Vector2d centre_;
  Polygon2 corners_;
};

}  // namespace

Vector2d apexOf(const SectionTouch& first, const SectionTouch& second, double margin) {
  const Vector2d& u = first.normal;
  const Vector2d foot =
      first.point + (first.offset + margin - u.dot(first.point)) / u.squaredNorm() * u;
  const Vector2d along(-u.y(), u.x());
  const double beyond = second.offset + margin - second.normal.dot(foot);
  return foot + beyond / second.normal.dot(along) * along;
}

std::optional<Polygon2> innerCorners(const Polygon2& points, const Vector2d& centre) {
  const Vector2d from = onGrid(centre);
  Polygon2 rounded;
  for (const Vector2d& p : points) rounded.push_back(onGrid(p));
  Polygon2 corners = turningLeft(rounded, from);
  if (!isInRange(corners) || !goesOnceAround(corners, from)) return std::nullopt;
  return corners;
}

std::optional<Polygon2> outerCorners(std::vector<const SectionTouch*> lines,
                                     const Vector2d& centre) {
  const Vector2d from = onGrid(centre);
  Polygon2 corners = OuterPolygon(std::move(lines), from).corners();
  if (!isInRange(corners) || !goesOnceAround(corners, from)) return std::nullopt;
  return corners;
}

}  // namespace fcl_prob::detail
