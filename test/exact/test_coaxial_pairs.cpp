// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Cones and cylinders about parallel axes, against quadrature over their sections.
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>

#include <array>
#include <memory>

#include "catch.h"
#include "curved_cases.h"
#include "fcl_prob/convex_pcd.h"
#include "random_bodies.h"
#include "section_truth.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob;
using Eigen::Vector3d;
using Pose = Eigen::Isometry3d;

/// Where the radius of a sum of two frustums about one axis is largest: sides follow each other by
/// their slopes.
struct Profile {
  std::array<double, 3> height, radius;

  double at(double z) const {
    const std::size_t k = z < height[1] ? 0 : 1;
    const double share = (z - height[k]) / (height[k + 1] - height[k]);
    return radius[k] + share * (radius[k + 1] - radius[k]);
  }
};

/// Of frustums with these lengths and radii at the bottom and at the top, about the middle.
Profile profileOf(std::array<Vector3d, 2> frustums) {
  const auto slope = [](const Vector3d& f) { return (f[1] - f[2]) / f[0]; };
  if (slope(frustums[1]) < slope(frustums[0])) std::swap(frustums[0], frustums[1]);
  const double bottom = -0.5 * (frustums[0][0] + frustums[1][0]);
  return {{bottom, bottom + frustums[0][0], -bottom},
          {frustums[0][1] + frustums[1][1], frustums[0][2] + frustums[1][1],
           frustums[0][2] + frustums[1][2]}};
}

TEST_CASE("cones and cylinders about parallel axes against quadrature over sections") {
  RandomBodies random(310);
  for (int k = 0; k < 24; ++k) {
    const CoaxialPair pair(random);
    const bool is_cone = k % 2 == 0, turned = k % 4 < 2;
    // -A is a cone upside down, unless A is turned.
    const Vector3d a(pair.length, turned ? pair.radius : 0.0, turned ? 0.0 : pair.radius);
    const Profile profile = profileOf({a, {pair.longer, pair.other, is_cone ? 0.0 : pair.other}});
    const double truth = integrateOver(
        {pair.along + profile.height[0], pair.along + profile.height[1],
         pair.along + profile.height[2]},
        [&](double z) {
          return densityAt(z / pair.sigma_along) / pair.sigma_along *
                 discMassAt(pair.across / pair.sigma, profile.at(z - pair.along) / pair.sigma);
        });
    const auto error = pair.error();
    Pose pose_a = Pose::Identity();
    if (turned) pose_a.linear() = Vector3d(1.0, -1.0, -1.0).asDiagonal();
    const fcl::Coned cone(pair.radius, pair.length);
    const std::unique_ptr<fcl::CollisionGeometryd> second =
        is_cone
            ? std::unique_ptr<fcl::CollisionGeometryd>(new fcl::Coned(pair.other, pair.longer))
            : std::unique_ptr<fcl::CollisionGeometryd>(new fcl::Cylinderd(pair.other, pair.longer));
    INFO((is_cone ? "cone " : "cylinder ")
         << pair.radius << " " << pair.length << " and " << pair.other << " " << pair.longer
         << " at " << pair.across << ", " << pair.along);
    Pose pose_b = Pose::Identity();
    pose_b.translation() << pair.across, 0.0, pair.along;
    const Bounds mass =
        convexPairMass(ConvexBody(cone), pose_a, ConvexBody(*second), pose_b, error);
    CHECK(mass.lower <= truth * (1.0 + 1e-8));
    CHECK(mass.upper >= truth * (1.0 - 1e-8));
    CHECK(mass.width() <= 1e-6 * mass.upper);
  }
}

}  // namespace
