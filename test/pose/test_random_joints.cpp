// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Errors of joints, of bases and of several bodies, against counting.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>

#include <Eigen/Geometry>
#include <cmath>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "mesh_shapes.h"
#include "pose_cases.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Method = ProbabilityMethod;

constexpr double kLink = 0.3;

/// An arm of capsules along x; joints turn about z and y by turns.
std::vector<fcl::Transform3d> arm(const Eigen::VectorXd& joints) {
  std::vector<fcl::Transform3d> poses;
  fcl::Transform3d frame = kIdentity;
  for (Eigen::Index i = 0; i < joints.size(); ++i) {
    const Eigen::Vector3d axis = i % 2 == 0 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
    frame = frame * Eigen::AngleAxisd(joints[i], axis);
    fcl::Transform3d middle = frame;
    middle = middle * Eigen::Translation3d(0.5 * kLink, 0, 0) *
             Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitY());
    poses.push_back(middle);
    frame = frame * Eigen::Translation3d(kLink, 0, 0);
  }
  return poses;
}

GroupQuery::Geometries links(int count) {
  return GroupQuery::Geometries(static_cast<std::size_t>(count),
                                std::make_shared<fcl::Capsuled>(0.04, kLink));
}

GroupQuery::Geometries obstacles() {
  return {makeModel<fcl::OBBRSSd>(bumpyMesh(0.15, 4, 6, 1)),
          std::make_shared<fcl::Boxd>(0.2, 0.2, 0.5)};
}

ProbabilityResult answer(const ConfigurationQuery& query, const RandomConfiguration& configuration,
                         const ProbabilityRequest& request) {
  ProbabilityResult result;
  query.collisionProbability(configuration, request, result);
  return result;
}

ProbabilityRequest counting(std::size_t samples) {
  ProbabilityRequest request = poseRequest(Method::monte_carlo, 1e-9);
  request.samples = samples;
  request.seed = 5;
  return request;
}

void checkAgree(const ProbabilityResult& estimate, const ProbabilityResult& counted) {
  CAPTURE(*estimate.estimate, *estimate.standard_error, *counted.estimate, *counted.standard_error);
  CHECK(std::fabs(*estimate.estimate - *counted.estimate) <=
        5.0 * std::hypot(*estimate.standard_error, *counted.standard_error));
}

RandomJoints sevenJoints(double sigma) {
  Eigen::VectorXd mean(7);
  mean << 0.1, 0.2, -0.3, 0.2, 0.4, -0.1, 0.2;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(7, 7) * sigma * sigma;
  covariance(0, 2) = covariance(2, 0) = 0.5 * sigma * sigma;
  return {mean,
          covariance,
          arm,
          {at(1.4, 0.35, 0.0), at(0.9, -0.35, 0.1)},
          GaussianDisplacement::fromStandardDeviations({0.03, 0.03, 0.03})};
}

}  // namespace

TEST_CASE("an arm with errors in seven joints agrees with counting") {
  const ConfigurationQuery query(links(7), obstacles());
  for (const double sigma : {0.01, 0.05}) {
    const RandomJoints configuration = sevenJoints(sigma);
    CHECK(configuration.dimension() == 7);
    const auto result = answer(query, configuration, poseRequest(Method::estimate, 0.1));
    CHECK(result.status == ProbabilityStatus::converged);
    checkAgree(result, answer(query, configuration, counting(3'000)));
  }
}

TEST_CASE("joints that move together count once") {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(3, 3, 0.01);
  covariance.diagonal() << 0.01, 0.01, 0.0;
  covariance.row(2).setZero();
  covariance.col(2).setZero();
  const RandomJoints configuration(Eigen::Vector3d(0.1, 0.2, 0.3), covariance, arm, {kIdentity},
                                   GaussianDisplacement());
  CHECK(configuration.dimension() == 1);
  // Both angles are one deviation off.
  const auto expected = arm(Eigen::Vector3d(0.2, 0.3, 0.3));
  const Eigen::VectorXd z = Eigen::VectorXd::Constant(1, 1.0);
  const auto plus = configuration.at(z), minus = configuration.at(-z);
  const double off = std::min((plus.poses_a[2].matrix() - expected[2].matrix()).norm(),
                              (minus.poses_a[2].matrix() - expected[2].matrix()).norm());
  CHECK(off < 1e-12);
}

TEST_CASE("an arm on a base that is localised badly, beside obstacles with errors of their own") {
  RandomBodies random(3);
  const ConfigurationQuery query(links(3), {std::make_shared<fcl::Boxd>(0.3, 0.2, 0.3)});
  const auto joints = std::make_shared<RandomJoints>(
      Eigen::Vector3d(0.2, 0.1, 0.3), Eigen::Matrix3d(0.001 * Eigen::Matrix3d::Identity()), arm,
      std::vector<fcl::Transform3d>{at(0.8, 0.5, 0.0)},
      GaussianDisplacement::fromStandardDeviations({0.02, 0.03, 0.0}, random.quaternion(),
                                                   {0.01, 0.0, 0.02}));
  for (const auto convention :
       {PoseConvention::body_rotation_vector, PoseConvention::world_exponential}) {
    const RandomBase configuration(
        joints, at(0.1, -0.2, 0.0),
        PoseError(randomPoseCovariance(random, 6, 0.05, 0.05), convention));
    CHECK(configuration.dimension() == 6);
    const auto result = answer(query, configuration, poseRequest(Method::estimate, 0.03));
    checkAgree(result, answer(query, configuration, counting(3'000)));
  }
}

TEST_CASE("two bodies with pose errors are one with the sum, for small errors") {
  RandomBodies random(4);
  const auto a = std::make_shared<fcl::Boxd>(0.5, 0.3, 0.2);
  const auto b = std::make_shared<fcl::Boxd>(0.4, 0.4, 0.3);
  const fcl::Transform3d pose_a(random.pose(0.1)), pose_b = at(0.5, 0.05, 0.1);
  const PoseError of_a(randomPoseCovariance(random, 6, 0.05, 0.01));
  const PoseError of_b(randomPoseCovariance(random, 6, 0.05, 0.01),
                       PoseConvention::body_rotation_vector);
  const RandomPoses poses({{pose_a}, pose_a, of_a}, {{pose_b}, pose_b, of_b});
  CHECK(poses.dimension() == 6);
  const ConfigurationQuery query({a}, {b});
  const auto both = answer(query, poses, poseRequest(Method::estimate, 0.01));
  checkAgree(both, answer(query, poses, counting(3'000)));
  ProbabilityResult summed;
  collisionProbability(a.get(), pose_a, b.get(), pose_b,
                       PoseError::betweenBodies(of_a, pose_a, of_b, pose_b),
                       poseRequest(Method::estimate, 0.01), summed);
  checkAgree(both, summed);
}

TEST_CASE("a mixture of configurations is their weighted sum") {
  const ConfigurationQuery query(links(7), obstacles());
  const auto narrow = std::make_shared<RandomJoints>(sevenJoints(0.01));
  const auto wide = std::make_shared<RandomJoints>(sevenJoints(0.1));
  ProbabilityResult mixed, counted;
  query.collisionProbability({{0.7, narrow}, {0.3, wide}}, poseRequest(Method::estimate, 0.08),
                             mixed);
  query.collisionProbability({{0.7, narrow}, {0.3, wide}}, counting(3'000), counted);
  checkAgree(mixed, counted);
  CHECK(mixed.status == ProbabilityStatus::converged);
  CHECK(*mixed.standard_error <= 0.1 * *mixed.estimate);
  CHECK_THROWS_AS(query.collisionProbability({{0.7, narrow}, {0.2, wide}},
                                             poseRequest(Method::estimate), mixed),
                  InvalidDistribution);
  CHECK_THROWS_AS(
      query.collisionProbability({{1.0, nullptr}}, poseRequest(Method::estimate), mixed),
      InvalidRequest);
  CHECK_THROWS_AS(query.collisionProbability(*narrow, poseRequest(Method::interval), mixed),
                  UnsupportedGeometry);
}

TEST_CASE("joints that are no distribution are refused") {
  const auto make = [](const Eigen::MatrixXd& covariance) {
    return RandomJoints(Eigen::Vector2d(0, 0), covariance, arm, {}, GaussianDisplacement());
  };
  Eigen::Matrix2d bad = Eigen::Matrix2d::Identity();
  CHECK_NOTHROW(make(bad));
  bad(0, 1) = 0.5;
  CHECK_THROWS_AS(make(bad), InvalidDistribution);
  bad(1, 0) = 0.5;
  CHECK_NOTHROW(make(bad));
  bad(0, 1) = bad(1, 0) = 1.5;
  CHECK_THROWS_AS(make(bad), InvalidDistribution);
  bad = Eigen::Matrix2d::Identity();
  bad(0, 0) = -1.0;
  CHECK_THROWS_AS(make(bad), InvalidDistribution);
  bad(0, 0) = std::nan("");
  CHECK_THROWS_AS(make(bad), InvalidDistribution);
  CHECK_THROWS_AS(make(Eigen::MatrixXd::Identity(3, 3)), InvalidDistribution);
}
