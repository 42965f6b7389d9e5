// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/long_polytope.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "mass/polytope_boundary.h"

namespace fcl_prob::detail {
namespace {

/// A face whose area is below this times its longest edge squared has no normal.
constexpr long double kNoArea = 1e-15L;

/// Smaller bodies stay whole.
constexpr long double kNearExtent = 16.0L;

/// Of reach² beyond the least |y|²: the density is below e^-75 of what it is there.
constexpr double kHeavyRange = 150.0;

LongVector3 normalOf(const LongPolytope& polytope, const std::vector<int>& loop) {
  const auto at = [&](std::size_t k) -> const LongVector3& {
    return polytope.vertices[static_cast<std::size_t>(loop[k % loop.size()])];
  };
  LongVector3 area = LongVector3::Zero(), longest = LongVector3::Zero();
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const LongVector3 edge = at(k + 1) - at(k);
    if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
    if (k > 1) area += (at(k - 1) - at(0)).cross(at(k) - at(0));
  }
  if (area.norm() > kNoArea * longest.squaredNorm()) return area.normalized();
  if (longest.isZero(0.0L)) return LongVector3::UnitX();
  return longest.normalized().unitOrthogonal();
}

/// Cuts off what is beyond reach along one axis, upwards or downwards.
class SideCut {
 public:
  SideCut(const LongPolytope& polytope, int axis, long double sign, long double reach)
      : polytope_(polytope),
        axis_(axis),
        sign_(sign),
        reach_(reach),
        kept_(polytope.vertices.size(), -1) {}

  bool cutsAnything() const {
    return std::any_of(polytope_.vertices.begin(), polytope_.vertices.end(),
                       [&](const LongVector3& v) { return above(v) > 0.0L; });
  }

  std::optional<LongPolytope> cut() {
    for (const LongPolytope::Face& face : polytope_.faces) {
      if (!cutFace(face)) return std::nullopt;
    }
    if (!addCaps()) return std::nullopt;
    return std::move(result_);
  }

 private:
  long double above(const LongVector3& v) const { return sign_ * v[axis_] - reach_; }
  const LongVector3& at(int vertex) const {
    return polytope_.vertices[static_cast<std::size_t>(vertex)];
  }
  bool isKept(int vertex) const { return !(above(at(vertex)) > 0.0L); }

  int added(const LongVector3& vertex) {
    result_.vertices.push_back(vertex);
    return static_cast<int>(result_.vertices.size()) - 1;
  }

  int keptVertex(int vertex) {
    int& index = kept_[static_cast<std::size_t>(vertex)];
    if (index < 0) index = added(at(vertex));
    return index;
  }

  /// Shared by the two faces of the edge.
  int cutVertex(int kept, int dropped) {
    const auto [entry, is_new] = cuts_.try_emplace({kept, dropped}, -1);
    if (is_new) {
      const long double below = -above(at(kept));
      LongVector3 v = at(kept) + below / (below + above(at(dropped))) * (at(dropped) - at(kept));
      v[axis_] = sign_ * reach_;
      entry->second = added(v);
    }
    return entry->second;
  }

  /// Where the part that is kept is in pieces, which rounding can do, they stay one face.
  bool cutFace(const LongPolytope::Face& face) {
    LongPolytope::Face part{face.normal, {}};
    int exit = -1, first_entrance = -1;
    const std::size_t count = face.vertices.size();
    for (std::size_t k = 0; k < count; ++k) {
      const int from = face.vertices[k], to = face.vertices[(k + 1) % count];
      if (isKept(from)) part.vertices.push_back(keptVertex(from));
      if (isKept(from) == isKept(to)) continue;
      const int crossing = isKept(from) ? cutVertex(from, to) : cutVertex(to, from);
      part.vertices.push_back(crossing);
      if (isKept(from)) {
        exit = crossing;
      } else if (exit < 0) {
        first_entrance = crossing;
      } else {
        if (!closeAt(crossing, exit)) return false;
        exit = -1;
      }
    }
    if (first_entrance >= 0 && !closeAt(first_entrance, exit)) return false;
    if (!part.vertices.empty()) result_.faces.push_back(std::move(part));
    return true;
  }

  /// A cap runs against the new side of the face.
  bool closeAt(int entrance, int exit) { return cap_next_.emplace(entrance, exit).second; }

  bool addCaps() {
    while (!cap_next_.empty()) {
      LongPolytope::Face cap{sign_ * LongVector3::Unit(axis_), {}};
      for (auto side = cap_next_.begin(); side != cap_next_.end();) {
        cap.vertices.push_back(side->first);
        const int next = side->second;
        cap_next_.erase(side);
        side = cap_next_.find(next);
        if (side == cap_next_.end() && next != cap.vertices.front()) return false;
      }
      // Between two vertices the faces close without.
      if (cap.vertices.size() > 2) result_.faces.push_back(std::move(cap));
    }
    return true;
  }

  const LongPolytope& polytope_;
  int axis_;
  long double sign_, reach_;
  std::vector<int> kept_;
  std::map<std::pair<int, int>, int> cuts_;
  std::map<int, int> cap_next_;
  LongPolytope result_;
};

}  // namespace

void LongPolytope::findNormals() {
  for (Face& face : faces) face.normal = normalOf(*this, face.vertices);
}

LongVector3 LongPolytope::extent() const {
  LongVector3 extent = LongVector3::Zero();
  for (const LongVector3& v : vertices) extent = extent.cwiseMax(v.cwiseAbs());
  return extent;
}

ConvexPolytope LongPolytope::seenFrom(const LongVector3& point) const {
  ConvexPolytope polytope;
  for (const LongVector3& v : vertices) {
    polytope.vertices.push_back(LongVector3(v - point).cast<double>());
  }
  for (const Face& face : faces) {
    const Eigen::Vector3d normal = face.normal.cast<double>().normalized();
    double offset = -std::numeric_limits<double>::infinity();
    for (const int k : face.vertices) {
      offset = std::max(offset, normal.dot(polytope.vertices[static_cast<std::size_t>(k)]));
    }
    polytope.faces.push_back({normal, offset, face.vertices});
  }
  return polytope;
}

std::optional<LongPolytope> withinCube(LongPolytope polytope, long double reach) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const long double sign : {1.0L, -1.0L}) {
      SideCut side(polytope, axis, sign, reach);
      if (!side.cutsAnything()) continue;
      auto rest = side.cut();
      if (!rest) return std::nullopt;
      polytope = std::move(*rest);
    }
  }
  return polytope;
}

HeavyPart heavyPart(const LongPolytope& polytope) {
  const LongVector3 extent = polytope.extent();
  if (!(extent.maxCoeff() > kNearExtent)) return {polytope};
  const PolytopeBoundary boundary = polytopeBoundary(polytope.seenFrom(LongVector3::Zero()));
  const double distance = boundary.origin_inside.value_or(false) ? 0.0 : boundary.distance;
  const double reach = std::sqrt(distance * distance + kHeavyRange);
  if (!(extent.maxCoeff() > 1.5L * reach)) return {polytope};
  auto within = withinCube(polytope, reach);
  if (!within || within->faces.size() < 4) return {polytope};
  return {std::move(*within), kCutOffRounding * extent.cast<double>(), reach};
}

}  // namespace fcl_prob::detail
