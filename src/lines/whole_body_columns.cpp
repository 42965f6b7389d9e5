// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is certain of all lines of a column.
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"
#include "lines/whole_body_lines.h"

namespace fcl_prob::detail {
namespace {

// Of a bound on a column: what rounding may take from it.
constexpr double kRoundedLines = 1e-12;

// Nodes that are smaller than this share of a column tell no more of it by being opened.
constexpr double kFineEnough = 0.5;

// Triangles of which planes of their own are looked at in one column.
constexpr int kMostPlanes = 64;

// Lines that come so late tell nothing.
constexpr double kTooLate = 40.0;

CornerValues all(double value) { return {value, value, value, value}; }

bool isWithin(const LineSpan& span, const std::vector<LineSpan>& spans) {
  return std::any_of(spans.begin(), spans.end(), [&span](const LineSpan& known) {
    return known.lo <= span.lo && span.hi <= known.hi;
  });
}

// Adds it, united with all that it meets.
void unite(LineSpan span, std::vector<LineSpan>& spans) {
  std::size_t kept = 0;
  for (const LineSpan& known : spans) {
    if (known.hi < span.lo || span.hi < known.lo) {
      spans[kept++] = known;
    } else {
      span = {std::min(span.lo, known.lo), std::max(span.hi, known.hi)};
    }
  }
  spans.resize(kept);
  spans.push_back(span);
}

}  // namespace

// Nodes that are fine, and behind them those that stick out, united. Where one solid is in the
// other, too, their surfaces touch before and behind: far out on the line the objects are apart.
WholeBodyLines::Met WholeBodyLines::meet(const Column& column, const Met& among) {
  const Eigen::Vector2d fine = kFineEnough * (column.hi - column.lo);
  Met met;
  std::vector<LineSpan>& spans = met.spans;
  begin(column, among);
  while (!stack_.empty()) {
    const Visit visit = stack_.back();
    stack_.pop_back();
    const WhitenedTree& mesh = visit.place.member->fan.mesh();
    const NodeBox& box = mesh.boxOf(visit.place.node);
    const bool is_fine = box.hi[1] - box.lo[1] < fine[0] && box.hi[2] - box.lo[2] < fine[1];
    if (isWithin(visit.span, spans)) {
      met.visits.push_back(visit);
    } else if (is_fine || mesh.tree->nodes[visit.place.node].isLeaf()) {
      met.visits.push_back(visit);
      unite(visit.span, spans);
    } else {
      pushChildren(visit);
    }
  }
  std::sort(spans.begin(), spans.end(),
            [](const LineSpan& one, const LineSpan& other) { return one.lo < other.lo; });
  if (solids_ && !spans.empty()) spans = {{spans.front().lo, spans.back().hi}};
  return met;
}

double WholeBodyLines::mostOn(const Met& met) {
  double mass = 0.0;
  for (const LineSpan& span : met.spans) mass += normalIntervalMass(span.lo, span.hi);
  return std::min(1.0, mass * (1.0 + kRoundedLines));
}

// In order of where the column may first meet them, until no other one can be met before those.
CornerValues WholeBodyLines::entriesAt(const CornerMeans& means, const Column& column,
                                       const Met& met) {
  const auto later = [](const Visit& one, const Visit& other) {
    return one.span.lo > other.span.lo;
  };
  const Eigen::Vector2d middle = 0.5 * (column.lo + column.hi);
  CornerValues entries = all(kTooLate);
  begin(column, met);
  std::make_heap(stack_.begin(), stack_.end(), later);
  for (int leaves = 0; !stack_.empty();) {
    std::pop_heap(stack_.begin(), stack_.end(), later);
    const Visit visit = stack_.back();
    stack_.pop_back();
    if (!(visit.span.lo < *std::max_element(entries.begin(), entries.end()))) break;
    if (leaves == kMostPlanes) {
      for (double& entry : entries) entry = std::min(entry, visit.span.lo);
      break;
    }
    const PieceTree::Node& node = visit.place.member->fan.mesh().tree->nodes[visit.place.node];
    if (node.isLeaf()) {
      ++leaves;
      lowerTo(means, visit, middle, entries);
      continue;
    }
    for (const int child : {node.left, node.right}) {
      const auto span = visit.place.member->nodes.around(child);
      if (!span) continue;
      stack_.push_back({{visit.place.member, child}, *span});
      std::push_heap(stack_.begin(), stack_.end(), later);
    }
  }
  return entries;
}

// All that the column has of one C-obstacle is behind the plane at which the line in the middle
// enters it, and behind the end of its span.
void WholeBodyLines::lowerTo(const CornerMeans& means, const Visit& leaf,
                             const Eigen::Vector2d& middle, CornerValues& entries) {
  FanLine& line = leaf.place.member->outermost();
  const int triangle = triangleOf(leaf.place);
  line.first(triangle, middle, 1.0, kInfinity);
  CornerValues at = all(leaf.span.lo);
  if (const auto plane = line.planeBefore(triangle)) {
    CornerValues on_plane;
    for (int k = 0; k < 4; ++k) on_plane[static_cast<std::size_t>(k)] = plane->on(means.corner(k));
    if (means.mostTail(on_plane) < means.mostTail(at)) at = on_plane;
  }
  // The tail behind what begins before 0 is not convex: then it counts from its least end.
  const double least = *std::min_element(at.begin(), at.end());
  if (least < 0.0) at = all(least);
  for (std::size_t k = 0; k < 4; ++k) entries[k] = std::min(entries[k], at[k]);
}

// No line has anything before what is linear between the entries at the corners, which is not
// behind the last one of those; what is free behind that is free on all lines. Nor has any line
// less than nothing, as if it entered behind the end: such entries are at the end.
double WholeBodyLines::mostMeanOn(const Column& column, const Met& met) {
  const auto means = CornerMeans::of(column);
  const std::vector<LineSpan>& spans = met.spans;
  if (!means || spans.empty()) return mostOn(met);
  CornerValues entries = entriesAt(*means, column, met);
  for (double& entry : entries) entry = std::min(entry, spans.back().hi);
  const double last = *std::max_element(entries.begin(), entries.end());
  CornerValues tails;
  for (std::size_t k = 0; k < 4; ++k) tails[k] = normalTailMass(entries[k]);
  double free = normalTailMass(spans.back().hi);
  for (std::size_t i = 1; i < spans.size(); ++i) {
    const double from = spans[i - 1].hi, to = spans[i].lo;
    if (from >= last) free += normalIntervalMass(from, to);
  }
  const double most = means->most(tails) * (1.0 + kRoundedLines) - free * (1.0 - kRoundedLines);
  return std::clamp(most, 0.0, mostOn(met));
}

// Of the lines at the corners what is certainly within P ⊕ T, which is convex.
std::optional<WholeBodyLines::CornerSpans> WholeBodyLines::spansAt(const CornerMeans& means,
                                                                   const Touching& touching) {
  Member& member = members_[static_cast<std::size_t>(touching.member)];
  CornerSpans spans;
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector2d& u = means.corner(static_cast<int>(k));
    const auto spanWhere = [&](double sign) -> std::optional<LineSpan> {
      if (!member.line.first(touching.triangle, u, sign, kInfinity)) return std::nullopt;
      const LineSpan span = member.inner.on(u, member.line.touchedPoint(u));
      if (!(span.lo < span.hi)) return std::nullopt;
      return span;
    };
    const auto first = spanWhere(1.0), last = spanWhere(-1.0);
    if (!first && !last) return std::nullopt;
    spans.from[k] = first ? first->lo : last->lo;
    spans.to[k] = last ? last->hi : first->hi;
  }
  return spans;
}

// Lines between the corners enter no later than linearly between those, and leave no earlier.
double WholeBodyLines::leastOn(const Column& column, const std::vector<Touching>& chain) {
  const auto means = CornerMeans::of(column);
  if (!means) return 0.0;
  std::optional<CornerSpans> known;
  const auto reaches = [](const CornerValues& to, const CornerValues& from) {
    return std::equal(from.begin(), from.end(), to.begin(), std::less_equal<double>());
  };
  for (const Touching& touching : chain) {
    const auto next = spansAt(*means, touching);
    if (!next) continue;
    if (!known) {
      known = next;
    } else if (reaches(known->to, next->from) &&
               means->mostTail(next->to) < means->mostTail(known->to)) {
      known->to = next->to;
    }
  }
  if (!known) return 0.0;
  const double mass = means->leastTail(known->from) * (1.0 - kRoundedLines) -
                      means->mostTail(known->to) * (1.0 + kRoundedLines);
  return std::max(mass, 0.0);
}

}  // namespace fcl_prob::detail
