// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The control variate on functions whose means are known.
#include <cmath>
#include <random>

#include "catch.h"
#include "fcl_prob/normal_mass.h"
#include "pose/even_regression.h"
#include "pose_cases.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

using Function = std::function<double(const Eigen::VectorXd&)>;

std::vector<AntitheticPair> draw(std::mt19937_64& engine, int count, int dimension,
                                 const Function& f, double noise) {
  std::normal_distribution<double> normal;
  std::vector<AntitheticPair> pairs;
  for (int i = 0; i < count; ++i) {
    Eigen::VectorXd z(dimension);
    for (double& coordinate : z) coordinate = normal(engine);
    pairs.push_back({z, f(z) + noise * normal(engine), f(-z) + noise * normal(engine)});
  }
  return pairs;
}

// Root mean square of error / standard error.
double calibration(int count, int dimension, const Function& f, double truth, double noise) {
  std::mt19937_64 engine(17);
  constexpr int kRepeats = 300;
  double sum = 0.0;
  for (int i = 0; i < kRepeats; ++i) {
    const EstimatedMean mean = meanOfPairs(draw(engine, count, dimension, f, noise));
    const double ratio = (mean.mean - truth) / mean.standard_error;
    sum += ratio * ratio;
  }
  return std::sqrt(sum / kRepeats);
}

}  // namespace

TEST_CASE("a quadratic is integrated exactly once the pairs are enough") {
  std::mt19937_64 engine(1);
  for (const int dimension : {1, 2, 3, 7}) {
    Eigen::MatrixXd h = Eigen::MatrixXd::Random(dimension, dimension);
    h = (h + h.transpose()).eval();
    const Eigen::VectorXd g = Eigen::VectorXd::Random(dimension);
    const auto f = [&](const Eigen::VectorXd& z) { return 0.3 + g.dot(z) + z.dot(h * z); };
    const EstimatedMean mean =
        meanOfPairs(draw(engine, dimension * (dimension + 1) + 8, dimension, f, 0.0));
    CHECK(mean.quadratic);
    CHECK(std::fabs(mean.mean - (0.3 + h.trace())) < 1e-12);
    CHECK(mean.standard_error < 0.3 * h.norm() / std::sqrt(dimension * (dimension + 1) + 8));
  }
}

TEST_CASE("standard errors are calibrated, with and without the control variate") {
  for (const int dimension : {1, 3, 7}) {
    const Eigen::VectorXd g = Eigen::VectorXd::Constant(dimension, 0.2 / std::sqrt(dimension));
    // Φ(a + g·z) has mean Φ(a / √(1 + |g|²)).
    for (const double a : {-0.3, -1.3}) {
      const auto f = [&](const Eigen::VectorXd& z) { return normalCdf(a + g.dot(z)); };
      const double truth = normalCdf(a / std::sqrt(1.0 + g.squaredNorm()));
      for (const int count : {12, 20, 48, 80}) {
        for (const double noise : {0.0, 0.04}) {
          const double rms = calibration(count, dimension, f, truth, noise * truth);
          CAPTURE(dimension, a, count, noise, rms);
          // Without noise what is left is of higher order, and rare where it is large.
          CHECK(rms > (noise > 0.0 ? 0.7 : 0.1));
          CHECK(rms < (noise > 0.0 ? 1.4 : 2.2));
        }
      }
    }
  }
}

TEST_CASE("what is no quadratic does no harm") {
  // An indicator: the plain mean is as good as it gets.
  for (const int dimension : {1, 3}) {
    const auto f = [](const Eigen::VectorXd& z) { return z[0] > 0.7 ? 1.0 : 0.0; };
    const double rms = calibration(60, dimension, f, normalCdf(-0.7), 0.0);
    CAPTURE(dimension, rms);
    CHECK(rms > 0.75);
    CHECK(rms < 1.3);
  }
}
