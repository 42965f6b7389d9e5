// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/shell_pieces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>

#include "fcl_prob/convex_polytope.h"
#include "geometry/directed_edges.h"
#include "geometry/surface_caps.h"

namespace fcl_prob::detail {
namespace {

// Where the point below a patch is: on the way from its middle to the apex, or else below that
// middle, as a share of the patch's size. The deepest with which the piece is within the mesh.
constexpr std::array kDepths{1.0, 0.5, 0.25, 0.1, 0.03};
constexpr std::size_t kPlaces = 2 * kDepths.size();

// A patch that grows is tried with the point where it was and a few less deep.
constexpr std::size_t kPlacesTried = 2;

// A mesh with more of them is left to its triangles.
constexpr int kMostPieces = 1'000;

// Triangles of a patch: each may give its piece a face, and obstacles have all faces of a piece.
constexpr std::size_t kLargestPatch = 64;

// A patch is convex if none of its corners is farther beyond one of its planes, as a share of the
// size of the mesh.
constexpr double kConvex = 1e-9;

std::array<double, 3> key(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

void keepEachOnce(std::vector<Eigen::Vector3d>& points) {
  std::sort(points.begin(), points.end(),
            [](const auto& x, const auto& y) { return key(x) < key(y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

class PatchSearch {
 public:
  PatchSearch(const MeshView& view, const std::vector<Eigen::Vector3d>& vertices,
              const SurroundingMesh& mesh, const Eigen::Vector3d& apex)
      : view_(view), vertices_(vertices), mesh_(mesh), apex_(apex) {
    for (const Eigen::Vector3d& v : vertices) size_ = std::max(size_, (v - apex).norm());
    findNeighbours();
    for (int t = 0; t < view.triangle_count; ++t) {
      const Eigen::Vector3d n = (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
      normals_.push_back(n.norm() > 0.0 ? n.normalized().eval() : Eigen::Vector3d::Zero().eval());
    }
  }

  /// Pieces that hold all triangles that are not held yet.
  std::vector<ConvexFan> cover(std::vector<bool>& held) {
    std::vector<ConvexFan> pieces;
    for (int t = 0; t < view_.triangle_count; ++t) {
      if (held[t]) continue;
      std::vector<int> patch = patchAround(t, held);
      const auto piece = largestPiece(patch);
      if (!piece || pieces.size() == kMostPieces) return {};
      for (const int each : patch) held[each] = true;
      pieces.push_back(*piece);
    }
    return pieces;
  }

 private:
  using Piece = std::shared_ptr<const ConvexFan>;

  const Eigen::Vector3d& corner(int t, int k) const { return vertices_[view_.triangles[t][k]]; }

  void findNeighbours() {
    const std::vector<int> welded = weldVertices(view_);
    std::vector<DirectedEdge> edges;
    for (int t = 0; t < view_.triangle_count; ++t) {
      addSides(weldedCorners(welded, view_.triangles[t]), t, edges);
    }
    neighbours_.resize(view_.triangle_count);
    for (const EdgeMatch& match : pairEdges(std::move(edges)).matches) {
      neighbours_[match.forward.polygon].push_back(match.backward.polygon);
      neighbours_[match.backward.polygon].push_back(match.forward.polygon);
    }
  }

  // Whether no corner of one is beyond the plane of the other.
  bool areConvex(int t, int s) const {
    const auto isBehind = [this](int below, int plane) {
      const Eigen::Vector3d& n = normals_[plane];
      const double level = n.dot(corner(plane, 0)) + kConvex * size_;
      return n.dot(corner(below, 0)) <= level && n.dot(corner(below, 1)) <= level &&
             n.dot(corner(below, 2)) <= level;
    };
    return isBehind(t, s) && isBehind(s, t);
  }

  // Around a seed, by rings, as long as all of it is on its hull (Ehmann and Lin 2001).
  std::vector<int> patchAround(int seed, const std::vector<bool>& held) const {
    std::vector<int> patch{seed};
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const int next : neighbours_[patch[i]]) {
        if (patch.size() == kLargestPatch) return patch;
        if (held[next] || std::find(patch.begin(), patch.end(), next) != patch.end()) continue;
        const auto fits = [&](int t) { return areConvex(t, next); };
        if (std::all_of(patch.begin(), patch.end(), fits)) patch.push_back(next);
      }
    }
    return patch;
  }

  // Of the first of its triangles, to which the patch is cut down: so many as doubling and then
  // halving the difference finds that a piece within the mesh can have.
  Piece largestPiece(std::vector<int>& patch) const {
    std::size_t place = 0;
    Piece piece = pieceBelow(patch, 1, kPlaces, place);
    std::size_t count = 1;
    std::size_t most = patch.size() + 1;
    while (piece && most - count > 1) {
      const std::size_t more = std::min(2 * count, (count + most) / 2);
      if (const Piece larger = pieceBelow(patch, more, kPlacesTried, place)) {
        piece = larger;
        count = more;
      } else {
        most = more;
      }
    }
    patch.resize(count);
    return piece;
  }

  // With the deepest place from `place` on that will do, of so many; says which.
  Piece pieceBelow(const std::vector<int>& patch, std::size_t count, std::size_t places,
                   std::size_t& place) const {
    std::vector<Eigen::Vector3d> points;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    Eigen::Vector3d across = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      const int t = patch[i];
      for (int k = 0; k < 3; ++k) points.push_back(corner(t, k));
      middle += (corner(t, 0) + corner(t, 1) + corner(t, 2)) / (3.0 * static_cast<double>(count));
      across += 0.5 * (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
    }
    const double size = std::sqrt(across.norm());
    if (!(size > 0.0)) return nullptr;
    keepEachOnce(points);
    points.push_back(middle);
    for (std::size_t at = place; at < std::min(place + places, kPlaces); ++at) {
      const Eigen::Vector3d inwards =
          at < kDepths.size() ? apex_ - middle : Eigen::Vector3d(-size * across.normalized());
      points.back() = middle + kDepths[at % kDepths.size()] * inwards;
      if (Piece fan = within(points)) {
        place = at;
        return fan;
      }
    }
    return nullptr;
  }

  Piece within(const std::vector<Eigen::Vector3d>& points) const {
    const Piece known = convexFanOf(convexHull(points), points);
    if (!known) return nullptr;
    auto fan = std::make_shared<ConvexFan>(*known);
    return mesh_.surrounds(*fan, {}) ? fan : nullptr;
  }

  const MeshView view_;
  const std::vector<Eigen::Vector3d>& vertices_;
  const SurroundingMesh& mesh_;
  Eigen::Vector3d apex_;
  double size_ = 0.0;
  std::vector<Eigen::Vector3d> normals_;      // of triangles, 0 without area
  std::vector<std::vector<int>> neighbours_;  // of triangles, across their sides
};

}  // namespace

std::vector<ConvexFan> shellPieces(const MeshView& view,
                                   const std::vector<Eigen::Vector3d>& vertices,
                                   const SurroundingMesh& mesh, const TriangleMesh& core,
                                   const Eigen::Vector3d& apex) {
  std::set<std::array<double, 3>> of_core;
  for (const fcl::Triangle& t : core.triangles) {
    for (int k = 0; k < 3; ++k) of_core.insert(key(core.vertices[t[k]]));
  }
  std::vector<bool> held(view.triangle_count, true);
  for (int t = 0; t < view.triangle_count; ++t) {
    for (int k = 0; k < 3; ++k) {
      held[t] = held[t] && of_core.count(key(vertices[view.triangles[t][k]])) > 0;
    }
  }
  return PatchSearch(view, vertices, mesh, apex).cover(held);
}

}  // namespace fcl_prob::detail
