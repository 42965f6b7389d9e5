// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/sphere_bv.h"

#include <algorithm>
#include <cmath>

namespace fcl_prob {
namespace {

/// Steps towards the farthest point; the radius is then within about 1/kSteps of the smallest.
constexpr int kSteps = 48;

/// A radius is rounded up by this fraction, and by this fraction of the centre's coordinates.
constexpr double kOutwards = 1e-15;

const Eigen::Vector3d& farthestFrom(const Eigen::Vector3d& centre,
                                    const std::vector<Eigen::Vector3d>& points) {
  const Eigen::Vector3d* best = &points.front();
  double largest = -1.0;
  for (const Eigen::Vector3d& p : points) {
    const double squared = (p - centre).squaredNorm();
    if (squared > largest) {
      largest = squared;
      best = &p;
    }
  }
  return *best;
}

double roundedOutwards(double radius, const Eigen::Vector3d& centre) {
  return radius * (1.0 + kOutwards) + kOutwards * centre.norm();
}

}  // namespace

SphereBv SphereBv::around(const std::vector<Eigen::Vector3d>& points) {
  SphereBv sphere;
  for (const Eigen::Vector3d& p : points) {
    sphere.lower_ = sphere.lower_.cwiseMin(p);
    sphere.upper_ = sphere.upper_.cwiseMax(p);
  }
  Eigen::Vector3d centre = 0.5 * (sphere.lower_ + sphere.upper_);
  sphere.centre_ = centre;
  double least = (farthestFrom(centre, points) - centre).norm();
  for (int step = 0; step < kSteps; ++step) {
    centre += (farthestFrom(centre, points) - centre) / (step + 2.0);
    const double radius = (farthestFrom(centre, points) - centre).norm();
    if (radius < least) {
      least = radius;
      sphere.centre_ = centre;
    }
  }
  sphere.radius_ = roundedOutwards(least, sphere.centre_);
  return sphere;
}

SphereBv& SphereBv::operator+=(const Eigen::Vector3d& point) {
  SphereBv other;
  other.centre_ = other.lower_ = other.upper_ = point;
  other.radius_ = 0.0;
  return *this += other;
}

SphereBv& SphereBv::operator+=(const SphereBv& other) {
  lower_ = lower_.cwiseMin(other.lower_);
  upper_ = upper_.cwiseMax(other.upper_);
  if (other.radius_ < 0.0) return *this;
  const Eigen::Vector3d between = other.centre_ - centre_;
  const double distance = between.norm();
  if (radius_ < 0.0 || distance + radius_ <= other.radius_) {
    centre_ = other.centre_;
    radius_ = other.radius_;
  } else if (distance + other.radius_ > radius_) {
    const double radius = 0.5 * (radius_ + distance + other.radius_);
    centre_ += between * ((radius - radius_) / distance);
    radius_ = roundedOutwards(radius, centre_);
  }
  return *this;
}

SphereBv SphereBv::operator+(const SphereBv& other) const {
  SphereBv sum = *this;
  return sum += other;
}

bool SphereBv::overlap(const SphereBv& other) const {
  if (radius_ < 0.0 || other.radius_ < 0.0) return false;
  return (other.centre_ - centre_).norm() <= radius_ + other.radius_;
}

bool SphereBv::contain(const Eigen::Vector3d& point) const {
  return (point - centre_).norm() <= radius_;
}

double SphereBv::volume() const {
  return radius_ > 0.0 ? 4.0 / 3.0 * M_PI * radius_ * radius_ * radius_ : 0.0;
}

}  // namespace fcl_prob
