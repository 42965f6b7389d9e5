// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pose errors: what is refused, conventions, changes of frame, and their conditional form.
#include "fcl_prob/pose_error.h"

#include <Eigen/Geometry>
#include <limits>
#include <random>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "gaussian/conditional_translation.h"
#include "gaussian/rotation.h"
#include "random_bodies.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Vector6 = PoseError::Vector6;
using Matrix6 = PoseError::Matrix6;

Matrix6 randomCovariance(RandomBodies& random, int rank) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> factor(6, rank);
  for (int i = 0; i < factor.size(); ++i) factor.data()[i] = 0.1 * random.normal();
  return factor * factor.transpose();
}

Vector6 randomError(RandomBodies& random) {
  Vector6 error;
  error << 0.3 * random.normalVector(), 0.5 * random.normalVector();
  return error;
}

void checkSame(const fcl::Transform3d& a, const fcl::Transform3d& b) {
  CHECK((a.matrix() - b.matrix()).cwiseAbs().maxCoeff() < 1e-13);
}

}  // namespace

TEST_CASE("the covariance of a ROS message is read row by row, about fixed axes of the world") {
  RandomBodies random(11);
  const Matrix6 covariance = randomCovariance(random, 6);
  std::array<double, 36> message;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) message[6 * row + column] = covariance(row, column);
  }
  const PoseError error = PoseError::fromRosCovariance(message);
  CHECK(error.covariance() == PoseError(covariance).covariance());
  CHECK(error.convention() == PoseConvention::world_rotation_vector);
  message[1] += 1.0;
  CHECK_THROWS_WITH(PoseError::fromRosCovariance(message), Catch::Contains("(x, y)"));
}

TEST_CASE("a pose error that is no distribution is refused by name") {
  const Matrix6 good = Matrix6::Identity() * 0.01;
  CHECK_NOTHROW(PoseError(good));
  CHECK_NOTHROW(PoseError(Matrix6::Zero()));

  Matrix6 bad = good;
  bad(1, 4) = 1e-4;
  CHECK_THROWS_AS(PoseError(bad), InvalidDistribution);
  CHECK_THROWS_WITH(PoseError(bad), Catch::Contains("(y, ry)") && Catch::Contains("symmetric"));

  bad = good;
  bad(2, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(PoseError(bad), Catch::Contains("(z, z)") && Catch::Contains("not finite"));

  bad = good;
  bad(0, 3) = bad(3, 0) = 0.02;
  CHECK_THROWS_WITH(PoseError(bad), Catch::Contains("negative eigenvalue"));

  bad = good;
  bad.row(5).setZero();
  bad.col(5).setZero();
  bad(5, 0) = bad(0, 5) = 1e-3;
  CHECK_THROWS_AS(PoseError(bad), InvalidDistribution);

  bad = Matrix6::Zero();
  bad(0, 4) = bad(4, 0) = 1e-3;
  CHECK_THROWS_WITH(PoseError(bad), Catch::Contains("does not vary"));

  bad = good;
  bad(4, 4) = 5.0 * 5.0;
  CHECK_THROWS_WITH(PoseError(bad), Catch::Contains("degrees") && Catch::Contains("5"));

  Vector6 mean = Vector6::Zero();
  mean[5] = 45.0;
  CHECK_THROWS_WITH(PoseError(good, PoseConvention::world_rotation_vector, mean),
                    Catch::Contains("45") && Catch::Contains("degrees"));
  mean[5] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(PoseError(good, PoseConvention::world_rotation_vector, mean),
                    Catch::Contains("not finite"));
  CHECK_THROWS_AS(PoseError::fromStandardDeviations({0.1, 0.1, 0.1}, {0.1, -0.1, 0.1}),
                  InvalidDistribution);
  CHECK_THROWS_AS(PoseError::fromStandardDeviations({-0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}),
                  InvalidDistribution);

  fcl::Transform3d sheared = fcl::Transform3d::Identity();
  sheared.linear()(0, 1) = 0.1;
  CHECK_THROWS_AS(PoseError(good).inWorldFrame(sheared), InvalidPose);
  CHECK_THROWS_AS(PoseError(good).transformed(sheared), InvalidPose);
}

TEST_CASE("covariances of every rank are taken, and the rank of the rotation is found") {
  RandomBodies random(1);
  for (int i = 0; i < 500; ++i) {
    const int rank = random.integer(0, 6);
    const PoseError error(randomCovariance(random, rank));
    CHECK(error.rotationRank() == std::min(rank, 3));
  }
  const auto one_axis = PoseError::fromStandardDeviations({0, 0, 0}, {0, 0.1, 0});
  CHECK(one_axis.rotationRank() == 1);
  CHECK(one_axis.translation().rank() == 0);
}

TEST_CASE("rotations and the Jacobian of SE(3) agree with the matrix exponential") {
  RandomBodies random(2);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d theta = random.logUniform(1e-9, 3.1) * random.direction();
    const Eigen::Matrix3d expected(Eigen::AngleAxisd(theta.norm(), theta.normalized()));
    CHECK((rotationOf(theta) - expected).cwiseAbs().maxCoeff() < 1e-14);
    // exp([ξ]) of the 4 x 4 matrix, by its series after halving.
    const Eigen::Vector3d t = random.normalVector();
    Eigen::Matrix4d generator = Eigen::Matrix4d::Zero();
    generator.topLeftCorner<3, 3>() = detail::crossMatrix(theta);
    generator.topRightCorner<3, 1>() = t;
    Eigen::Matrix4d term = Eigen::Matrix4d::Identity();
    Eigen::Matrix4d sum = term;
    for (int k = 1; k < 40; ++k) {
      term = (term * generator / k).eval();
      sum += term;
    }
    CHECK((detail::translationJacobian(theta) * t - sum.topRightCorner<3, 1>())
              .cwiseAbs()
              .maxCoeff() < 1e-13);
  }
}

TEST_CASE("an error means the same in the world's and in the body's frame") {
  RandomBodies random(3);
  for (int i = 0; i < 200; ++i) {
    const fcl::Transform3d pose(random.pose(2.0));
    const Vector6 mean = randomError(random);
    for (const auto convention :
         {PoseConvention::world_rotation_vector, PoseConvention::body_rotation_vector,
          PoseConvention::world_exponential, PoseConvention::body_exponential}) {
      const PoseError error(randomCovariance(random, 6), convention, mean);
      const fcl::Transform3d expected = displacedPose(pose, convention, mean);
      const PoseError same = error.inWorldFrame(pose);
      checkSame(displacedPose(pose, same.convention(), same.mean()), expected);
    }
  }
}

TEST_CASE("an exponential seen from another frame is the adjoint") {
  RandomBodies random(4);
  for (int i = 0; i < 200; ++i) {
    const fcl::Transform3d pose(random.pose(2.0));
    const fcl::Transform3d to_new(random.pose(2.0));
    const Vector6 mean = randomError(random);
    const PoseError error(Matrix6::Zero(), PoseConvention::world_exponential, mean);
    const PoseError seen = error.transformed(to_new);
    checkSame(displacedPose(to_new * pose, seen.convention(), seen.mean()),
              to_new * displacedPose(pose, error.convention(), mean));
  }
}

TEST_CASE("another reference point is right to first order") {
  RandomBodies random(5);
  for (int i = 0; i < 200; ++i) {
    const fcl::Transform3d pose(random.pose(2.0));
    const Eigen::Vector3d lever = random.normalVector();
    const Vector6 mean = 1e-5 * randomError(random);
    const PoseError about_origin(Matrix6::Zero(), PoseConvention::world_rotation_vector, mean);
    fcl::Transform3d shift = fcl::Transform3d::Identity();
    shift.translation() = -lever;
    // Of a frame carried along, `lever` away.
    fcl::Transform3d carried = pose;
    carried.translation() += lever;
    const PoseError about_lever = about_origin.transformed(shift);
    const fcl::Transform3d moved =
        displacedPose(pose, about_origin.convention(), mean) * pose.inverse() * carried;
    const fcl::Transform3d expected =
        displacedPose(carried, about_lever.convention(), about_lever.mean());
    CHECK((moved.matrix() - expected.matrix()).cwiseAbs().maxCoeff() < 1e-8);
  }
}

TEST_CASE("two bodies: the relative error has the covariance of the relative motion") {
  RandomBodies random(6);
  const fcl::Transform3d pose_a(random.pose(1.0));
  const fcl::Transform3d pose_b(random.pose(1.0));
  const PoseError of_a(1e-6 * randomCovariance(random, 6), PoseConvention::body_exponential);
  const PoseError of_b(1e-6 * randomCovariance(random, 6), PoseConvention::world_rotation_vector);
  const PoseError relative = PoseError::betweenBodies(of_a, pose_a, of_b, pose_b);
  // B stays, A moves by B's inverse motion after its own: differentiated numerically.
  const auto motion = [&](const PoseError& error, const fcl::Transform3d& pose, const Vector6& xi) {
    return displacedPose(pose, error.convention(), xi) * pose.inverse();
  };
  Eigen::Matrix<double, 6, 12> jacobian;
  const double step = 1e-6;
  for (int k = 0; k < 12; ++k) {
    Eigen::Matrix<double, 12, 1> xi = Eigen::Matrix<double, 12, 1>::Zero();
    xi[k] = step;
    const fcl::Transform3d moved =
        motion(of_b, pose_b, xi.tail<6>()).inverse() * motion(of_a, pose_a, xi.head<6>()) * pose_a;
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(moved.linear() * pose_a.linear().transpose()));
    jacobian.col(k) << (moved.translation() - pose_a.translation()) / step,
        turn.angle() * turn.axis() / step;
  }
  const Matrix6 expected =
      jacobian.leftCols<6>() * of_a.covariance() * jacobian.leftCols<6>().transpose() +
      jacobian.rightCols<6>() * of_b.covariance() * jacobian.rightCols<6>().transpose();
  CHECK((relative.covariance() - expected).cwiseAbs().maxCoeff() <
        1e-4 * expected.cwiseAbs().maxCoeff());
}

TEST_CASE("rotation and, given that, translation make up the covariance again") {
  RandomBodies random(7);
  for (int i = 0; i < 300; ++i) {
    const int rank = random.integer(1, 6);
    const PoseError error(randomCovariance(random, rank));
    const detail::ConditionalTranslation conditional(error);
    const auto& f = conditional.rotationFactor();
    const auto& c = conditional.slope();
    const GaussianDisplacement left = conditional.translation(Eigen::VectorXd::Zero(f.cols()));
    Matrix6 again;
    again << c * c.transpose() + left.covariance(), c * f.transpose(), f * c.transpose(),
        f * f.transpose();
    CAPTURE(rank);
    CHECK((again - error.covariance()).cwiseAbs().maxCoeff() <
          1e-10 * error.covariance().cwiseAbs().maxCoeff());
    CHECK(conditional.rank() == std::min(rank, 3));
    CHECK(left.rank() == std::max(0, rank - 3));
  }
}

TEST_CASE("an independent translation is kept to the last bit") {
  RandomBodies random(8);
  const auto translation = GaussianDisplacement::fromStandardDeviations(
      {0.3, 1e-9, 0.0}, random.quaternion(), {0.1, 0.2, 0.3});
  const auto error = PoseError::fromIndependent(translation, 0.01 * Eigen::Matrix3d::Identity());
  const detail::ConditionalTranslation conditional(error);
  const GaussianDisplacement left = conditional.translation(Eigen::Vector3d(0.3, -0.2, 1.0));
  CHECK(left.mean() == translation.mean());
  CHECK(left.standardDeviations() == translation.standardDeviations());
  CHECK(left.axes() == translation.axes());
}
