// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/section_polygons.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/constants.h"
#include "exact/section_corners.h"

namespace fcl_prob::detail {
namespace {

using Eigen::Vector2d;

constexpr int kFirstDirections = 8;
constexpr std::size_t kFirstLimit = 32;
constexpr std::size_t kMostNodes = 20000;

/// Turns below this are none.
constexpr double kLeastTurn = 1e-12;

/// Of the square of a triangle's height: the gap that a search may leave. It stays when neighbours
/// are divided further; from them a search gets that far in two or three steps.
constexpr double kSearchGap = 1e-3;

double crossOf(const Vector2d& u, const Vector2d& v) { return u.x() * v.y() - u.y() * v.x(); }

double squareTo(const Vector2d& from, const Vector2d& to) {
  const Vector2d way = to - from;
  const double square = way.squaredNorm();
  if (!(square > 0.0)) return from.squaredNorm();
  return (from + std::clamp(-from.dot(way) / square, 0.0, 1.0) * way).squaredNorm();
}

}  // namespace

SectionPolygons::SectionPolygons(const PrincipalSection& section, const Interruption& interruption)
    : section_(section), interruption_(interruption) {}

Bounds SectionPolygons::mass(double accuracy) {
  if (section_.meeting() == Meeting::none) return {0.0, 0.0};
  if (section_.meeting() != Meeting::inside || !addFirstNodes()) return {0.0, 1.0};
  double known = 0.0;
  for (std::size_t limit = kFirstLimit;; limit *= 2) {
    refineUntil(accuracy * known, std::min(limit, kMostNodes));
    const bool is_done = nodes_.size() < limit || limit >= kMostNodes || isDue(interruption_);
    if (is_done) break;
    known = std::max(0.0, innerMass().lower);
  }
  return {std::max(0.0, innerMass().lower), std::min(1.0, outerMass().upper)};
}

bool SectionPolygons::addFirstNodes() {
  for (int k = 0; k < kFirstDirections; ++k) {
    const double angle = 2.0 * M_PI * k / kFirstDirections;
    const auto touch =
        section_.touch({std::cos(angle), std::sin(angle)}, section_.obstacle().resolution());
    if (!touch) return false;
    nodes_.push_back({*touch, nodes_.size() + 1, true});
  }
  nodes_.back().next = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) addArc(k);
  summed_gap_ = gap_;
  return true;
}

Vector2d SectionPolygons::whitened(const Vector2d& point, double share) const {
  const PrincipalObstacle& obstacle = section_.obstacle();
  const Vector2d& centre = section_.within().point;
  Vector2d result;
  for (int k = 0; k < 2; ++k) {
    const long double from = centre[k];
    const long double moved = from + static_cast<long double>(share) * (point[k] - from);
    result[k] = static_cast<double>((moved + obstacle.offset()[k]) / obstacle.deviations()[k]);
  }
  return result;
}

/// About the mass of a triangle, rather too much.
double SectionPolygons::weightOf(const Vector2d& p, const Vector2d& apex, const Vector2d& q) const {
  const Vector2d x = whitened(p, 1.0), y = whitened(apex, 1.0), z = whitened(q, 1.0);
  const double area = 0.5 * std::abs(crossOf(y - x, z - x));
  const double first = crossOf(x, y), second = crossOf(y, z), third = crossOf(z, x);
  const bool holds_mean = (first >= 0.0 && second >= 0.0 && third >= 0.0) ||
                          (first <= 0.0 && second <= 0.0 && third <= 0.0);
  const double square =
      holds_mean ? 0.0 : std::min({squareTo(x, y), squareTo(y, z), squareTo(z, x)});
  return area * std::exp(-0.5 * square) / (2.0 * M_PI);
}

void SectionPolygons::addArc(std::size_t first) {
  const SectionTouch& from = nodes_[first].touch;
  const SectionTouch& to = nodes_[nodes_[first].next].touch;
  if (!(crossOf(from.normal, to.normal) > kLeastTurn)) return;
  const double gap = weightOf(from.point, apexOf(from, to), to.point);
  if (!(gap > 0.0)) return;
  gap_ += gap;
  arcs_.push_back({gap, first});
  std::push_heap(arcs_.begin(), arcs_.end());
}

void SectionPolygons::divide(const Arc& arc) {
  const SectionTouch& from = nodes_[arc.first].touch;
  const SectionTouch& to = nodes_[nodes_[arc.first].next].touch;
  const Vector2d chord = to.point - from.point;
  const double length = chord.norm();
  if (!(length > 2.0 * section_.error())) return;
  const Vector2d normal = Vector2d(chord.y(), -chord.x()) / length;
  const double turn = crossOf(from.normal, to.normal);
  const double before = crossOf(from.normal, normal), after = crossOf(normal, to.normal);
  if (!(before > kLeastTurn && after > kLeastTurn)) {
    sharpen(arc.first);
    return;
  }
  const double height = normal.dot(apexOf(from, to) - from.point);
  const double tolerance = std::max(section_.obstacle().resolution(), kSearchGap * height * height);
  const double across = (after * from.across + before * to.across) / turn;
  const auto touch = section_.touch(normal, tolerance, across, from.bend);
  if (!touch) return;
  const std::size_t added = nodes_.size();
  nodes_.push_back({*touch, nodes_[arc.first].next, false});
  nodes_[arc.first].next = added;
  addArc(arc.first);
  addArc(added);
}

/// A search that was left off early may hide which part of an arc is open: the one of the two nodes
/// that leaves more is searched to the end, once.
void SectionPolygons::sharpen(std::size_t first) {
  const auto slackOf = [&](std::size_t k) {
    const SectionTouch& touch = nodes_[k].touch;
    return touch.offset - touch.normal.dot(touch.point);
  };
  const std::size_t second = nodes_[first].next;
  Node& node = nodes_[slackOf(first) > slackOf(second) ? first : second];
  if (node.is_sharp) return;
  node.is_sharp = true;
  const SectionTouch& old = node.touch;
  const auto touch =
      section_.touch(old.normal, section_.obstacle().resolution(), old.across, old.bend);
  if (!touch) return;
  node.touch = *touch;
  addArc(first);
}

void SectionPolygons::refineUntil(double gap, std::size_t most_nodes) {
  while (gap_ > gap && nodes_.size() < most_nodes && !arcs_.empty()) {
    if (nodes_.size() % 64 == 0 && isDue(interruption_)) return;
    std::pop_heap(arcs_.begin(), arcs_.end());
    const Arc widest = arcs_.back();
    arcs_.pop_back();
    gap_ -= widest.gap;
    divide(widest);
    sumAnew();
  }
}

/// The first arcs may weigh 1e100 times as much as what they leave in the end.
void SectionPolygons::sumAnew() {
  if (gap_ > 0.1 * summed_gap_) return;
  gap_ = 0.0;
  for (const Arc& arc : arcs_) gap_ += arc.gap;
  summed_gap_ = gap_;
}

std::vector<std::size_t> SectionPolygons::ring() const {
  std::vector<std::size_t> order;
  std::size_t at = 0;
  do {
    order.push_back(at);
    at = nodes_[at].next;
  } while (at != 0);
  return order;
}

/// Points are within an error of the obstacle, which has a ball of some radius about the centre:
/// seen from there, at a share of their distance they are within it.
Bounds SectionPolygons::innerMass() const {
  Polygon2 points;
  for (const std::size_t k : ring()) points.push_back(nodes_[k].touch.point);
  const auto corners = innerCorners(points, section_.within().point);
  if (!corners) return {0.0, 1.0};
  const double error = section_.error() + kGridRounding;
  return massOf(*corners, 1.0 / (1.0 + error / section_.within().distance));
}

Bounds SectionPolygons::outerMass() const {
  std::vector<const SectionTouch*> lines;
  for (const std::size_t k : ring()) lines.push_back(&nodes_[k].touch);
  const auto corners = outerCorners(std::move(lines), section_.within().point);
  return corners ? massOf(*corners, 1.0) : Bounds{0.0, 1.0};
}

Bounds SectionPolygons::massOf(const Polygon2& corners, double share) const {
  Polygon2 image;
  double reach = 0.0;
  for (const Vector2d& p : corners) {
    image.push_back(whitened(p, share));
    reach = std::max(reach, image.back().norm());
  }
  return polygonMass(image, Vector2d::Constant(kEpsilon * reach));
}

}  // namespace fcl_prob::detail
