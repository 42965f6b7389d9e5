// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What gradients of motions state as their standard errors, against balls whose boundary is
// integrated here: no part of the library takes part in that.
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>
#include <cmath>

#include "catch.h"
#include "fcl_prob/group.h"
#include "fcl_prob/whitening.h"
#include "poses.h"
#include "random_bodies.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

struct Ball {
  Eigen::Vector3d centre;
  double radius;
};

/// Balls beside balls.
struct BallScene {
  std::vector<Ball> a;
  std::vector<Ball> b;
  GaussianDisplacement displacement;

  MotionGradient gradient(const MotionGradientRequest& request) const {
    GroupQuery::Geometries of_a, of_b;
    std::vector<fcl::Transform3d> poses_a, poses_b;
    for (const Ball& ball : a) of_a.push_back(std::make_shared<fcl::Sphered>(ball.radius));
    for (const Ball& ball : b) of_b.push_back(std::make_shared<fcl::Sphered>(ball.radius));
    for (const Ball& ball : a) poses_a.push_back(at(ball.centre));
    for (const Ball& ball : b) poses_b.push_back(at(ball.centre));
    return GroupQuery(of_a, of_b)
        .motionGradient(poses_a, poses_b, displacement, rigidMotions(a.size()), request);
  }
};

/// P, and its gradient by the twist of each member.
struct Truth {
  double probability = 0.0;
  bool knows_probability = true;  ///< the mean is not so near a sphere that its points are too far
                                  ///< from each other
  Eigen::VectorXd gradient;
  Eigen::VectorXd doubt;  ///< of the quadrature
};

/// P(|y| > r) of a standard normal in three dimensions.
double beyond(double r) {
  return std::erfc(r / std::sqrt(2.0)) + std::sqrt(2.0 / M_PI) * r * std::exp(-0.5 * r * r);
}

/// The flux through what is exposed of the spheres |ε - (b - a)| = r, point by point of a Fibonacci
/// lattice. P is that of the field y/|y|³ P(|Y| > |y|)/4π, whose divergence is the normal density.
Truth integrated(const BallScene& scene, int points) {
  std::vector<Ball> obstacles;
  std::vector<std::size_t> owner;
  for (std::size_t i = 0; i < scene.a.size(); ++i) {
    for (const Ball& other : scene.b) {
      obstacles.push_back({other.centre - scene.a[i].centre, other.radius + scene.a[i].radius});
      owner.push_back(i);
    }
  }
  const Whitening whitening(scene.displacement);
  const Eigen::Matrix3d& w = whitening.matrix();
  const double volume = std::fabs(w.determinant());
  const auto isInside = [&](const Eigen::Vector3d& x, std::size_t but) {
    for (std::size_t k = 0; k < obstacles.size(); ++k) {
      if (k != but && (x - obstacles[k].centre).norm() < obstacles[k].radius) return true;
    }
    return false;
  };
  Truth truth;
  truth.gradient = truth.doubt =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * scene.a.size()));
  if (isInside(whitening.mean(), obstacles.size())) truth.probability = 1.0;
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    const Ball& ball = obstacles[k];
    const double area = 4.0 * M_PI * ball.radius * ball.radius / points;
    Eigen::Vector3d flux = Eigen::Vector3d::Zero();
    Eigen::Vector3d size = Eigen::Vector3d::Zero();
    for (int i = 0; i < points; ++i) {
      const double z = 1.0 - (2.0 * i + 1.0) / points;
      const double turn = 2.0 * M_PI * i / 1.6180339887498949;
      const double flat = std::sqrt(1.0 - z * z);
      const Eigen::Vector3d n(flat * std::cos(turn), flat * std::sin(turn), z);
      const Eigen::Vector3d x = ball.centre + ball.radius * n;
      if (isInside(x, k)) continue;
      const Eigen::Vector3d y = whitening.apply(x);
      const double r = y.norm();
      if (r < 10.0 * std::sqrt(area) * w.operatorNorm()) truth.knows_probability = false;
      const double density = volume * std::pow(2.0 * M_PI, -1.5) * std::exp(-0.5 * r * r);
      // A moves forwards, its C-obstacle backwards.
      flux -= area * density * n;
      size += area * density * n.cwiseAbs();
      const Eigen::Vector3d of_area = volume * w.inverse().transpose() * n;
      truth.probability -= area * beyond(r) / (4.0 * M_PI * r * r * r) * y.dot(of_area);
    }
    const auto first = static_cast<Eigen::Index>(6 * owner[k]);
    const Eigen::Vector3d& c = scene.a[owner[k]].centre;
    truth.gradient.segment<3>(first) += flux;
    truth.gradient.segment<3>(first + 3) += c.cross(flux);
    truth.doubt.segment<3>(first) += 2e-3 * size;
    truth.doubt.segment<3>(first + 3) += Eigen::Vector3d::Constant(2e-3 * c.norm() * size.norm());
  }
  return truth;
}

enum class Kind { ordinary, rare, likely };

/// A few members of A, at distances from B that differ by what makes P of one a million times that
/// of another.
BallScene randomScene(RandomBodies& random, Kind kind) {
  BallScene scene;
  const double unit = random.logUniform(0.01, 0.1);
  const Eigen::Vector3d deviations =
      unit * Eigen::Vector3d(random.logUniform(0.4, 1.5), random.logUniform(0.4, 1.5),
                             random.logUniform(0.4, 1.5));
  scene.displacement =
      GaussianDisplacement::fromStandardDeviations(deviations, random.quaternion());
  const auto radius = [&] { return unit * random.logUniform(0.3, 1.0); };
  scene.b.push_back({0.3 * random.normalVector(), radius()});
  if (kind == Kind::likely) scene.b[0].radius = unit * random.uniform(2.5, 4.0);
  const int members = random.integer(2, 8);
  for (int i = 0; i < members; ++i) {
    const double r = radius();
    const Eigen::Vector3d along = random.direction();
    const double sigma = (scene.displacement.axes().transpose() * along)
                             .cwiseProduct(scene.displacement.standardDeviations())
                             .norm();
    const double least = kind == Kind::rare ? 3.2 : kind == Kind::likely ? -4.0 : -0.3;
    const double gap = sigma * random.uniform(least, kind == Kind::likely ? -1.0 : 5.0);
    scene.a.push_back({scene.b[0].centre + (scene.b[0].radius + r + gap) * along, r});
  }
  return scene;
}

struct Count {
  int components = 0;
  int small = 0;           ///< of components: below 1 % of the largest
  std::vector<double> of;  ///< standard errors of those that are above 30 %, over their values
  double worst = 0.0;      ///< error over standard error
  double worst_of_probability = 0.0;
};

double inErrors(double off, double doubt, double error) {
  return std::max(0.0, std::fabs(off) - doubt) / error;
}

void add(const BallScene& scene, std::uint64_t seed, std::size_t lines, Count& count) {
  MotionGradientRequest request;
  request.seed = seed;
  request.lines = lines;
  const MotionGradient found = scene.gradient(request);
  const Truth truth = integrated(scene, 10'000);
  const double largest = truth.gradient.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < truth.gradient.size(); ++k) {
    const double value = std::fabs(truth.gradient[k]);
    const double error = found.gradient_standard_error[k];
    const double off = inErrors(found.gradient[k] - truth.gradient[k], truth.doubt[k], error);
    CAPTURE(seed, k, truth.gradient[k], found.gradient[k], error);
    CHECK(off < 6.0);
    CHECK(std::isfinite(error));
    ++count.components;
    count.small += value < 0.01 * largest;
    count.worst = std::max(count.worst, off);
    if (value > 0.3 * largest) count.of.push_back(error / value);
  }
  if (!truth.knows_probability) return;
  const double off =
      inErrors(found.probability - truth.probability,
               5e-3 * std::min(truth.probability, 1.0 - truth.probability), found.standard_error);
  CAPTURE(seed, truth.probability, found.probability, found.standard_error);
  CHECK(off < 6.0);
  count.worst_of_probability = std::max(count.worst_of_probability, off);
}

Count countOf(Kind kind, int scenes, std::size_t lines) {
  RandomBodies random(7);
  Count count;
  for (int i = 0; i < scenes; ++i) {
    add(randomScene(random, kind), static_cast<std::uint64_t>(i) + 1, lines, count);
  }
  std::sort(count.of.begin(), count.of.end());
  return count;
}

void checkErrors(int scenes) {
  for (const std::size_t lines : {256, 4096}) {
    for (const Kind kind : {Kind::ordinary, Kind::rare, Kind::likely}) {
      const Count count = countOf(kind, scenes, lines);
      CAPTURE(static_cast<int>(kind), lines, count.components, count.small, count.worst,
              count.worst_of_probability);
      CHECK(count.small > count.components / 6);
      // They are not just large: but for P near 1, where no line meets what is left.
      if (kind == Kind::likely || lines < 4096) continue;
      CHECK(count.of[count.of.size() / 2] < 0.1);
    }
  }
}

}  // namespace

TEST_CASE("gradients of members that are met often, seldom and never state what they are off") {
  checkErrors(5);
}

TEST_CASE("the same of thousands of components", "[long]") { checkErrors(150); }

TEST_CASE("of a member that is far away it is known that it changes next to nothing") {
  BallScene scene;
  scene.displacement = GaussianDisplacement::fromStandardDeviations({0.1, 0.1, 0.1});
  scene.a = {{{0.0, 0.0, 0.0}, 0.1}, {{0.0, 0.8, 0.0}, 0.1}, {{0.0, 900.0, 0.0}, 0.1}};
  scene.b = {{{0.25, 0.0, 0.0}, 0.1}};
  const MotionGradient found = scene.gradient({});
  const Truth truth = integrated(scene, 10'000);
  const auto sizeOf = [](const Eigen::VectorXd& of, Eigen::Index member) {
    return of.segment<3>(6 * member).norm();
  };
  CHECK(sizeOf(truth.gradient, 1) < 1e-6);
  CHECK(sizeOf(found.gradient_standard_error, 1) < 1e-6);
  CHECK(sizeOf(found.gradient - truth.gradient, 1) <
        6.0 * sizeOf(found.gradient_standard_error, 1));
  CHECK(found.gradient.segment<6>(12).isZero(0.0));
  CHECK(found.gradient_standard_error.segment<6>(12).isZero(0.0));
}
