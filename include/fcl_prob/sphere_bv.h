// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Spheres as a bounding volume that fcl::BVHModel builds a tree of.
#pragma once

#include <fcl/geometry/bvh/detail/BV_fitter.h>

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace fcl_prob {

/// A bounding sphere: fcl::BVHModel<SphereBv> works like FCL's own models, in its own frame,
/// metres. FCL cannot collide such models (it has no traversal for them); generalPcd() can bound
/// them.
class SphereBv {
 public:
  using S = double;

  /// Contains nothing; its radius is negative.
  SphereBv() = default;

  /// A nearly smallest sphere around some points (Bădoiu and Clarkson 2003; within about 2 % of the
  /// smallest radius), rounded outwards. \param points  at least one
  static SphereBv around(const std::vector<Eigen::Vector3d>& points);

  const Eigen::Vector3d& center() const { return centre_; }
  double radius() const { return radius_; }

  SphereBv& operator+=(const Eigen::Vector3d& point);
  SphereBv& operator+=(const SphereBv& other);
  SphereBv operator+(const SphereBv& other) const;

  bool overlap(const SphereBv& other) const;
  bool contain(const Eigen::Vector3d& point) const;

  /// Sides of the axis-aligned box of the contents (not of the sphere, whose sides are all equal):
  /// FCL splits a node across the longest one.
  double width() const { return upper_.x() - lower_.x(); }
  double height() const { return upper_.y() - lower_.y(); }
  double depth() const { return upper_.z() - lower_.z(); }

  double volume() const;
  double size() const { return radius_ * radius_; }

 private:
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  double radius_ = -1.0;
  Eigen::Vector3d lower_ = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d upper_ = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());
};

}  // namespace fcl_prob

namespace fcl::detail {

/// FCL's way to fit a bounding volume of one's own better than by adding one point after another.
template <>
struct FitImpl<double, fcl_prob::SphereBv> {
  static fcl_prob::SphereBv run(const BVFitter<fcl_prob::SphereBv>& fitter,
                                unsigned int* primitive_indices, int num_primitives) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < num_primitives; ++i) {
      if (fitter.type == BVH_MODEL_TRIANGLES) {
        const Triangle& triangle = fitter.tri_indices[primitive_indices[i]];
        for (int corner = 0; corner < 3; ++corner) {
          points.push_back(fitter.vertices[triangle[corner]]);
          if (fitter.prev_vertices) points.push_back(fitter.prev_vertices[triangle[corner]]);
        }
      } else {
        points.push_back(fitter.vertices[primitive_indices[i]]);
        if (fitter.prev_vertices) points.push_back(fitter.prev_vertices[primitive_indices[i]]);
      }
    }
    return fcl_prob::SphereBv::around(points);
  }
};

}  // namespace fcl::detail
