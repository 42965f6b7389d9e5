// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Gradients for joints against central differences of certified answers.
#include "arm_motions.h"
#include "fcl_prob/exceptions.h"
#include "mesh_shapes.h"
#include "robot/gradient_parts.h"
#include "robot/obstacle_gradient.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Waypoints = std::vector<Eigen::VectorXd>;

double certified(const RobotQuery& query, const Waypoints& waypoints, double tolerance = 1e-4) {
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  request.relative_tolerance = 0.0;
  request.absolute_tolerance = tolerance;
  return query.motion(waypoints, ErrorsOverTime::persistent, request).any.middle();
}

/// Of the waypoints from `first` on.
void checkDifferences(const RobotQuery& query, const Waypoints& waypoints, double step,
                      Eigen::Index first = 0) {
  MotionGradientRequest request;
  request.lines = 20'000;
  const JointGradient found = query.gradient(waypoints, request);
  const double p = certified(query, waypoints);
  CAPTURE(found.probability, found.standard_error, p);
  CHECK(std::fabs(found.probability - p) < 5.0 * found.standard_error + 1e-4);
  CHECK(p > 0.01);
  const double largest = found.gradient.cwiseAbs().maxCoeff();
  CHECK(largest > 0.1);
  for (Eigen::Index k = first; k < found.gradient.cols(); ++k) {
    for (Eigen::Index joint = 0; joint < found.gradient.rows(); ++joint) {
      Waypoints before = waypoints;
      Waypoints behind = waypoints;
      before[static_cast<std::size_t>(k)][joint] -= step;
      behind[static_cast<std::size_t>(k)][joint] += step;
      const double slope = (certified(query, behind) - certified(query, before)) / (2.0 * step);
      CAPTURE(k, joint, slope, found.gradient(joint, k), found.gradient_standard_error(joint, k));
      CHECK(std::fabs(found.gradient(joint, k) - slope) <
            5.0 * found.gradient_standard_error(joint, k) + 1e-4 / step + 0.02 * largest);
    }
  }
}

Eigen::VectorXd near(const Robot& arm, double turn) {
  return arm.values(
      {{"turn", turn}, {"shoulder", 0.25}, {"elbow", 0.2}, {"roll", 0.4}, {"grip", 0.02}});
}

}  // namespace

TEST_CASE("joint gradients of a state and of waypoints agree with central differences", "[slow]") {
  const Robot arm = shippedArm();
  const RobotQuery query(arm, ballAndBox());
  checkDifferences(query, {near(arm, 0.6)}, 5e-3);
  checkDifferences(query, {near(arm, 0.8), near(arm, -0.25)}, 5e-3);
}

TEST_CASE("joint gradients with a mixture, an obstacle that moves and one that is certain") {
  const Robot arm = shippedArm();
  std::vector<Obstacle> obstacles = ballAndBox();
  obstacles[0].displacement = GaussianMixture(
      {{0.3, sigma(0.03, 0.02, 0.04)}, {0.7, sigma(0.02, 0.03, 0.02).withMean({0.05, 0.0, 0.02})}});
  obstacles[1].over_time = {{at(0.5, -0.45, 0.2), sigma(0.02, 0.05, 0.01)},
                            {at(0.45, -0.35, 0.22), sigma(0.02, 0.05, 0.01)}};
  obstacles.push_back(
      {"far", std::make_shared<fcl::Boxd>(0.1, 0.1, 0.1), at(5.0, 0.0, 0.0), sigma(0, 0, 0)});
  const RobotQuery query(arm, obstacles);
  checkDifferences(query, {near(arm, 0.5), near(arm, -0.4)}, 5e-3, 1);
}

TEST_CASE("joint gradients of a robot far from everything are zero") {
  const Robot arm = shippedArm();
  std::vector<Obstacle> obstacles = ballAndBox();
  for (Obstacle& obstacle : obstacles) obstacle.pose.translation().x() += 10.0;
  const RobotQuery query(arm, obstacles);
  const JointGradient found = query.gradient({near(arm, 0.3), near(arm, 0.2)});
  CHECK(found.probability == 0.0);
  CHECK(found.lines == 0);
  CHECK(found.gradient.rows() == static_cast<Eigen::Index>(arm.joints().size()));
  CHECK(found.gradient.cols() == 2);
  CHECK(found.gradient.isZero(0.0));
}

TEST_CASE("joint gradients of several obstacles are told of as one, and cancelled as one") {
  const Robot arm = shippedArm();
  std::vector<Obstacle> obstacles = ballAndBox();
  obstacles[0].displacement = GaussianMixture(
      {{0.3, sigma(0.03, 0.02, 0.04)}, {0.7, sigma(0.02, 0.03, 0.02).withMean({0.05, 0.0, 0.02})}});
  const RobotQuery query(arm, obstacles);
  const Waypoints waypoints{near(arm, 0.5), near(arm, -0.4)};
  MotionGradientRequest request;
  request.lines = 500;
  const JointGradient whole = query.gradient(waypoints, request);
  CHECK(whole.lines == 1500);
  CHECK(whole.status == ProbabilityStatus::sampled);

  std::vector<double> fractions;
  request.on_progress = [&](const ProbabilityProgress& progress) {
    CHECK(progress.fraction > (fractions.empty() ? 0.0 : fractions.back()));
    fractions.push_back(progress.fraction);
    return true;
  };
  const JointGradient told = query.gradient(waypoints, request);
  CHECK(told.gradient == whole.gradient);
  CHECK(told.gradient_standard_error == whole.gradient_standard_error);
  CHECK(told.probability == whole.probability);
  REQUIRE(fractions.size() > 3);
  CHECK(fractions.back() < 1.0);

  std::size_t lines = 0;
  for (std::size_t last = 1; last <= fractions.size(); ++last) {
    std::size_t calls = 0;
    request.on_progress = [&](const ProbabilityProgress&) { return ++calls < last; };
    const JointGradient cancelled = query.gradient(waypoints, request);
    CAPTURE(last);
    CHECK(calls == last);
    CHECK(cancelled.status == ProbabilityStatus::cancelled);
    CHECK(cancelled.lines > lines);
    CHECK(cancelled.lines < whole.lines);
    lines = cancelled.lines;
    // What is not reached any more takes part, known badly.
    CHECK(cancelled.standard_error > 0.0);
    CHECK(std::fabs(cancelled.probability - whole.probability) <
          6.0 * std::hypot(cancelled.standard_error, whole.standard_error));
  }
}

TEST_CASE("parts of a gradient share its time, and leave to others what they do not use") {
  fcl_prob::MotionGradientRequest whole;
  fcl_prob::detail::GradientParts unlimited(whole, 4);
  CHECK_FALSE(unlimited.requestOf(0).time_limit);
  whole.time_limit = 1000.0;
  fcl_prob::detail::GradientParts parts(whole, 4);
  CHECK(*parts.requestOf(0).time_limit <= 250.0);
  CHECK(*parts.requestOf(2).time_limit > 300.0);
  CHECK(*parts.requestOf(3).time_limit > 600.0);
  CHECK(*parts.requestOf(3).time_limit <= 1000.0);
  whole.time_limit = 1e-12;
  fcl_prob::detail::GradientParts none(whole, 2);
  CHECK(*none.requestOf(1).time_limit > 0.0);
}

TEST_CASE("joint gradients of few lines are within their errors, whatever the seed", "[slow]") {
  const Robot arm = shippedArm();
  const RobotQuery query(arm, ballAndBox());
  const Waypoints waypoints{near(arm, 0.75), near(arm, -0.3)};
  const double step = 5e-3, tolerance = 2e-5;
  const auto moved = [&](Eigen::Index joint, Eigen::Index k, double by) {
    Waypoints changed = waypoints;
    changed[static_cast<std::size_t>(k)][joint] += by;
    return certified(query, changed, tolerance);
  };
  const auto joints = static_cast<Eigen::Index>(arm.joints().size());
  Eigen::MatrixXd slopes(joints, 2);
  for (Eigen::Index k = 0; k < 2; ++k) {
    for (Eigen::Index joint = 0; joint < joints; ++joint) {
      slopes(joint, k) = (moved(joint, k, step) - moved(joint, k, -step)) / (2.0 * step);
    }
  }
  for (const std::size_t lines : {64, 1024}) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      MotionGradientRequest request;
      request.lines = lines;
      request.seed = seed;
      const JointGradient found = query.gradient(waypoints, request);
      const Eigen::ArrayXXd off = (found.gradient - slopes).array().abs() - tolerance / step -
                                  0.01 * slopes.array().abs().maxCoeff();
      CAPTURE(lines, seed, found.gradient, found.gradient_standard_error, slopes);
      CHECK((off < 6.0 * found.gradient_standard_error.array()).all());
    }
  }
}

TEST_CASE("components of a mixture that are alike are not off together") {
  const Robot arm = shippedArm();
  std::vector<Obstacle> obstacles = ballAndBox();
  obstacles.resize(1);
  const auto displacement = sigma(0.03, 0.02, 0.04);
  const auto gradientOf = [&](std::size_t lines) {
    MotionGradientRequest request;
    request.lines = lines;
    return RobotQuery(arm, obstacles).gradient({near(arm, 0.5)}, request);
  };
  const JointGradient one = gradientOf(1000);
  obstacles[0].displacement =
      GaussianMixture({{0.25, displacement}, {0.25, displacement}, {0.5, displacement}});
  const JointGradient several = gradientOf(1000);
  CHECK(several.lines == 3000);
  CHECK(several.probability != Approx(one.probability).epsilon(1e-9));
  CHECK(several.standard_error < 0.9 * one.standard_error);
  CHECK(std::fabs(several.probability - one.probability) <
        6.0 * std::hypot(several.standard_error, one.standard_error));
}

TEST_CASE("what P of other obstacles is off by is in the error of a gradient") {
  MotionGradient known, seldom;
  known.probability = 0.5;
  known.gradient = Eigen::VectorXd::Constant(1, 2.0);
  known.gradient_standard_error = Eigen::VectorXd::Zero(1);
  seldom.probability = 0.2;
  seldom.standard_error = 0.1;
  seldom.gradient = seldom.gradient_standard_error = Eigen::VectorXd::Zero(1);
  const JointGradient both = detail::anyOfGradients({known, seldom}, 1, 1);
  CHECK(both.probability == Approx(0.6));
  CHECK(both.standard_error == Approx(0.05));
  CHECK(both.gradient(0, 0) == Approx(1.6));
  CHECK(both.gradient_standard_error(0, 0) == Approx(0.2));
  // Where the others touch surely as far as is known, they may yet not.
  known.gradient_standard_error[0] = 1.0;
  seldom.probability = 1.0;
  CHECK(detail::anyOfGradients({known, seldom}, 1, 1).gradient_standard_error(0, 0) > 0.2);
  // What is not known of one is not known of all.
  seldom.gradient_standard_error[0] = std::numeric_limits<double>::infinity();
  CHECK(std::isinf(detail::anyOfGradients({known, seldom}, 1, 1).gradient_standard_error(0, 0)));
}

TEST_CASE("joint gradients refuse what has none") {
  const Robot arm = shippedArm();
  std::vector<Obstacle> obstacles = ballAndBox();
  const Eigen::VectorXd values = near(arm, 0.35);
  MotionGradientRequest none;
  none.lines = 0;
  CHECK_THROWS_AS(RobotQuery(arm, obstacles).gradient({values}, none), InvalidRequest);
  CHECK_THROWS_AS(RobotQuery(arm, obstacles).gradient({}), InvalidRequest);
  CHECK_THROWS_AS(RobotQuery(arm, obstacles).gradient({Eigen::VectorXd(values.head(2))}),
                  InvalidRequest);
  obstacles[0].displacement = TruncatedGaussian(sigma(0.03, 0.02, 0.04), 3.0);
  CHECK_THROWS_AS(RobotQuery(arm, obstacles).gradient({values}), InvalidRequest);
}
