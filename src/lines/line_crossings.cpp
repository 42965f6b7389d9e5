// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/line_crossings.h"

#include <algorithm>
#include <cmath>

#include "convex/portal.h"

namespace fcl_prob::detail {
namespace {

// Cuts in search of a point within a curved C-obstacle: each halves what is left of the line.
constexpr int kMostLineCuts = 40;

// Steps of a portal towards a point, or towards the boundary, and how near to that is near enough.
constexpr int kMostRefinements = 60;
constexpr double kNearBoundary = 1e-10;

}  // namespace

const std::vector<LineStretch>& LineCrossings::on(const Eigen::Vector3d& origin,
                                                  const Eigen::Vector3d& direction) {
  origin_ = origin;
  direction_ = direction;
  stretches_.clear();
  curved_.clear();
  if (pair_.a.tree->isEmpty() || pair_.b.tree->isEmpty()) return stretches_;
  stack_.assign(1, {0, 0});
  while (!stack_.empty()) {
    const NodePair nodes = stack_.back();
    stack_.pop_back();
    const auto in_box = clipped(obstacleBox(pair_, nodes));
    if (!in_box || isKnown(*in_box)) continue;
    if (areLeaves(pair_, nodes)) {
      clip(nodes);
      continue;
    }
    for (const NodePair& child : childrenOf(pair_, nodes)) stack_.push_back(child);
  }
  clipCurved();
  return stretches_;
}

void LineCrossings::clip(NodePair leaves) {
  const SlabArrays slabs = obstacles_.slabsOnce(leaves, once_);
  const auto stretch = clippedBySlabs(slabs, leaves);
  if (!stretch) return;
  if (slabs.outer_only) {
    curved_.push_back(*stretch);
  } else {
    add(*stretch);
  }
}

// The longest first: of the others, which take long to clip, most are then within known stretches.
void LineCrossings::clipCurved() {
  std::sort(curved_.begin(), curved_.end(), [](const LineStretch& x, const LineStretch& y) {
    return x.to.at - x.from.at > y.to.at - y.from.at;
  });
  for (const LineStretch& within : curved_) {
    if (isKnown(within)) continue;
    if (const auto stretch = clippedBySupport(within)) add(*stretch);
  }
}

std::optional<LineStretch> LineCrossings::clipped(const NodeBox& box) const {
  double lo = -kReach;
  double hi = kReach;
  for (int k = 0; k < 3; ++k) {
    if (direction_[k] == 0.0) {
      if (origin_[k] < box.lo[k] || origin_[k] > box.hi[k]) return std::nullopt;
      continue;
    }
    const double first = (box.lo[k] - origin_[k]) / direction_[k];
    const double second = (box.hi[k] - origin_[k]) / direction_[k];
    lo = std::max(lo, std::min(first, second));
    hi = std::min(hi, std::max(first, second));
  }
  if (!(lo <= hi)) return std::nullopt;
  return LineStretch{{lo}, {hi}};
}

std::optional<LineStretch> LineCrossings::clippedBySlabs(const SlabArrays& slabs,
                                                         NodePair leaves) const {
  LineStretch stretch{{-kReach, leaves}, {kReach, leaves}};
  for (int i = 0; i < slabs.count; ++i) {
    const Eigen::Vector3d n(slabs.nx()[i], slabs.ny()[i], slabs.nz()[i]);
    const double slope = n.dot(direction_);
    const double at = n.dot(origin_);
    if (slope == 0.0) {
      if (at < slabs.lo()[i] || at > slabs.hi()[i]) return std::nullopt;
      continue;
    }
    const double sign = slope > 0.0 ? 1.0 : -1.0;
    const double enter = ((slope > 0.0 ? slabs.lo()[i] : slabs.hi()[i]) - at) / slope;
    const double leave = ((slope > 0.0 ? slabs.hi()[i] : slabs.lo()[i]) - at) / slope;
    if (enter > stretch.from.at) stretch.from = {enter, leaves, -sign * n};
    if (leave < stretch.to.at) stretch.to = {leave, leaves, sign * n};
    if (!(stretch.from.at < stretch.to.at)) return std::nullopt;
  }
  return stretch;
}

// From a point inside, a ray each way.
std::optional<LineStretch> LineCrossings::clippedBySupport(const LineStretch& within) const {
  const NodePair leaves = within.from.leaves;
  const SupportObstacle obstacle = obstacles_.support(leaves);
  const auto inside = placeInside(obstacle, within.from.at, within.to.at);
  if (!inside) return std::nullopt;
  const auto from = leaving(obstacle, *inside, -1.0, leaves);
  const auto to = leaving(obstacle, *inside, 1.0, leaves);
  if (!from || !to || !(from->at < to->at)) return std::nullopt;
  return LineStretch{*from, *to};
}

// A plane that separates the middle of what is left from V cuts off one half or more of it.
std::optional<double> LineCrossings::placeInside(const SupportObstacle& obstacle, double lo,
                                                 double hi) const {
  for (int cut = 0; cut < kMostLineCuts && lo < hi; ++cut) {
    const double middle = 0.5 * (lo + hi);
    const Eigen::Vector3d y = pointAt(middle);
    const Eigen::Vector3d away = y - obstacle.centre();
    if (away.isZero(0.0)) return middle;
    Portal portal(obstacle, obstacle.centre(), away);
    if (!portal.found()) return std::nullopt;
    bool separated = false;
    for (int step = 0; step < kMostRefinements && !separated; ++step) {
      Eigen::Vector3d combination;
      if (portal.holds(y, combination)) return middle;
      const Eigen::Vector3d& n = portal.normal();
      const double offset = n.dot(obstacle.supportPoint(n)) - n.dot(origin_);
      const double slope = n.dot(direction_);
      separated = slope * middle > offset;
      if (separated && slope > 0.0) hi = std::min(hi, offset / slope);
      if (separated && slope < 0.0) lo = std::max(lo, offset / slope);
      if (separated ? slope == 0.0 : !portal.refine()) return std::nullopt;
    }
    if (!separated) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<LineEnd> LineCrossings::leaving(const SupportObstacle& obstacle, double from,
                                              double sign, NodePair leaves) const {
  const Eigen::Vector3d inside = pointAt(from);
  const Eigen::Vector3d ray = sign * direction_;
  Portal portal(obstacle, inside, ray);
  if (!portal.found()) return std::nullopt;
  for (int step = 0; step < kMostRefinements && portal.slack() > kNearBoundary; ++step) {
    if (!portal.refine()) break;
  }
  const double length = ray.dot(portal.piercedPoint() - inside);
  return LineEnd{from + sign * length, leaves, portal.normal()};
}

bool LineCrossings::isKnown(const LineStretch& stretch) const {
  return std::any_of(stretches_.begin(), stretches_.end(), [&stretch](const LineStretch& known) {
    return known.from.at <= stretch.from.at && stretch.to.at <= known.to.at;
  });
}

// United with all that it meets.
void LineCrossings::add(const LineStretch& stretch) {
  LineStretch united = stretch;
  const auto first =
      std::find_if(stretches_.begin(), stretches_.end(),
                   [&stretch](const LineStretch& known) { return known.to.at >= stretch.from.at; });
  auto last = first;
  for (; last != stretches_.end() && last->from.at <= stretch.to.at; ++last) {
    if (last->from.at < united.from.at) united.from = last->from;
    if (last->to.at > united.to.at) united.to = last->to;
  }
  stretches_.insert(stretches_.erase(first, last), united);
}

Eigen::Vector3d LineCrossings::touchingPointOfA(const LineEnd& end) const {
  return obstacles_.support(end.leaves).touchingPointOfA(pointAt(end.at), end.normal);
}

}  // namespace fcl_prob::detail
