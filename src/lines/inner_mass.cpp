// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/inner_mass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/constants.h"
#include "base/left_out.h"
#include "convex/slab_kernels.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

// Of the reach: what the points within triangles and the heights of others above planes are rounded
// by, with much to spare.
constexpr double kInnerRounding = 4096 * kEpsilon;

// Faces whose normals have no more of the lines' direction are neither entered nor left by.
constexpr double kAlong = 1e-9;

// Parts of a column, along each axis, of which certain bounds are added up, and how far they reach
// where the column has no end. Measured: 4 and 16. Their ends are rounded by much less than that.
constexpr int kStrips = 8;
constexpr double kStepOfStrips = 0.4;
constexpr double kRoundedEnds = 64 * kEpsilon * kReach;

/// A part of an interval, and its mass under N(0, 1).
struct Strip {
  double middle;
  double half;
  double measure;
};

using Strips = std::array<Strip, kStrips>;

// What is beyond some steps from the inner end of an interval without another one is left out.
Strips stripsOf(double lo, double hi) {
  const bool is_below = lo <= -kReach, is_above = hi >= kReach;
  const double step = is_below || is_above ? kStepOfStrips : (hi - lo) / kStrips;
  const double all = kStrips * step;
  const double from = is_below && is_above ? -0.5 * all : is_below ? hi - all : lo;
  // Neighbours have the very same end.
  const auto endOf = [&](int i) { return i == kStrips && !is_above ? hi : from + i * step; };
  Strips strips;
  for (int i = 0; i < kStrips; ++i) {
    const double begin = endOf(i), end = endOf(i + 1);
    strips[static_cast<std::size_t>(i)] = {0.5 * (begin + end), 0.5 * (end - begin) + kRoundedEnds,
                                           normalIntervalMass(begin, end)};
  }
  return strips;
}

// Around all of them.
Strip unitedStrip(const Strips& strips) {
  const double lo = strips.front().middle - strips.front().half;
  const double hi = strips.back().middle + strips.back().half;
  return {0.5 * (lo + hi), 0.5 * (hi - lo) + kRoundedEnds, 0.0};
}

}  // namespace

InnerMass::InnerMass(const WhitenedFan& fan)
    : fan_(fan), all_faces_(static_cast<std::size_t>(fan.faceCount())) {
  std::iota(all_faces_.begin(), all_faces_.end(), 0);
  entries_ = endsOf(-1.0);
  exits_ = endsOf(1.0);
  for (const int f : all_faces_) {
    if (!(std::fabs(fan.faceNormal(f).x()) > kAlong)) along_.push_back(f);
  }
}

InnerMass::Ends InnerMass::endsOf(double sign) const {
  std::vector<int> faces;
  for (const int f : all_faces_) {
    if (sign * fan_.faceNormal(f).x() > kAlong) faces.push_back(f);
  }
  const auto count = static_cast<Eigen::Index>(faces.size());
  Ends ends{Eigen::ArrayXd(count), Eigen::ArrayXd(count), Eigen::ArrayXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const int f = faces[static_cast<std::size_t>(i)];
    const Eigen::Vector3d& n = fan_.faceNormal(f);
    ends.at[i] = leftOf(f, Eigen::Vector3d::Zero()) / n.x();
    ends.first[i] = n.y() / n.x();
    ends.second[i] = n.z() / n.x();
  }
  return ends;
}

LineSpan InnerMass::on(const Eigen::Vector2d& u, const Eigen::Vector3d& point) const {
  const Eigen::Vector3d from = Eigen::Vector3d(0.0, u[0], u[1]) - point;
  const auto passedAt = [&from](const Ends& ends) {
    return ends.at - ends.first * from[1] - ends.second * from[2];
  };
  const LineSpan none{kReach, -kReach};
  if (entries_.at.size() == 0 || exits_.at.size() == 0) return none;
  for (const int f : along_) {
    if (!(leftOf(f, from) > kAlong * 2 * kReach)) return none;
  }
  const double rounded = 8 * kEpsilon * fan_.reach();
  return {std::max(passedAt(entries_).maxCoeff() - from[0] + rounded, -kReach),
          std::min(passedAt(exits_).minCoeff() - from[0] - rounded, kReach)};
}

// P put to a point has the y with n·(y - point) <= offset; what is below all faces by their margins
// is certainly within (see WhitenedFan). On a line that is `from` the point at y_0 = 0, so much is
// left for n_0 y_0, ...
double InnerMass::leftOf(int face, const Eigen::Vector3d& from) const {
  const double inner = fan_.faceMargin(face) - fan_.facePad(face) + kInnerRounding * fan_.reach();
  return fan_.faceOffset(face) - inner - fan_.faceNormal(face).dot(from);
}

// ... and on lines beside it so much less or more.
double InnerMass::widthOf(int face, const Eigen::Vector2d& half) const {
  return fan_.faceNormal(face).tail<2>().cwiseAbs().dot(half);
}

// Those at which some line of a column may enter or leave P: not those that all lines pass before
// they enter, or after they leave.
std::vector<int> InnerMass::endsWithin(const std::vector<int>& faces, const Eigen::Vector3d& from,
                                       const Eigen::Vector2d& half) const {
  LineSpan inner{-kInfinity, kInfinity};
  std::vector<LineSpan> passed;
  passed.reserve(faces.size());
  for (const int f : faces) {
    const double x = fan_.faceNormal(f).x(), left = leftOf(f, from), width = widthOf(f, half);
    passed.push_back({(left - std::copysign(width, x)) / x, (left + std::copysign(width, x)) / x});
    if (x < 0.0) inner.lo = std::max(inner.lo, passed.back().lo);
    if (x > 0.0) inner.hi = std::min(inner.hi, passed.back().hi);
  }
  std::vector<int> ends;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const double x = fan_.faceNormal(faces[i]).x();
    const bool is_passed_outside =
        (x < 0.0 && passed[i].hi < inner.lo) || (x > 0.0 && passed[i].lo > inner.hi);
    if (!is_passed_outside) ends.push_back(faces[i]);
  }
  return ends;
}

LineSpan InnerMass::within(const std::vector<int>& faces, const Eigen::Vector3d& from,
                           const Eigen::Vector2d& half) const {
  LineSpan span{-kReach, kReach};
  for (const int face : faces) {
    const double x = fan_.faceNormal(face).x();
    const double left = leftOf(face, from) - widthOf(face, half);
    if (x > 0.0) {
      span.hi = std::min(span.hi, left / x);
    } else if (x < 0.0) {
      span.lo = std::max(span.lo, left / x);
    } else if (left < 0.0) {
      return {kReach, -kReach};
    }
  }
  span.lo += 8 * kEpsilon * std::fabs(span.lo);
  span.hi -= 8 * kEpsilon * std::fabs(span.hi);
  return span;
}

// In small columns what all lines of one have in common is nearly what each of them has.
double InnerMass::of(const Column& column, const Eigen::Vector3d& point) const {
  if (isLeftOut("inner mass")) return 0.0;
  const Strips first = stripsOf(column.lo[0], column.hi[0]);
  const Strips second = stripsOf(column.lo[1], column.hi[1]);
  const Strip all_first = unitedStrip(first), all_second = unitedStrip(second);
  const auto from = [&point](const Strip& i, const Strip& j) {
    return Eigen::Vector3d(Eigen::Vector3d(0.0, i.middle, j.middle) - point);
  };
  const std::vector<int> faces =
      endsWithin(all_faces_, from(all_first, all_second), {all_first.half, all_second.half});
  double sum = 0.0;
  for (const Strip& i : first) {
    const std::vector<int> of_row =
        endsWithin(faces, from(i, all_second), {i.half, all_second.half});
    for (const Strip& j : second) {
      const LineSpan span = within(of_row, from(i, j), {i.half, j.half});
      sum += i.measure * j.measure * normalIntervalMass(span.lo, span.hi);
    }
  }
  return sum / (normalIntervalMass(column.lo[0], column.hi[0]) *
                normalIntervalMass(column.lo[1], column.hi[1]));
}

}  // namespace fcl_prob::detail
