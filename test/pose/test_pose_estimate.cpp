// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Estimates over poses against closed forms and counting in six dimensions.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "mesh_shapes.h"
#include "pose_cases.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Method = ProbabilityMethod;

bool isCounted(const ProbabilityResult& result) {
  return result.plan.front().find("calls of fcl::collide") != std::string::npos &&
         result.plan.size() == 1;
}

void checkNear(const ProbabilityResult& estimate, double expected, double error_of_expected) {
  CAPTURE(*estimate.estimate, *estimate.standard_error, expected, error_of_expected);
  CHECK(std::fabs(*estimate.estimate - expected) <=
        5.0 * std::hypot(*estimate.standard_error, error_of_expected));
}

}  // namespace

TEST_CASE("a sphere that turns about its centre collides as if it did not turn") {
  const PreparedPoseQuery query(std::make_shared<fcl::Sphered>(0.3),
                                std::make_shared<fcl::Boxd>(1, 1, 1));
  const auto translation = GaussianDisplacement::fromStandardDeviations({0.1, 0.05, 0.08});
  const fcl::Transform3d pose_a = at(0.9, 0.1, 0.0);
  for (const double sigma : {1e-6, 0.02, 1.0}) {
    const auto error =
        PoseError::fromIndependent(translation, sigma * sigma * Eigen::Matrix3d::Identity(),
                                   PoseConvention::body_rotation_vector);
    ProbabilityResult exact;
    collisionProbability(std::make_shared<fcl::Sphered>(0.3).get(), pose_a,
                         std::make_shared<fcl::Boxd>(1, 1, 1).get(), kIdentity, translation,
                         poseRequest(Method::interval, 1e-5), exact);
    const auto result = answer(query, pose_a, kIdentity, error, poseRequest(Method::estimate));
    CHECK(result.status == ProbabilityStatus::converged);
    CHECK(*result.standard_error <= 0.01 * *result.estimate * 1.0001);
    checkNear(result, exact.probability(), 1e-5);
  }
}

TEST_CASE("what counting has said stays said where the limits end it") {
  // Turned about its centre or not, it is the same sphere.
  const auto sphere = std::make_shared<fcl::Sphered>(0.3);
  const auto box = std::make_shared<fcl::Boxd>(1, 1, 1);
  const auto translation = GaussianDisplacement::fromStandardDeviations({0.1, 0.05, 0.08});
  const PreparedPoseQuery query(sphere, box);
  const auto error = PoseError::fromIndependent(translation, Eigen::Matrix3d::Identity(),
                                                PoseConvention::body_rotation_vector);
  const fcl::Transform3d pose_a = at(1.12, 0.1, 0.0);
  ProbabilityResult exact;
  collisionProbability(sphere.get(), pose_a, box.get(), kIdentity, translation,
                       poseRequest(Method::interval, 1e-3), exact);
  REQUIRE(*exact.upper < 2e-3);
  auto request = poseRequest(Method::estimate, 1e-3);
  const auto check = [&](std::size_t max_cells, double most) {
    request.max_cells = max_cells;
    const auto result = answer(query, pose_a, kIdentity, error, request);
    CAPTURE(max_cells);
    CHECK(result.status != ProbabilityStatus::converged);
    REQUIRE(result.confidence_interval);
    CHECK(result.confidence_interval->upper < most);
    CHECK(result.confidence_interval->lower <= *exact.upper);
    CHECK(result.confidence_interval->upper >= *exact.lower);
    CHECK(result.estimate);
    return result.status;
  };
  CHECK(check(20'000, 10.0 * *exact.upper) == ProbabilityStatus::resolution_limit);
  // Too few for a single answer at a configuration.
  check(300, 0.2);
}

TEST_CASE("a sphere on a lever before a wall has a closed form") {
  // It turns about the world's z axis, L away; the wall is y >= gap + radius.
  const double lever = 0.8, radius = 0.1, sigma = 0.03;
  const auto wall = std::make_shared<fcl::Halfspaced>(Eigen::Vector3d(0, -1, 0), 0.0);
  const auto block = std::make_shared<fcl::Boxd>(4.0, 4.0, 4.0);
  const auto sphere = std::make_shared<fcl::Sphered>(radius);
  for (const double gap : {0.02, 0.08}) {
    for (const double angle : {0.005, 0.3}) {
      const double expected = gaussianMean(
          angle, [&](double theta) { return normalCdf((lever * std::sin(theta) - gap) / sigma); });
      RandomPoses::Body arm{
          {at(lever, 0, 0)},
          kIdentity,
          PoseError::fromStandardDeviations({sigma, sigma, sigma}, {0, 0, angle})};
      for (const bool bounded : {false, true}) {
        const fcl::Transform3d pose_b = at(lever, gap + radius + (bounded ? 2.0 : 0.0), 0);
        const RandomPoses poses(arm, {{pose_b}, pose_b, PoseError()});
        const ConfigurationQuery query(
            {sphere}, {bounded ? std::static_pointer_cast<fcl::CollisionGeometryd>(block)
                               : std::static_pointer_cast<fcl::CollisionGeometryd>(wall)});
        ProbabilityResult result;
        query.collisionProbability(poses, poseRequest(Method::estimate, 0.02), result);
        CAPTURE(gap, angle, bounded);
        checkNear(result, expected, 1e-4 * expected);
        CHECK(*result.standard_error <= 0.02 * *result.estimate + 1e-6);
      }
    }
  }
}

TEST_CASE("an exponential about the world's origin, against quadrature") {
  // Rotation about z by θ; what is left of the translation in the plane is σ sin(θ/2)/(θ/2).
  const double lever = 0.7, radius = 0.1, sigma = 0.05, angle = 0.4, gap = 0.06;
  const PreparedPoseQuery query(std::make_shared<fcl::Sphered>(radius),
                                std::make_shared<fcl::Halfspaced>(Eigen::Vector3d(0, -1, 0), 0.0));
  const auto error = PoseError::fromStandardDeviations({sigma, sigma, sigma}, {0, 0, angle},
                                                       PoseConvention::world_exponential);
  const double expected = gaussianMean(angle, [&](double theta) {
    const double shrunk = std::fabs(theta) < 1e-6 ? 1.0 : std::sin(0.5 * theta) / (0.5 * theta);
    return normalCdf((lever * std::sin(theta) - gap) / (sigma * shrunk));
  });
  const auto result = answer(query, at(lever, 0, 0), at(0, gap + radius, 0), error,
                             poseRequest(Method::estimate, 0.005));
  checkNear(result, expected, 1e-9);
}

TEST_CASE("boxes and meshes agree with counting in six dimensions, in every convention") {
  RandomBodies random(11);
  const PreparedPoseQuery of_boxes = boxes();
  const PreparedPoseQuery of_meshes(makeModel<fcl::OBBRSSd>(bumpyMesh(0.4, 4, 6, 1)),
                                    makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 8, 5)));
  int i = 0;
  for (const auto convention :
       {PoseConvention::world_rotation_vector, PoseConvention::body_rotation_vector,
        PoseConvention::world_exponential, PoseConvention::body_exponential}) {
    for (const PreparedPoseQuery* query : {&of_boxes, &of_meshes}) {
      PoseError::Vector6 mean;
      mean << 0.02 * random.normalVector(), 0.1 * random.normalVector();
      const PoseError error(randomPoseCovariance(random, 6, 0.1, 0.15), convention, mean);
      const fcl::Transform3d pose_a(random.pose(0.3));
      fcl::Transform3d pose_b(random.pose(0.1));
      pose_b.pretranslate(0.75 * random.direction());
      ProbabilityRequest counting = poseRequest(Method::monte_carlo, 1e-9);
      counting.samples = 5'000;
      counting.seed = static_cast<std::uint64_t>(++i);
      const auto counted = answer(*query, pose_a, pose_b, error, counting);
      const auto result =
          answer(*query, pose_a, pose_b, error, poseRequest(Method::estimate, 0.03));
      CAPTURE(i);
      CHECK(result.status == ProbabilityStatus::converged);
      checkNear(result, *counted.estimate, *counted.standard_error);
    }
  }
}

TEST_CASE("boxes and meshes agree with a million samples in six dimensions", "[long]") {
  RandomBodies random(15);
  const PreparedPoseQuery of_boxes = boxes();
  const PreparedPoseQuery of_meshes(makeModel<fcl::OBBRSSd>(bumpyMesh(0.4, 4, 6, 1)),
                                    makeModel<fcl::OBBRSSd>(torusMesh(0.5, 0.2, 8, 5)));
  for (int i = 0; i < 8; ++i) {
    const PreparedPoseQuery& query = i % 2 == 0 ? of_boxes : of_meshes;
    const PoseError error(randomPoseCovariance(random, 6, 0.1, i < 4 ? 0.03 : 0.3));
    fcl::Transform3d pose_b(random.pose(0.1));
    pose_b.pretranslate(0.8 * random.direction());
    ProbabilityRequest counting = poseRequest(Method::monte_carlo, 1e-9);
    counting.samples = 1'000'000;
    counting.seed = static_cast<std::uint64_t>(100 + i);
    const auto counted = answer(query, kIdentity, pose_b, error, counting);
    CAPTURE(i);
    for (const double tolerance : {0.01, 0.002}) {
      checkNear(answer(query, kIdentity, pose_b, error, poseRequest(Method::estimate, tolerance)),
                *counted.estimate, *counted.standard_error);
    }
  }
}

TEST_CASE("contacts on a side that the quadric does not follow are counted") {
  // Two walls, one on either side: the nearer one is what the quadric follows.
  TriangleMesh walls = boxMesh({0.2, 2.0, 2.0});
  TriangleMesh other = walls;
  for (Eigen::Vector3d& vertex : walls.vertices) vertex.x() += 0.55;
  const std::size_t first = walls.vertices.size();
  for (const Eigen::Vector3d& vertex : other.vertices) {
    walls.vertices.push_back(vertex - Eigen::Vector3d(0.6, 0, 0));
  }
  for (const fcl::Triangle& t : other.triangles) {
    walls.triangles.emplace_back(first + t[0], first + t[1], first + t[2]);
  }
  const PreparedPoseQuery query(makeModel<fcl::OBBRSSd>(boxMesh({0.6, 0.4, 0.2})),
                                makeModel<fcl::OBBRSSd>(walls));
  const auto error = PoseError::fromStandardDeviations({0.08, 0.05, 0.05}, {0.1, 0.1, 0.1});
  ProbabilityRequest counting = poseRequest(Method::monte_carlo, 1e-9);
  counting.samples = 40'000;
  const auto counted = answer(query, kIdentity, kIdentity, error, counting);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    ProbabilityRequest request = poseRequest(Method::estimate, 0.02);
    request.seed = seed;
    const auto result = answer(query, kIdentity, kIdentity, error, request);
    CAPTURE(seed, result.plan.back());
    checkNear(result, *counted.estimate, *counted.standard_error);
  }
}

TEST_CASE("covariances of low rank are answered, and standard errors stay true") {
  RandomBodies random(12);
  const PreparedPoseQuery query = boxes();
  int i = 0;
  for (const int rank : {1, 2, 3, 4, 5}) {
    const PoseError error(randomPoseCovariance(random, rank, 0.05, 0.3));
    ProbabilityRequest counting = poseRequest(Method::monte_carlo, 1e-9);
    counting.samples = 5'000;
    counting.seed = static_cast<std::uint64_t>(++i);
    const fcl::Transform3d pose_b = at(0.85, 0.1, 0.1);
    const auto counted = answer(query, kIdentity, pose_b, error, counting);
    const auto result =
        answer(query, kIdentity, pose_b, error, poseRequest(Method::automatic, 0.03));
    CAPTURE(rank, *counted.estimate, *result.estimate, *result.standard_error, result.plan[0]);
    // Where nothing collides no number of configurations tells P from the least tolerance.
    CHECK(result.status == (*counted.estimate > 0.0 ? ProbabilityStatus::converged
                                                    : ProbabilityStatus::resolution_limit));
    CHECK(*result.standard_error > 0.0);
    checkNear(result, *counted.estimate, *counted.standard_error);
    ProbabilityRequest request = poseRequest(Method::interval, 0.1);
    request.max_cells = 3'000;
    const auto interval = answer(query, kIdentity, pose_b, error, request);
    CAPTURE(*interval.lower, *interval.upper);
    CHECK(*interval.lower <= *counted.estimate + 5.0 * *counted.standard_error);
    CHECK(*interval.upper >= *counted.estimate - 5.0 * *counted.standard_error);
  }
  SECTION("one axis, and nothing but rotation") {
    // The corner (0.5, 0.2) of the box reaches x = 0.53 at an angle found by hand.
    const auto error = PoseError::fromStandardDeviations({0, 0, 0}, {0, 0, 0.2});
    const PreparedPoseQuery before_wall(
        std::make_shared<fcl::Boxd>(1.0, 0.4, 0.2),
        std::make_shared<fcl::Halfspaced>(Eigen::Vector3d(-1, 0, 0), 0.0));
    const double corner = std::hypot(0.5, 0.2), direction = std::atan2(0.2, 0.5);
    const double touching = direction - std::acos(0.53 / corner);
    const double other = direction + std::acos(0.53 / corner);
    // Symmetric: |θ| between the two angles (0.4 deviations times 0.2 and far beyond).
    const double expected = 2.0 * (normalCdf(other / 0.2) - normalCdf(touching / 0.2));
    const auto result =
        answer(before_wall, kIdentity, at(0.53, 0, 0), error, poseRequest(Method::estimate, 0.02));
    checkNear(result, expected, 1e-3);
  }
}

TEST_CASE("without rotation every answer is that of the translation, to the last bit") {
  RandomBodies random(13);
  const auto a = std::make_shared<fcl::Boxd>(1.0, 0.4, 0.2);
  const auto b = std::make_shared<fcl::Boxd>(0.5, 0.8, 0.6);
  const PreparedPoseQuery pose_query(a, b);
  const PreparedQuery query(a, b);
  for (int i = 0; i < 10; ++i) {
    const auto translation = GaussianDisplacement::fromStandardDeviations(
        {0.1, 0.05, 0.02}, random.quaternion(), 0.05 * random.normalVector());
    const auto error = PoseError::fromIndependent(translation, Eigen::Matrix3d::Zero());
    const fcl::Transform3d pose_a(random.pose(0.2)), pose_b = at(0.8, 0.1, 0.1);
    for (const auto method : {Method::automatic, Method::interval, Method::estimate, Method::exact,
                              Method::convex_pcd, Method::monte_carlo}) {
      ProbabilityResult expected, result;
      query.collisionProbability(pose_a, pose_b, translation, poseRequest(method), expected);
      pose_query.collisionProbability(pose_a, pose_b, error, poseRequest(method), result);
      CAPTURE(toString(method));
      CHECK(result.lower == expected.lower);
      CHECK(result.upper == expected.upper);
      CHECK(result.estimate == expected.estimate);
      CHECK(result.standard_error == expected.standard_error);
    }
  }
}

TEST_CASE("the seed fixes the answer, whatever the number of threads") {
  const PreparedPoseQuery query = boxes();
  const auto error = PoseError::fromStandardDeviations({0.1, 0.1, 0.1}, {0.1, 0.2, 0.1});
  for (const bool gradient : {true, false}) {
    ProbabilityRequest request = poseRequest(Method::estimate);
    request.gradient = gradient;
    const auto one = answer(query, kIdentity, at(0.9, 0, 0), error, request);
    CHECK(isCounted(one) == !gradient);  // the gradient is that of answers given rotations
    request.threads = 3;
    const auto three = answer(query, kIdentity, at(0.9, 0, 0), error, request);
    CHECK(*one.estimate == *three.estimate);
    CHECK(*one.standard_error == *three.standard_error);
    CHECK(one.statistics.samples == three.statistics.samples);
    CHECK(one.gradient.has_value() == gradient);
    if (gradient) CHECK(*one.gradient == *three.gradient);
    request.seed = 2;
    const auto other = answer(query, kIdentity, at(0.9, 0, 0), error, request);
    CHECK(*one.estimate != *other.estimate);
  }
}

TEST_CASE("estimates that count are calibrated, and take less than counting at random") {
  const PreparedPoseQuery query = boxes();
  const auto error = PoseError::fromStandardDeviations({0.1, 0.1, 0.1}, {0.3, 0.4, 0.3});
  for (const double x : {0.7, 0.9}) {
    const fcl::Transform3d pose_b = at(x, 0, 0);
    ProbabilityRequest request = poseRequest(Method::estimate, 0.001);
    request.seed = 1000;
    const auto reference = answer(query, kIdentity, pose_b, error, request);
    const double truth = *reference.estimate;
    constexpr int kSeeds = 40;
    double squares = 0.0, gain = 0.0;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      request = poseRequest(Method::estimate, 0.005);
      request.seed = static_cast<std::uint64_t>(seed);
      const auto result = answer(query, kIdentity, pose_b, error, request);
      REQUIRE(isCounted(result));
      CHECK(result.status == ProbabilityStatus::converged);
      const double ratio = (*result.estimate - truth) / *result.standard_error;
      squares += ratio * ratio;
      gain +=
          truth * (1.0 - truth) /
          (static_cast<double>(result.statistics.samples) * std::pow(*result.standard_error, 2));
    }
    CAPTURE(x, truth, gain / kSeeds);
    CHECK(std::sqrt(squares / kSeeds) > 0.75);
    CHECK(std::sqrt(squares / kSeeds) < 1.25);
    CHECK(gain / kSeeds > 2.0);
  }
}

TEST_CASE("estimates count where fcl::collide can be asked and the limits are enough") {
  const auto wide = PoseError::fromStandardDeviations({0.1, 0.1, 0.1}, {0.3, 0.3, 0.3});
  const fcl::Transform3d pose_b = at(0.9, 0, 0);
  const ProbabilityRequest request = poseRequest(Method::estimate, 0.02);
  CHECK(isCounted(answer(boxes(), kIdentity, pose_b, wide, request)));
  // Far out in the tail no counting gets there.
  const auto narrow = PoseError::fromStandardDeviations({0.1, 0.1, 0.1}, {1e-3, 1e-3, 1e-3});
  ProbabilityRequest relative = request;
  relative.absolute_tolerance = 0.0;
  const auto far = answer(boxes(), kIdentity, at(1.3, 0, 0), narrow, relative);
  CHECK_FALSE(isCounted(far));
  CHECK(*far.estimate < 1e-6);
  // So small a probability is told of the rotations that were drawn, and the interval says so.
  CHECK(far.status == ProbabilityStatus::resolution_limit);
  CHECK(*far.standard_error <= 0.02 * *far.estimate);
  CHECK(far.confidence_interval->upper > 1e-4);
  // What fcl::collide takes for touching is no longer small beside such displacements.
  const auto small = PoseError::fromStandardDeviations({1e-5, 1e-5, 1e-5}, {0.3, 0.3, 0.3});
  CHECK_FALSE(isCounted(answer(boxes(), kIdentity, pose_b, small, request)));
  // It has no answer for a triangle.
  const auto triangle = std::make_shared<fcl::TrianglePd>(
      Eigen::Vector3d(0, -1, -1), Eigen::Vector3d(0, 1, -1), Eigen::Vector3d(0, 0, 1));
  const PreparedPoseQuery of_triangle(triangle, std::make_shared<fcl::Boxd>(0.5, 0.8, 0.6));
  CHECK_FALSE(isCounted(answer(of_triangle, kIdentity, at(0.3, 0, 0), wide, request)));
}

TEST_CASE("a query over poses stops at a threshold, a limit or when told to") {
  const PreparedPoseQuery query = boxes();
  const auto error = PoseError::fromStandardDeviations({0.1, 0.1, 0.1}, {0.1, 0.2, 0.1});
  const fcl::Transform3d pose_b = at(0.9, 0, 0);
  ProbabilityRequest request = poseRequest(Method::estimate, 1e-4);
  const double p =
      answer(query, kIdentity, pose_b, error, poseRequest(Method::estimate)).probability();

  request.threshold = 0.5 * p;
  auto result = answer(query, kIdentity, pose_b, error, request);
  CHECK(result.status == ProbabilityStatus::decided);
  CHECK(result.decision == Decision::above);
  request.threshold = std::min(0.99, 2.0 * p);
  result = answer(query, kIdentity, pose_b, error, request);
  CHECK(result.decision == Decision::below);
  request.threshold.reset();

  request.max_cells = 2000;
  result = answer(query, kIdentity, pose_b, error, request);
  CHECK(result.status == ProbabilityStatus::cell_limit);
  checkNear(result, p, 0.01 * p);
  request.max_cells = 100'000'000;

  request.time_limit = 0.05;
  result = answer(query, kIdentity, pose_b, error, request);
  CHECK(result.status == ProbabilityStatus::time_limit);
  request.time_limit = 1e-9;
  result = answer(query, kIdentity, pose_b, error, request);
  CHECK(result.status == ProbabilityStatus::time_limit);
  CHECK_FALSE(result.estimate);
  CHECK(*result.lower == 0.0);
  CHECK(*result.upper == 1.0);
  request.time_limit.reset();

  for (const unsigned threads : {1u, 2u}) {
    int calls = 0;
    request.threads = threads;
    request.on_progress = [&](const ProbabilityProgress&) { return ++calls < 60; };
    result = answer(query, kIdentity, pose_b, error, request);
    CHECK(result.status == ProbabilityStatus::cancelled);
  }
}

TEST_CASE("the gradient over poses is that of the mean position") {
  const PreparedPoseQuery query = boxes();
  const auto error = PoseError::fromStandardDeviations({0.1, 0.1, 0.1}, {0.1, 0.2, 0.1});
  ProbabilityRequest request = poseRequest(Method::estimate, 0.01);
  request.gradient = true;
  const auto answerAt = [&](double x) {
    return answer(query, at(x, 0, 0), at(0.9, 0, 0), error, request);
  };
  const double step = 0.05;
  const auto here = answerAt(0.0), before = answerAt(-step), behind = answerAt(step);
  const double slope = (*behind.estimate - *before.estimate) / (2.0 * step);
  const double doubt =
      std::hypot(*behind.standard_error, *before.standard_error) / (2.0 * step) + 0.05 * slope;
  CHECK(std::fabs(here.gradient->x() - slope) <
        5.0 * std::hypot(doubt, here.gradient_standard_error->x()));
}

// And with a closed form far out. \param tolerance  relative, of the rare events
static void compareRareEvents(double tolerance) {
  const PreparedPoseQuery query = boxes();
  const auto error = PoseError::fromStandardDeviations({0.1, 0.1, 0.1}, {0.1, 0.2, 0.1});
  for (const double x : {1.0, 1.2}) {
    const auto estimate =
        answer(query, kIdentity, at(x, 0, 0), error, poseRequest(Method::estimate, 0.01));
    const auto rare =
        answer(query, kIdentity, at(x, 0, 0), error, poseRequest(Method::rare_event, tolerance));
    CAPTURE(x, *estimate.estimate, *rare.estimate, *rare.standard_error);
    CHECK(rare.method == Method::rare_event);
    CHECK(std::fabs(*rare.estimate - *estimate.estimate) <=
          5.0 * std::hypot(*rare.standard_error, *estimate.standard_error));
    CHECK(*rare.standard_error <= std::max(1.5 * tolerance * *rare.estimate, 1e-6));
  }
  // A sphere that turns about its centre: rotations change nothing.
  const PreparedPoseQuery ball(std::make_shared<fcl::Sphered>(0.3),
                               std::make_shared<fcl::Boxd>(1, 1, 1));
  const auto translation = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  const auto turning = PoseError::fromIndependent(translation, 0.04 * Eigen::Matrix3d::Identity());
  ProbabilityResult exact;
  collisionProbability(std::make_shared<fcl::Sphered>(0.3).get(), at(1.5, 0, 0),
                       std::make_shared<fcl::Boxd>(1, 1, 1).get(), kIdentity, translation,
                       poseRequest(Method::interval, 1e-3), exact);
  const auto far =
      answer(ball, at(1.5, 0, 0), kIdentity, turning, poseRequest(Method::rare_event, tolerance));
  CAPTURE(*far.estimate, *far.standard_error, *exact.lower, *exact.upper);
  CHECK(*exact.upper < 1e-9);
  CHECK(*far.estimate - 5.0 * *far.standard_error <= *exact.upper);
  CHECK(*far.estimate + 5.0 * *far.standard_error >= *exact.lower);
}

TEST_CASE("rare events over poses agree with the estimate", "[slow]") { compareRareEvents(0.05); }

TEST_CASE("rare events over poses to 2 %", "[long]") { compareRareEvents(0.02); }

TEST_CASE("rare events over poses of low rank agree with counting", "[slow]") {
  RandomBodies random(21);
  const PreparedPoseQuery query = boxes();
  const fcl::Transform3d pose_b = at(0.8, 0.1, 0.1);
  for (const int rank : {1, 2, 3, 4, 5}) {
    const PoseError error(randomPoseCovariance(random, rank, 0.05, 0.3));
    ProbabilityRequest counting = poseRequest(Method::monte_carlo, 1e-9);
    counting.samples = 20'000;
    const auto counted = answer(query, kIdentity, pose_b, error, counting);
    ProbabilityRequest request = poseRequest(Method::rare_event, 0.04);
    request.absolute_tolerance = 0.005;
    request.samples = 1'000;
    const auto rare = answer(query, kIdentity, pose_b, error, request);
    CAPTURE(rank, *counted.estimate, *rare.estimate, *rare.standard_error, rare.plan);
    CHECK(rare.method == Method::rare_event);
    CHECK(std::fabs(*rare.estimate - *counted.estimate) <=
          5.0 * std::hypot(*rare.standard_error, *counted.standard_error));
  }
}

TEST_CASE("what cannot be answered over poses is refused, and the result untouched") {
  const PreparedPoseQuery query = boxes();
  const auto error = PoseError::fromStandardDeviations({0.1, 0.1, 0.1}, {0.1, 0.2, 0.1});
  ProbabilityResult result;
  result.estimate = 42.0;
  for (const auto method :
       {Method::exact, Method::convex_pcd, Method::general_pcd, Method::general_pcd_min}) {
    CHECK_THROWS_AS(
        query.collisionProbability(kIdentity, at(1, 0, 0), error, poseRequest(method), result),
        UnsupportedGeometry);
  }
  ProbabilityRequest bad = poseRequest(Method::estimate);
  bad.relative_tolerance = -1.0;
  CHECK_THROWS_AS(query.collisionProbability(kIdentity, kIdentity, error, bad, result),
                  InvalidRequest);
  fcl::Transform3d sheared = kIdentity;
  sheared.linear()(0, 1) = 0.1;
  CHECK_THROWS_AS(
      query.collisionProbability(sheared, kIdentity, error, poseRequest(Method::estimate), result),
      InvalidPose);
  CHECK(*result.estimate == 42.0);
  CHECK_THROWS_AS(
      collisionProbability(nullptr, nullptr, error, poseRequest(Method::estimate), result),
      InvalidGeometry);
}
