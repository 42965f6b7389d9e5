// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pairs of convex hulls of so many vertices: their Minkowski sum alone, ConvexPCD, and the exact
// mass.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "convex/convex_mesh.h"
#include "convex/minkowski_sum.h"
#include "fcl_prob/convex_pcd.h"

namespace {

using namespace fcl_prob;

std::vector<Eigen::Vector3d> pointsOnSphere(int count, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const double x = normal(engine), y = normal(engine), z = normal(engine);
    points.push_back(0.5 * Eigen::Vector3d(x, y, z).normalized());
  }
  return points;
}

/// Two hulls, all of whose points are vertices, 5 cm apart; standard deviations of 1, 3 and 5 cm.
struct HullPair {
  explicit HullPair(int vertices) : a(pointsOnSphere(vertices, 1)), b(pointsOnSphere(vertices, 2)) {
    pose_b.translation() = Eigen::Vector3d(1.05, 0.0, 0.0);
    pose_b.linear() =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  }

  ConvexBody a;
  ConvexBody b;
  fcl::Transform3d pose_a = fcl::Transform3d::Identity();
  fcl::Transform3d pose_b = fcl::Transform3d::Identity();
  GaussianDisplacement displacement = GaussianDisplacement::fromStandardDeviations(
      {0.01, 0.03, 0.05}, Eigen::Quaterniond(0.5, 0.1, -0.7, 0.5).normalized());
};

void minkowskiSum(benchmark::State& state) {
  const int vertices = static_cast<int>(state.range(0));
  const detail::ConvexMesh p = detail::makeConvexMesh(pointsOnSphere(vertices, 1));
  const detail::ConvexMesh q = detail::makeConvexMesh(pointsOnSphere(vertices, 2));
  detail::MinkowskiSum sum;
  detail::FaceSet faces;
  for (auto _ : state) benchmark::DoNotOptimize(sum.compute(p, q, faces));
  state.counters["faces"] = static_cast<double>(faces.faceCount());
}
BENCHMARK(minkowskiSum)->Arg(10)->Arg(100)->Arg(300)->Unit(benchmark::kMicrosecond);

/// ConvexPCD with the sum: what one pair of the convex-hull row costs.
void convexPcdOfHulls(benchmark::State& state) {
  const HullPair pair(static_cast<int>(state.range(0)));
  const auto bound = [&] {
    return convexPcd(pair.a, pair.pose_a, pair.b, pair.pose_b, pair.displacement).least;
  };
  for (auto _ : state) benchmark::DoNotOptimize(bound());
  state.counters["bound"] = bound();
}
BENCHMARK(convexPcdOfHulls)->Arg(10)->Arg(100)->Arg(300)->Unit(benchmark::kMicrosecond);

void exactMassOfHulls(benchmark::State& state) {
  const HullPair pair(static_cast<int>(state.range(0)));
  const auto mass = [&] {
    return convexPairMass(pair.a, pair.pose_a, pair.b, pair.pose_b, pair.displacement).middle();
  };
  for (auto _ : state) benchmark::DoNotOptimize(mass());
  state.counters["mass"] = mass();
}
BENCHMARK(exactMassOfHulls)->Arg(10)->Arg(100)->Arg(300)->Unit(benchmark::kMicrosecond);

}  // namespace
