// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/convex_solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/constants.h"
#include "convex/convex_set.h"
#include "geometry/closed_mesh.h"
#include "geometry/exact_sum.h"

namespace fcl_prob::detail {
namespace {

/// Triangles times faces of the hull, and vertices of it, that are looked at.
constexpr std::size_t kMostHeights = 4'000'000;
constexpr int kMostVertices = 10'000;

/// In ε of the size: less than what others count for the rounding of points.
constexpr double kMostInset = 8.0;

/// Of a height as a sum of three products of doubles, in ε of the lengths.
constexpr double kHeightRounding = 4.0 * kEpsilon;

using Points = std::vector<Eigen::Vector3d>;

Points usedVertices(const MeshView& view) {
  std::vector<bool> used(static_cast<std::size_t>(view.vertex_count), false);
  for (int t = 0; t < view.triangle_count; ++t) {
    for (int k = 0; k < 3; ++k) used[view.triangles[t][k]] = true;
  }
  Points points;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) points.push_back(view.vertices[i]);
  }
  return points;
}

/// The hull with normals as its corners have them, which of faces along the axes are the axes:
/// those of two boxes are the same to the last bit, and their faces are merged.
std::shared_ptr<const ConvexSet> hullWithOwnNormals(const Points& points) {
  constexpr double kLeastAgreement = 1.0 - 1e-6;
  ConvexPolytope hull = convexHull(points);
  for (ConvexPolytope::Face& face : hull.faces) {
    const auto at = [&](std::size_t k) -> const Eigen::Vector3d& {
      return hull.vertices[static_cast<std::size_t>(face.vertices[k])];
    };
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (std::size_t k = 2; k < face.vertices.size(); ++k) {
      area += (at(k - 1) - at(0)).cross(at(k) - at(0));
    }
    const Eigen::Vector3d normal = area.stableNormalized();
    if (normal.dot(face.normal) > kLeastAgreement) face.normal = normal;
  }
  return std::make_shared<const ConvexSet>(makeConvexMesh(hull, points));
}

/// direction·(to - from), to all digits.
double rise(const Eigen::Vector3d& direction, const Eigen::Vector3d& from,
            const Eigen::Vector3d& to) {
  ExactSum sum;
  for (Eigen::Index k = 0; k < 3; ++k) {
    sum.addProduct(direction[k], to[k]);
    sum.addProduct(direction[k], -from[k]);
  }
  return static_cast<double>(sum.value());
}

class CoreSearch {
 public:
  CoreSearch(const MeshView& view, const Points& points, const ConvexMesh& hull)
      : view_(view), points_(points) {
    for (const Eigen::Vector3d& v : hull.vertices) {
      centre_ += v / static_cast<double>(hull.vertices.size());
    }
    for (const Eigen::Vector3d& p : points) {
      size_ = std::max(size_, p.norm());
      reach_ = std::max(reach_, (p - centre_).norm());
    }
    for (const ConvexMesh::Face& face : hull.faces) addTop(face.normal);
  }

  const Eigen::Vector3d& centre() const { return centre_; }
  double size() const { return size_; }

  /// The core is what is below the lowest triangle at every face, seen from the centre: at least
  /// the hull, made smaller about it by the largest share of a height.
  std::optional<double> inset() const {
    double share = 0.0;
    for (int t = 0; t < view_.triangle_count; ++t) {
      share = std::max(share, shareBelow(t));
      if (!(share * reach_ <= kMostInset * kEpsilon * size_)) return std::nullopt;
    }
    return share * reach_ * (1.0 + 8.0 * kEpsilon);
  }

 private:
  /// A vertex about as high as any, and how much higher others are.
  struct Top {
    Eigen::Vector3d normal;
    Eigen::Vector3d highest;
    double above = 0.0;
    double height;  ///< over the centre, no less
  };

  void addTop(const Eigen::Vector3d& normal) {
    const auto heightOf = [&](const Eigen::Vector3d& p) { return normal.dot(p - centre_); };
    const auto& highest =
        *std::max_element(points_.begin(), points_.end(),
                          [&](const auto& p, const auto& q) { return heightOf(p) < heightOf(q); });
    Top top{normal, highest, 0.0, heightOf(highest) - kHeightRounding * (reach_ + size_)};
    for (const Eigen::Vector3d& p : points_) {
      if (heightOf(p) < heightOf(highest) - 4.0 * kHeightRounding * reach_) continue;
      top.above = std::max(top.above, rise(normal, highest, p));
    }
    tops_.push_back(top);
  }

  /// Of the face that a triangle is nearest to.
  double shareBelow(int triangle) const {
    const Top* nearest = nullptr;
    double least = kInfinity;
    for (const Top& top : tops_) {
      double depth = 0.0;
      for (int k = 0; k < 3; ++k) {
        depth = std::max(depth, top.normal.dot(top.highest - view_.vertex(triangle, k)));
      }
      if (depth < least) {
        least = depth;
        nearest = &top;
      }
    }
    if (!nearest || !(nearest->height > 0.0)) return kInfinity;
    double depth = 0.0;
    for (int k = 0; k < 3; ++k) {
      depth = std::max(depth, rise(nearest->normal, view_.vertex(triangle, k), nearest->highest));
    }
    return (depth + nearest->above) / nearest->height;
  }

  const MeshView& view_;
  const Points& points_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  double size_ = 0.0, reach_ = 0.0;
  std::vector<Top> tops_;
};

}  // namespace

std::unique_ptr<const ConvexSolid> convexSolidOf(const MeshView& view, const std::string& name) {
  if (view.triangle_count < 4 || view.vertex_count > kMostVertices || opennessOf(view)) {
    return nullptr;
  }
  const ClosedMesh solid(view, name);
  if (solid.partPoints().size() != 1) return nullptr;
  const Points points = usedVertices(view);
  ConvexBody hull(hullWithOwnNormals(points));
  const ConvexMesh& mesh = hull.set().outerMesh();
  const auto triangles = static_cast<std::size_t>(view.triangle_count);
  if (mesh.faces.size() < 4 || mesh.faces.size() * triangles > kMostHeights) return nullptr;
  const CoreSearch core(view, points, mesh);
  const auto inset = core.inset();
  if (!inset) return nullptr;
  if (solid.contains(core.centre(), 0.0) != Containment::inside) return nullptr;
  return std::make_unique<const ConvexSolid>(ConvexSolid{std::move(hull), *inset});
}

}  // namespace fcl_prob::detail
