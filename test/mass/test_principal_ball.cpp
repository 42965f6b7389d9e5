// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of balls against quadrature, series and closed forms in 50 digits.
#include "mass/principal_ball.h"

#include <boost/math/special_functions/gamma.hpp>
#include <vector>

#include "catch.h"
#include "disc_truth.h"
#include "fcl_prob/normal_mass.h"
#include "high_precision.h"
#include "random_inputs.h"

using fcl_prob_test::densityOf;
using fcl_prob_test::DiscTruth;
using fcl_prob_test::HighPrecision;
using fcl_prob_test::intervalOf;
using fcl_prob_test::logUniform;
using fcl_prob_test::QuadPrecision;
using fcl_prob_test::uniform;

namespace fcl_prob {
namespace {

using detail::PrincipalBall;
using detail::principalBallMass;

struct BallCase {
  Eigen::Vector3d deviations;  // descending
  Eigen::Vector3d centre;
  double radius;
};

// Ruben, "Probability content of regions under spherical normal distributions, IV", Annals of
// Mathematical Statistics 33 (1962): a mixture of chi-square distributions, all terms positive.
HighPrecision rubenMass(const BallCase& one, int terms) {
  std::array<HighPrecision, 3> gamma, shift;
  const HighPrecision beta = HighPrecision(one.deviations.z()) * one.deviations.z();
  HighPrecision first = 1, exponent = 0;
  for (int j = 0; j < 3; ++j) {
    const HighPrecision deviation = one.deviations[j], c = one.centre[j] / deviation;
    gamma[j] = 1 - beta / (deviation * deviation);
    shift[j] = c * c;
    first *= sqrt(beta) / deviation;
    exponent += shift[j] / 2;
  }
  std::vector<HighPrecision> weights{first * exp(-exponent)}, growth{0};
  std::array<HighPrecision, 3> power{1, 1, 1};
  for (int k = 1; k < terms; ++k) {
    HighPrecision g = 0;
    for (int j = 0; j < 3; ++j) {
      g += k * shift[j] * power[j] * (1 - gamma[j]);
      power[j] *= gamma[j];
      g += power[j];
    }
    growth.push_back(g / 2);
    HighPrecision sum = 0;
    for (int r = 0; r < k; ++r) sum += growth[k - r] * weights[r];
    weights.push_back(sum / k);
  }
  // F_{n+2k} = F_{n+2k+2} + x^a exp(-x) / Γ(a + 1), downwards.
  const HighPrecision x = HighPrecision(one.radius) * one.radius / beta / 2;
  HighPrecision a = HighPrecision(3) / 2 + terms, cdf = boost::math::gamma_p(a, x), sum = 0;
  HighPrecision step = boost::math::gamma_p_derivative(a, x) * x / a;
  for (int k = terms - 1; k >= 0; --k) {
    step *= a / x;
    a -= 1;
    cdf += step;
    sum += weights[k] * cdf;
  }
  return sum;
}

PrincipalBall ballOf(const BallCase& one) {
  PrincipalBall ball;
  for (int k = 0; k < 3; ++k) ball.centre[k] = one.centre[k];
  ball.radius = one.radius;
  return ball;
}

Bounds massOf(const BallCase& one) {
  return principalBallMass(ballOf(one),
                           GaussianDisplacement::fromStandardDeviations(one.deviations));
}

// A ball whose nearest point is `depth` deviations away (inside for < 0), of a size next to that of
// the least deviation (even) or between the least and the largest.
BallCase randomCase(std::mt19937& random, int rank, double most_ratio, double most_size) {
  BallCase one;
  one.deviations.setZero();
  one.centre.setZero();
  double deviation = logUniform(random, 1e-3, 1e3);
  for (int k = rank - 1; k >= 0; --k) {
    one.deviations[k] = deviation;
    if (uniform(random, 0, 1) < 0.8) deviation *= logUniform(random, 1, most_ratio);
  }
  one.radius = one.deviations[rank - 1] * logUniform(random, 1e-3, most_size);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (int k = 0; k < rank; ++k) normal[k] = std::abs(uniform(random, -1, 1));
  if (uniform(random, 0, 1) < 0.3) normal[static_cast<int>(uniform(random, 0, rank))] = 0.0;
  if (normal.norm() == 0.0) normal[0] = 1.0;
  normal.normalize();
  const double depth =
      uniform(random, 0, 1) < 0.4 ? uniform(random, -15, 5) : uniform(random, 0, 36);
  const Eigen::Vector3d away = normal.cwiseProduct(one.deviations).normalized();
  one.centre = (one.radius * normal + depth * away.cwiseProduct(one.deviations)).cwiseAbs();
  return one;
}

struct Tally {
  double worst_width = 0;
  int count = 0, tail = 0, sure = 0, small = 0;

  void check(const BallCase& one, const HighPrecision& truth, double promised) {
    if (truth < 1e-280) return;
    const Bounds bounds = massOf(one);
    CAPTURE(one.deviations, one.centre, one.radius, bounds.lower, bounds.upper, truth);
    // What the truth itself is computed to.
    const HighPrecision margin = truth * 1e-16;
    REQUIRE(bounds.lower <= truth + margin);
    REQUIRE(bounds.upper >= truth - margin);
    REQUIRE(bounds.upper <= 1);
    const double width = bounds.width() / bounds.upper;
    CHECK(width <= promised);
    worst_width = std::max(worst_width, width);
    ++count;
    tail += truth < 1e-50;
    sure += truth > 0.99;
    small += one.radius < 0.1 * one.deviations.maxCoeff();
  }
};

template <class Number>
Tally checkDiscs(int seed, int cases) {
  std::mt19937 random(seed);
  Tally tally;
  for (int i = 0; i < cases; ++i) {
    const BallCase one = randomCase(random, 2, i % 2 == 0 ? 10.0 : 1e12, 1e3);
    const DiscTruth<Number> truth(one.centre.x(), one.centre.y(), one.radius, one.deviations.x(),
                                  one.deviations.y());
    tally.check(one, HighPrecision(truth.mass()), 1e-10);
  }
  return tally;
}

}  // namespace

TEST_CASE("disc masses from 1e-280 to 1, axes from equal to 1e12 apart") {
  const Tally tally = checkDiscs<QuadPrecision>(1, 60);
  CHECK(tally.count > 45);
  CHECK(tally.tail > 10);
  CHECK(tally.sure >= 3);
  CHECK(tally.small > 15);
}

TEST_CASE("disc masses in 50 digits, and thousands of them in 34", "[long]") {
  CHECK(checkDiscs<HighPrecision>(2, 200).count > 150);
  CHECK(checkDiscs<QuadPrecision>(3, 5000).count > 4000);
}

TEST_CASE("ball masses of three different deviations against Ruben's series") {
  std::mt19937 random(3);
  Tally tally;
  for (int i = 0; i < 150; ++i) {
    const BallCase one = randomCase(random, 3, 3.0, 3.0);
    const double noncentral = one.centre.cwiseQuotient(one.deviations).squaredNorm();
    if (noncentral > 150) continue;
    tally.check(one, rubenMass(one, 700), 1e-10);
  }
  CHECK(tally.count > 50);
  CHECK(tally.small > 10);
}

TEST_CASE("ball masses of equal deviations against the closed form") {
  std::mt19937 random(4);
  int count = 0;
  for (int i = 0; i < 500; ++i) {
    const BallCase one = randomCase(random, 3, 1.0, 1e3);
    const double sigma = one.deviations.x();
    const HighPrecision distance = sqrt(HighPrecision(one.centre.x()) * one.centre.x() +
                                        HighPrecision(one.centre.y()) * one.centre.y() +
                                        HighPrecision(one.centre.z()) * one.centre.z()) /
                                   sigma;
    const HighPrecision radius = HighPrecision(one.radius) / sigma;
    const HighPrecision truth = intervalOf<HighPrecision>(distance - radius, distance + radius) -
                                (densityOf<HighPrecision>(distance - radius) -
                                 densityOf<HighPrecision>(distance + radius)) /
                                    distance;
    if (truth < 1e-280 || radius < 1e-2) continue;
    const Bounds bounds = massOf(one);
    CAPTURE(one.deviations, one.centre, one.radius, bounds.lower, bounds.upper, truth);
    REQUIRE(bounds.lower <= truth * (1 + 1e-16));
    REQUIRE(bounds.upper >= truth * (1 - 1e-16));
    CHECK(bounds.width() <= (one.radius < 500 * sigma ? 1e-10 : 2e-10) * bounds.upper);
    ++count;
  }
  CHECK(count > 200);
}

/// Of the cube with the ball's centre and the given half of an edge.
HighPrecision cubeMass(const BallCase& one, const HighPrecision& half) {
  HighPrecision mass = 1;
  for (int k = 0; k < 3; ++k) {
    const HighPrecision sigma = one.deviations[k], centre = one.centre[k];
    mass *= intervalOf<HighPrecision>((centre - half) / sigma, (centre + half) / sigma);
  }
  return mass;
}

TEST_CASE(
    "balls of deviations up to 450 orders of magnitude apart hold the cubes in and around them") {
  std::mt19937 random(7);
  int known = 0;
  for (int i = 0; i < 2000; ++i) {
    BallCase one;
    const double least = i % 2 == 0 ? 1e-300 : 1e-80, most = i % 3 == 0 ? 1e150 : 1e80;
    for (int k = 0; k < 3; ++k) one.deviations[k] = logUniform(random, least, most);
    if (i == 0) one.deviations << 1e60, 1.0, 1e-300;
    std::sort(one.deviations.data(), one.deviations.data() + 3, std::greater<>());
    one.radius = 1.0;
    one.centre << 0.4, 0.2, uniform(random, 0.0, 0.9);
    const Bounds bounds = massOf(one);
    CAPTURE(one.deviations, one.centre, bounds.lower, bounds.upper);
    REQUIRE(bounds.lower <= cubeMass(one, 1) * (1 + 1e-15));
    REQUIRE(bounds.upper >= cubeMass(one, 1 / sqrt(HighPrecision(3))) * (1 - 1e-15));
    known += bounds.upper < 1.0 || bounds.lower > 0.0;
  }
  CHECK(known > 1000);
}

TEST_CASE("a ball on a line, and axes along which nothing moves") {
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    BallCase one = randomCase(random, 1, 1.0, 1e3);
    one.centre.y() = i % 2 == 0 ? 0.0 : 0.6 * one.radius;
    const HighPrecision half = sqrt(HighPrecision(one.radius) * one.radius -
                                    HighPrecision(one.centre.y()) * one.centre.y());
    const HighPrecision sigma = one.deviations.x(), x = one.centre.x();
    const HighPrecision truth = intervalOf<HighPrecision>((x - half) / sigma, (x + half) / sigma);
    if (truth < 1e-280) continue;
    const Bounds bounds = massOf(one);
    CAPTURE(one.deviations, one.centre, one.radius, bounds.lower, bounds.upper, truth);
    REQUIRE(bounds.lower <= truth);
    REQUIRE(bounds.upper >= truth);
    CHECK(bounds.width() <= 1e-10 * bounds.upper);
    one.centre.y() = 1.001 * one.radius;
    CHECK(massOf(one).upper == 0.0);
  }
}

TEST_CASE("errors of a ball's centre and radius widen its mass") {
  std::mt19937 random(6);
  for (int i = 0; i < 200; ++i) {
    const int rank = 1 + i % 3;
    const BallCase one = randomCase(random, rank, 10.0, 10.0);
    const auto displacement = GaussianDisplacement::fromStandardDeviations(one.deviations);
    PrincipalBall ball = ballOf(one);
    ball.centre_error = one.deviations[rank - 1] * logUniform(random, 1e-12, 0.1);
    ball.radius_error = one.radius * logUniform(random, 1e-12, 0.1);
    const Bounds wide = principalBallMass(ball, displacement);
    BallCase moved = one;
    for (int k = 0; k < 3; ++k) moved.centre[k] += uniform(random, -1, 1) * ball.centre_error;
    moved.radius += uniform(random, -1, 1) * ball.radius_error;
    const Bounds inside = massOf(moved);
    CAPTURE(one.deviations, one.centre, one.radius, ball.centre_error, ball.radius_error);
    CHECK(wide.lower <= inside.upper);
    CHECK(wide.upper >= inside.lower);
    const Bounds known = massOf(one);
    CHECK(wide.lower <= known.upper);
    CHECK(wide.upper >= known.lower);
    CHECK(wide.width() >= 0.9 * known.width());
  }
}

}  // namespace fcl_prob
