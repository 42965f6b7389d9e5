// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// States and motions of a robot against fcl::collide on displaced obstacles.
#include "fcl_prob/robot_query.h"

#include <functional>

#include "arm_motions.h"
#include "catch.h"
#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/robot_scene.h"
#include "mesh_shapes.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

TEST_CASE("without errors a state is what fcl::collide says of it") {
  const Robot arm = shippedArm();
  std::vector<Obstacle> obstacles = ballAndBox();
  for (Obstacle& obstacle : obstacles) obstacle.displacement = GaussianDisplacement();
  const RobotQuery query(arm, obstacles);
  std::mt19937_64 random(3);
  int touching = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXd values = randomValues(arm, random);
    const bool truth = touches(arm, values, obstacles[0], Eigen::Vector3d::Zero()) ||
                       touches(arm, values, obstacles[1], Eigen::Vector3d::Zero());
    const RobotResult result = query.state(values, withTolerance(0.01));
    CAPTURE(i, values.transpose());
    CHECK(result.any.middle() == Approx(truth ? 1.0 : 0.0).margin(1e-12));
    CHECK(result.any.width() < 1e-12);
    touching += truth;
  }
  CHECK(touching > 3);
  CHECK(touching < 100);
}

TEST_CASE("a state holds what counting finds; an estimate agrees") {
  const RobotQuery query(shippedArm(), ballAndBox());
  constexpr int kDraws = 2'000;
  for (const double turn : {0.6, 0.35, -0.5, -0.9}) {
    const Eigen::VectorXd values =
        query.robot().values({{"turn", turn}, {"shoulder", 0.15}, {"elbow", 0.3}});
    const RobotResult result = query.state(values, withTolerance(0.02));
    CHECK(result.status == ProbabilityStatus::converged);
    CHECK(result.any.width() <= std::max(1e-6, 0.02 * result.any.upper));
    checkCounted(result.any, counted(query, {values}, kDraws, 11), kDraws);
    ProbabilityRequest estimate = withTolerance(0.01);
    estimate.method = ProbabilityMethod::estimate;
    const RobotResult sampled = query.state(values, estimate);
    REQUIRE(sampled.estimate);
    CHECK(overlap(sampled.any, result.any));
    CHECK(*sampled.estimate >= result.any.lower - 5.0 * *sampled.standard_error);
    CHECK(*sampled.estimate <= result.any.upper + 5.0 * *sampled.standard_error);
  }
}

TEST_CASE("a motion with persistent errors is the union over its waypoints") {
  const RobotQuery query(shippedArm(), ballAndBox());
  const auto waypoints = sweep(query.robot(), 12);
  const ProbabilityRequest request = withTolerance(0.05);
  const RobotResult motion = query.motion(waypoints, ErrorsOverTime::persistent, request);
  CHECK(motion.status == ProbabilityStatus::converged);
  CHECK(motion.far_bodies > 0);
  CHECK(motion.far_upper <= 1e-6);
  double worst = 0.0, sum = 0.0;
  std::vector<Bounds> states;
  for (const auto& values : waypoints) {
    states.push_back(query.state(values, request).any);
    worst = std::max(worst, states.back().lower);
    sum += states.back().upper;
  }
  CHECK(motion.any.upper >= worst);
  CHECK(motion.any.lower <= sum);
  constexpr int kDraws = 1'000;
  checkCounted(motion.any, counted(query, waypoints, kDraws, 12), kDraws);

  const RobotResult independent = query.motion(waypoints, ErrorsOverTime::independent, request);
  CHECK(overlap(independent.any, anyOfIndependent(states)));
  CHECK(independent.any.upper >= motion.any.lower);
  CHECK(independent.parts.size() == 24);
}

TEST_CASE("bodies by themselves add up to no less than the motion") {
  const RobotQuery query(shippedArm(), ballAndBox());
  const auto waypoints = sweep(query.robot(), 5);
  const ProbabilityRequest request = withTolerance(0.05);
  const RobotResult all = query.motion(waypoints, ErrorsOverTime::persistent, request);
  const auto bodies = query.byBody(waypoints, request);
  REQUIRE(bodies.size() == query.robot().bodies().size());
  double sum = 0.0, largest = 0.0;
  for (const RobotResult& body : bodies) {
    sum += body.any.upper;
    largest = std::max(largest, body.any.lower);
  }
  CHECK(sum >= all.any.lower);
  CHECK(largest <= all.any.upper);
}

TEST_CASE("thresholds of a robot are decided as its probability says, with less work") {
  const RobotQuery query(shippedArm(), ballAndBox());
  std::mt19937_64 random(8);
  int above = 0, below = 0;
  for (int i = 0; i < 40; ++i) {
    const Eigen::VectorXd values = randomValues(query.robot(), random);
    ProbabilityRequest request = withTolerance(0.02);
    const Bounds truth = query.state(values, request).any;
    request.threshold = 0.05;
    const RobotResult decided = query.state(values, request);
    if (decided.decision == Decision::above) CHECK(truth.upper >= 0.05);
    if (decided.decision == Decision::below) CHECK(truth.lower <= 0.05);
    above += decided.decision == Decision::above;
    below += decided.decision == Decision::below;
    CHECK(decided.decision != Decision::undecided);
  }
  CHECK(above > 0);
  CHECK(below > 0);
}

TEST_CASE("decisions close to a threshold are right, by bounds and by cells") {
  std::vector<Obstacle> one = ballAndBox();
  one.pop_back();
  one[0].displacement = sigma(0.1, 0.08, 0.12);
  const RobotQuery query(shippedArm(), one);
  std::mt19937_64 random(9);
  int by_half_spaces = 0, by_cells = 0, close = 0;
  for (int i = 0; i < 60; ++i) {
    const Eigen::VectorXd values = randomValues(query.robot(), random);
    const Bounds truth = query.state(values, withTolerance(0.02)).any;
    if (truth.lower < 1e-3 || truth.upper > 0.03 || close > 12) continue;
    // Close to it and far away.
    for (const double factor : {0.97, 1.03, 30.0}) {
      ProbabilityRequest request = withTolerance(1e-3);
      request.threshold = factor * truth.middle();
      const RobotResult decided = query.state(values, request);
      CAPTURE(i, factor, truth.lower, truth.upper, decided.any.lower, decided.any.upper);
      CHECK(decided.any.lower <= truth.upper);
      CHECK(decided.any.upper >= truth.lower);
      if (decided.decision == Decision::below) CHECK(truth.lower < *request.threshold);
      if (decided.decision == Decision::above) CHECK(truth.upper > *request.threshold);
      CHECK(decided.decision != Decision::undecided);
      for (const std::string& note : decided.parts[0].plan) {
        by_half_spaces += note.find("by half-spaces between the bodies") != std::string::npos;
        by_cells += note.find("partition of the displacement space") != std::string::npos;
      }
      ++close;
    }
  }
  CHECK(by_half_spaces > 2);
  CHECK(by_cells > 2);
  CHECK(close > 10);
}

TEST_CASE("open meshes are refused as solids wherever they are") {
  TriangleMesh open = boxMesh({0.1, 0.1, 0.1});
  open.triangles.pop_back();
  const Obstacle far{"open", makeModel<fcl::OBBRSSd>(open), at(50.0, 0.0, 0.0),
                     sigma(0.1, 0.1, 0.1)};
  const Robot arm = shippedArm();
  ProbabilityRequest request = withTolerance(0.01);
  CHECK(RobotQuery(arm, {far}).state(arm.values({}), request).any.upper < 1e-6);
  request.contact = ContactMeaning::solid;
  CHECK_THROWS_AS(RobotQuery(arm, {far}).state(arm.values({}), request), OpenMesh);
}

TEST_CASE("obstacles may follow mixtures and truncated Gaussians") {
  std::vector<Obstacle> obstacles = ballAndBox();
  const GaussianDisplacement gaussian = std::get<GaussianDisplacement>(obstacles[0].displacement);
  obstacles.pop_back();
  const Robot arm = shippedArm();
  const Eigen::VectorXd values = arm.values({{"turn", 0.45}, {"shoulder", 0.1}, {"elbow", 0.35}});
  const Bounds plain = RobotQuery(arm, obstacles).state(values, withTolerance(0.01)).any;
  REQUIRE(plain.lower > 1e-4);
  obstacles[0].displacement = GaussianMixture({{0.25, gaussian}, {0.75, gaussian}});
  CHECK(overlap(RobotQuery(arm, obstacles).state(values, withTolerance(0.01)).any, plain));
  obstacles[0].displacement = TruncatedGaussian(gaussian, 9.0);
  CHECK(overlap(RobotQuery(arm, obstacles).state(values, withTolerance(0.01)).any, plain));
  // A mean moves the obstacle, not the robot.
  obstacles[0].displacement = gaussian.withMean(Eigen::Vector3d(0.02, -0.03, 0.01));
  const Bounds shifted = RobotQuery(arm, obstacles).state(values, withTolerance(0.01)).any;
  obstacles[0].displacement = gaussian;
  obstacles[0].pose.translation() += Eigen::Vector3d(0.02, -0.03, 0.01);
  CHECK(overlap(RobotQuery(arm, obstacles).state(values, withTolerance(0.01)).any, shifted));
}

TEST_CASE("what is far is left out, and its bound is kept") {
  std::vector<Obstacle> obstacles{
      {"ball", std::make_shared<fcl::Sphered>(0.1), at(2.0, 0, 0), sigma(0.1, 0.1, 0.1)}};
  const Robot arm = shippedArm();
  const RobotResult far = RobotQuery(arm, obstacles).state(arm.values({}), withTolerance(0.01));
  CHECK(far.far_bodies == arm.bodies().size());
  CHECK(far.any.lower == 0.0);
  CHECK(far.any.upper == far.far_upper);
  CHECK(far.any.upper < 1e-6);
  // No double is as small as P at 100 deviations, but it is not 0.
  obstacles[0].displacement = sigma(0.01, 0.01, 0.01);
  CHECK(RobotQuery(arm, obstacles).state(arm.values({}), withTolerance(0.01)).any.upper > 0.0);
  obstacles[0].displacement = sigma(0.1, 0.1, 0.1);
  ProbabilityRequest strict = withTolerance(0.5);
  strict.absolute_tolerance = 0.0;
  const RobotResult near = RobotQuery(arm, obstacles).state(arm.values({}), strict);
  CHECK(near.far_bodies == 0);
  CHECK(near.any.lower > 0.0);
  CHECK(near.any.upper <= far.any.upper);
}

TEST_CASE("motions are interpolated in steps that are short enough") {
  const Eigen::VectorXd a = Eigen::Vector2d(0.0, 1.0), b = Eigen::Vector2d(1.0, 0.75);
  const auto path = interpolated({a, b, b}, 0.3);
  REQUIRE(path.size() == 6);
  for (std::size_t i = 1; i < path.size(); ++i) {
    CHECK((path[i] - path[i - 1]).cwiseAbs().maxCoeff() <= 0.3);
  }
  CHECK(path.front() == a);
  CHECK(path.back() == b);
  CHECK_THROWS_AS(interpolated({a, b}, 0.0), InvalidRequest);
  CHECK_THROWS_AS(interpolated({a, b}, 1e-9), InvalidRequest);
  CHECK_THROWS_AS(interpolated({a, Eigen::Vector3d::Zero()}, 0.1), InvalidRequest);
}

TEST_CASE("a robot query refuses what makes no sense") {
  const Robot arm = shippedArm();
  CHECK_THROWS_AS(RobotQuery(arm, {}), InvalidRequest);
  const RobotQuery query(arm, ballAndBox());
  CHECK_THROWS_AS(query.motion({}, ErrorsOverTime::persistent, {}), InvalidRequest);
  CHECK_THROWS_AS(query.state(Eigen::VectorXd::Zero(3), {}), InvalidRequest);
  ProbabilityRequest request;
  request.relative_tolerance = -1.0;
  CHECK_THROWS_AS(query.state(arm.values({}), request), InvalidRequest);
  request = {};
  request.gradient = true;
  CHECK_THROWS_AS(query.state(arm.values({}), request), InvalidRequest);
}

TEST_CASE("the shipped motion is read and answered; bad robot scenes are refused") {
  const RobotScene scene = loadRobotScene(shippedFile("arm_path.json"));
  const RobotQuery query = loadRobotQuery(scene);
  const auto waypoints = waypointsOf(scene, query.robot());
  CHECK(waypoints.size() > 10);
  const RobotResult result = query.motion(waypoints, scene.errors, scene.request);
  CHECK(result.decision != Decision::none);
  CHECK(result.parts.size() == 2);

  const TemporaryFolder folder;
  const std::string good =
      R"({"robot": {"urdf": "a.urdf"}, "joints": {"j": 1}, "obstacles": [{"name": "o",)"
      R"( "sphere": 1, "displacement": {"sigma": [1, 1, 1]}}]})";
  CHECK_NOTHROW(loadRobotScene(folder.write("good.json", good)));
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    CAPTURE(text);
    CHECK_THROWS_AS(loadRobotScene(folder.write("bad.json", text)), FileError);
  };
  refused("\"joints\"", "\"limbs\"");
  refused("{\"j\": 1}", "{\"j\": \"1\"}");
  refused("\"joints\": {\"j\": 1}", "\"waypoints\": []");
  refused("\"name\": \"o\"", "\"names\": \"o\"");
  refused("\"urdf\": \"a.urdf\"", "\"urdf\": \"a.urdf\", \"base\": [1, 2]");
  refused("\"joints\"", "\"errors\": \"some\", \"joints\"");
  refused("\"joints\"", "\"largest_step\": 0, \"joints\"");
  refused("\"joints\"", "\"between\": \"some\", \"joints\"");
  refused("[1, 1, 1]", "[1, -1, 1]");
}

TEST_CASE("no query of a robot asks again whoever said no") {
  const RobotQuery query(shippedArm(), ballAndBox());
  const auto waypoints = sweep(query.robot(), 5);
  using Ask = std::function<void(const ProbabilityRequest&)>;
  std::vector<Ask> calls;
  calls.push_back([&](const auto& request) { query.state(waypoints[1], request); });
  calls.push_back([&](const auto& request) { query.byBody(waypoints, request); });
  calls.push_back([&](const auto& request) {
    query.motion(waypoints, ErrorsOverTime::persistent, request, BetweenWaypoints::swept);
  });
  for (const auto errors :
       {ErrorsOverTime::persistent, ErrorsOverTime::independent, ErrorsOverTime::any_dependence}) {
    calls.push_back([&, errors](const auto& request) { query.motion(waypoints, errors, request); });
  }
  calls.push_back([&](const auto& request) {
    ProbabilityRequest without = request;
    without.threshold.reset();
    query.decideProbably(waypoints, 0.2, 1e-4, without);
  });
  calls.push_back([&](const auto& request) {
    MotionGradientRequest lines;
    lines.on_progress = request.on_progress;
    query.gradient(waypoints, lines);
  });
  for (std::size_t i = 0; i < calls.size(); ++i) {
    for (const bool decides : {false, true}) {
      for (const int last : {1, 2, 4}) {
        int asked = 0, after = 0;
        ProbabilityRequest request = withTolerance(1e-5);
        request.max_cells = 20'000;
        if (decides) request.threshold = 0.2;
        request.on_progress = [&](const ProbabilityProgress&) {
          after += asked >= last;
          return ++asked < last;
        };
        calls[i](request);
        CAPTURE(i, decides, last, asked);
        CHECK(after == 0);
      }
    }
  }
}

TEST_CASE("a threshold of a robot is decided inside of any tolerance, or a limit says why not") {
  const RobotQuery query(shippedArm(), ballAndBox());
  std::vector<Eigen::VectorXd> waypoints;
  for (const double turn : {0.8, -0.9}) {
    waypoints.push_back(query.robot().values({{"turn", turn}, {"shoulder", 0.15}, {"elbow", 0.3}}));
  }
  for (const auto errors : {ErrorsOverTime::persistent, ErrorsOverTime::independent}) {
    const RobotResult known = query.motion(waypoints, errors, withTolerance(1e-3));
    CAPTURE(errors == ErrorsOverTime::persistent, known.any.lower, known.any.upper,
            toString(known.status));
    // Far inside of the tolerance, on either side of P, which may be near 1.
    const double room = 1.0 - known.any.upper;
    for (const double threshold : {0.99 * known.any.lower, 0.997 * known.any.lower,
                                   known.any.upper + 0.5 * room, known.any.upper + 0.9 * room}) {
      ProbabilityRequest request = withTolerance(1.0);
      request.absolute_tolerance = 1.0;
      request.threshold = threshold;
      const RobotResult result = query.motion(waypoints, errors, request);
      CAPTURE(threshold, result.any.lower, result.any.upper);
      CHECK(result.status == ProbabilityStatus::decided);
      CHECK(result.decision == (threshold < known.any.lower ? Decision::above : Decision::below));
    }
    ProbabilityRequest request = withTolerance(1.0);
    request.threshold = known.any.middle();
    request.max_cells = 3'000;
    const RobotResult limited = query.motion(waypoints, errors, request);
    CAPTURE(toString(limited.status));
    CHECK((limited.status != ProbabilityStatus::converged));
    CHECK((limited.status == ProbabilityStatus::decided) ==
          (limited.decision != Decision::undecided));
  }
}

TEST_CASE("bodies that are left out as far away do not keep a threshold from being decided") {
  const Robot arm = shippedArm();
  std::vector<Obstacle> one = {ballAndBox()[0]};
  one[0].pose = at(0.55, 0.25, 0.75);
  const RobotQuery query(arm, one);
  const Eigen::VectorXd values = sweep(arm, 3)[0];
  ProbabilityRequest fine = withTolerance(1e-6);
  fine.absolute_tolerance = 0.0;
  const RobotResult known = query.state(values, fine);
  REQUIRE(known.any.lower > 0.0);
  REQUIRE(known.any.width() < 1e-3 * known.any.upper);
  for (const double factor : {0.9, 1.1}) {
    ProbabilityRequest request;
    request.absolute_tolerance = 1.0;
    request.threshold = factor * known.any.middle();
    const RobotResult result = query.state(values, request);
    CAPTURE(factor, known.any.lower, known.any.upper, result.any.lower, result.any.upper);
    CHECK(result.status == ProbabilityStatus::decided);
    CHECK(result.decision == (factor < 1.0 ? Decision::above : Decision::below));
  }
}
