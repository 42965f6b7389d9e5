// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cobstacle/slab_polytope.h"

#include <Eigen/Geometry>
#include <array>

namespace fcl_prob::detail {
namespace {

/// A planar convex polygon, clipped in place (Sutherland and Hodgman 1974). Every cut adds at most
/// one corner to the four of the start.
class Polygon {
 public:
  static constexpr int kMaxCorners = 64;

  /// A square in the plane normal·x = offset around `near`'s foot point.
  Polygon(const Eigen::Vector3d& normal, double offset, const Eigen::Vector3d& near, double reach) {
    const Eigen::Vector3d unit = normal.normalized();
    const Eigen::Vector3d foot =
        near + normal * ((offset - normal.dot(near)) / normal.squaredNorm());
    const Eigen::Vector3d u = reach * unit.unitOrthogonal();
    const Eigen::Vector3d v = unit.cross(u);
    count_ = 4;
    corners_ = {foot - u - v, foot + u - v, foot + u + v, foot - u + v};
  }

  /// Keeps direction·x <= limit.
  void clip(const Eigen::Vector3d& direction, double limit) {
    std::array<double, kMaxCorners> excess;
    bool cuts = false;
    for (int i = 0; i < count_; ++i) {
      excess[i] = direction.dot(corners_[i]) - limit;
      cuts = cuts || excess[i] > 0.0;
    }
    if (!cuts) return;
    std::array<Eigen::Vector3d, kMaxCorners> kept;
    int kept_count = 0;
    for (int i = 0; i < count_; ++i) {
      const int next = i + 1 < count_ ? i + 1 : 0;
      if (excess[i] <= 0.0) kept[kept_count++] = corners_[i];
      if ((excess[i] > 0.0) != (excess[next] > 0.0)) {
        const double t = excess[i] / (excess[i] - excess[next]);
        kept[kept_count++] = corners_[i] + t * (corners_[next] - corners_[i]);
      }
    }
    corners_ = kept;
    count_ = kept_count;
  }

  int count() const { return count_; }
  const Eigen::Vector3d& corner(int i) const { return corners_[i]; }

 private:
  std::array<Eigen::Vector3d, kMaxCorners> corners_;
  int count_;
};

}  // namespace

const std::vector<Eigen::Vector3d>& dopDirections() {
  static const std::vector<Eigen::Vector3d> directions = {
      {1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {1, 1, 0},  {1, 0, 1},  {0, 1, 1}, {1, -1, 0},
      {1, 0, -1}, {0, 1, -1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}};
  return directions;
}

void setToSlabs(const std::vector<Slab>& slabs, double padding, FaceSet& faces) {
  faces.clear();
  const Eigen::Vector3d lower(slabs[0].lower, slabs[1].lower, slabs[2].lower);
  const Eigen::Vector3d upper(slabs[0].upper, slabs[1].upper, slabs[2].upper);
  const Eigen::Vector3d middle = 0.5 * (lower + upper);
  const double reach = 2.0 * ((upper - lower).norm() + padding);
  for (std::size_t k = 0; k < slabs.size(); ++k) {
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector3d normal = side * slabs[k].direction;
      const double offset = side > 0.0 ? slabs[k].upper : -slabs[k].lower;
      Polygon polygon(normal, offset + padding * normal.norm(), middle, reach);
      for (std::size_t other = 0; other < slabs.size() && polygon.count() > 2; ++other) {
        if (other == k) continue;
        const Slab& slab = slabs[other];
        const double widening = padding * slab.direction.norm();
        polygon.clip(slab.direction, slab.upper + widening);
        polygon.clip(-slab.direction, -(slab.lower - widening));
      }
      if (polygon.count() < 3) continue;
      faces.beginFace();
      for (int i = 0; i < polygon.count(); ++i) {
        const int vertex = faces.addVertex(polygon.corner(i));
        faces.addCorner(vertex);
      }
    }
  }
}

}  // namespace fcl_prob::detail
