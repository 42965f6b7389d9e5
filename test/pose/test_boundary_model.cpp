// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The quadric along the boundary of contact on sets whose masses are known.
#include <algorithm>
#include <cmath>
#include <random>

#include "base/constants.h"
#include "catch.h"
#include "pose/boundary_search.h"
#include "pose/drawn_along.h"
#include "pose_cases.h"

using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

Eigen::VectorXd normals(std::mt19937_64& engine, Eigen::Index dimension) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd x(dimension);
  for (double& coordinate : x) coordinate = normal(engine);
  return x;
}

}  // namespace

TEST_CASE("the mass within a quadric is that of counting, and of a half-space the closed form") {
  std::mt19937_64 engine(3);
  for (const Eigen::Index dimension : {2, 4, 6, 10}) {
    const Eigen::VectorXd u = normals(engine, dimension).normalized();
    CHECK(std::fabs(BoundaryModel(u, 1.3).mass() - normalCdf(-1.3)) < 1e-12);
    // Points of a bent boundary: u·x = 0.8 + 0.4 w₀ + 0.15 |w|².
    const BoundaryModel straight(u, 0.0);
    Eigen::MatrixXd points(dimension, 4 * BoundaryModel::coefficients(dimension, true));
    const auto level = [](const Eigen::VectorXd& w) {
      return 0.8 + 0.4 * w[0] + 0.15 * w.squaredNorm();
    };
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Eigen::VectorXd w = straight.acrossOf(normals(engine, dimension));
      points.col(i) = straight.pointAt(w, level(w));
    }
    BoundaryModel bent = straight;
    bent.fit(points, true);
    CHECK(bent.spread() < 0.02);
    constexpr int kSamples = 200'000;
    int hits = 0;
    for (int i = 0; i < kSamples; ++i) {
      const Eigen::VectorXd x = normals(engine, dimension);
      hits += u.dot(x) > bent.level(bent.acrossOf(x)) ? 1 : 0;
    }
    const double counted = static_cast<double>(hits) / kSamples;
    CAPTURE(dimension, bent.mass(), counted);
    CHECK(std::fabs(bent.mass() - counted) <=
          5.0 * std::sqrt(counted * (1.0 - counted) / kSamples) + 1e-5);
  }
}

TEST_CASE("a half-space is found from questions, even if it is seen rarely") {
  std::mt19937_64 engine(4);
  for (const double distance : {-1.0, 0.3, 2.0, 3.2}) {
    const Eigen::VectorXd n = normals(engine, 6).normalized();
    const BoundarySearch::Question question = [&](const Eigen::VectorXd& x) {
      return n.dot(x) > distance;
    };
    BoundarySearch search(question, 6, 9);
    const auto model = search.plane();
    REQUIRE(model);
    CHECK(model->direction().dot(n) > 0.98);
    CHECK(std::fabs(model->mass() - normalCdf(-distance)) < 0.2 * normalCdf(-distance));
    CHECK(search.questions() < 540);
  }
  for (const bool always : {false, true}) {
    const BoundarySearch::Question question = [&](const Eigen::VectorXd&) { return always; };
    CHECK_FALSE(BoundarySearch(question, 6, 9).plane());
  }
}

TEST_CASE("a bent boundary is followed the better the more points of it are asked for") {
  const auto level = [](const Eigen::VectorXd& w) {
    return 0.5 + 0.3 * w[0] - 0.1 * w[1] * w[2] + 0.1 * std::sin(2.0 * w[3]);
  };
  const BoundaryModel truth(Eigen::VectorXd::Unit(6, 0), 0.0);
  const BoundarySearch::Question question = [&](const Eigen::VectorXd& x) {
    return x[0] > level(truth.acrossOf(x));
  };
  double before = kInfinity;
  for (const int points_each : {2, 8}) {
    double squares = 0.0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      BoundarySearch search(question, 6, seed);
      auto model = search.plane();
      REQUIRE(model);
      const double asked = static_cast<double>(search.questions());
      const double expected = search.questionsOfBend(points_each);
      search.bend(*model, points_each);
      CHECK(static_cast<double>(search.questions()) - asked < 1.5 * expected);
      CHECK(search.questionsOfBend(points_each) < 0.2 * expected);
      std::mt19937_64 engine(seed);
      for (int i = 0; i < 200; ++i) {
        const Eigen::VectorXd x = normals(engine, 6);
        const Eigen::VectorXd on =
            level(truth.acrossOf(x)) * truth.direction() + (x - x[0] * truth.direction());
        squares += std::pow(model->direction().dot(on) - model->level(model->acrossOf(on)), 2);
      }
    }
    CHECK(squares < before);
    before = 0.9 * squares;
  }
}

TEST_CASE("weights along a line make up the normal density for all shares, and none is too large") {
  for (const double share : {0.3, 0.6, 0.9}) {
    for (const double level : {-4.0, 0.2, 3.0}) {
      for (const double spread : {1e-3, 0.1, 1.0}) {
        const DrawnAlong drawn(level, spread, share);
        constexpr int kParts = 100'000;
        double total = 0.0, above = 0.0, largest = 0.0;
        for (int i = 0; i < kParts; ++i) {
          const double s = drawn.at((i + 0.5) / kParts);
          const double weight = drawn.weightAt(s);
          largest = std::max(largest, weight);
          total += weight / kParts;
          above += s > level ? weight / kParts : 0.0;
        }
        CAPTURE(share, level, spread);
        CHECK(largest <= 1.0 / share + 1e-12);
        CHECK(std::fabs(total - 1.0) < 1e-3);
        CHECK(std::fabs(above - normalCdf(-level)) < 1e-3);
      }
    }
  }
}
