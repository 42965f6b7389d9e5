// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/coplanar_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/edge_order.h"

namespace fcl_prob::detail {
namespace {

// Vertices this far off the plane of a triangle may be in the same polygon, as a share of the size
// of the mesh: what coordinates in single precision are rounded by, twice over.
constexpr double kFlatShare = 4 * 5.96e-8;

// Where more triangles than these share an edge, not all pairs of them are looked at.
constexpr std::size_t kMostAtEdge = 6;

// Borders of which lengths differ by less than one part in so many are about as long, and so of
// their directions.
constexpr double kSameLength = 1000.0;
constexpr double kSameDirection = 100.0;

class CoplanarSearch {
 public:
  CoplanarSearch(const TriangleMesh& mesh, const std::vector<int>& welded)
      : mesh_(mesh), welded_(welded) {
    normals_.reserve(mesh.triangles.size());
    areas_.reserve(mesh.triangles.size());
    double size = 0.0;
    for (const Eigen::Vector3d& v : mesh.vertices) size = std::max(size, v.norm());
    tolerance_ = kFlatShare * size;
    for (int t = 0; t < count(); ++t) {
      const Eigen::Vector3d& from = at(t, 0);
      normals_.emplace_back((at(t, 1) - from).cross(at(t, 2) - from));
      areas_.push_back(normals_.back().norm());
      if (areas_.back() > 0.0) normals_.back() /= areas_.back();
    }
  }

  /// Large triangles first: their planes are known best.
  std::vector<FlatPolygon> run() {
    findPairs();
    if (pairs_.empty()) return {};
    std::vector<std::pair<double, int>> order;
    for (int t = 0; t < count(); ++t) {
      const bool has_pairs = first_pair_[t] < first_pair_[t + 1];
      if (has_pairs && areas_[t] > 0.0) order.emplace_back(-areas_[t], t);
    }
    std::sort(order.begin(), order.end());
    region_of_.assign(mesh_.triangles.size(), -1);
    group_of_.assign(mesh_.triangles.size(), -1);
    for (const auto& [area, t] : order) {
      if (region_of_[t] < 0) divide(regionAround(t));
    }
    return std::move(found_);
  }

 private:
  /// Two triangles that are in one plane and share an edge.
  struct Pair {
    int from;
    int to;
    Eigen::Vector3d edge;
  };

  /// Triangles of a region, and the polygon of more than one.
  struct Group {
    std::vector<int> triangles;
    std::optional<FlatPolygon> polygon;
  };

  /// What two groups share.
  struct Border {
    int one;
    int other;
    double length;
    double along;  ///< the first edge of the region, as far as it goes there
    std::pair<long, long> rank;
  };

  struct Side {
    int low;
    int high;
    int triangle;
  };

  int count() const { return static_cast<int>(mesh_.triangles.size()); }
  int vertex(int t, int k) const { return welded_[mesh_.triangles[t][k]]; }
  const Eigen::Vector3d& at(int t, int k) const { return mesh_.vertices[vertex(t, k)]; }

  struct Plane {
    Eigen::Vector3d n;
    double level;
  };

  Plane planeOf(int t) const { return {normals_[t], normals_[t].dot(at(t, 0))}; }

  bool isIn(const Plane& plane, int t) const {
    for (int k = 0; k < 3; ++k) {
      if (!(std::fabs(plane.n.dot(at(t, k)) - plane.level) <= tolerance_)) return false;
    }
    return true;
  }

  bool arePair(int s, int t) const {
    const bool first = areas_[s] >= areas_[t];
    return areas_[first ? s : t] > 0.0 && (first ? isIn(planeOf(s), t) : isIn(planeOf(t), s));
  }

  void findPairs() {
    std::vector<Side> sides;
    sides.reserve(3 * mesh_.triangles.size());
    for (int t = 0; t < count(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax({vertex(t, k), vertex(t, (k + 1) % 3)});
        if (low != high) sides.push_back({low, high, t});
      }
    }
    sortEdges(
        sides, [](const Side& side) { return edgeRank(side.low, side.high); },
        [](const Side& a, const Side& b) { return a.triangle < b.triangle; });
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const std::size_t last = std::min(sides.size(), i + kMostAtEdge);
      for (std::size_t j = i + 1; j < last; ++j) {
        if (sides[j].low != sides[i].low || sides[j].high != sides[i].high) break;
        addPair(sides[i], sides[j]);
      }
    }
    std::stable_sort(pairs_.begin(), pairs_.end(),
                     [](const Pair& x, const Pair& y) { return x.from < y.from; });
    first_pair_.assign(mesh_.triangles.size() + 1, 0);
    for (const Pair& pair : pairs_) ++first_pair_[pair.from + 1];
    std::partial_sum(first_pair_.begin(), first_pair_.end(), first_pair_.begin());
  }

  void addPair(const Side& one, const Side& other) {
    if (one.triangle == other.triangle || !arePair(one.triangle, other.triangle)) return;
    const Eigen::Vector3d edge = mesh_.vertices[one.high] - mesh_.vertices[one.low];
    pairs_.push_back({one.triangle, other.triangle, edge});
    pairs_.push_back({other.triangle, one.triangle, edge});
  }

  template <typename Function>
  void visitPairs(int t, const Function& function) const {
    for (int i = first_pair_[t]; i < first_pair_[t + 1]; ++i) function(pairs_[i]);
  }

  // All that hang together in the plane of a triangle, or in that of all that did so far, which is
  // known better the larger they are.
  std::vector<int> regionAround(int seed) {
    std::vector<int> region = grown(seed, planeOf(seed));
    for (std::size_t before = 1; region.size() > before + before / 4;) {
      before = region.size();
      for (const int t : region) region_of_[t] = -1;
      region = grown(seed, planeAmid(region));
    }
    return region;
  }

  std::vector<int> grown(int seed, const Plane& plane) {
    std::vector<int> region{seed};
    region_of_[seed] = seed;
    for (std::size_t i = 0; i < region.size(); ++i) {
      visitPairs(region[i], [&](const Pair& pair) {
        if (region_of_[pair.to] >= 0 || !isIn(plane, pair.to)) return;
        region_of_[pair.to] = seed;
        region.push_back(pair.to);
      });
    }
    return region;
  }

  // The mean of those of triangles, by their areas; they walk either way round.
  Plane planeAmid(const std::vector<int>& region) const {
    const Eigen::Vector3d& first = normals_[region[0]];
    Eigen::Vector3d n = Eigen::Vector3d::Zero();
    for (const int t : region)
      n += (normals_[t].dot(first) < 0.0 ? -areas_[t] : areas_[t]) * normals_[t];
    n.normalize();
    double level = 0.0;
    double area = 0.0;
    for (const int t : region) {
      level += areas_[t] * n.dot(at(t, 0) + at(t, 1) + at(t, 2)) / 3;
      area += areas_[t];
    }
    return {n, level / area};
  }

  void divide(const std::vector<int>& region) {
    if (region.size() < 2) return;
    if (auto whole = flatPolygonOf(mesh_, welded_, region, tolerance_)) {
      found_.push_back(std::move(*whole));
      return;
    }
    groups_.clear();
    refused_.clear();
    for (const int t : region) {
      group_of_[t] = static_cast<int>(groups_.size());
      groups_.push_back({{t}, std::nullopt});
    }
    while (mergeOnce(region)) {
    }
    for (Group& group : groups_) {
      if (group.polygon) found_.push_back(std::move(*group.polygon));
    }
  }

  // Each group with one other at the most, so that all grow alike: across the longest borders
  // first (Hertel and Mehlhorn leave out diagonals in any order).
  bool mergeOnce(const std::vector<int>& region) {
    const std::size_t before = groups_.size();
    std::vector<bool> is_merged(before, false);
    for (const Border& border : bordersIn(region)) {
      if (is_merged[border.one] || is_merged[border.other]) continue;
      if (refused_.count({border.one, border.other}) > 0) continue;
      if (merge(border.one, border.other)) {
        is_merged[border.one] = is_merged[border.other] = true;
      } else {
        refused_.insert({border.one, border.other});
      }
    }
    return groups_.size() > before;
  }

  bool merge(int one, int other) {
    std::vector<int> both = groups_[one].triangles;
    both.insert(both.end(), groups_[other].triangles.begin(), groups_[other].triangles.end());
    auto polygon = flatPolygonOf(mesh_, welded_, both, tolerance_);
    if (!polygon) return false;
    for (const int t : both) group_of_[t] = static_cast<int>(groups_.size());
    groups_.push_back({std::move(both), std::move(polygon)});
    groups_[one] = {};
    groups_[other] = {};
    return true;
  }

  // Longest first, and of those that are about as long first those in one direction, so that what
  // is regular stays so.
  std::vector<Border> bordersIn(const std::vector<int>& region) const {
    const Eigen::Vector3d axis = (at(region[0], 1) - at(region[0], 0)).normalized();
    std::vector<Border> borders;
    for (const int t : region) {
      visitPairs(t, [&](const Pair& pair) {
        if (region_of_[pair.to] != region_of_[t] || group_of_[t] >= group_of_[pair.to]) return;
        borders.push_back({group_of_[t],
                           group_of_[pair.to],
                           pair.edge.norm(),
                           std::fabs(axis.dot(pair.edge)),
                           {}});
      });
    }
    std::stable_sort(borders.begin(), borders.end(), [](const Border& x, const Border& y) {
      return std::tie(x.one, x.other) < std::tie(y.one, y.other);
    });
    std::vector<Border> joined;
    for (const Border& border : borders) {
      if (!joined.empty() && joined.back().one == border.one &&
          joined.back().other == border.other) {
        joined.back().length += border.length;
        joined.back().along += border.along;
      } else {
        joined.push_back(border);
      }
    }
    for (Border& border : joined) {
      border.rank = {std::lround(kSameLength * std::log(std::max(border.length, 1e-300))),
                     std::lround(kSameDirection * border.along / std::max(border.length, 1e-300))};
    }
    std::stable_sort(joined.begin(), joined.end(),
                     [](const Border& x, const Border& y) { return x.rank > y.rank; });
    return joined;
  }

  const TriangleMesh& mesh_;
  const std::vector<int>& welded_;
  double tolerance_ = 0.0;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<double> areas_;    // doubled
  std::vector<Pair> pairs_;      // by the first of them
  std::vector<int> first_pair_;  // of every triangle, and one behind the last
  std::vector<int> region_of_;   // the triangle that it is around
  std::vector<int> group_of_;
  std::vector<Group> groups_;  // of one region
  std::set<std::pair<int, int>> refused_;
  std::vector<FlatPolygon> found_;
};

}  // namespace

std::vector<FlatPolygon> flatPolygonsIn(const TriangleMesh& mesh, const std::vector<int>& welded) {
  return CoplanarSearch(mesh, welded).run();
}

}  // namespace fcl_prob::detail
