// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/gaussian_displacement.h"

#include <Eigen/LU>
#include <array>
#include <limits>
#include <type_traits>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "high_precision.h"
#include "random_inputs.h"

using fcl_prob_test::HighPrecision;
using fcl_prob_test::logUniform;
using fcl_prob_test::randomQuaternion;
using fcl_prob_test::randomRotation;
using fcl_prob_test::randomVector;
using fcl_prob_test::relativeError;
using fcl_prob_test::uniform;

namespace fcl_prob {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Contains = decltype(Catch::Matchers::Contains(""));

const Vector3d kZero = Vector3d::Zero();

Contains mentions(const std::string& text) { return Catch::Matchers::Contains(text); }

Matrix3d diagonal(double x, double y, double z) { return Vector3d(x, y, z).asDiagonal(); }

// Worst relative error of the three invariants of the eigenvalues, the truth in 50 digits: trace,
// sum of the principal minors, determinant. Well separated eigenvalues are right if these are.
double invariantError(const GaussianDisplacement& displacement) {
  using Wide = Eigen::Matrix<HighPrecision, 3, 3>;
  Wide c;
  Eigen::Matrix<HighPrecision, 3, 1> lambda;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) c(i, j) = displacement.covariance()(i, j);
    const HighPrecision sigma = displacement.standardDeviations()[i];
    lambda[i] = sigma * sigma;
  }
  const auto minor = [&](int i, int j) {
    return HighPrecision(c(i, i) * c(j, j) - c(i, j) * c(j, i));
  };
  const HighPrecision trace = c(0, 0) + c(1, 1) + c(2, 2);
  const HighPrecision minors = minor(0, 1) + minor(0, 2) + minor(1, 2);
  const HighPrecision determinant = c(0, 0) * minor(1, 2) -
                                    c(0, 1) * (c(1, 0) * c(2, 2) - c(1, 2) * c(2, 0)) +
                                    c(0, 2) * (c(1, 0) * c(2, 1) - c(1, 1) * c(2, 0));
  const auto error = [](const HighPrecision& value, const HighPrecision& truth) {
    return abs(value / truth - 1).convert_to<double>();
  };
  return std::max(
      {error(lambda[0] + lambda[1] + lambda[2], trace),
       error(lambda[0] * lambda[1] + lambda[0] * lambda[2] + lambda[1] * lambda[2], minors),
       error(lambda[0] * lambda[1] * lambda[2], determinant)});
}

double rotationDefect(const Matrix3d& axes) {
  return std::max((axes * axes.transpose() - Matrix3d::Identity()).cwiseAbs().maxCoeff(),
                  std::abs(axes.determinant() - 1));
}

}  // namespace

TEST_CASE("a displacement is refused with the offending value in the message") {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::nan("");
  const Matrix3d one = Matrix3d::Identity();
  CHECK_THROWS_AS(GaussianDisplacement(Vector3d(0, nan, 0), one), InvalidDistribution);
  CHECK_THROWS_WITH(GaussianDisplacement(Vector3d(0, nan, 0), one), mentions("nan"));
  CHECK_THROWS_WITH(GaussianDisplacement(Vector3d(1, 2, infinity), one), mentions("(1, 2, inf)"));

  Matrix3d bad = one;
  bad(1, 2) = nan;
  CHECK_THROWS_WITH(GaussianDisplacement(kZero, bad), mentions("covariance(1, 2)"));
  bad = one;
  bad(0, 1) = 0.125;
  CHECK_THROWS_AS(GaussianDisplacement(kZero, bad), InvalidDistribution);
  CHECK_THROWS_WITH(GaussianDisplacement(kZero, bad),
                    mentions("not symmetric") && mentions("0.125"));
  CHECK_THROWS_AS(GaussianDisplacement(kZero, diagonal(1, -0.5, 1)), InvalidDistribution);
  CHECK_THROWS_WITH(GaussianDisplacement(kZero, diagonal(1, -0.5, 1)), mentions("-0.5"));
  CHECK_THROWS_AS(GaussianDisplacement(kZero, diagonal(1, 1, -2e-12)), InvalidDistribution);
  // Three times as much is the variance along (1, 1, 1), which must not overflow.
  CHECK_THROWS_WITH(GaussianDisplacement(kZero, Matrix3d::Constant(1e308)), mentions("1e300"));
  const GaussianDisplacement largest(kZero, Matrix3d::Constant(1e300));
  CHECK(largest.rank() == 1);
  CHECK(largest.standardDeviations()[0] == Approx(std::sqrt(3.0) * 1e150));
  CHECK_THROWS_WITH(GaussianDisplacement::fromIndependent(largest, largest), mentions("1e300"));

  using Factory = GaussianDisplacement;
  CHECK_THROWS_WITH(Factory::fromStandardDeviations({1, -2, 3}), mentions("-2"));
  CHECK_THROWS_WITH(Factory::fromStandardDeviations({1, 1e-310, 3}), mentions("1e-310"));
  CHECK_THROWS_WITH(Factory::fromStandardDeviations({1, nan, 3}), mentions("nan"));
  CHECK_THROWS_AS(Factory::fromStandardDeviations({1, 2, 3}, Eigen::Quaterniond(0, 0, 0, 0)),
                  InvalidDistribution);
  CHECK_THROWS_AS(GaussianDisplacement().withMean(Vector3d(nan, 0, 0)), InvalidDistribution);
  CHECK_THROWS_AS(GaussianDisplacement().rotated(2 * one), InvalidPose);
  CHECK_THROWS_WITH(GaussianDisplacement().rotated(-one), mentions("reflection"));
  CHECK_THROWS_AS(GaussianDisplacement().rotated(nan * one), InvalidPose);
}

TEST_CASE("a covariance by itself has a mean of zero and is checked") {
  Matrix3d covariance = diagonal(0.04, 0.01, 0);
  covariance(0, 1) = covariance(1, 0) = 0.005;
  const GaussianDisplacement by_itself(covariance);
  CHECK(by_itself.mean() == kZero);
  CHECK(by_itself.covariance() == covariance);
  CHECK(by_itself.rank() == 2);
  CHECK_THROWS_WITH(GaussianDisplacement(diagonal(1, -0.5, 1)), mentions("-0.5"));
  // A matrix is no displacement by itself, as a mean is not.
  CHECK_FALSE(std::is_convertible_v<Matrix3d, GaussianDisplacement>);
}

TEST_CASE("what rounding leaves of a valid covariance is accepted") {
  Matrix3d c = Matrix3d::Identity();
  c(0, 1) = 0.5;
  c(1, 0) = 0.5 * (1 + 1e-10);
  CHECK(GaussianDisplacement(kZero, c).covariance() ==
        GaussianDisplacement(kZero, c).covariance().transpose());
  CHECK(GaussianDisplacement(kZero, diagonal(1, 1, -1e-13)).rank() == 2);
  CHECK(GaussianDisplacement(kZero, diagonal(1e300, 1, 1e-300)).rank() == 3);
}

TEST_CASE("principal axes rebuild the covariance") {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const Matrix3d q = randomRotation(random);
    const Vector3d sigma(logUniform(random, 1e-3, 1), logUniform(random, 1e-3, 1),
                         logUniform(random, 1e-3, 1));
    const Matrix3d c = q * sigma.cwiseAbs2().asDiagonal() * q.transpose();
    const GaussianDisplacement d(kZero, 0.5 * (c + c.transpose()));
    REQUIRE(d.rank() == 3);
    CHECK(rotationDefect(d.axes()) < 1e-14);
    const Matrix3d rebuilt =
        d.axes() * d.standardDeviations().cwiseAbs2().asDiagonal() * d.axes().transpose();
    CHECK((rebuilt - d.covariance()).cwiseAbs().maxCoeff() < 1e-14 * c.cwiseAbs().maxCoeff());
    CHECK(d.standardDeviations()[0] >= d.standardDeviations()[1]);
    CHECK(d.standardDeviations()[1] >= d.standardDeviations()[2]);
  }
}

TEST_CASE("standard deviations of a graded covariance keep their relative accuracy") {
  const GaussianDisplacement d(kZero, diagonal(1e-30, 1, 1e-16));
  CHECK(d.rank() == 3);
  CHECK(d.standardDeviations() == Vector3d(1, 1e-8, 1e-15));

  std::mt19937 random(2);
  int ill_conditioned = 0;
  for (int i = 0; i < 500; ++i) {
    // A well conditioned matrix, its rows and columns scaled: the covariance of axes in mixed
    // scales.
    const Matrix3d q = randomRotation(random);
    const Matrix3d core = q * diagonal(1, 0.5, 0.25) * q.transpose();
    const Vector3d scale(1, logUniform(random, 1e-9, 1), logUniform(random, 1e-9, 1));
    const Matrix3d c = scale.asDiagonal() * core * scale.asDiagonal();
    const GaussianDisplacement graded(kZero, 0.5 * (c + c.transpose()));
    REQUIRE(graded.rank() == 3);
    CHECK(invariantError(graded) < 1e-13);
    ill_conditioned += graded.standardDeviations()[2] < 1e-6 * graded.standardDeviations()[0];
  }
  CHECK(ill_conditioned > 100);
}

TEST_CASE("the rank of a rotated singular covariance is found at every condition number") {
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    const int rank = 1 + i % 3;
    Vector3d sigma = kZero;
    for (int k = 0; k < rank; ++k) sigma[k] = logUniform(random, 1e-5, 1);
    sigma *= logUniform(random, 1e-100, 1e100);
    const Matrix3d q = randomRotation(random);
    const Matrix3d c = q * sigma.cwiseAbs2().asDiagonal() * q.transpose();
    const GaussianDisplacement d(kZero, 0.5 * c + 0.5 * c.transpose());
    REQUIRE(d.rank() == rank);
    std::sort(sigma.data(), sigma.data() + 3, std::greater<double>());
    for (int k = 0; k < 3; ++k) {
      const double noise = 1e-15 * sigma[0] * sigma[0] / (sigma[k] + 1e-5 * sigma[0]);
      CHECK(std::abs(d.standardDeviations()[k] - sigma[k]) <= 20 * noise);
    }
  }
  CHECK(GaussianDisplacement().rank() == 0);
  CHECK(GaussianDisplacement(kZero, Matrix3d::Zero()).rank() == 0);
  CHECK(GaussianDisplacement(kZero, Matrix3d::Ones()).rank() == 1);
}

TEST_CASE("given standard deviations are kept exactly, also where their squares underflow") {
  std::mt19937 random(4);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Quaterniond q = randomQuaternion(random);
    const Vector3d mean = randomVector(random);
    const auto d = GaussianDisplacement::fromStandardDeviations({1e-200, 3, 1e-12}, q, mean);
    CHECK(d.standardDeviations() == Vector3d(3, 1e-12, 1e-200));
    CHECK(d.rank() == 3);
    CHECK(d.mean() == mean);
    CHECK(rotationDefect(d.axes()) < 1e-14);
    CHECK((d.axes().col(0) - q * Vector3d::UnitY()).norm() < 1e-14);
    CHECK((d.axes().col(1) - q * Vector3d::UnitZ()).norm() < 1e-14);
  }
  const auto scaled =
      GaussianDisplacement::fromStandardDeviations({1, 2, 3}, Eigen::Quaterniond(0, 0, 0, 1e-200));
  CHECK(scaled.covariance() == diagonal(1, 4, 9));
  const auto flat = GaussianDisplacement::fromStandardDeviations({0, 2, 0});
  CHECK(flat.rank() == 1);
  CHECK(flat.axes().col(0).cwiseAbs() == Vector3d::UnitY());
}

TEST_CASE("only equal standard deviations are isotropic") {
  std::mt19937 random(5);
  const Matrix3d q = randomRotation(random);
  const Matrix3d c = q * diagonal(4, 4, 4) * q.transpose();
  CHECK(GaussianDisplacement(kZero, 0.5 * (c + c.transpose())).isotropic());
  CHECK(GaussianDisplacement::fromStandardDeviations({2, 2, 2}).isotropic());
  CHECK_FALSE(GaussianDisplacement::fromStandardDeviations({2, 2, 2 * (1 - 1e-11)}).isotropic());
  CHECK_FALSE(GaussianDisplacement::fromStandardDeviations({2, 2, 0}).isotropic());
  CHECK_FALSE(GaussianDisplacement().isotropic());
}

TEST_CASE("independent displacements add their covariances and subtract their means") {
  std::mt19937 random(6);
  for (int i = 0; i < 300; ++i) {
    const auto randomDisplacement = [&] {
      const Vector3d sigma(uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1));
      return GaussianDisplacement::fromStandardDeviations(sigma, randomQuaternion(random),
                                                          randomVector(random));
    };
    const auto a = randomDisplacement();
    const auto b = randomDisplacement();
    const auto sum = GaussianDisplacement::fromIndependent(a, b);
    CHECK(sum.mean() == a.mean() - b.mean());
    CHECK(sum.covariance() == a.covariance() + b.covariance());
    CHECK(rotationDefect(sum.axes()) < 1e-14);
    CHECK(invariantError(sum) < 1e-12);
  }
}

TEST_CASE("the sum of independent displacements keeps small common axes and finds the rank") {
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Quaterniond q = randomQuaternion(random);
    const auto a = GaussianDisplacement::fromStandardDeviations({1, 1e-4, 3e-12}, q);
    const auto b = GaussianDisplacement::fromStandardDeviations({1, 1e-4, 4e-12}, q);
    const auto sum = GaussianDisplacement::fromIndependent(a, b);
    CHECK(sum.rank() == 3);
    CHECK(sum.standardDeviations()[2] == Approx(5e-12).epsilon(1e-3));

    const auto line = GaussianDisplacement::fromStandardDeviations({1, 0, 0}, q);
    CHECK(GaussianDisplacement::fromIndependent(line, line).rank() == 1);
    const auto other =
        GaussianDisplacement::fromStandardDeviations({1, 0, 0}, randomQuaternion(random));
    CHECK(GaussianDisplacement::fromIndependent(line, other).rank() == 2);
  }
  const auto tiny = GaussianDisplacement::fromStandardDeviations({1e-180, 0, 1e-190});
  const auto sum = GaussianDisplacement::fromIndependent(tiny, tiny);
  CHECK(sum.rank() == 2);
  CHECK(sum.standardDeviations()[0] == Approx(std::sqrt(2) * 1e-180).epsilon(1e-15));
  CHECK(GaussianDisplacement::fromIndependent(GaussianDisplacement(), GaussianDisplacement())
            .rank() == 0);
}

TEST_CASE("without its last axis a displacement varies along the others as before") {
  const Vector3d mean(1, 2, 3);
  const Matrix3d axes = Eigen::Quaterniond(1, 2, -1, 3).normalized().toRotationMatrix();
  GaussianDisplacement all(mean, axes * diagonal(4.0, 1.0, 1e-6) * axes.transpose());
  for (int rank = 3; rank > 0; --rank) {
    const GaussianDisplacement less = all.withoutLastAxis();
    CHECK(less.rank() == rank - 1);
    CHECK(less.mean() == mean);
    CHECK(less.axes() == all.axes());
    const Vector3d last = all.axes().col(rank - 1);
    CHECK(last.dot(less.covariance() * last) == Approx(0.0).margin(1e-15));
    const double variance = all.standardDeviations()[rank - 1] * all.standardDeviations()[rank - 1];
    CHECK((less.covariance() + variance * last * last.transpose() - all.covariance()).norm() <
          1e-14);
    all = less;
  }
  CHECK(all.withoutLastAxis().rank() == 0);
  CHECK(all.withoutLastAxis().covariance().isZero(0.0));
}

TEST_CASE("reversing mirrors the mean, rotating turns mean, axes and covariance") {
  std::mt19937 random(8);
  for (int i = 0; i < 200; ++i) {
    const auto d = GaussianDisplacement::fromStandardDeviations(
        {1e-9, 2, 0}, randomQuaternion(random), randomVector(random));
    CHECK(d.reversed().mean() == -d.mean());
    CHECK(d.reversed().covariance() == d.covariance());
    const Matrix3d r = randomRotation(random);
    const auto turned = d.rotated(r);
    CHECK(turned.standardDeviations() == d.standardDeviations());
    CHECK((turned.mean() - r * d.mean()).norm() < 1e-15);
    CHECK((turned.axes() - r * d.axes()).cwiseAbs().maxCoeff() == 0);
    CHECK((turned.covariance() - r * d.covariance() * r.transpose()).cwiseAbs().maxCoeff() < 1e-14);
    CHECK(turned.covariance() == turned.covariance().transpose());
    CHECK(d.withMean(kZero).mean() == kZero);
    CHECK(d.withMean(kZero).standardDeviations() == d.standardDeviations());
  }
}

using WideVector = Eigen::Matrix<HighPrecision, 3, 1>;
using WideMatrix = Eigen::Matrix<HighPrecision, 3, 3>;

// R A D in 50 digits, where Σ = A D² Aᵀ: with its transpose it is R Σ Rᵀ, R as it is.
WideMatrix rotatedFactor(const GaussianDisplacement& d, const Matrix3d& r) {
  return r.cast<HighPrecision>() * d.axes().cast<HighPrecision>() *
         d.standardDeviations().cast<HighPrecision>().asDiagonal();
}

// Sums of the squares of all minors of each order, in which nothing cancels (Cauchy and Binet).
std::array<HighPrecision, 3> squaredMinors(const WideMatrix& f) {
  const WideVector x = f.col(0), y = f.col(1), z = f.col(2);
  const HighPrecision volume = x.dot(y.cross(z));
  return {f.squaredNorm(),
          x.cross(y).squaredNorm() + x.cross(z).squaredNorm() + y.cross(z).squaredNorm(),
          volume * volume};
}

TEST_CASE("a displacement rotated by a matrix that is nearly a rotation") {
  std::mt19937 random(81);
  for (int i = 0; i < 2000; ++i) {
    const int rank = i % 4;
    const double least = i % 3 ? logUniform(random, 1e-140, 1.0) : 1.0;
    const double scale = logUniform(random, 1e-140, 1e140);
    Vector3d sigma = Vector3d::Zero();
    for (int k = 0; k < rank; ++k) sigma[k] = scale * logUniform(random, 0.999 * least, 1.0);
    auto d = GaussianDisplacement::fromStandardDeviations(sigma, randomQuaternion(random));
    Matrix3d r = randomRotation(random);
    const double off = logUniform(random, 1e-16, 2e-10);
    for (int k = 0; k < 9; ++k) r(k / 3, k % 3) += uniform(random, -off, off);
    const auto rotated = d.rotated(r);
    INFO("case " << i << " deviations " << d.standardDeviations().transpose() << " off by " << off);
    CHECK(rotated.rank() == rank);
    CHECK(rotationDefect(rotated.axes()) < 3e-15);
    // The largest deviations first: each order of minors shows one more of them.
    const WideMatrix factor = rotatedFactor(d, r);
    const auto truth = squaredMinors(factor);
    const WideMatrix diagonal = rotated.standardDeviations().cast<HighPrecision>().asDiagonal();
    const auto found = squaredMinors(diagonal);
    for (int k = 0; k < rank; ++k) CHECK(abs(found[k] / truth[k] - 1) <= 1e-13);
    // Whitened by the transpose, what is rotated has the identity as its covariance.
    if (least < 1.0 || rank == 0) continue;
    const WideMatrix turned = rotated.axes().cast<HighPrecision>().transpose() * factor;
    const WideMatrix covariance = turned * turned.transpose();
    for (int k = 0; k < rank; ++k) {
      for (int j = 0; j < rank; ++j) {
        const HighPrecision one = diagonal(k, k) * diagonal(j, j);
        CHECK(abs(covariance(k, j) / one - (k == j ? 1 : 0)) <= 1e-14);
      }
    }
  }
}

TEST_CASE("rotating again and again keeps axes that are a rotation") {
  std::mt19937 random(82);
  auto d = GaussianDisplacement::fromStandardDeviations({3, 2, 1}, randomQuaternion(random));
  for (int i = 0; i < 20000; ++i) d = d.rotated(randomRotation(random));
  CHECK(rotationDefect(d.axes()) < 3e-15);
  CHECK((d.standardDeviations() - Vector3d(3, 2, 1)).norm() < 1e-10);
}

TEST_CASE("a quaternion of any length, as small or large as doubles go, is the same rotation") {
  const Eigen::Vector4d coefficients(0.25, -0.5, 0.75, 1.0);
  const auto axesFor = [&](double length) {
    const Eigen::Quaterniond axes(Eigen::Vector4d(length * coefficients));
    return GaussianDisplacement::fromStandardDeviations({3, 2, 1}, axes).axes();
  };
  const Matrix3d expected = axesFor(1.0);
  for (const double length : {0x1p-1060, 0x1p-1030, 0x1p-300, 0x1p300, 0x1p1020}) {
    CAPTURE(length);
    CHECK(axesFor(length) == expected);
  }
}

}  // namespace fcl_prob
