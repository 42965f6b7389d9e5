// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Objects far from the origin of the world or of their own frames, against 50 digits.
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>

#include <algorithm>
#include <cmath>

#include "catch.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/convex_pcd.h"
#include "fcl_prob/group.h"
#include "fcl_prob/mixture.h"
#include "high_precision.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

struct Interval {
  HighPrecision lo;
  HighPrecision hi;
};

/// Where along x a point lies that a pose places.
HighPrecision placedX(const fcl::Transform3d& pose, const Eigen::Vector3d& point) {
  HighPrecision x = pose.translation().x();
  for (int j = 0; j < 3; ++j) {
    x += HighPrecision(pose.linear()(0, j)) * HighPrecision(point[j]);
  }
  return x;
}

Interval extentOf(const std::vector<Eigen::Vector3d>& points, const fcl::Transform3d& pose) {
  Interval extent{placedX(pose, points[0]), placedX(pose, points[0])};
  for (const Eigen::Vector3d& point : points) {
    extent.lo = std::min(extent.lo, placedX(pose, point));
    extent.hi = std::max(extent.hi, placedX(pose, point));
  }
  return extent;
}

/// Displacements along x, standardised, at which an extent meets that of a wall.
Interval contactWith(const Interval& wall, const Interval& moving, double mean, double sigma) {
  const HighPrecision m = mean, s = sigma;
  return {(wall.lo - moving.hi - m) / s, (wall.hi - moving.lo - m) / s};
}

HighPrecision mass(const Interval& y) {
  return y.lo + y.hi < 0 ? trueTail(-y.hi) - trueTail(-y.lo) : trueTail(y.lo) - trueTail(y.hi);
}

/// A body beside a wall across x, both far away, the displacement along x only.
struct WallScene {
  TriangleMesh body;
  fcl::Transform3d pose_body = fcl::Transform3d::Identity();
  Eigen::Vector3d half_wall;
  fcl::Transform3d pose_wall = fcl::Transform3d::Identity();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double sigma = 1.0;

  GaussianDisplacement displacement() const {
    return GaussianDisplacement::fromStandardDeviations({sigma, 0, 0},
                                                        Eigen::Quaterniond::Identity(), mean);
  }
  Interval wall() const {
    const HighPrecision middle = pose_wall.translation().x();
    return {middle - HighPrecision(half_wall.x()), middle + HighPrecision(half_wall.x())};
  }
  Interval contact() const {
    return contactWith(wall(), extentOf(body.vertices, pose_body), mean.x(), sigma);
  }
};

/// The far translations cancel up to about a metre and what is far rounds of that, in one of three
/// ways: by the poses, by the mean, or by the body's distance from its own frame's origin.
WallScene randomWall(RandomBodies& random) {
  WallScene scene;
  const double far = std::ldexp(random.uniform(0.5, 1.0), random.integer(1, 40));
  const Eigen::Vector3d away = far * random.direction();
  const double size = random.logUniform(1e-3, 1.0);
  scene.body = bumpyMesh(size, 4, 5, static_cast<unsigned>(random.integer(1, 1000)));
  if (random.integer(0, 1) == 0) scene.pose_body.linear() = random.rotation();
  switch (random.integer(0, 2)) {
    case 0:
      scene.pose_body.translation() = away;
      scene.pose_wall.translation() = away;
      break;
    case 1:
      scene.pose_body.translation() = away;
      scene.mean = -away;
      break;
    default:
      for (Eigen::Vector3d& vertex : scene.body.vertices) vertex += away;
      scene.pose_body.translation() = -(scene.pose_body.linear() * away);
  }
  const double wide = 10 + std::ldexp(far, -30);  // wherever rounding has put the body
  scene.half_wall = {random.uniform(0.1, 1.0) * size, wide, wide};
  const Interval gap = contactWith(scene.wall(), extentOf(scene.body.vertices, scene.pose_body),
                                   scene.mean.x(), 1.0);
  scene.sigma = std::max(1e-6, std::abs(gap.lo.convert_to<double>())) * random.logUniform(0.1, 10);
  return scene;
}

ProbabilityRequest tightRequest(ProbabilityMethod method) {
  ProbabilityRequest request;
  request.method = method;
  request.absolute_tolerance = 0.0;
  request.relative_tolerance = 1e-12;
  request.max_cells = 500;
  return request;
}

void checkHolds(const Bounds& bounds, const HighPrecision& truth) {
  CAPTURE(bounds.lower);
  CAPTURE(bounds.upper);
  CAPTURE(truth);
  CHECK(HighPrecision(bounds.lower) <= truth);
  CHECK(HighPrecision(bounds.upper) >= truth);
}

Bounds boundsOf(const ProbabilityResult& result) { return {*result.lower, *result.upper}; }

}  // namespace

TEST_CASE("a mesh and a wall far away: the interval holds the mass on a line") {
  RandomBodies random(51);
  int tight = 0;
  const int count = 400;
  for (int i = 0; i < count; ++i) {
    INFO("scene " << i);
    const WallScene scene = randomWall(random);
    const auto model = makeModel<fcl::OBBRSSd>(scene.body);
    const fcl::Boxd wall(2 * scene.half_wall);
    ProbabilityResult result;
    const bool body_first = i % 2 == 0;
    if (body_first) {
      collisionProbability(model.get(), scene.pose_body, &wall, scene.pose_wall,
                           scene.displacement(), tightRequest(ProbabilityMethod::interval), result);
    } else {
      collisionProbability(&wall, scene.pose_wall, model.get(), scene.pose_body,
                           scene.displacement().reversed(),
                           tightRequest(ProbabilityMethod::interval), result);
    }
    checkHolds(boundsOf(result), mass(scene.contact()));
    tight += *result.upper - *result.lower < 1e-6;
  }
  // However far: what is left is the rounding of the numbers passed in.
  CHECK(tight > 0.9 * count);
}

TEST_CASE("truncated far away: the interval holds the mass within the cut") {
  RandomBodies random(52);
  for (int i = 0; i < 100; ++i) {
    INFO("scene " << i);
    const WallScene scene = randomWall(random);
    const auto model = makeModel<fcl::OBBRSSd>(scene.body);
    const auto wall = std::make_shared<fcl::Boxd>(2 * scene.half_wall);
    const double cut = random.uniform(0.5, 4.0);
    ProbabilityResult result;
    collisionProbability(PreparedQuery(model, wall), scene.pose_body, scene.pose_wall,
                         TruncatedGaussian(scene.displacement(), cut),
                         tightRequest(ProbabilityMethod::interval), result);
    const Interval contact = scene.contact();
    const Interval kept{std::max<HighPrecision>(contact.lo, -cut),
                        std::min<HighPrecision>(contact.hi, cut)};
    const HighPrecision within = kept.lo < kept.hi ? mass(kept) : HighPrecision(0);
    checkHolds(boundsOf(result), within / mass({-cut, cut}));
  }
}

TEST_CASE("groups far away: the interval holds the mass of the union on a line") {
  RandomBodies random(53);
  for (int i = 0; i < 100; ++i) {
    INFO("scene " << i);
    WallScene scene = randomWall(random);
    const auto model = makeModel<fcl::OBBRSSd>(scene.body);
    const auto wall = std::make_shared<fcl::Boxd>(2 * scene.half_wall);
    // Another wall, so far along x that the two contacts are apart.
    WallScene other = scene;
    other.pose_wall.translation().x() += random.uniform(5.0, 8.0) + 1e-9 * scene.mean.norm();
    const auto near = std::make_shared<fcl::Boxd>(2 * other.half_wall);
    ProbabilityResult result;
    GroupQuery(GroupQuery::Geometries{model}, GroupQuery::Geometries{wall, near})
        .collisionProbability({scene.pose_body}, {scene.pose_wall, other.pose_wall},
                              scene.displacement(), tightRequest(ProbabilityMethod::interval),
                              result);
    const Interval first = scene.contact(), second = other.contact();
    if (first.hi >= second.lo) continue;
    checkHolds(boundsOf(result), mass(first) + mass(second));
  }
}

TEST_CASE("convex pairs far away: masses and bounds hold") {
  RandomBodies random(54);
  int tight = 0;
  const int count = 200;
  for (int i = 0; i < count; ++i) {
    INFO("scene " << i);
    const double far = std::ldexp(random.uniform(0.5, 1.0), random.integer(1, 40));
    const Eigen::Vector3d away = far * random.direction();
    const fcl::Boxd a(Eigen::Vector3d::Constant(random.logUniform(0.1, 1.0)));
    const fcl::Boxd b(Eigen::Vector3d::Constant(random.logUniform(0.1, 1.0)));
    fcl::Transform3d pose_a = fcl::Transform3d::Identity(), pose_b = pose_a;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    pose_a.translation() = away;
    if (i % 2 == 0) {
      pose_b.translation() = away;
    } else {
      mean = -away;
    }
    pose_b.translation() += random.uniform(0.0, 1.0) * random.direction();
    const Eigen::Vector3d sigma(random.uniform(0.1, 1), random.uniform(0.1, 1),
                                random.uniform(0.1, 1));
    const auto displacement =
        GaussianDisplacement::fromStandardDeviations(sigma, Eigen::Quaterniond::Identity(), mean);
    HighPrecision truth = 1;
    for (int k = 0; k < 3; ++k) {
      const HighPrecision middle = HighPrecision(pose_b.translation()[k]) -
                                   HighPrecision(pose_a.translation()[k]) - HighPrecision(mean[k]);
      const HighPrecision half = (HighPrecision(a.side[k]) + HighPrecision(b.side[k])) / 2;
      truth *= mass({(middle - half) / sigma[k], (middle + half) / sigma[k]});
    }
    ProbabilityResult result;
    collisionProbability(&a, pose_a, &b, pose_b, displacement,
                         tightRequest(ProbabilityMethod::exact), result);
    checkHolds(boundsOf(result), truth);
    tight += *result.upper - *result.lower < 1e-6;
    checkHolds({0.0, convexPcd(ConvexBody(a), pose_a, ConvexBody(b), pose_b, displacement).least},
               truth);
  }
  // However far: what is left is the rounding of the numbers passed in.
  CHECK(tight == count);
}

TEST_CASE("a half-space far away: the closed form holds") {
  RandomBodies random(55);
  int tight = 0;
  const int count = 200;
  for (int i = 0; i < count; ++i) {
    INFO("scene " << i);
    const double far = std::ldexp(random.uniform(0.5, 1.0), random.integer(1, 40));
    const Eigen::Vector3d away = far * random.direction();
    const fcl::Boxd box(Eigen::Vector3d::Constant(random.logUniform(0.1, 1.0)));
    const fcl::Halfspaced ground(Eigen::Vector3d::UnitX(), random.uniform(-1.0, 1.0));
    fcl::Transform3d pose = fcl::Transform3d::Identity(), pose_ground = pose;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    pose.translation() = away;
    if (i % 2 == 0) {
      pose_ground.translation() = away + random.direction();
    } else {
      mean = -away;
    }
    const double sigma = random.uniform(0.1, 1.0);
    ProbabilityResult result;
    collisionProbability(&box, pose, &ground, pose_ground,
                         GaussianDisplacement::fromStandardDeviations(
                             {sigma, 0, 0}, Eigen::Quaterniond::Identity(), mean),
                         tightRequest(ProbabilityMethod::interval), result);
    const HighPrecision lowest =
        HighPrecision(away.x()) - HighPrecision(box.side[0]) / 2 + HighPrecision(mean.x());
    const HighPrecision top =
        HighPrecision(ground.d) + HighPrecision(pose_ground.translation().x());
    const HighPrecision truth = trueTail((lowest - top) / HighPrecision(sigma));
    checkHolds(boundsOf(result), truth);
    tight += *result.upper - *result.lower < 1e-8;
  }
  CHECK(tight > 0.9 * count);
}

TEST_CASE("a voxel far from the middle of its octree is where FCL has it") {
  RandomBodies random(56);
  for (int i = 0; i < 200; ++i) {
    INFO("scene " << i);
    const double resolution = random.uniform(0.01, 0.2);
    const auto map = std::make_shared<octomap::OcTree>(resolution);
    const Eigen::Vector3f at =
        (resolution * random.logUniform(1.0, 3e4) * random.direction()).cast<float>();
    map->updateNode(at.x(), at.y(), at.z(), true);
    const fcl::OcTreed octree{std::shared_ptr<const octomap::OcTree>(map)};
    fcl::AABBd voxel = octree.getRootBV();
    for (const fcl::OcTreed::OcTreeNode* node = octree.getRoot(); octree.nodeHasChildren(node);) {
      unsigned int child = 0;
      while (!octree.nodeChildExists(node, child)) ++child;
      fcl::AABBd part;
      fcl::computeChildBV(voxel, child, part);
      voxel = part;
      node = octree.getNodeChild(node, child);
    }
    const fcl::Boxd wall(1, 1, 1);
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.translation() = voxel.center();
    pose.translation().x() = voxel.max_.x() + 0.5;
    const double sigma = random.logUniform(1e-14, 1e-10);
    ProbabilityResult result;
    collisionProbability(&octree, fcl::Transform3d::Identity(), &wall, pose,
                         GaussianDisplacement::fromStandardDeviations({sigma, 0, 0}),
                         tightRequest(ProbabilityMethod::interval), result);
    const HighPrecision gap =
        HighPrecision(pose.translation().x()) - HighPrecision(0.5) - HighPrecision(voxel.max_.x());
    checkHolds(boundsOf(result), trueTail(gap / HighPrecision(sigma)));
  }
}

TEST_CASE("a half-space in a group is where its pose has it, though that is not quite a rotation") {
  RandomBodies random(57);
  const auto box = std::make_shared<fcl::Boxd>(1, 1, 1);
  const fcl::Transform3d here = fcl::Transform3d::Identity();
  for (int i = 0; i < 50; ++i) {
    INFO("scene " << i);
    const auto ground =
        std::make_shared<fcl::Halfspaced>(Eigen::Vector3d::UnitX(), random.uniform(-2.0, 2.0));
    fcl::Transform3d pose = here;
    pose.linear() *= 1 + random.uniform(-4e-10, 4e-10);
    pose.translation().x() = -0.5 - ground->d;
    const double sigma = random.logUniform(1e-11, 1e-9);
    ProbabilityResult result;
    GroupQuery(GroupQuery::Geometries{box, box}, GroupQuery::Geometries{ground})
        .collisionProbability({here, here}, {pose},
                              GaussianDisplacement::fromStandardDeviations({sigma, 0, 0}),
                              tightRequest(ProbabilityMethod::interval), result);
    const HighPrecision top = HighPrecision(ground->d) / HighPrecision(pose.linear()(0, 0)) +
                              HighPrecision(pose.translation().x());
    checkHolds(boundsOf(result), trueTail((HighPrecision(-0.5) - top) / HighPrecision(sigma)));
  }
}
