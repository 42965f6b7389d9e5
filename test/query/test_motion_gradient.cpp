// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Gradients for the motion of single members, against certified ones and central differences.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include <cmath>
#include <stdexcept>
#include <thread>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/group.h"
#include "mesh_shapes.h"
#include "poses.h"
#include "random_bodies.h"
#include "shapes.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

using Poses = std::vector<fcl::Transform3d>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Moved by a twist about the world's origin.
fcl::Transform3d moved(const fcl::Transform3d& pose, const Vector6& twist) {
  fcl::Transform3d motion = fcl::Transform3d::Identity();
  const Eigen::Vector3d turn = twist.tail<3>();
  if (turn.norm() > 0.0) {
    motion.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  }
  motion.translation() = twist.head<3>();
  return motion * pose;
}

/// Everything about one query but where A is.
struct GradientScene {
  GroupQuery::Geometries a;
  GroupQuery::Geometries b;
  Poses poses_a;
  Poses poses_b;
  GaussianDisplacement displacement;
  ContactMeaning contact = ContactMeaning::fcl;

  ProbabilityResult certified(const Poses& poses, double tolerance, bool gradient = false) const {
    ProbabilityRequest request;
    request.method = ProbabilityMethod::interval;
    request.absolute_tolerance = tolerance;
    request.relative_tolerance = 0.0;
    request.gradient = gradient;
    request.contact = contact;
    ProbabilityResult result;
    GroupQuery(a, b).collisionProbability(poses, poses_b, displacement, request, result);
    return result;
  }

  MotionGradient gradient(std::size_t lines) const {
    MotionGradientRequest request;
    request.lines = lines;
    request.contact = contact;
    return GroupQuery(a, b).motionGradient(poses_a, poses_b, displacement, rigidMotions(a.size()),
                                           request);
  }
};

void checkProbability(const GradientScene& scene, const MotionGradient& gradient) {
  const ProbabilityResult interval = scene.certified(scene.poses_a, 1e-3);
  CAPTURE(gradient.probability, gradient.standard_error, *interval.lower, *interval.upper);
  CHECK(gradient.probability > *interval.lower - 5.0 * gradient.standard_error);
  CHECK(gradient.probability < *interval.upper + 5.0 * gradient.standard_error);
}

/// A that moves as one is displaced.
void checkTranslation(const GradientScene& scene, const MotionGradient& gradient) {
  const ProbabilityResult certified = scene.certified(scene.poses_a, 1e-4, true);
  REQUIRE(certified.gradient);
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0.0;
    double error = 0.0;
    for (std::size_t i = 0; i < scene.a.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(6 * i) + axis;
      sum += gradient.gradient[k];
      error += gradient.gradient_standard_error[k];
    }
    CAPTURE(axis, sum, error, (*certified.gradient)[axis]);
    CHECK(std::fabs(sum - (*certified.gradient)[axis]) <
          5.0 * error + 0.02 * certified.gradient->norm());
  }
}

void checkDifferences(const GradientScene& scene, const MotionGradient& gradient, double step,
                      double tolerance) {
  for (std::size_t i = 0; i < scene.a.size(); ++i) {
    for (int axis = 0; axis < 6; ++axis) {
      Vector6 twist = Vector6::Zero();
      Poses before = scene.poses_a;
      Poses behind = scene.poses_a;
      twist[axis] = step;
      behind[i] = moved(behind[i], twist);
      before[i] = moved(before[i], -twist);
      const double slope = (scene.certified(behind, tolerance).probability() -
                            scene.certified(before, tolerance).probability()) /
                           (2.0 * step);
      const auto k = static_cast<Eigen::Index>(6 * i) + axis;
      CAPTURE(i, axis, gradient.gradient[k], gradient.gradient_standard_error[k], slope);
      CHECK(std::fabs(gradient.gradient[k] - slope) <
            5.0 * gradient.gradient_standard_error[k] + tolerance / step +
                0.01 * gradient.gradient.lpNorm<Eigen::Infinity>());
    }
  }
}

bool isSame(const MotionGradient& x, const MotionGradient& y) {
  return x.probability == y.probability && x.standard_error == y.standard_error &&
         x.gradient == y.gradient && x.gradient_standard_error == y.gradient_standard_error &&
         x.lines == y.lines;
}

GradientScene twoBodiesBesideABox(const GaussianDisplacement& displacement) {
  GradientScene scene;
  scene.a = {std::make_shared<fcl::Boxd>(1.0, 0.4, 0.3),
             makeModel<fcl::OBBRSSd>(bumpyMesh(0.4, 4, 6, 1))};
  scene.b = {std::make_shared<fcl::Boxd>(0.8, 0.9, 0.7)};
  fcl::Transform3d turned = at(1.0, 0.1, -0.2);
  turned.linear() =
      Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  scene.poses_a = {at(0.0, 0.0, 0.0), at(0.3, 0.7, 0.2)};
  scene.poses_b = {turned};
  scene.displacement = displacement;
  return scene;
}

}  // namespace

TEST_CASE("gradients for single members agree with central differences, at every rank") {
  RandomBodies random(31);
  for (const Eigen::Vector3d& deviations :
       {Eigen::Vector3d(0.3, 0.25, 0.2), Eigen::Vector3d(0.3, 0.25, 0.0),
        Eigen::Vector3d(0.3, 0.0, 0.0)}) {
    const GradientScene scene = twoBodiesBesideABox(
        GaussianDisplacement::fromStandardDeviations(deviations, random.quaternion()));
    const MotionGradient gradient = scene.gradient(40'000);
    CAPTURE(deviations.transpose());
    checkProbability(scene, gradient);
    // On a single line nothing evens out where one side ends and the next begins.
    const bool single_line = scene.displacement.rank() == 1;
    checkDifferences(scene, gradient, single_line ? 1e-5 : 0.02, single_line ? 1e-10 : 1e-4);
  }
}

TEST_CASE("moved all together, members have the certified gradient of the displacement") {
  RandomBodies random(32);
  const std::vector<std::shared_ptr<const fcl::CollisionGeometryd>> shapes{
      std::make_shared<fcl::Sphered>(0.4),
      std::make_shared<fcl::Capsuled>(0.2, 0.7),
      std::make_shared<fcl::Cylinderd>(0.3, 0.6),
      std::make_shared<fcl::Coned>(0.4, 0.7),
      std::make_shared<fcl::Ellipsoidd>(0.3, 0.4, 0.6),
      std::make_shared<fcl::Boxd>(0.6, 0.5, 0.7)};
  const auto mesh = makeModel<fcl::OBBRSSd>(bumpyMesh(0.5, 5, 7, 2));
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto& shape = shapes[i];
    const bool beside_mesh = i % 2 == 0;
    GradientScene scene;
    scene.a = {shape, std::make_shared<fcl::Sphered>(0.2)};
    if (beside_mesh) {
      scene.b = {mesh};
    } else {
      scene.b = {std::make_shared<fcl::Capsuled>(0.3, 0.5)};
    }
    const fcl::Transform3d pose(random.pose(0.1));
    scene.poses_a = {pose, at(-0.5, 0.2, 0.1)};
    scene.poses_b = {at(0.9, 0.2, 0.1)};
    scene.displacement =
        GaussianDisplacement::fromStandardDeviations({0.3, 0.2, 0.1}, random.quaternion());
    CAPTURE(static_cast<int>(shape->getNodeType()), beside_mesh);
    const MotionGradient gradient = scene.gradient(4096);
    checkProbability(scene, gradient);
    checkTranslation(scene, gradient);
  }
}

TEST_CASE("a ball that turns about its centre changes nothing, and about another point it moves") {
  GradientScene scene;
  scene.a = {std::make_shared<fcl::Sphered>(0.3)};
  scene.b = {std::make_shared<fcl::Boxd>(1.0, 1.0, 1.0)};
  const Eigen::Vector3d centre(0.2, -0.1, 0.3);
  scene.poses_a = {at(centre.x(), centre.y(), centre.z())};
  scene.poses_b = {at(1.1, 0.2, 0.1)};
  scene.displacement = GaussianDisplacement::fromStandardDeviations({0.2, 0.2, 0.2});
  const Eigen::VectorXd gradient = scene.gradient(2048).gradient;
  // About the origin, ω moves the centre by ω × c: line by line, not only in the mean.
  const Eigen::Vector3d expected = centre.cross(gradient.head<3>());
  CHECK((gradient.tail<3>() - expected).norm() < 1e-6 * gradient.head<3>().norm());
}

TEST_CASE("within a solid there is no boundary, beside its surface there is") {
  for (const auto contact : {ContactMeaning::fcl, ContactMeaning::solid}) {
    GradientScene scene;
    scene.a = {makeModel<fcl::OBBRSSd>(bumpyMesh(0.15, 4, 6, 3))};
    scene.b = {makeModel<fcl::OBBRSSd>(boxMesh({2.0, 2.0, 2.0}))};
    scene.poses_a = {at(0.7, 0.1, 0.0)};
    scene.poses_b = {at(0.0, 0.0, 0.0)};
    scene.displacement = GaussianDisplacement::fromStandardDeviations({0.2, 0.2, 0.2});
    scene.contact = contact;
    const MotionGradient gradient = scene.gradient(8192);
    checkProbability(scene, gradient);
    checkTranslation(scene, gradient);
  }
}

TEST_CASE("a wall without end has a gradient, too") {
  GradientScene scene;
  scene.a = {std::make_shared<fcl::Sphered>(0.1)};
  scene.b = {std::make_shared<fcl::Halfspaced>(Eigen::Vector3d(0, 0, 1), 0.0)};
  scene.poses_a = {at(0.3, 0.2, 0.15)};
  scene.poses_b = {at(0, 0, 0)};
  const double sigma = 0.05;
  scene.displacement = GaussianDisplacement::fromStandardDeviations({sigma, sigma, sigma});
  const MotionGradient gradient = scene.gradient(4096);
  // P = Φ(-0.05 / σ)
  const double density = std::exp(-0.5) / std::sqrt(2.0 * M_PI) / sigma;
  CHECK(std::fabs(gradient.probability - 0.5 * std::erfc(1.0 / std::sqrt(2.0))) <
        5.0 * gradient.standard_error);
  CHECK(std::fabs(gradient.gradient[2] + density) < 5.0 * gradient.gradient_standard_error[2]);
}

TEST_CASE("lines are fixed by the seed, whatever the number of threads, and end in time") {
  const GradientScene scene =
      twoBodiesBesideABox(GaussianDisplacement::fromStandardDeviations({0.3, 0.25, 0.2}));
  const GroupQuery query(scene.a, scene.b);
  MotionGradientRequest request;
  request.lines = 1000;
  const auto ask = [&] {
    return query.motionGradient(scene.poses_a, scene.poses_b, scene.displacement, rigidMotions(2),
                                request);
  };
  const MotionGradient one = ask();
  CHECK(one.lines == 1000);
  CHECK(one.status == ProbabilityStatus::sampled);
  request.threads = 3;
  const MotionGradient three = ask();
  CHECK(one.gradient == three.gradient);
  CHECK(one.probability == three.probability);
  request.seed = 2;
  CHECK(ask().probability != one.probability);
  request.lines = 100'000'000;
  request.time_limit = 0.05;
  const MotionGradient stopped = ask();
  CHECK(stopped.lines >= 2);
  CHECK(stopped.lines < request.lines);
  CHECK(stopped.status == ProbabilityStatus::time_limit);
}

TEST_CASE("a gradient tells how far it is, and cancelled it is that of the lines so far") {
  const GradientScene scene =
      twoBodiesBesideABox(GaussianDisplacement::fromStandardDeviations({0.3, 0.25, 0.2}));
  const GroupQuery query(scene.a, scene.b);
  MotionGradientRequest request;
  request.lines = 1000;
  const auto ask = [&](const MotionGradientRequest& of) {
    return query.motionGradient(scene.poses_a, scene.poses_b, scene.displacement, rigidMotions(2),
                                of);
  };
  const MotionGradient whole = ask(request);
  for (const unsigned threads : {1U, 3U}) {
    request.threads = threads;
    std::vector<ProbabilityProgress> told;
    request.on_progress = [&, caller = std::this_thread::get_id()](const auto& progress) {
      CHECK(std::this_thread::get_id() == caller);
      told.push_back(progress);
      return true;
    };
    CHECK(isSame(ask(request), whole));
    REQUIRE(told.size() > 4);
    for (std::size_t i = 0; i < told.size(); ++i) {
      CHECK(told[i].interval.lower == 0.0);
      CHECK(told[i].interval.upper == 1.0);
      CHECK(told[i].fraction > (i > 0 ? told[i - 1].fraction : 0.0));
      CHECK(told[i].seconds >= (i > 0 ? told[i - 1].seconds : 0.0));
    }
    CHECK(told.back().fraction < 1.0);

    for (std::size_t last = 1; last <= told.size(); ++last) {
      CAPTURE(threads, last);
      std::size_t calls = 0;
      request.on_progress = [&](const auto&) { return ++calls < last; };
      const MotionGradient cancelled = ask(request);
      CHECK(calls == last);
      CHECK(cancelled.status == ProbabilityStatus::cancelled);
      CHECK(static_cast<double>(cancelled.lines) == Approx(1000.0 * told[last - 1].fraction));
      // Nothing but fewer lines.
      MotionGradientRequest fewer;
      fewer.lines = cancelled.lines;
      CHECK(isSame(ask(fewer), cancelled));
    }
    request.on_progress = [](const auto&) -> bool { throw std::runtime_error("no"); };
    CHECK_THROWS_AS(ask(request), std::runtime_error);
  }
}

TEST_CASE("a gradient of two lines has none left to cancel, and that of nothing is exact") {
  GradientScene scene =
      twoBodiesBesideABox(GaussianDisplacement::fromStandardDeviations({0.3, 0.25, 0.2}));
  CHECK(scene.gradient(2).status == ProbabilityStatus::sampled);
  const auto unoccupied = std::make_shared<fcl::Boxd>(0.8, 0.9, 0.7);
  unoccupied->cost_density = 0.0;
  scene.b = {unoccupied};
  const MotionGradient nothing = scene.gradient(100);
  CHECK(nothing.status == ProbabilityStatus::exact);
  CHECK(nothing.lines == 0);
}

TEST_CASE("gradients refuse what has none") {
  const GradientScene scene =
      twoBodiesBesideABox(GaussianDisplacement::fromStandardDeviations({0.3, 0.25, 0.2}));
  const GroupQuery query(scene.a, scene.b);
  const auto ask = [&](const GaussianDisplacement& displacement, const MemberVelocities& velocities,
                       std::size_t lines) {
    MotionGradientRequest request;
    request.lines = lines;
    query.motionGradient(scene.poses_a, scene.poses_b, displacement, velocities, request);
  };
  CHECK_THROWS_AS(ask(GaussianDisplacement(), rigidMotions(2), 100), InvalidRequest);
  CHECK_THROWS_AS(ask(scene.displacement, rigidMotions(1), 100), InvalidRequest);
  CHECK_THROWS_AS(ask(scene.displacement, rigidMotions(2), 1), InvalidRequest);
  MemberVelocities uneven = rigidMotions(2);
  uneven[1].conservativeResize(6, 3);
  CHECK_THROWS_AS(ask(scene.displacement, uneven, 100), InvalidRequest);
  MemberVelocities broken = rigidMotions(2);
  broken[0](0, 0) = std::nan("");
  CHECK_THROWS_AS(ask(scene.displacement, broken, 100), InvalidRequest);
}
