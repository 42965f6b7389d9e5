// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The quadric along the boundary of contact on sets whose masses are known.
#include <cmath>
#include <random>

#include "catch.h"
#include "pose/boundary_search.h"
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
    CHECK(static_cast<double>(search.questions()) < 3.0 * BoundarySearch::questionsOfPlane(6));
  }
  for (const bool always : {false, true}) {
    const BoundarySearch::Question question = [&](const Eigen::VectorXd&) { return always; };
    CHECK_FALSE(BoundarySearch(question, 6, 9).plane());
  }
}
