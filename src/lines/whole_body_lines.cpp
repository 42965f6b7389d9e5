// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/whole_body_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/constants.h"
#include "base/quantiles.h"
#include "convex/slab_kernels.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

// Of a line that only tells where contact is.
constexpr LeftOut kRoughly{0.1, 1e-6};

// Triangles of one line that are looked at on the lines beside it.
constexpr std::size_t kLongestChain = 6;

// Places at ends of contact on earlier lines that a line is asked for first.
constexpr std::size_t kMostKnown = 8;

// Directions in which the width of a member is measured, to both sides.
constexpr int kWidths = 8;
constexpr double kPi = 3.14159265358979323846;
constexpr double kSqrt2 = 1.41421356237309504880;

// Tails beyond this distance have this mass.
double distanceOfTail(double mass) {
  return mass < 0.5 ? kSqrt2 * erfcInverseInDouble(2.0 * std::max(mass, 1e-300)) : 0.0;
}

double nearness(const LineSpan& span) { return std::max({span.lo, -span.hi, 0.0}); }

}  // namespace

std::unique_ptr<WholeBodyLines> WholeBodyLines::of(const QueryScene& scene) {
  const auto& whole = scene.wholeBody();
  if (!whole) return nullptr;
  return of(*whole, scene.pair(), scene.whitening().matrix(), scene.solids());
}

std::unique_ptr<WholeBodyLines> WholeBodyLines::of(const WholeBody& whole, const WhitenedPair& pair,
                                                   const Eigen::Matrix3d& matrix,
                                                   const SolidContact* solids) {
  if (pair.band) return nullptr;
  auto lines = std::make_unique<WholeBodyLines>();
  lines->solids_ = solids;
  for (std::size_t i = 0; i < whole.body.parts.size(); ++i) {
    lines->addMember(whole, i, pair, matrix * whole.body.parts[i].pose.linear());
    const Member& member = lines->members_.back();
    const bool usable = member.fan.usable() && member.body().usable();
    if (!usable || mayHoldPart(whole, i, member.fan)) return nullptr;
  }
  return lines;
}

void WholeBodyLines::addMember(const WholeBody& whole, std::size_t index, const WhitenedPair& pair,
                               const Eigen::Matrix3d& linear) {
  const PieceTree::Part& part = whole.body.tree->parts[index];
  const bool is_a = whole.body_is_a;
  const auto fanOf = [&](const ConvexFan& fan) {
    return WhitenedFan(pair, part, fan, is_a, linear);
  };
  if (part.fan) {
    members_.emplace_back(fanOf(*part.fan), nullptr, static_cast<int>(index));
    return;
  }
  members_.emplace_back(fanOf(part.nearly->hull),
                        std::make_unique<WhitenedFan>(fanOf(part.nearly->core)),
                        static_cast<int>(index));
  Member& member = members_.back();
  member.hull = std::make_unique<FanLine>(member.fan);
  is_convex_ = false;
}

double WholeBodyLines::rounding() const {
  double most = 0.0;
  for (const Member& member : members_) {
    for (int f = 0; f < member.fan.faceCount(); ++f) {
      most = std::max(most, member.fan.faceMargin(f));
    }
  }
  return most;
}

WholeBodyLines::Met WholeBodyLines::everything() {
  Met met{{{-kInfinity, kInfinity}}, {}};
  for (Member& member : members_) met.visits.push_back({{&member, 0}, met.spans.front()});
  return met;
}

void WholeBodyLines::begin(const Column& column, const Met& among) {
  stack_.clear();
  for (Member& member : members_) member.nodes.lookAt(column);
  for (auto visit = among.visits.rbegin(); visit != among.visits.rend(); ++visit) {
    const Place& place = visit->place;
    if (const auto span = place.member->nodes.around(place.node)) stack_.push_back({place, *span});
  }
}

// The node that may be nearer to the lines' middle comes first.
void WholeBodyLines::pushChildren(const Visit& visit) {
  Member* const member = visit.place.member;
  const PieceTree::Node& node = member->fan.mesh().tree->nodes[visit.place.node];
  const Place left{member, node.left}, right{member, node.right};
  const auto of_left = member->nodes.around(left.node);
  const auto of_right = member->nodes.around(right.node);
  const bool left_first = of_left && of_right && nearness(*of_left) < nearness(*of_right);
  if (of_left && !left_first) stack_.push_back({left, *of_left});
  if (of_right) stack_.push_back({right, *of_right});
  if (of_left && left_first) stack_.push_back({left, *of_left});
}

WholeBodyLines::LineContacts WholeBodyLines::contactsOn(const Eigen::Vector2d& u, const Met& met,
                                                        Taken taken) {
  // Such lines are far from each other.
  known_.clear();
  const double mass = massOn(u, met, kRoughly, taken);
  return {mass, chainOf()};
}

// Triangles that together make most of the stretch with the largest mass, in order.
std::vector<WholeBodyLines::Touching> WholeBodyLines::chainOf() const {
  std::vector<Touching> chain;
  if (stretches_.empty()) return chain;
  const auto mass = [](const Stretch& s) { return normalIntervalMass(s.span.lo, s.span.hi); };
  const auto main = std::max_element(
      stretches_.begin(), stretches_.end(),
      [&](const Stretch& one, const Stretch& other) { return mass(one) < mass(other); });
  double end = main->span.lo;
  while (chain.size() < kLongestChain && end < main->span.hi) {
    const Stretch* next = nullptr;
    for (const Stretch& part : parts_) {
      const bool goes_on = part.span.lo <= end && part.span.hi > end;
      if (goes_on && (!next || part.span.hi > next->span.hi)) next = &part;
    }
    if (!next) break;
    chain.push_back({next->first.member->index, triangleOf(next->first)});
    end = next->span.hi;
  }
  return chain;
}

void WholeBodyLines::beginLine(const LeftOut& negligible) {
  for (const Stretch& stretch : stretches_) {
    remember(stretch.first);
    remember(stretch.last);
  }
  stretches_.clear();
  parts_.clear();
  mass_ = 0.0;
  negligible_ = negligible;
  beyond_ = distanceOfTail(negligible.mass);
  left_out_below_ = left_out_above_ = false;
}

// The latest comes first.
void WholeBodyLines::remember(const Place& place) {
  const auto at = std::find(known_.begin(), known_.end(), place);
  if (at == known_.end()) {
    if (known_.size() == kMostKnown) known_.pop_back();
    known_.insert(known_.begin(), place);
  } else {
    std::rotate(known_.begin(), at, at + 1);
  }
}

// Most of a line is like the last ones.
void WholeBodyLines::testKnown(const Eigen::Vector2d& u) {
  for (const Place& place : known_) {
    const auto span = place.member->nodes.around(place.node);
    if (!span) continue;
    Visit visit{place, *span};
    if (!isSettled(visit.span)) test(visit, u);
  }
}

double WholeBodyLines::massOn(const Eigen::Vector2d& u, const Met& met, const LeftOut& negligible,
                              Taken taken) {
  beginLine(negligible);
  taken_ = taken;
  for (Member& member : members_) member.nodes.lookAt({u, u});
  testKnown(u);
  for (const Visit& visit : met.visits) {
    LineSpan of_column = visit.span;
    if (isSettled(of_column)) continue;
    const auto span = visit.place.member->nodes.around(visit.place.node);
    if (!span) continue;
    stack_.assign(1, {visit.place, *span});
    testAll(u);
  }
  mass_ = 0.0;
  for (const Stretch& known : stretches_) {
    mass_ += normalIntervalMass(known.span.lo, known.span.hi);
  }
  // Where the core meets nothing, the surface may.
  if (solids_ && (is_convex_ || taken != Taken::cores)) joinContained(u);
  return mass_;
}

// What is on the stack, and below it.
void WholeBodyLines::testAll(const Eigen::Vector2d& u) {
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
}

// Whether all of it is within known stretches or negligible; otherwise its ends are moved out of
// those.
bool WholeBodyLines::isSettled(LineSpan& span) {
  for (const Stretch& stretch : stretches_) {
    const LineSpan& known = stretch.span;
    if (known.hi < span.lo) continue;
    if (known.lo <= span.lo) {
      if (span.hi <= known.hi) return true;
      span.lo = known.hi;
    } else if (span.hi <= known.hi) {
      if (known.lo <= span.hi) span.hi = known.lo;
      break;
    }
  }
  left_out_above_ = left_out_above_ || span.hi > beyond_;
  left_out_below_ = left_out_below_ || span.lo < -beyond_;
  span.lo = std::max(span.lo, -beyond_);
  span.hi = std::min(span.hi, beyond_);
  return !(span.lo < span.hi);
}

bool WholeBodyLines::endsStretch(double s) const {
  return std::any_of(stretches_.begin(), stretches_.end(),
                     [s](const Stretch& known) { return known.span.hi == s; });
}

// Most of what is only open behind a known stretch does not stick out of it: that is asked first.
void WholeBodyLines::test(const Visit& visit, const Eigen::Vector2d& u) {
  FanLine& line = visit.place.member->lineOf(taken_);
  const int triangle = triangleOf(visit.place);
  std::optional<double> to;
  if (endsStretch(visit.span.lo)) {
    const auto last = line.first(triangle, u, -1.0, -visit.span.lo);
    if (!last) return;
    to = -*last;
  }
  const auto from = line.first(triangle, u, 1.0, visit.span.hi);
  if (!from) return;
  if (!to) {
    LineSpan left{std::max(*from, visit.span.lo), visit.span.hi};
    if (isSettled(left)) return;
    to = endOf({visit.place, left}, u);
  }
  if (to && *from < *to) add({{*from, *to}, visit.place, visit.place});
}

// Where what is behind the end of the part that is easily known makes no difference, that will do.
std::optional<double> WholeBodyLines::endOf(const Visit& visit, const Eigen::Vector2d& u) {
  FanLine& line = visit.place.member->lineOf(taken_);
  const int triangle = triangleOf(visit.place);
  double least = visit.span.lo;
  const bool sticks_out = endsStretch(least);
  if (!sticks_out) {
    least = line.endBehindFirst();
    if (least >= visit.span.hi) return least;
  }
  const auto last = line.first(triangle, u, -1.0, -least);
  if (last) return -*last;
  return sticks_out ? std::nullopt : std::optional<double>(least);
}

// United with all that it meets.
void WholeBodyLines::add(Stretch stretch) {
  parts_.push_back(stretch);
  const auto first =
      std::find_if(stretches_.begin(), stretches_.end(),
                   [&stretch](const Stretch& known) { return known.span.hi >= stretch.span.lo; });
  auto last = first;
  for (; last != stretches_.end() && last->span.lo <= stretch.span.hi; ++last) {
    if (last->span.lo < stretch.span.lo) {
      stretch.span.lo = last->span.lo;
      stretch.first = last->first;
    }
    if (last->span.hi > stretch.span.hi) {
      stretch.span.hi = last->span.hi;
      stretch.last = last->last;
    }
  }
  if (first == last) count(stretch);
  stretches_.insert(stretches_.erase(first, last), stretch);
}

// What known stretches grow by makes little difference to what is negligible.
void WholeBodyLines::count(const Stretch& stretch) {
  mass_ += normalIntervalMass(stretch.span.lo, stretch.span.hi);
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
double WholeBodyLines::leastArea() const {
  double least = kInfinity;
  for (const Member& member : members_) {
    double radius = kInfinity, length = 0.0;
    for (int i = 0; i < kWidths; ++i) {
      const double angle = kPi * i / kWidths;
      const Eigen::Vector3d n(0.0, std::cos(angle), std::sin(angle));
      const double ahead = member.fan.support(n), behind = member.fan.support(-n);
      radius = std::min({radius, ahead, behind});
      length = std::max(length, ahead + behind);
    }
    least = std::min(least, radius * length);
  }
  return least;
}

}  // namespace fcl_prob::detail
