// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Errors of joints and base beside the obstacles' displacements, against counting.
#include <fcl/geometry/shape/sphere.h>

#include "arm_motions.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "fcl_prob/robot_scene.h"
#include "random_bodies.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

/// How often anything is touched in any of the states, where joints, base and obstacles are all
/// drawn, the same for each.
double countedWithErrors(const RobotQuery& query, const std::vector<Eigen::VectorXd>& states,
                         const Eigen::VectorXd& deviations, double base, int draws) {
  std::mt19937_64 random(17);
  std::normal_distribution<double> normal;
  const auto three = [&] {
    return Eigen::Vector3d(normal(random), normal(random), normal(random));
  };
  int hits = 0;
  for (int i = 0; i < draws; ++i) {
    Eigen::VectorXd error_of_joints = Eigen::VectorXd::Zero(deviations.size());
    for (Eigen::Index k = 0; k < deviations.size(); ++k) {
      error_of_joints[k] = deviations[k] * normal(random);
    }
    const Eigen::Vector3d shift = base * three();
    std::vector<fcl::Transform3d> placed;
    for (const Obstacle& obstacle : query.obstacles()) {
      const auto& error = std::get<GaussianDisplacement>(obstacle.displacement);
      placed.push_back(obstacle.pose);
      placed.back().translation() +=
          error.mean() + error.axes() * error.standardDeviations().cwiseProduct(three());
    }
    bool hit = false;
    for (const Eigen::VectorXd& values : states) {
      auto poses = query.robot().poses(values + error_of_joints);
      for (fcl::Transform3d& pose : poses) pose.translation() += shift;
      for (std::size_t j = 0; j < placed.size(); ++j) {
        hit = hit || touchesAt(query.robot(), poses, query.obstacles()[j], placed[j]);
      }
    }
    hits += hit;
  }
  return static_cast<double>(hits) / draws;
}

Eigen::VectorXd deviationsOf(const Eigen::MatrixXd& covariance) {
  return covariance.diagonal().cwiseSqrt();
}

}  // namespace

namespace {

/// The shipped arm beside one or two obstacles, with errors of joints and base.
struct ArmWithErrors {
  explicit ArmWithErrors(std::size_t obstacles) : query(shippedArm(), ballAndBox()) {
    std::vector<Obstacle> all = ballAndBox();
    all.resize(obstacles);
    query = query.withObstacles(all);
    errors.joints = jointCovariance(query.robot(), {{"turn", 0.08}, {"shoulder", 0.05}});
    errors.base = PoseError::fromStandardDeviations({0.03, 0.03, 0.03}, {0.0, 0.0, 0.0});
    request.absolute_tolerance = 1e-3;
  }

  Eigen::VectorXd turned(double turn) const {
    return query.robot().values({{"turn", turn}, {"shoulder", 0.15}, {"elbow", 0.3}});
  }

  /// Checks the estimate; the value that counting finds.
  double check(const std::vector<Eigen::VectorXd>& states, const RobotResult& result) const {
    constexpr int kDraws = 4'000;
    REQUIRE(result.estimate);
    REQUIRE(result.standard_error);
    const double truth =
        countedWithErrors(query, states, deviationsOf(errors.joints), 0.03, kDraws);
    const double of_truth = std::sqrt(truth * (1.0 - truth) / kDraws);
    CAPTURE(query.obstacles().size(), truth, *result.estimate, *result.standard_error, result.plan);
    CHECK(truth > 0.05);
    CHECK(truth < 0.95);
    CHECK(std::abs(*result.estimate - truth) <= 5.0 * std::hypot(of_truth, *result.standard_error));
    return truth;
  }

  RobotQuery query;
  RobotErrors errors;
  ProbabilityRequest request = withTolerance(0.02);
};

}  // namespace

TEST_CASE("errors of joints, base and obstacles together are what counting finds") {
  for (const std::size_t obstacles : {1, 2}) {
    const ArmWithErrors arm(obstacles);
    const Eigen::VectorXd values = arm.turned(0.6);
    const double truth = arm.check({values}, arm.query.state(values, arm.errors, arm.request));
    ProbabilityRequest decision;
    decision.threshold = 0.3 * truth;
    CHECK(arm.query.state(values, arm.errors, decision).decision == Decision::above);
    decision.threshold = std::min(0.99, 2.0 * truth);
    CHECK(arm.query.state(values, arm.errors, decision).decision == Decision::below);
  }
}

TEST_CASE("errors that are the same at all waypoints are what counting finds") {
  for (const std::size_t obstacles : {1, 2}) {
    const ArmWithErrors arm(obstacles);
    const std::vector<Eigen::VectorXd> states{arm.turned(0.2), arm.turned(0.5), arm.turned(1.1)};
    const RobotResult result = arm.query.motion(states, arm.errors, arm.request);
    arm.check(states, result);
    double worst = 0.0;
    for (const Eigen::VectorXd& values : states) {
      worst = std::max(worst, arm.query.state(values, arm.errors, arm.request).probability());
    }
    CHECK(*result.estimate > worst - 0.02);
    ProbabilityRequest interval = arm.request;
    interval.method = ProbabilityMethod::interval;
    CHECK_THROWS_AS(arm.query.motion(states, arm.errors, interval), InvalidRequest);
  }
}

TEST_CASE("errors of joints that slide add to those of an obstacle, at all waypoints together") {
  const fcl_prob_test::TemporaryFolder folder;
  const Robot cart(folder.write("cart.urdf", R"(<robot name="cart"><link name="base"/>
    <joint name="x" type="prismatic"><parent link="base"/><child link="slide"/><axis xyz="1 0 0"/>
      <limit lower="-9" upper="9" effort="1" velocity="1"/></joint><link name="slide"/>
    <joint name="y" type="prismatic"><parent link="slide"/><child link="ball"/><axis xyz="0 1 0"/>
      <limit lower="-9" upper="9" effort="1" velocity="1"/></joint>
    <link name="ball"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
    </robot>)"));
  const auto queryWith = [&](const Eigen::Vector3d& sigma) {
    Obstacle ball;
    ball.name = "ball";
    ball.geometry = std::make_shared<fcl::Sphered>(0.15);
    ball.displacement = GaussianDisplacement::fromStandardDeviations(sigma);
    return RobotQuery(cart, {ball});
  };
  std::vector<Eigen::VectorXd> states;
  for (const double x : {-0.3, 0.0, 0.2}) states.push_back(cart.values({{"x", x}, {"y", 0.33}}));
  RobotErrors errors;
  errors.joints = jointCovariance(cart, {{"x", 0.06}, {"y", 0.08}});
  const RobotResult result =
      queryWith({0.08, 0.06, 0.05}).motion(states, errors, withTolerance(0.005));
  const Bounds truth = queryWith({0.1, 0.1, 0.05})
                           .motion(states, ErrorsOverTime::persistent, withTolerance(1e-4))
                           .any;
  CAPTURE(*result.estimate, *result.standard_error, truth.lower, truth.upper);
  CHECK(truth.lower > 0.1);
  CHECK(std::abs(*result.estimate - truth.middle()) <= 4.0 * *result.standard_error + 1e-4);
}

TEST_CASE("certified intervals over errors of a robot hold what counting finds") {
  constexpr int kDraws = 1'000;
  RandomBodies random(5);
  int narrow = 0;
  for (int i = 0; i < 40; ++i) {
    std::vector<Obstacle> all = ballAndBox();
    all.resize(1 + static_cast<std::size_t>(i % 2));
    const RobotQuery query(shippedArm(), all);
    const Eigen::VectorXd values = query.robot().values({{"turn", random.uniform(-0.5, 1.2)},
                                                         {"shoulder", random.uniform(-0.3, 0.4)},
                                                         {"elbow", random.uniform(0.0, 0.6)}});
    RobotErrors errors;
    const double small = random.logUniform(0.0005, 0.02);
    errors.joints = jointCovariance(query.robot(), {{"turn", small}, {"shoulder", 0.5 * small}});
    const double of_base = i % 4 < 2 ? 0.0 : random.logUniform(0.0005, 0.01);
    if (of_base > 0.0) {
      errors.base = PoseError::fromStandardDeviations(Eigen::Vector3d::Constant(of_base),
                                                      Eigen::Vector3d::Zero());
    }
    ProbabilityRequest request = withTolerance(0.05);
    request.method = ProbabilityMethod::interval;
    const RobotResult result = query.state(values, errors, request);
    const double truth =
        countedWithErrors(query, {values}, deviationsOf(errors.joints), of_base, kDraws);
    CAPTURE(i, small, of_base, truth, result.any.lower, result.any.upper, result.plan);
    const auto slack = [](double p) { return 5.0 * std::sqrt(p * (1.0 - p) / kDraws) + 1e-9; };
    CHECK_FALSE(result.estimate);
    CHECK(truth <= result.any.upper + slack(result.any.upper));
    CHECK(truth >= result.any.lower - slack(result.any.lower));
    narrow += result.any.width() < 0.3;
  }
  CHECK(narrow > 15);
}

// Beside a wall the errors of a joint that slides and of the wall add up: P in closed form.
TEST_CASE("half-spaces know errors of the robot as they are") {
  const fcl_prob_test::TemporaryFolder folder;
  const Robot slide(folder.write("slide.urdf", R"(<robot name="slide"><link name="base"/>
    <joint name="x" type="prismatic"><parent link="base"/><child link="box"/><axis xyz="1 0 0"/>
      <limit lower="-9" upper="9" effort="1" velocity="1"/></joint>
    <link name="box"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
    </robot>)"));
  Obstacle wall;
  wall.name = "wall";
  wall.geometry = std::make_shared<fcl::Boxd>(2.0, 20.0, 20.0);
  wall.pose.translation().x() = 1.0;
  wall.displacement = GaussianDisplacement::fromStandardDeviations({0.04, 0.04, 0.04});
  const RobotQuery query(slide, {wall});
  RobotErrors errors;
  errors.joints = jointCovariance(slide, {{"x", 0.03}});
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  for (const double deviations : {1.0, 2.0, 3.0}) {
    const Eigen::VectorXd values = Eigen::VectorXd::Constant(1, -0.1 - 0.05 * deviations);
    const double truth = normalTailMass(deviations);
    request.threshold = 1.2 * truth;
    const RobotResult result = query.state(values, errors, request);
    CHECK(result.decision == Decision::below);
    CHECK(result.any.upper >= truth);
    CHECK(result.any.upper <= 1.02 * truth);
  }
  // Of two bodies behind one wall the errors count once, of two walls twice.
  errors.base = PoseError::fromStandardDeviations({0.12, 0.0, 0.0}, {0.0, 0.0, 0.0});
  request.threshold = 0.03;
  const double both = std::hypot(0.05, 0.12);
  const Eigen::VectorXd values = Eigen::VectorXd::Constant(1, -0.1 - 2.0 * both);
  const double upper = query.state(values, errors, request).any.upper;
  CHECK(upper >= normalTailMass(2.0));
  CHECK(upper <= 1.02 * normalTailMass(2.0));
}

TEST_CASE("turns of the base move what is far from it") {
  const RobotQuery query(shippedArm(), {ballAndBox()[0]});
  const Eigen::VectorXd values = query.robot().values({{"turn", 0.6}, {"elbow", 0.3}});
  ProbabilityRequest request = withTolerance(0.02);
  request.method = ProbabilityMethod::interval;
  const Bounds exact = query.state(values, request).any;
  double before = exact.width();
  for (const double turn : {0.001, 0.01, 0.1}) {
    for (const PoseConvention convention :
         {PoseConvention::world_rotation_vector, PoseConvention::world_exponential}) {
      RobotErrors errors;
      errors.base =
          PoseError::fromStandardDeviations({0.0, 0.0, 0.0}, {0.0, 0.0, turn}, convention);
      const Bounds any = query.state(values, errors, request).any;
      CHECK(overlap(any, exact));
      CHECK(any.width() >= before);
    }
    before = std::min(0.99, before * 1.2);
  }
}

TEST_CASE("an interval over errors of a robot decides what is far from the threshold") {
  const RobotQuery query(shippedArm(), {ballAndBox()[0]});
  RobotErrors errors;
  errors.joints = jointCovariance(query.robot(), {{"turn", 0.002}, {"elbow", 0.002}});
  ProbabilityRequest request;
  request.method = ProbabilityMethod::interval;
  request.threshold = 0.9;
  const Eigen::VectorXd values = query.robot().values({{"turn", 0.6}, {"elbow", 0.3}});
  CHECK(query.state(values, errors, request).decision == Decision::below);
  request.threshold = 1e-3;
  CHECK(query.state(values, errors, request).decision == Decision::above);
  request.on_progress = [](const ProbabilityProgress&) { return false; };
  request.threshold = query.state(values, {}).any.middle();
  CHECK(query.state(values, errors, request).status == ProbabilityStatus::cancelled);
}

TEST_CASE("many states are decided with errors of the robot, as counting has them") {
  constexpr int kDraws = 1'000;
  const RobotQuery query(shippedArm(), ballAndBox());
  RobotErrors errors;
  errors.joints = jointCovariance(query.robot(), {{"turn", 0.01}, {"shoulder", 0.005}});
  Eigen::MatrixXd states(query.robot().joints().size(), 24);
  for (Eigen::Index i = 0; i < states.cols(); ++i) {
    const double at = static_cast<double>(i);
    states.col(i) = query.robot().values({{"turn", -0.8 + 0.1 * at}, {"elbow", 0.02 * at}});
  }
  ProbabilityRequest request;
  request.threshold = 0.2;
  request.threads = 2;
  const auto certain = query.decideStates(states, errors, request);
  const auto probable = query.decideStates(states, errors, request, 1e-4);
  std::map<ProbableDecision, int> found;
  for (Eigen::Index i = 0; i < states.cols(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double truth =
        countedWithErrors(query, {states.col(i)}, deviationsOf(errors.joints), 0.0, kDraws);
    const double slack = 5.0 * std::sqrt(truth * (1.0 - truth) / kDraws) + 5.0 / kDraws;
    CAPTURE(i, truth);
    if (certain[k] == ProbableDecision::certainly_below) CHECK(truth - slack < 0.2);
    if (certain[k] == ProbableDecision::certainly_above) CHECK(truth + slack > 0.2);
    if (probable[k] == ProbableDecision::probably_below) CHECK(truth - slack < 0.2);
    if (probable[k] == ProbableDecision::probably_above) CHECK(truth + slack > 0.2);
    ++found[probable[k]];
  }
  CHECK(found[ProbableDecision::certainly_below] > 3);
  CHECK(found[ProbableDecision::probably_above] > 3);
  CHECK(found[ProbableDecision::undecided] == 0);
  errors.joints = Eigen::MatrixXd::Identity(2, 2);
  CHECK_THROWS_AS(query.decideStates(states, errors, request), InvalidDistribution);
}

TEST_CASE("a robot whose errors are none is where it is said to be") {
  const RobotQuery query(shippedArm(), {ballAndBox()[0]});
  const Eigen::VectorXd values = query.robot().values({{"turn", 0.35}, {"elbow", 0.3}});
  RobotErrors errors;
  errors.joints = jointCovariance(query.robot(), {});
  const RobotResult exact = query.state(values, withTolerance(0.02));
  const RobotResult same = query.state(values, errors, withTolerance(0.02));
  CHECK(overlap(same.any, exact.any));
  CHECK(same.any.width() <= 0.02 * same.any.upper + 1e-6);
}

TEST_CASE("errors of a robot that cannot be meant are refused") {
  const RobotQuery query(shippedArm(), ballAndBox());
  const Eigen::VectorXd values = query.robot().values({});
  CHECK_THROWS_AS(jointCovariance(query.robot(), {{"elbwo", 0.1}}), InvalidRequest);
  CHECK_THROWS_AS(jointCovariance(query.robot(), {{"elbow", -0.1}}), InvalidDistribution);
  RobotErrors errors;
  errors.joints = Eigen::MatrixXd::Identity(2, 2);
  CHECK_THROWS_AS(query.state(values, errors, {}), InvalidDistribution);
  errors.joints = jointCovariance(query.robot(), {{"elbow", 0.1}});
  const std::string base = query.robot().bodies()[0].name();
  const RobotQuery partly(shippedArm(), ballAndBox(), {{base, "box"}});
  CHECK_THROWS_AS(partly.state(values, errors, {}), UnsupportedGeometry);
  std::vector<Obstacle> moving = ballAndBox();
  moving[0].over_time = {{moving[0].pose, moving[0].displacement}};
  CHECK_THROWS_AS(query.withObstacles(moving).state(values, errors, {}), InvalidRequest);
}

TEST_CASE("with errors a threshold is decided even where every contact is allowed") {
  const RobotQuery query(shippedArm(), ballAndBox(), {{"*", "*"}});
  RobotErrors errors;
  errors.joints = jointCovariance(query.robot(), {{"elbow", 0.1}});
  ProbabilityRequest decision;
  decision.threshold = 0.05;
  const RobotResult result = query.state(query.robot().values({}), errors, decision);
  CHECK(result.any.upper == 0.0);
  CHECK(result.decision == Decision::below);
}

TEST_CASE("scenes have errors of joints and base") {
  const TemporaryFolder folder;
  const auto sceneWith = [&](const std::string& errors, const std::string& states) {
    return loadRobotScene(
        folder.write("scene.json", R"({"robot": {"urdf": ")" + shippedFile("arm.urdf") + R"("}, )" +
                                       errors + ", " + states +
                                       R"(, "obstacles": [{"name": "o", "sphere": 1,)"
                                       R"( "displacement": {"sigma": [1, 1, 1]}}]})"));
  };
  const std::string one = R"("joints": {})";
  const Robot robot = shippedArm();
  const RobotErrors sigma =
      errorsOf(sceneWith(R"("joint_error": {"sigma": {"elbow": 0.1}})", one), robot);
  CHECK(sigma.joints.trace() == Approx(0.01));
  CHECK(!sigma.base);
  const RobotErrors both = errorsOf(
      sceneWith(R"("joint_error": {"joints": ["elbow", "turn"], "covariance": [0.04, 0.01, 0.09]},)"
                R"( "base_error": {"sigma": [0.1, 0.1, 0, 0, 0, 0.02]})",
                one),
      robot);
  CHECK(both.joints.trace() == Approx(0.13));
  CHECK(both.joints.sum() == Approx(0.15));
  CHECK(both.base);
  CHECK(
      errorsOf(sceneWith(R"("joint_error": {"sigma": {"elbow": 0.1}})", R"("waypoints": [{}, {}])"),
               robot)
          .joints.trace() == Approx(0.01));
  CHECK_THROWS_AS(sceneWith(R"("joint_error": {"joints": ["elbow"], "covariance": [1, 2]})", one),
                  FileError);
  const std::string twice =
      R"("joint_error": {"joints": ["elbow", "elbow"], "covariance": [0.04, 0.01, 0.09]})";
  CHECK_THROWS_AS(errorsOf(sceneWith(twice, one), robot), InvalidRequest);
  CHECK_THROWS_AS(errorsOf(sceneWith(R"("joint_error": {"sigma": {"elbwo": 0.1}})", one), robot),
                  InvalidRequest);
  CHECK_THROWS_AS(requireExactRobot(sceneWith(R"("joint_error": {"sigma": {}})", one), "it"),
                  InvalidRequest);
}
