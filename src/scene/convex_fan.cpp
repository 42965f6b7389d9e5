// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/convex_fan.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "base/constants.h"
#include "base/keep_once.h"
#include "geometry/directed_edges.h"

namespace fcl_prob::detail {
namespace {

// Every group's plane is held against every vertex.
constexpr int kMostTriangles = 20'000;

// What coordinates in single precision, as STL has them, are rounded by, twice over: relative to
// the largest one.
constexpr double kFileRounding = 4 * 5.96e-8;

// Three normals of a vertex with a smaller determinant count as coplanar.
constexpr double kLeastDeterminant = 1e-6;

// Of a mesh with more connected parts nothing is said.
constexpr std::size_t kMostParts = 64;

class FanBuilder {
 public:
  FanBuilder(const MeshView& view, const std::vector<Eigen::Vector3d>& vertices)
      : view_(view), vertices_(vertices), welded_(weldVertices(view)) {}

  /// P is to hold these, too.
  void include(const std::vector<Eigen::Vector3d>& points) { points_ = points; }

  std::shared_ptr<ConvexFan> build() {
    if (!readSurface() || !readNeighbours() || !groupTriangles()) return nullptr;
    placeCentre();
    for (std::size_t f = 0; f < fan_.normals.size(); ++f) {
      // As far as this the centre must be inside of every plane.
      if (!(fan_.offsets[f] > 1e3 * fan_.depths[f]) || !(fan_.offsets[f] > 0.0)) return nullptr;
    }
    findArcs();
    return std::make_shared<ConvexFan>(std::move(fan_));
  }

 private:
  using Arc = std::pair<int, int>;  // of groups, the lower one first
  // What is around a vertex.
  struct Around {
    boost::container::small_vector<int, 8> groups;
    boost::container::small_vector<Arc, 8> arcs;
  };

  const Eigen::Vector3d& corner(int triangle, int k) const {
    return vertices_[corners_[triangle][k]];
  }

  bool readSurface() {
    double largest = 0.0;
    corners_.reserve(view_.triangle_count);
    std::vector<bool> is_used(view_.vertex_count, false);
    for (int t = 0; t < view_.triangle_count; ++t) {
      const std::array<int, 3> corners = weldedCorners(welded_, view_.triangles[t]);
      for (int k = 0; k < 3; ++k) {
        // Rounding is that of the file's coordinates, which may be far from the origin.
        largest = std::max(largest, view_.vertex(t, k).cwiseAbs().maxCoeff());
        is_used[corners[k]] = true;
      }
      if (!anyEqual(corners)) corners_.push_back(corners);
    }
    if (corners_.size() < 4) return false;
    tolerance_ = kFileRounding * largest;
    if (!points_.empty()) return true;
    for (int v = 0; v < view_.vertex_count; ++v) {
      if (is_used[v]) points_.push_back(vertices_[v]);
    }
    return true;
  }

  bool readNeighbours() {
    std::vector<DirectedEdge> edges;
    edges.reserve(3 * corners_.size());
    for (int t = 0; t < static_cast<int>(corners_.size()); ++t) addSides(corners_[t], t, edges);
    EdgePairing pairing = pairEdges(std::move(edges));
    if (pairing.fault) return false;
    matches_ = std::move(pairing.matches);
    neighbours_.resize(corners_.size());
    for (const EdgeMatch& match : matches_) {
      neighbours_[match.forward.polygon].push_back(match.backward.polygon);
      neighbours_[match.backward.polygon].push_back(match.forward.polygon);
    }
    return true;
  }

  // Large triangles first: their planes are known best. A mesh that is not convex mostly shows it
  // at the first of them.
  bool groupTriangles() {
    std::vector<Eigen::Vector3d> areas;
    areas.reserve(corners_.size());
    for (int t = 0; t < static_cast<int>(corners_.size()); ++t) {
      const Eigen::Vector3d first = corner(t, 1) - corner(t, 0);
      areas.push_back(first.cross(corner(t, 2) - corner(t, 0)));
    }
    std::vector<int> order(corners_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&areas](int x, int y) {
      const double size_x = areas[x].squaredNorm();
      const double size_y = areas[y].squaredNorm();
      return size_x != size_y ? size_x > size_y : x < y;
    });
    group_.assign(corners_.size(), -1);
    for (const int t : order) {
      if (group_[t] < 0 && !startGroup(t, areas[t])) return false;
    }
    return true;
  }

  bool startGroup(int seed, const Eigen::Vector3d& area) {
    const double size = area.norm();
    if (!(size > 0.0)) return false;
    const Eigen::Vector3d n = area / size;
    double highest = -kInfinity;
    for (const Eigen::Vector3d& point : points_) highest = std::max(highest, n.dot(point));
    double lowest = highest;
    const int index = static_cast<int>(fan_.normals.size());
    const auto take = [&](int t) {
      double least = highest;
      for (int k = 0; k < 3; ++k) least = std::min(least, n.dot(corner(t, k)));
      if (!(highest - least <= tolerance_)) return false;
      lowest = std::min(lowest, least);
      group_[t] = index;
      return true;
    };
    if (!take(seed)) return false;
    rim_.assign(1, seed);
    while (!rim_.empty()) {
      const int from = rim_.back();
      rim_.pop_back();
      for (const int to : neighbours_[from]) {
        if (group_[to] < 0 && take(to)) rim_.push_back(to);
      }
    }
    fan_.normals.push_back(n);
    fan_.offsets.push_back(highest);
    fan_.depths.push_back(highest - lowest);
    return true;
  }

  // The centre of gravity, to which offsets are relative from here on.
  void placeCentre() {
    const Eigen::Vector3d apex = points_.front();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double volume = 0.0;
    for (int t = 0; t < static_cast<int>(corners_.size()); ++t) {
      const Eigen::Vector3d a = corner(t, 0) - apex;
      const Eigen::Vector3d b = corner(t, 1) - apex;
      const Eigen::Vector3d c = corner(t, 2) - apex;
      const double part = a.dot(b.cross(c));
      volume += part;
      sum += 0.25 * part * (a + b + c);
    }
    fan_.centre = apex;
    if (std::fabs(volume) > 0.0) fan_.centre += sum / volume;
    fan_.vertices.reserve(points_.size());
    for (const Eigen::Vector3d& point : points_) {
      fan_.vertices.push_back(point - fan_.centre);
      fan_.radius = std::max(fan_.radius, fan_.vertices.back().norm());
    }
    const double rounding = 16 * kEpsilon * (fan_.radius + fan_.centre.norm());
    for (std::size_t f = 0; f < fan_.normals.size(); ++f) {
      fan_.offsets[f] += rounding - fan_.normals[f].dot(fan_.centre);
      fan_.depths[f] += 2 * rounding;
    }
  }

  void findArcs() {
    std::vector<Around> around(view_.vertex_count);
    for (int t = 0; t < static_cast<int>(corners_.size()); ++t) {
      for (int k = 0; k < 3; ++k) around[corners_[t][k]].groups.push_back(group_[t]);
    }
    fan_.arcs.reserve(matches_.size());
    for (const EdgeMatch& match : matches_) {
      const int f = group_[match.forward.polygon];
      const int g = group_[match.backward.polygon];
      if (f == g) continue;
      const Arc arc = std::minmax(f, g);
      fan_.arcs.push_back(arc);
      for (const int v : {match.forward.from, match.forward.to}) around[v].arcs.push_back(arc);
    }
    for (Around& each : around) {
      keepOnce(each.groups);
      keepOnce(each.arcs);
      completeArcs(each);
    }
    keepOnce(fan_.arcs);
  }

  // Where the arcs around a vertex are not clearly the edges of the cone of its normals, all pairs
  // of them are taken.
  void completeArcs(const Around& around) {
    const auto isEdge = [&](const Arc& arc) { return isEdgeOfCone(around, arc); };
    if (around.groups.size() > 3 && around.arcs.size() == around.groups.size() &&
        std::all_of(around.arcs.begin(), around.arcs.end(), isEdge)) {
      return;
    }
    for (auto one = around.groups.begin(); one != around.groups.end(); ++one) {
      for (auto other = around.groups.begin(); other != one; ++other) {
        fan_.arcs.emplace_back(*other, *one);
      }
    }
  }

  bool isEdgeOfCone(const Around& around, const Arc& arc) const {
    const Eigen::Vector3d across = fan_.normals[arc.first].cross(fan_.normals[arc.second]);
    int above = 0;
    int below = 0;
    for (const int g : around.groups) {
      if (g == arc.first || g == arc.second) continue;
      const double side = across.dot(fan_.normals[g]);
      above += side > kLeastDeterminant;
      below += side < -kLeastDeterminant;
    }
    const int others = static_cast<int>(around.groups.size()) - 2;
    return above == others || below == others;
  }

  const MeshView view_;
  const std::vector<Eigen::Vector3d>& vertices_;
  std::vector<int> welded_;
  std::vector<std::array<int, 3>> corners_;  // welded, of the triangles with three different ones
  std::vector<Eigen::Vector3d> points_;      // that triangles use, or what was included
  std::vector<EdgeMatch> matches_;
  std::vector<boost::container::static_vector<int, 3>> neighbours_;  // of triangles
  std::vector<int> group_;
  std::vector<int> rim_;  // of the group that grows
  double tolerance_ = 0.0;
  ConvexFan fan_;
};

}  // namespace

std::shared_ptr<const ConvexFan> convexFanOf(const MeshView& view,
                                             const std::vector<Eigen::Vector3d>& vertices,
                                             const Eigen::Vector3d& moved_by) {
  if (view.triangle_count < 4 || view.triangle_count > kMostTriangles) return nullptr;
  std::shared_ptr<ConvexFan> fan = FanBuilder(view, vertices).build();
  if (!fan) return nullptr;
  if (!hasCentreWithin(*fan, ClosedMesh(view, "mesh"), moved_by)) return nullptr;
  return fan;
}

std::shared_ptr<const ConvexFan> convexFanOf(const ConvexPolytope& hull,
                                             const std::vector<Eigen::Vector3d>& points) {
  std::vector<fcl::Triangle> triangles;
  for (const ConvexPolytope::Face& face : hull.faces) {
    const auto corner = [&face](std::size_t k) {
      return static_cast<std::size_t>(face.vertices[k]);
    };
    for (std::size_t k = 2; k < face.vertices.size(); ++k) {
      triangles.emplace_back(corner(0), corner(k - 1), corner(k));
    }
  }
  MeshView view;
  view.vertices = hull.vertices.data();
  view.vertex_count = static_cast<int>(hull.vertices.size());
  view.triangles = triangles.data();
  view.triangle_count = static_cast<int>(triangles.size());
  if (view.triangle_count < 4 || view.triangle_count > kMostTriangles) return nullptr;
  FanBuilder builder(view, hull.vertices);
  builder.include(points);
  std::shared_ptr<ConvexFan> fan = builder.build();
  if (!fan) return nullptr;
  const ClosedMesh solid(view, "polytope");
  return hasCentreWithin(*fan, solid, Eigen::Vector3d::Zero()) ? fan : nullptr;
}

bool hasCentreWithin(const ConvexFan& fan, const ClosedMesh& solid,
                     const Eigen::Vector3d& moved_by) {
  const double rounding = 16 * kEpsilon * (moved_by.norm() + fan.centre.norm() + fan.radius);
  return solid.contains(moved_by + fan.centre, rounding) == Containment::inside;
}

std::vector<std::pair<int, int>> spansOf(const MeshView& view,
                                         const SurfaceComponents& components) {
  const std::vector<int>& part = components.of_vertex;
  const auto count = static_cast<std::size_t>(components.count);
  if (count > kMostParts) return {};
  std::vector<std::pair<int, int>> spans(count, {-1, -1});
  for (int sweep = 0; sweep < 3; ++sweep) {
    std::vector<double> farthest(count, -1.0);
    std::vector<int> end(count, -1);
    for (int v = 0; v < view.vertex_count; ++v) {
      if (part[v] < 0) continue;
      const auto i = static_cast<std::size_t>(part[v]);
      const int from = spans[i].second;
      const double distance =
          from < 0 ? 0.0 : (view.vertices[v] - view.vertices[from]).squaredNorm();
      if (distance > farthest[i]) {
        farthest[i] = distance;
        end[i] = v;
      }
    }
    for (std::size_t i = 0; i < count; ++i) spans[i] = {spans[i].second, end[i]};
  }
  return spans;
}

}  // namespace fcl_prob::detail
