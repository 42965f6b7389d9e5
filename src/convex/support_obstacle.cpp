// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/support_obstacle.h"

#include <Eigen/Geometry>

namespace fcl_prob::detail {
namespace {

// Relative to the size of a triangle: corners that are as high as the highest.
constexpr double kSameCorner = 1e-9;

}  // namespace

const Eigen::Vector3d& SupportBody::farthestCorner(const Eigen::Vector3d& direction) const {
  const double heights[3] = {direction.dot(corners_[0]), direction.dot(corners_[1]),
                             direction.dot(corners_[2])};
  const int first = heights[0] >= heights[1] ? 0 : 1;
  return corners_[heights[first] >= heights[2] ? first : 2];
}

Eigen::Vector3d SupportBody::supportPoint(const Eigen::Vector3d& direction) const {
  if (!shape_) return farthestCorner(direction);
  return position_ + shape_->supportPoint(direction);
}

double SupportBody::supportValue(const Eigen::Vector3d& direction) const {
  if (!shape_) return direction.dot(farthestCorner(direction));
  return direction.dot(position_) + shape_->supportValue(direction);
}

TouchingFace SupportBody::touchingFace(const Eigen::Vector3d& direction) const {
  if (shape_) {
    TouchingFace face = shape_->touchingFace(direction);
    face.middle += position_;
    return face;
  }
  const Eigen::Vector3d& top = farthestCorner(direction);
  const double size = (corners_[1] - corners_[0]).norm() + (corners_[2] - corners_[0]).norm();
  Eigen::Matrix<double, 3, Eigen::Dynamic> farthest(3, 3);
  Eigen::Index count = 0;
  for (const Eigen::Vector3d& corner : corners_) {
    if (direction.dot(top - corner) > kSameCorner * direction.norm() * size) continue;
    farthest.col(count++) = corner;
  }
  return TouchingFace::around(farthest.leftCols(count));
}

Eigen::Matrix3d SupportBody::supportDerivative(const Eigen::Vector3d& direction) const {
  return shape_ ? shape_->supportDerivative(direction) : Eigen::Matrix3d::Zero();
}

Eigen::Vector3d SupportBody::centre() const {
  if (!shape_) return (corners_[0] + corners_[1] + corners_[2]) / 3.0;
  return position_ + shape_->centre();
}

Eigen::Matrix3d SupportBody::spread() const {
  if (shape_) return shape_->spread();
  const Eigen::Vector3d middle = centre();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& corner : corners_) {
    sum += (corner - middle) * (corner - middle).transpose() / 3.0;
  }
  return sum;
}

std::vector<Eigen::Vector3d> SupportBody::sideNormals() const {
  if (shape_) return shape_->sideNormals();
  const Eigen::Vector3d area = (corners_[1] - corners_[0]).cross(corners_[2] - corners_[0]);
  if (!(area.norm() > 0.0)) return {};
  return {area.stableNormalized()};
}

std::vector<Eigen::Vector3d> SupportObstacle::sideNormals() const {
  std::vector<Eigen::Vector3d> normals = a_.sideNormals();
  for (const Eigen::Vector3d& normal : b_.sideNormals()) normals.push_back(normal);
  return normals;
}

SupportObstacle::SupportObstacle(const SupportBody& a, const SupportBody& b,
                                 const Eigen::Vector3d& error)
    : a_(a), b_(b), error_(error), centre_(b.centre() - a.centre()) {}

}  // namespace fcl_prob::detail
