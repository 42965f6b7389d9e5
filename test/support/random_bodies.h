// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Reproducible random convex bodies for tests.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

namespace fcl_prob_test {

class RandomBodies {
 public:
  explicit RandomBodies(unsigned seed) : engine_(seed) {}

  double uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(engine_);
  }
  double logUniform(double lower, double upper) {
    return std::exp(uniform(std::log(lower), std::log(upper)));
  }
  int integer(int lower, int upper) {
    return std::uniform_int_distribution<int>(lower, upper)(engine_);
  }
  double normal() { return normal_(engine_); }
  Eigen::Vector3d normalVector() { return {normal(), normal(), normal()}; }
  Eigen::Vector3d direction() { return normalVector().normalized(); }

  Eigen::Quaterniond quaternion() {
    return Eigen::Quaterniond(normal(), normal(), normal(), normal()).normalized();
  }
  Eigen::Matrix3d rotation() { return quaternion().toRotationMatrix(); }

  Eigen::Isometry3d pose(double reach) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = rotation();
    pose.translation() = uniform(0.0, reach) * direction();
    return pose;
  }

  /// Points scattered around the origin, about `size` across.
  std::vector<Eigen::Vector3d> cloud(int count, double size) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < count; ++i) points.push_back(0.3 * size * normalVector());
    return points;
  }

  /// Points on a sphere, all of which are vertices of their hull.
  std::vector<Eigen::Vector3d> onSphere(int count, double radius) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < count; ++i) points.push_back(radius * direction());
    return points;
  }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

}  // namespace fcl_prob_test
