// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "carving/whole_body_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/constants.h"
#include "cobstacle/slab_kernels.h"
#include "fcl_prob/normal_mass.h"
#include "pieces/nearly_convex.h"

namespace fcl_prob::detail {
namespace {

// Of a bound on a column: what rounding may take from it.
constexpr double kRoundedLines = 1e-12;

// Of a line that only tells where contact is.
constexpr LeftOut kRoughly{0.1, 1e-6};

// Nodes that are smaller than this share of a column tell no more of it by being opened.
constexpr double kFineEnough = 0.5;

// Directions in which the width of a member is measured, to both sides.
constexpr int kWidths = 8;
constexpr double kPi = 3.14159265358979323846;

// Tails beyond this distance have at most this mass: Φ(-d) <= exp(-d²/2) / 2.
double distanceOfTail(double mass) {
  return std::sqrt(std::max(0.0, -2.0 * std::log(std::max(2.0 * mass, 1e-300))));
}

/// One part of the body in the frame of the lines.
class WhitenedPart {
 public:
  WhitenedPart(const WhitenedPair& pair, const WholeBody& whole, const Eigen::Matrix3d& matrix,
               std::size_t index)
      : pair_(pair), whole_(whole), index_(index), part_(whole.body.tree->parts[index]) {
    linear_ = matrix * whole.body.parts[index].pose.linear();
  }

  bool isConvex() const { return part_.fan != nullptr; }

  /// Nothing if that is not accurate enough, or may hold part of the mesh.
  std::optional<WhitenedFan> fan(StandIns stand_ins) const {
    if (isConvex()) return visible(*part_.fan);
    auto hull = visible(part_.nearly->hull);
    if (!hull || stand_ins == StandIns::hulls) return hull;
    return whitened(part_.nearly->core);
  }

 private:
  std::optional<WhitenedFan> whitened(const ConvexFan& fan) const {
    WhitenedFan result(pair_, part_, fan, whole_.body_is_a, linear_);
    if (!result.usable()) return std::nullopt;
    return result;
  }

  std::optional<WhitenedFan> visible(const ConvexFan& fan) const {
    auto result = whitened(fan);
    if (result && mayHoldPart(whole_, index_, *result)) return std::nullopt;
    return result;
  }

  const WhitenedPair& pair_;
  const WholeBody& whole_;
  std::size_t index_;
  const PieceTree::Part& part_;
  Eigen::Matrix3d linear_;
};

double nearness(const LineSpan& span) { return std::max({span.lo, -span.hi, 0.0}); }

}  // namespace

std::unique_ptr<WholeBodyLines> WholeBodyLines::of(const WhitenedPair& pair,
                                                   const PartitionObject& a,
                                                   const PartitionObject& b,
                                                   const GaussianDisplacement& displacement,
                                                   const Eigen::Matrix3d& matrix,
                                                   const SolidContact* solids, StandIns stand_ins) {
  const auto whole = wholeBodyOf(
      a, b, displacement, stand_ins == StandIns::none ? Convexity::exact : Convexity::nearly);
  if (!whole || pair.band) return nullptr;
  auto lines = std::make_unique<WholeBodyLines>();
  for (std::size_t i = 0; i < whole->body.parts.size(); ++i) {
    const WhitenedPart part(pair, *whole, matrix, i);
    if (!part.isConvex()) lines->stand_ins_ = stand_ins;
    auto fan = part.fan(stand_ins);
    if (!fan) return nullptr;
    lines->members_.emplace_back(std::move(*fan), static_cast<int>(i));
  }
  if (lines->stand_ins_ != StandIns::cores) lines->solids_ = solids;
  return lines;
}

void WholeBodyLines::begin(const Column& column) {
  stack_.clear();
  for (Member& member : members_) {
    member.line.lookAt(column);
    if (const auto span = member.line.around(0)) stack_.push_back({{&member, 0}, *span});
  }
}

// The node that may be nearer to the lines' middle comes first.
void WholeBodyLines::pushChildren(const Visit& visit) {
  Member* const member = visit.place.member;
  const PieceTree::Node& node = member->fan.mesh().tree->nodes[visit.place.node];
  const Place left{member, node.left}, right{member, node.right};
  const auto of_left = member->line.around(left.node);
  const auto of_right = member->line.around(right.node);
  const bool left_first = of_left && of_right && nearness(*of_left) < nearness(*of_right);
  if (of_left && !left_first) stack_.push_back({left, *of_left});
  if (of_right) stack_.push_back({right, *of_right});
  if (of_left && left_first) stack_.push_back({left, *of_left});
}

// What a column may meet, united: nodes that are fine, and behind them those that stick out.
void WholeBodyLines::meet(const Column& column) {
  const Eigen::Vector2d fine = kFineEnough * (column.hi - column.lo);
  begin(column);
  met_.clear();
  while (!stack_.empty()) {
    const Visit visit = stack_.back();
    stack_.pop_back();
    if (isMet(visit.span)) continue;
    const WhitenedTree& mesh = visit.place.member->fan.mesh();
    const NodeBox& box = mesh.boxes[visit.place.node];
    const bool is_fine = box.hi[1] - box.lo[1] < fine[0] && box.hi[2] - box.lo[2] < fine[1];
    if (is_fine || mesh.tree->nodes[visit.place.node].isLeaf()) {
      addMet(visit.span);
    } else {
      pushChildren(visit);
    }
  }
}

bool WholeBodyLines::isMet(const LineSpan& span) const {
  return std::any_of(met_.begin(), met_.end(), [&span](const LineSpan& known) {
    return known.lo <= span.lo && span.hi <= known.hi;
  });
}

// United with all that it meets.
void WholeBodyLines::addMet(LineSpan span) {
  std::size_t kept = 0;
  for (const LineSpan& known : met_) {
    if (known.hi < span.lo || span.hi < known.lo) {
      met_[kept++] = known;
    } else {
      span = {std::min(span.lo, known.lo), std::max(span.hi, known.hi)};
    }
  }
  met_.resize(kept);
  met_.push_back(span);
}

// Where one solid is in the other, too, their surfaces touch before and behind: far out on the line
// the objects are apart.
double WholeBodyLines::mostOn(const Column& column) {
  meet(column);
  if (met_.empty()) return 0.0;
  if (solids_) {
    LineSpan all = met_.front();
    for (const LineSpan& span : met_) {
      all = {std::min(all.lo, span.lo), std::max(all.hi, span.hi)};
    }
    met_ = {all};
  }
  double mass = 0.0;
  for (const LineSpan& span : met_) mass += normalIntervalMass(span.lo, span.hi);
  return std::min(1.0, mass * (1.0 + kRoundedLines));
}

double WholeBodyLines::leastOn(const Column& column, const Touch& touch) const {
  const Member& member = members_[static_cast<std::size_t>(touch.member)];
  return member.inner.of(column, touch.point) * (1.0 - kRoundedLines);
}

WholeBodyLines::LineContacts WholeBodyLines::contactsOn(const Eigen::Vector2d& u) {
  LineContacts contacts{massOn(u, kRoughly), {}};
  for (const Stretch& stretch : stretches_) {
    contacts.touches.push_back({stretch.first.member->index, stretch.point});
  }
  return contacts;
}

void WholeBodyLines::beginLine(const LeftOut& negligible) {
  known_.clear();
  for (const Stretch& stretch : stretches_) {
    known_.push_back(stretch.first);
    known_.push_back(stretch.last);
  }
  stretches_.clear();
  mass_ = 0.0;
  negligible_ = negligible;
  beyond_ = distanceOfTail(negligible.mass);
  left_out_below_ = left_out_above_ = false;
}

// Most of a line is like the last one.
void WholeBodyLines::testKnown(const Eigen::Vector2d& u) {
  for (const Place& place : known_) {
    const auto span = place.member->line.around(place.node);
    if (!span) continue;
    Visit visit{place, *span};
    if (!isSettled(visit.span)) test(visit, u);
  }
}

double WholeBodyLines::massOn(const Eigen::Vector2d& u, const LeftOut& negligible) {
  beginLine(negligible);
  begin({u, u});
  testKnown(u);
  while (!stack_.empty()) {
    Visit visit = stack_.back();
    stack_.pop_back();
    if (isSettled(visit.span)) continue;
    if (visit.place.member->fan.mesh().tree->nodes[visit.place.node].isLeaf()) {
      test(visit, u);
    } else {
      pushChildren(visit);
    }
  }
  if (solids_) joinContained(u);
  return mass_;
}

// Whether all of it is within known stretches or negligible; otherwise its ends are moved out of
// those.
bool WholeBodyLines::isSettled(LineSpan& span) {
  left_out_above_ = left_out_above_ || span.hi > beyond_;
  left_out_below_ = left_out_below_ || span.lo < -beyond_;
  span.lo = std::max(span.lo, -beyond_);
  span.hi = std::min(span.hi, beyond_);
  for (const Stretch& stretch : stretches_) {
    const LineSpan& known = stretch.span;
    if (known.lo <= span.lo && span.lo <= known.hi) span.lo = known.hi;
    if (known.lo <= span.hi && span.hi <= known.hi) span.hi = known.lo;
  }
  return !(span.lo < span.hi);
}

bool WholeBodyLines::endsStretch(double s) const {
  return std::any_of(stretches_.begin(), stretches_.end(),
                     [s](const Stretch& known) { return known.span.hi == s; });
}

// Most of what is only open behind a known stretch does not stick out of it: that is asked first.
void WholeBodyLines::test(const Visit& visit, const Eigen::Vector2d& u) {
  Member& member = *visit.place.member;
  const int piece = member.fan.mesh().tree->nodes[visit.place.node].piece;
  const Eigen::Matrix3d corners = member.fan.corners(piece);
  std::optional<double> to;
  if (endsStretch(visit.span.lo)) {
    const auto last = member.line.first(corners, u, -1.0, -visit.span.lo);
    if (!last) return;
    to = -*last;
  }
  const auto from = member.line.first(corners, u, 1.0, visit.span.hi);
  if (!from) return;
  const Eigen::Vector3d point = member.line.touchedPoint(u);
  if (!to) {
    LineSpan left{std::max(*from, visit.span.lo), visit.span.hi};
    if (isSettled(left)) return;
    to = endOf({visit.place, left}, corners, u);
  }
  if (to && *from < *to) add({{*from, *to}, visit.place, visit.place, point});
}

// Where what is behind the end of the part that is easily known makes no difference, that will do.
std::optional<double> WholeBodyLines::endOf(const Visit& visit, const Eigen::Matrix3d& corners,
                                            const Eigen::Vector2d& u) {
  FanLine& line = visit.place.member->line;
  double least = visit.span.lo;
  const bool sticks_out = endsStretch(least);
  if (!sticks_out) {
    least = line.endBehindFirst();
    if (least >= visit.span.hi) return least;
  }
  const auto last = line.first(corners, u, -1.0, -least);
  if (last) return -*last;
  return sticks_out ? std::nullopt : std::optional<double>(least);
}

// United with all that it meets.
void WholeBodyLines::add(Stretch stretch) {
  const auto first =
      std::find_if(stretches_.begin(), stretches_.end(),
                   [&stretch](const Stretch& known) { return known.span.hi >= stretch.span.lo; });
  auto last = first;
  for (; last != stretches_.end() && last->span.lo <= stretch.span.hi; ++last) {
    if (last->span.lo < stretch.span.lo) {
      stretch.span.lo = last->span.lo;
      stretch.first = last->first;
      stretch.point = last->point;
    }
    if (last->span.hi > stretch.span.hi) {
      stretch.span.hi = last->span.hi;
      stretch.last = last->last;
    }
  }
  stretches_.insert(stretches_.erase(first, last), stretch);
  mass_ = 0.0;
  for (const Stretch& known : stretches_) {
    mass_ += normalIntervalMass(known.span.lo, known.span.hi);
  }
  const double tail = std::max(negligible_.mass, negligible_.share * mass_);
  beyond_ = std::min(beyond_, distanceOfTail(tail));
}

// Between two stretches the surfaces do not meet, and one point tells of all. What is before the
// first and behind the last is joined to where the objects are far apart, unless something was left
// out there.
void WholeBodyLines::joinContained(const Eigen::Vector2d& u) {
  std::vector<LineSpan> gaps;
  double from = left_out_below_ ? -beyond_ : -kInfinity;
  for (const Stretch& stretch : stretches_) {
    gaps.push_back({from, stretch.span.lo});
    from = stretch.span.hi;
  }
  gaps.push_back({from, left_out_above_ ? beyond_ : kInfinity});
  for (const LineSpan& gap : gaps) {
    if (!std::isfinite(gap.lo) || !std::isfinite(gap.hi) || !(gap.lo < gap.hi)) continue;
    const Eigen::Vector3d y(0.5 * (gap.lo + gap.hi), u[0], u[1]);
    if (solids_->at(y) != Containment::inside) continue;
    mass_ += normalIntervalMass(gap.lo, gap.hi);
  }
  mass_ = std::min(mass_, 1.0);
}

// The hull of a disc and two points opposite each other has at least the area r·L.
Silhouette WholeBodyLines::leastSilhouette() const {
  Silhouette least{kInfinity, kInfinity};
  for (const Member& member : members_) {
    double radius = kInfinity, length = 0.0;
    for (int i = 0; i < kWidths; ++i) {
      const double angle = kPi * i / kWidths;
      const Eigen::Vector3d n(0.0, std::cos(angle), std::sin(angle));
      const double ahead = member.fan.support(n), behind = member.fan.support(-n);
      radius = std::min({radius, ahead, behind});
      length = std::max(length, ahead + behind);
    }
    least.radius = std::min(least.radius, radius);
    least.area = std::min(least.area, radius * length);
  }
  return least;
}

}  // namespace fcl_prob::detail
