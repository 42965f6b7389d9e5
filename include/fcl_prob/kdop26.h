// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// 26-DOPs as a bounding volume that fcl::BVHModel builds a tree of.
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>

namespace fcl_prob {

/// The polytope between 13 pairs of parallel planes with normals x, y, z, the six face diagonals
/// and the four space diagonals: what fcl::KDOP<24> lacks is x+y+z. fcl::BVHModel<Kdop26> works
/// like FCL's own models, in its own frame, metres. FCL cannot collide such models (it has no
/// traversal for them); generalPcd() can bound them.
class Kdop26 {
 public:
  using S = double;
  static constexpr int kSlabs = 13;

  /// Contains nothing: every lower() is above its upper().
  Kdop26();

  /// Extent along the unnormalised direction(k).
  double lower(int k) const { return lower_[k]; }
  double upper(int k) const { return upper_[k]; }
  static const Eigen::Vector3d& direction(int k);

  Kdop26& operator+=(const Eigen::Vector3d& point);
  Kdop26& operator+=(const Kdop26& other);
  Kdop26 operator+(const Kdop26& other) const;

  /// Whether no slab separates them (which does not prove that they overlap).
  bool overlap(const Kdop26& other) const;
  bool contain(const Eigen::Vector3d& point) const;

  /// Sides, centre, volume and size of its axis-aligned box, as fcl::KDOP has them.
  double width() const { return upper_[0] - lower_[0]; }
  double height() const { return upper_[1] - lower_[1]; }
  double depth() const { return upper_[2] - lower_[2]; }
  Eigen::Vector3d center() const;
  double volume() const { return width() * height() * depth(); }
  double size() const { return width() * width() + height() * height() + depth() * depth(); }

 private:
  std::array<double, kSlabs> lower_;
  std::array<double, kSlabs> upper_;
};

}  // namespace fcl_prob
