// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "separation.h"

#include <algorithm>
#include <cmath>

#include "nearest.h"

namespace verify {
namespace {

constexpr std::size_t kSmall = 4;  // pieces of no more vertices have all their edges looked at

struct Range {
  double lo = DBL_MAX, hi = -DBL_MAX;
  void add(double value) {
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
};

Range range_of(const Vec& direction, const std::vector<Vec>& points,
               const std::vector<int>& which) {
  Range range;
  for (const int v : which) range.add(dot(direction, points[v]));
  return range;
}

// The vertices that reach farthest (`sign` 1) or least (-1) along a direction, but for what is next
// to nothing: the faces between which the hyperplane is to be are among them.
std::vector<int> extreme(const Object& object, const Piece& piece, const Vec& direction, int sign) {
  std::vector<std::pair<double, int>> heights;
  double size = 0;
  for (const int v : piece.vertices) {
    heights.emplace_back(-sign * dot(direction, object.points[v]), v);
    size = std::max(size, std::abs(heights.back().first - heights.front().first));
  }
  std::sort(heights.begin(), heights.end());
  std::vector<int> result;
  for (const auto& [height, v] : heights) {
    if (result.size() >= 3 && height > heights.front().first + 1e-6 * size) break;
    if (result.size() == 8) break;
    result.push_back(v);
  }
  return result;
}

void add_edges(const Object& object, const std::vector<int>& vertices, Edge::Of of,
               std::vector<Edge>& edges) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      edges.push_back({of, vertices[j], vertices[i],
                       minus(object.points[vertices[i]], object.points[vertices[j]])});
    }
  }
}

}  // namespace

Region::Region(int rank, const Vec& low, const Vec& high)
    : lo(low), hi(high), normals{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}} {
  for (int i = 0; i < 3; ++i) bound[i] = std::max(std::abs(lo[i]), std::abs(hi[i]));
  for (int corner = 0; corner < 1 << rank; ++corner) {
    Vec point = lo;
    for (int i = 0; i < rank; ++i) point[i] = corner >> i & 1 ? hi[i] : lo[i];
    corners.push_back(point);
  }
}

Region::Region(const Polytope& polytope, const Vec& low, const Vec& high,
               const std::vector<Plane>& planes)
    : Region(polytope.rank(), low, high) {
  for (const Plane& plane : planes) normals.push_back(plane.normal);
  corners.clear();
  for (const int v : polytope.used()) {
    exact.push_back(polytope.vertices()[v]);
    const Precision enough(128);
    const BallVec q = exact.back().ball();
    corners.push_back({q[0].nearest(), q[1].nearest(), q[2].nearest()});
  }
}

Region::Corner Region::exact_corner(std::size_t i) const {
  if (exact.empty()) return {balls(corners[i]), Ball(1)};
  const auto& x = exact[i].x;
  return {{Ball(x[0]), Ball(x[1]), Ball(x[2])}, Ball(exact[i].w)};
}

Heights::Heights(const Frame& frame, const Object& a, const Piece& k, const Object& b,
                 const Piece& l, const BallVec& normal)
    : constant(dot(normal, frame.mean)) {
  const auto range = [&](const Object& object, const Piece& piece, Ball& low, Ball& high) {
    for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
      const Ball height = dot(normal, object.world(piece.vertices[i]));
      low = i == 0 ? height : min(low, height);
      high = i == 0 ? height : max(high, height);
    }
  };
  Ball k_lo, k_hi, l_lo, l_hi;
  range(a, k, k_lo, k_hi);
  range(b, l, l_lo, l_hi);
  lo = l_lo - k_hi;
  hi = l_hi - k_lo;
  for (int i = 0; i < frame.rank; ++i) slope[i] = dot(normal, frame.columns[i]);
}

BallVec Separator::exact_edge(const Edge& edge) const {
  if (edge.of == Edge::kA) return minus(a_.world(edge.to), a_.world(edge.from));
  if (edge.of == Edge::kB) return minus(b_.world(edge.to), b_.world(edge.from));
  return frame_.to_world(
      cross(balls(region_->normals[edge.from]), balls(region_->normals[edge.to])));
}

// Whether the direction or its negative separates, beyond what rounding can be: 16 operations'
// errors are more than the few products and sums of which any of the terms is made.
bool Separator::proven(const Vec& direction, bool& unclear) const {
  const Range k = range_of(direction, a_.points, k_->vertices);
  const Range l = range_of(direction, b_.points, l_->vertices);
  Range q;
  for (const Vec& corner : region_->corners) q.add(dot(direction, corner));
  double margin = 0;
  for (int i = 0; i < 3; ++i) {
    const double bounds = a_.bound[i] + b_.bound[i] + region_->bound[i];
    margin += std::abs(direction[i]) * (a_.error[i] + b_.error[i] + 16 * kUnit * bounds);
  }
  margin = margin * (1 + 1e-10) + DBL_MIN;
  const double gap = std::max((l.lo - k.hi) - q.hi, q.lo - (l.hi - k.lo));
  unclear = gap > -2 * margin;
  return gap > margin;
}

bool Separator::proven_exactly(const Direction& direction) const {
  BallVec normal;
  if (direction.second >= 0) {
    normal = cross(exact_edge(edges_[direction.first]), exact_edge(edges_[direction.second]));
  } else {
    const Vec& n = region_->normals[direction.first];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) normal[j] = normal[j] + frame_.cofactors[i][j] * Ball(n[i]);
    }
  }
  const Heights heights(frame_, a_, *k_, b_, *l_, normal);
  bool varies = false;
  for (const Ball& x : heights.slope) varies |= x.sign() != 0;
  bool below = true, above = true;
  for (std::size_t i = 0; i < region_->corners.size() && (below || above); ++i) {
    const Region::Corner corner = region_->exact_corner(i);
    const Ball value = heights.at(corner);
    const Ball lo = heights.lo * corner.times, hi = heights.hi * corner.times;
    // Regions are open: on them a function that is not constant has no value that it has at a
    // corner only.
    below = below && (varies ? value <= lo : value < lo);
    above = above && (varies ? hi <= value : hi < value);
  }
  return below || above;
}

bool Separator::try_direction(const Direction& direction) {
  bool unclear = false;
  if (proven(direction.y, unclear)) return true;
  if (unclear) unclear_.push_back(direction);
  return false;
}

void Separator::list_edges(const Vertices& of_k, const Vertices& of_l) {
  edges_.clear();
  add_edges(a_, of_k, Edge::kA, edges_);
  add_edges(b_, of_l, Edge::kB, edges_);
  const int count = static_cast<int>(region_->normals.size());
  for (int j = 1; j < count; ++j) {
    for (int i = 0; i < j; ++i) {
      edges_.push_back({Edge::kRegion, i, j, cross(region_->normals[i], region_->normals[j])});
    }
  }
}

// Of two polytopes that a hyperplane separates one does that is along a face of one of them or
// along an edge of each. (The axes beyond the rank are among the region's edges for what is flat
// with the region.)
bool Separator::search(const Vertices& of_k, const Vertices& of_l) {
  list_edges(of_k, of_l);
  unclear_.clear();
  for (int i = 0; i < static_cast<int>(region_->normals.size()); ++i) {
    if (try_direction({region_->normals[i], i, -1})) return true;
  }
  for (int i = 0; i < static_cast<int>(edges_.size()) && edges_[i].of != Edge::kRegion; ++i) {
    for (int j = i + 1; j < static_cast<int>(edges_.size()); ++j) {
      if (try_direction({cross(edges_[i].y, edges_[j].y), i, j})) return true;
    }
  }
  return std::any_of(unclear_.begin(), unclear_.end(),
                     [&](const Direction& d) { return proven_exactly(d); });
}

// For hulls of many vertices, whose faces are not tried one by one.
bool Separator::search_from_nearest_point() {
  const auto support = [&](const Vec& direction) {
    const auto farthest = [&](const std::vector<Vec>& points, const Vertices& which, int sign) {
      return points[*std::max_element(which.begin(), which.end(), [&](int u, int v) {
        return sign * dot(direction, points[u]) < sign * dot(direction, points[v]);
      })];
    };
    const Vec q = *std::max_element(
        region_->corners.begin(), region_->corners.end(),
        [&](const Vec& u, const Vec& v) { return dot(direction, u) < dot(direction, v); });
    return minus(minus(farthest(b_.points, l_->vertices, -1), farthest(a_.points, k_->vertices, 1)),
                 q);
  };
  Vec direction{};
  bool unclear = false;
  const bool found = nearest_to_origin(support, direction,
                                       [&](const Vec& tried) { return proven(tried, unclear); });
  if (found) return true;
  return search(extreme(a_, *k_, direction, 1), extreme(b_, *l_, direction, -1));
}

bool Separator::separates(const Region& region, const Piece& k, const Piece& l) {
  region_ = &region;
  k_ = &k;
  l_ = &l;
  if (k.vertices.size() <= kSmall && l.vertices.size() <= kSmall) {
    return search(k.vertices, l.vertices);
  }
  return search_from_nearest_point();
}

}  // namespace verify
