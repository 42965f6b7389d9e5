// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex_pair_cases.h"

#include <fcl/geometry/shape/box.h>

#include <algorithm>
#include <cmath>

#include "face_geometry.h"
#include "fcl_prob/normal_mass.h"
#include "slice_cubature.h"

namespace fcl_prob_test {
namespace {

using fcl_prob::ConvexBody;
using fcl_prob::GaussianDisplacement;
using Points = std::vector<Eigen::Vector3d>;

constexpr double kLeastSize = 1e-3;
constexpr double kLargestSize = 1e3;
constexpr double kLargestDistance = 8.0;

struct Frame {
  Eigen::Vector3d standard_deviations;
  Eigen::Quaterniond axes;

  Eigen::Vector3d toWorld(const Eigen::Vector3d& y) const {
    return axes * standard_deviations.cwiseProduct(y);
  }
};

Frame randomFrame(RandomBodies& random) {
  return {
      {random.logUniform(0.001, 0.1), random.logUniform(0.001, 0.1), random.logUniform(0.001, 0.1)},
      random.quaternion()};
}

/// An interval of length `size` at `distance` from 0, on either side; containing 0 if that is zero.
std::pair<double, double> interval(RandomBodies& random, double size, double distance) {
  if (distance == 0.0) {
    const double lower = -random.uniform(0.0, size);
    return {lower, lower + size};
  }
  if (random.integer(0, 1)) return {distance, distance + size};
  return {-distance - size, -distance};
}

Eigen::Vector3d distancesByAxis(RandomBodies& random, double distance) {
  Eigen::Vector3d direction = random.direction().cwiseAbs();
  for (int zeroed = random.integer(0, 2); zeroed > 0; --zeroed) direction[random.integer(0, 2)] = 0;
  if (direction.isZero(0.0)) direction.x() = 1.0;
  return distance * direction.normalized();
}

double randomDistance(RandomBodies& random) {
  return random.integer(0, 9) == 0 ? 0.0 : random.uniform(0.0, kLargestDistance);
}

Points corners(const Eigen::Vector3d& half_sides, const Eigen::Matrix3d& axes) {
  Points points;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d signs((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1,
                                (corner & 4) ? 1 : -1);
    points.push_back(axes * signs.cwiseProduct(half_sides));
  }
  return points;
}

/// Chooses where B is, given the whitened C-obstacle of A and B at the origin.
struct Placement {
  Points obstacle;  // moved
  Eigen::Vector3d shift;
  double size;
  double distance;
};

/// The vertex farthest along some direction becomes the nearest point, or nearly so; or the mean is
/// inside.
Placement place(RandomBodies& random, Points obstacle) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : obstacle) box.extend(p);
  const double distance = randomDistance(random);
  Placement placement{std::move(obstacle), Eigen::Vector3d::Zero(), box.diagonal().norm(),
                      distance};
  if (distance == 0.0) {
    const Points& points = placement.obstacle;
    const int last = static_cast<int>(points.size()) - 1;
    for (int i = 0; i < 4; ++i) placement.shift -= 0.25 * points[random.integer(0, last)];
  } else {
    const Eigen::Vector3d direction = random.direction();
    placement.shift = (distance + supportOf(placement.obstacle, -direction)) * direction;
  }
  for (Eigen::Vector3d& p : placement.obstacle) p += placement.shift;
  return placement;
}

Eigen::Isometry3d at(const Eigen::Vector3d& position, const Eigen::Quaterniond& orientation) {
  Eigen::Isometry3d pose(orientation);
  pose.translation() = position;
  return pose;
}

}  // namespace

ConvexPairCase alignedBoxes(RandomBodies& random) {
  const Frame frame = randomFrame(random);
  const double distance = randomDistance(random);
  const Eigen::Vector3d distances = distancesByAxis(random, distance);
  Eigen::Vector3d lower;
  Eigen::Vector3d upper;
  Eigen::Vector3d sides_a;
  for (int k = 0; k < 3; ++k) {
    const double size = random.logUniform(kLeastSize, kLargestSize);
    std::tie(lower[k], upper[k]) = interval(random, size, distances[k]);
    sides_a[k] = size * random.uniform(0.1, 0.9);
  }
  const Eigen::Vector3d sides = upper - lower;
  const Eigen::Vector3d world_a = frame.standard_deviations.cwiseProduct(sides_a);
  const Eigen::Vector3d world_b = frame.standard_deviations.cwiseProduct(sides - sides_a);
  const Eigen::Vector3d anywhere = random.normalVector();
  const double mass = fcl_prob::normalBoxMass(lower, upper);
  // P is that of the exact sides; rounding of the sides and poses moves the faces by 1e-15 of the
  // size.
  return {ConvexBody(fcl::Boxd(world_a)),
          ConvexBody(fcl::Boxd(world_b)),
          at(anywhere, frame.axes),
          at(anywhere + frame.toWorld(0.5 * (lower + upper)), frame.axes),
          GaussianDisplacement::fromStandardDeviations(frame.standard_deviations, frame.axes),
          sides.maxCoeff(),
          distance,
          mass,
          1e-9 * mass};
}

ConvexPairCase turnedBoxes(RandomBodies& random) {
  const Frame frame = randomFrame(random);
  const double size = random.logUniform(kLeastSize, kLargestSize);
  const auto sides = [&]() -> Eigen::Vector3d {
    return 0.05 * size *
           Eigen::Vector3d(random.uniform(0.01, 1), random.uniform(0.01, 1),
                           random.uniform(0.01, 1));
  };
  const Eigen::Vector3d half_a = sides();
  const Eigen::Vector3d half_b = sides();
  const Eigen::Quaterniond turn_a = random.quaternion();
  const Eigen::Quaterniond turn_b = random.quaternion();
  const Eigen::Matrix3d whitening = frame.standard_deviations.cwiseInverse().asDiagonal() *
                                    frame.axes.toRotationMatrix().transpose();
  const Placement placement =
      place(random, allDifferences(corners(half_b, whitening * turn_b.toRotationMatrix()),
                                   corners(half_a, whitening * turn_a.toRotationMatrix())));
  const double mass = massBySlices(placement.obstacle);
  return {ConvexBody(fcl::Boxd(2.0 * half_a)),
          ConvexBody(fcl::Boxd(2.0 * half_b)),
          at(Eigen::Vector3d::Zero(), turn_a),
          at(frame.toWorld(placement.shift), turn_b),
          GaussianDisplacement::fromStandardDeviations(frame.standard_deviations, frame.axes),
          placement.size,
          placement.distance,
          mass,
          kSliceCubatureError * mass};
}

ConvexPairCase hulls(RandomBodies& random, int count_a, int count_b) {
  const Frame frame = randomFrame(random);
  const double size = random.logUniform(kLeastSize, kLargestSize);
  const Points whitened_a = random.cloud(count_a, size * random.uniform(0.1, 1.0));
  const Points whitened_b = random.cloud(count_b, size * random.uniform(0.1, 1.0));
  const Placement placement = place(random, allDifferences(whitened_b, whitened_a));
  Points a;
  Points b;
  for (const Eigen::Vector3d& p : whitened_a) a.push_back(frame.toWorld(p));
  for (const Eigen::Vector3d& p : whitened_b) b.push_back(frame.toWorld(p));
  const double mass = massBySlices(placement.obstacle);
  return {ConvexBody(a),
          ConvexBody(b),
          Eigen::Isometry3d::Identity(),
          at(frame.toWorld(placement.shift), Eigen::Quaterniond::Identity()),
          GaussianDisplacement::fromStandardDeviations(frame.standard_deviations, frame.axes),
          placement.size,
          placement.distance,
          mass,
          kSliceCubatureError * mass};
}

}  // namespace fcl_prob_test
