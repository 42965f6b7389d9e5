// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/cell_polytope.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

// Of a tetrahedron with less volume than this share of that of a cube around it nothing is said;
// of others rounding moves the ball within, and its radius, by less than that share of the radius.
constexpr double kFlat = 1e-9;
constexpr double kBallRounding = 1e-3;

// What depth() is rounded by, as a share of the diameter: normals of faces that are only just wider
// than kThinFace are not known better.
constexpr double kDepthRounding = 1e-7;

}  // namespace

CellPolytope::CellPolytope(const Cell& box) {
  for (int i = 0; i < 8; ++i) {
    vertices_.emplace_back(i & 1 ? box.hi[0] : box.lo[0], i & 2 ? box.hi[1] : box.lo[1],
                           i & 4 ? box.hi[2] : box.lo[2]);
  }
  first_ = {0, 4, 8, 12, 16, 20};
  corners_ = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
}

CellPolytope::Extent CellPolytope::along(const Eigen::Vector3d& n) const {
  Extent extent{1e300, -1e300};
  for (const Eigen::Vector3d& v : vertices_) {
    const double height = n.dot(v);
    extent.lo = std::min(extent.lo, height);
    extent.hi = std::max(extent.hi, height);
  }
  return extent;
}

Eigen::Vector3d CellPolytope::middle() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : vertices_) sum += v;
  return sum / static_cast<double>(vertices_.size());
}

double CellPolytope::depth(const Eigen::Vector3d& point) const {
  double least = kInfinity;
  for (std::size_t f = 0; f < first_.size(); ++f) {
    const Eigen::Vector3d& apex = vertices_[corners_[first_[f]]];
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double longest = 0.0;
    for (int i = first_[f] + 1; i < end(f); ++i) {
      const Eigen::Vector3d side = vertices_[corners_[i]] - apex;
      longest = std::max(longest, side.norm());
      if (i + 1 < end(f)) normal += side.cross(vertices_[corners_[i + 1]] - apex);
    }
    const double size = normal.norm();
    if (!(size > kThinFace * longest)) return 0.0;
    least = std::min(least, normal.dot(apex - point) / size);
  }
  return least;
}

CellPolytope::Ball CellPolytope::ballWithin() const {
  const Ball central{middle(), std::max(0.0, depth(middle()) - kDepthRounding * diameter())};
  const Ball other = ballOfTetrahedron();
  return other.radius > central.radius ? other : central;
}

CellPolytope::Ball CellPolytope::ballOfTetrahedron() const {
  const auto farthest = [this](const auto& measure) {
    return *std::max_element(vertices_.begin(), vertices_.end(),
                             [&](const auto& x, const auto& y) { return measure(x) < measure(y); });
  };
  const Eigen::Vector3d b =
      farthest([this](const auto& v) { return (v - vertices_.front()).squaredNorm(); });
  const Eigen::Vector3d a = farthest([&](const auto& v) { return (v - b).squaredNorm(); });
  const Eigen::Vector3d c = farthest([&](const auto& v) { return (b - a).cross(v - a).norm(); });
  const Eigen::Vector3d n = (b - a).cross(c - a);
  const Eigen::Vector3d d = farthest([&](const auto& v) { return std::fabs(n.dot(v - a)); });
  const Eigen::Vector4d areas((c - b).cross(d - b).norm(), (c - a).cross(d - a).norm(),
                              (b - a).cross(d - a).norm(), n.norm());
  const double volume = std::fabs(n.dot(d - a));
  const double size = diameter();
  if (!(volume > kFlat * size * size * size)) return {a, 0.0};
  return {(areas[0] * a + areas[1] * b + areas[2] * c + areas[3] * d) / areas.sum(),
          (1.0 - kBallRounding) * volume / areas.sum()};
}

Cell CellPolytope::box() const {
  Cell box{vertices_.front(), vertices_.front(), 3};
  for (const Eigen::Vector3d& v : vertices_) {
    box.lo = box.lo.cwiseMin(v);
    box.hi = box.hi.cwiseMax(v);
  }
  return box;
}

double CellPolytope::diameter() const {
  const Cell around = box();
  return (around.hi - around.lo).norm();
}

double CellPolytope::nearest() const {
  double farthest = 0.0;
  for (const Eigen::Vector3d& v : vertices_) farthest = std::max(farthest, v.norm());
  return std::max(0.0, farthest - diameter());
}

Bounds CellPolytope::mass(const MassAccuracy& accuracy) const {
  if (empty()) return {0.0, 0.0};
  SimplexMass sum;
  const Eigen::Vector3d& apex = vertices_.front();
  for (std::size_t f = 0; f < first_.size(); ++f) {
    const int* begin = corners_.data() + first_[f];
    const int* stop = corners_.data() + end(f);
    // A face around the apex spans nothing with it.
    if (std::find(begin, stop, 0) != stop) continue;
    for (const int* at = begin + 1; at + 1 < stop; ++at) {
      sum.add({apex, vertices_[*begin], vertices_[at[0]], vertices_[at[1]]}, accuracy);
    }
  }
  return sum.bounds();
}

int PolytopeCutter::crossing(int one, int other) {
  const int low = height_[one] < height_[other] ? one : other;
  const int high = low == one ? other : one;
  for (const Crossing& known : crossings_) {
    if (known.low == low && known.high == high) return known.vertex;
  }
  const double t = height_[low] / (height_[low] - height_[high]);
  const Eigen::Vector3d point = vertices_[low] + t * (vertices_[high] - vertices_[low]);
  vertices_.push_back(point);
  height_.push_back(0.0);
  crossings_.push_back({low, high, static_cast<int>(vertices_.size()) - 1});
  return crossings_.back().vertex;
}

void PolytopeCutter::cut(const CellPolytope& body, const Eigen::Vector3d& n, double s,
                         CellPolytope* below, CellPolytope* above) {
  vertices_ = body.vertices_;
  crossings_.clear();
  height_.resize(vertices_.size());
  double least = 0.0;
  double most = 0.0;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    double height = n.dot(vertices_[i]) - s;
    if (std::fabs(height) <= CellPolytope::kSnap) height = 0.0;
    height_[i] = height;
    least = std::min(least, height);
    most = std::max(most, height);
  }
  if (most <= 0.0 || least >= 0.0) {
    // Nothing is cut: all of the body is on one side.
    CellPolytope* const whole = most <= 0.0 ? below : above;
    CellPolytope* const nothing = most <= 0.0 ? above : below;
    if (whole && whole != &body) *whole = body;
    if (nothing) *nothing = CellPolytope();
    return;
  }
  // Either of them may be the body. Copied, since memory that is handed on would tell which cells a
  // thread had before: what a cell needs must not depend on that.
  if (below) keep(body, -1.0, low_);
  if (above) keep(body, 1.0, high_);
  if (below) *below = low_;
  if (above) *above = high_;
}

// The part of the surface on one side of the plane, and a face in the plane.
void PolytopeCutter::keep(const CellPolytope& body, double side, CellPolytope& part) {
  rim_.clear();
  part.vertices_.clear();
  part.first_.clear();
  part.corners_.clear();
  for (std::size_t f = 0; f < body.first_.size(); ++f) {
    const int* begin = body.corners_.data() + body.first_[f];
    const int* stop = body.corners_.data() + body.end(f);
    loop_.clear();
    bool inside = false;
    for (const int* at = begin; at < stop; ++at) {
      const int from = *at;
      const int to = at + 1 < stop ? at[1] : *begin;
      const double here = side * height_[from];
      const double there = side * height_[to];
      inside = inside || here > 0.0;
      if (here >= 0.0) loop_.push_back(from);
      if ((here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0)) {
        loop_.push_back(crossing(from, to));
      }
    }
    if (!inside || loop_.size() < 3) continue;
    part.first_.push_back(static_cast<int>(part.corners_.size()));
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      part.corners_.push_back(loop_[i]);
      const int next = loop_[i + 1 < loop_.size() ? i + 1 : 0];
      if (height_[loop_[i]] == 0.0 && height_[next] == 0.0) rim_.emplace_back(next, loop_[i]);
    }
  }
  close(part);
  // Only the vertices that are used.
  index_.assign(vertices_.size(), -1);
  for (int& corner : part.corners_) {
    if (index_[corner] < 0) {
      index_[corner] = static_cast<int>(part.vertices_.size());
      part.vertices_.push_back(vertices_[corner]);
    }
    corner = index_[corner];
  }
}

// Faces kept on both sides of an edge in the plane leave no hole there. What else lies in the plane
// is the rim of holes, walked the other way round by their caps; it leaves every vertex as often as
// it comes to it.
void PolytopeCutter::close(CellPolytope& part) {
  for (std::size_t i = 0; i < rim_.size(); ++i) {
    const auto twin = std::find(rim_.begin() + static_cast<std::ptrdiff_t>(i) + 1, rim_.end(),
                                std::make_pair(rim_[i].second, rim_[i].first));
    if (twin == rim_.end()) continue;
    rim_.erase(twin);
    rim_.erase(rim_.begin() + static_cast<std::ptrdiff_t>(i));
    --i;
  }
  while (!rim_.empty()) {
    part.first_.push_back(static_cast<int>(part.corners_.size()));
    const int start = rim_.back().first;
    int at = start;
    do {
      const auto next = std::find_if(rim_.begin(), rim_.end(),
                                     [at](const auto& edge) { return edge.first == at; });
      if (next == rim_.end()) break;
      part.corners_.push_back(at);
      at = next->second;
      rim_.erase(next);
    } while (at != start);
  }
}

}  // namespace fcl_prob::detail
