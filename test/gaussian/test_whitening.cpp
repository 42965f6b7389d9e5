// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/whitening.h"

#include <limits>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "random_inputs.h"

using fcl_prob_test::logUniform;
using fcl_prob_test::randomQuaternion;
using fcl_prob_test::randomVector;

namespace fcl_prob {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

GaussianDisplacement randomDisplacement(std::mt19937& random, int rank) {
  Vector3d sigma = Vector3d::Zero();
  for (int k = 0; k < rank; ++k) sigma[k] = logUniform(random, 1e-4, 1e4);
  return GaussianDisplacement::fromStandardDeviations(sigma, randomQuaternion(random),
                                                      randomVector(random));
}

// W Σ Wᵀ must be 1 in the moving coordinates and 0 in the others.
double covarianceDefect(const Whitening& w, const GaussianDisplacement& d) {
  Matrix3d expected = Matrix3d::Zero();
  for (int k = 0; k < d.rank(); ++k) expected(k, k) = 1;
  const Matrix3d factor = w.matrix() * d.axes() * d.standardDeviations().asDiagonal();
  return (factor * factor.transpose() - expected).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("whitening turns the covariance into the identity of its rank") {
  std::mt19937 random(1);
  for (int i = 0; i < 400; ++i) {
    const GaussianDisplacement d = randomDisplacement(random, i % 4);
    const Whitening w(d, 1e3);
    CHECK(w.rank() == d.rank());
    CHECK(w.mean() == d.mean());
    CHECK(covarianceDefect(w, d) < 1e-7);
    CHECK(w.apply(d.mean()) == Vector3d::Zero());
    const Vector3d y = randomVector(random);
    CHECK((w.apply(w.unapply(y)) - y).norm() < 1e-6 * y.norm());
    for (int k = 0; k < d.rank(); ++k) {
      const Vector3d step = d.standardDeviations()[k] * d.axes().col(k);
      CHECK((w.matrix() * step - Vector3d::Unit(k)).norm() < 1e-7);
    }
  }
}

TEST_CASE("coordinates that do not move are lengths over the length unit") {
  std::mt19937 random(2);
  for (int rank = 0; rank < 3; ++rank) {
    const GaussianDisplacement d = randomDisplacement(random, rank);
    const Whitening w(d, 0.25);
    for (int k = rank; k < 3; ++k) {
      const Vector3d y = w.apply(d.mean() + 0.5 * d.axes().col(k));
      CHECK((y - 2 * Vector3d::Unit(k)).norm() < 1e-10);
    }
  }
  CHECK_THROWS_AS(Whitening(GaussianDisplacement(), 0), InvalidDistribution);
  CHECK_THROWS_AS(Whitening(GaussianDisplacement(), std::nan("")), InvalidDistribution);
  CHECK_THROWS_AS(Whitening(GaussianDisplacement(), std::numeric_limits<double>::infinity()),
                  InvalidDistribution);
}

TEST_CASE("a whitening rotated to a direction stays a whitening") {
  std::mt19937 random(3);
  for (int i = 0; i < 400; ++i) {
    const int rank = i % 4;
    const GaussianDisplacement d = randomDisplacement(random, rank);
    const Whitening w(d);
    const Vector3d direction = randomVector(random) * logUniform(random, 1e-200, 1e200);
    const Whitening turned = w.rotatedTo(direction);
    CHECK(covarianceDefect(turned, d) < 1e-7);
    CHECK((turned.inverse() * turned.matrix() - Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6);
    if (rank < 2) {
      CHECK(turned.matrix() == w.matrix());
      continue;
    }
    // The image of the direction's moving part: first axis, positive.
    Vector3d moving = direction.stableNormalized();
    for (int k = rank; k < 3; ++k) moving[k] = 0;
    const Vector3d image = turned.matrix() * (w.inverse() * moving);
    CHECK((image - moving.norm() * Vector3d::UnitX()).norm() < 1e-6);
    // Same distances, same fixed coordinates.
    const Vector3d point = d.mean() + randomVector(random);
    CHECK(turned.apply(point).norm() == Approx(w.apply(point).norm()).epsilon(1e-7));
    if (rank == 2) CHECK(turned.apply(point).z() == w.apply(point).z());
  }
}

TEST_CASE("a whitening stays as it is when the direction has no moving part") {
  const Whitening w(GaussianDisplacement::fromStandardDeviations({3, 2, 0}));
  CHECK(w.rotatedTo(Vector3d::UnitZ()).matrix() == w.matrix());
  CHECK(w.rotatedTo(Vector3d::Zero()).matrix() == w.matrix());
}

}  // namespace fcl_prob
