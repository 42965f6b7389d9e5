// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Sections of every scale and thinness against truth in 50 digits: a deviation and a length are
// never compared, and nothing thin is taken for flat.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "catch.h"
#include "fcl_prob/convex_pcd.h"
#include "fcl_prob/normal_mass.h"
#include "high_precision.h"
#include "mass/exact_hull.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using fcl_prob::Bounds;
using fcl_prob::ConvexBody;
using fcl_prob::GaussianDisplacement;

using Digits50 = HighPrecision;
using Vector = std::array<Digits50, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Digits50 dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector exactly(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

struct PlacedBox {
  Eigen::Vector3d sides;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

/// Half the sides as vectors of the world, with the matrix as it is.
void addGenerators(const PlacedBox& box, std::vector<Vector>& generators) {
  for (int k = 0; k < 3; ++k) {
    Vector g = exactly(box.pose.linear().col(k));
    for (Digits50& x : g) x *= Digits50(box.sides[k]) / 2;
    generators.push_back(g);
  }
}

/// The mass of the part of the line { t σ axis } in the zonotope of all differences of two boxes,
/// where that is widened by `by` (may be negative): an intersection of slabs.
Digits50 trueLineMass(const PlacedBox& a, const PlacedBox& b, const GaussianDisplacement& d,
                      double by) {
  std::vector<Vector> generators;
  addGenerators(a, generators);
  addGenerators(b, generators);
  const Vector from = exactly(a.pose.translation()), to = exactly(b.pose.translation());
  const Vector mean = exactly(d.mean()), axis = exactly(d.axes().col(0));
  Vector centre;
  for (int k = 0; k < 3; ++k) centre[k] = to[k] - from[k] - mean[k];
  Digits50 first = -1000, last = 1000;
  for (std::size_t i = 0; i < generators.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vector n = cross(generators[i], generators[j]);
      const Digits50 length = sqrt(dot(n, n));
      const Digits50 sizes =
          sqrt(dot(generators[i], generators[i]) * dot(generators[j], generators[j]));
      if (length <= Digits50(1e-40) * sizes) continue;  // parallel
      Digits50 half = Digits50(by) * length;
      for (const Vector& g : generators) half += abs(dot(n, g));
      if (half < 0) return 0;
      const Digits50 middle = dot(n, centre);
      const Digits50 slope = dot(n, axis) * Digits50(d.standardDeviations()[0]);
      if (abs(slope) <= Digits50(1e-45) * length * Digits50(d.standardDeviations()[0])) {
        if (abs(middle) > half) return 0;
        continue;
      }
      const Digits50 p = (middle - half) / slope, q = (middle + half) / slope;
      first = std::max(first, std::min(p, q));
      last = std::min(last, std::max(p, q));
    }
  }
  return first < last ? trueIntervalMass(first, last) : Digits50(0);
}

/// A body is moved inwards by `by` by shrinking it to a point, by a share of its least width.
PlacedBox shrunk(PlacedBox box, double by) {
  box.sides *= std::max(0.0, 1.0 - 4.0 * by / box.sides.minCoeff());
  return box;
}

double sizeOf(const PlacedBox& box) { return box.sides.norm() + box.pose.translation().norm(); }

PlacedBox randomBox(RandomBodies& random, double scale) {
  PlacedBox box;
  for (double& side : box.sides) {
    side = scale * random.logUniform(0.3, 3.0) *
           (random.integer(0, 3) ? 1.0 : random.logUniform(1e-9, 1.0));
  }
  switch (random.integer(0, 2)) {
    case 0:
      box.pose.linear() = random.rotation();
      break;
    case 1:
      box.pose.linear() =
          Eigen::AngleAxisd(random.logUniform(1e-15, 1e-3), random.direction()).toRotationMatrix();
      break;
    default:
      break;
  }
  return box;
}

bool holds(const Bounds& bounds, const Digits50& least, const Digits50& most) {
  return Digits50(bounds.lower) <= most * (1 + Digits50(1e-30)) &&
         Digits50(bounds.upper) >= least * (1 - Digits50(1e-30));
}

TEST_CASE("the exact mass of boxes along a line at every scale and thinness") {
  RandomBodies random(1201);
  int resolved = 0;
  for (int i = 0; i < 3000; ++i) {
    const double scale = random.integer(0, 2) ? std::pow(10.0, random.uniform(-131, 140)) : 1.0;
    const PlacedBox a = randomBox(random, scale);
    PlacedBox b = randomBox(random, scale);
    // Within reach of the line, often by little: deep in the thinnest side.
    b.pose.translation() =
        0.5 * b.pose.linear() * b.sides.cwiseProduct(Eigen::Vector3d::NullaryExpr([&] {
          return random.uniform(-1.2, 1.2);
        }));
    const double deviation = scale * random.logUniform(1e-15, 10.0);
    const Eigen::Quaterniond axes =
        random.integer(0, 1) ? random.quaternion() : Eigen::Quaterniond::Identity();
    const Eigen::Vector3d mean = 0.1 * deviation * random.normalVector();
    b.pose.translation() += mean;
    const auto displacement =
        GaussianDisplacement::fromStandardDeviations({deviation, 0.0, 0.0}, axes, mean);
    const Bounds bounds = convexPairMass(ConvexBody(fcl::Boxd(a.sides)), a.pose,
                                         ConvexBody(fcl::Boxd(b.sides)), b.pose, displacement);
    const Digits50 truth = trueLineMass(a, b, displacement, 0.0);
    INFO("case " << i << " scale " << scale << " deviation " << deviation / scale << " truth "
                 << truth << " bounds " << bounds.lower << " " << bounds.upper);
    CHECK(bounds.lower <= bounds.upper);
    CHECK(holds(bounds, truth, truth));
    CHECK(Digits50(convexPcd(ConvexBody(fcl::Boxd(a.sides)), a.pose, ConvexBody(fcl::Boxd(b.sides)),
                             b.pose, displacement)
                       .least) >= truth * (1 - Digits50(1e-30)));
    // As tight as rounding of the sizes allows, and ties that are broken by turning by 1e-10.
    const double rounding = 1e-9 * (sizeOf(a) + sizeOf(b));
    CHECK(Digits50(bounds.upper) <= trueLineMass(a, b, displacement, rounding) + Digits50(1e-12));
    // Of plates thinner than 1e-8 of their size one in 10,000 has no inside after rounding.
    const double inwards = 10.0 * rounding;
    const PlacedBox least_a = shrunk(a, inwards), least_b = shrunk(b, inwards);
    if (least_a.sides.minCoeff() > 0.0 && least_b.sides.minCoeff() > 0.0) {
      CHECK(Digits50(bounds.lower) >=
            trueLineMass(least_a, least_b, displacement, -inwards) - Digits50(1e-12));
    }
    resolved += truth > 1e-3 && bounds.width() < 1e-6 * bounds.upper;
  }
  CHECK(resolved > 1000);
}

struct AlignedPair {
  PlacedBox a, b;
  GaussianDisplacement displacement;
  Eigen::Vector3d centre, half;  // of the C-obstacle, along the axes

  Bounds mass() const {
    return convexPairMass(ConvexBody(fcl::Boxd(a.sides)), a.pose, ConvexBody(fcl::Boxd(b.sides)),
                          b.pose, displacement);
  }

  /// A product, with the sides moved outwards by `by`.
  Digits50 truth(double by) const {
    Digits50 product = 1;
    for (int k = 0; k < 3; ++k) {
      const Digits50 lower = Digits50(centre[k]) - half[k] - by,
                     upper = Digits50(centre[k]) + half[k] + by;
      if (lower > upper) return 0;
      const double deviation = displacement.standardDeviations()[k];
      if (deviation == 0.0) {
        if (lower > 0 || upper < 0) return 0;
        continue;
      }
      product *= trueIntervalMass(lower / deviation, upper / deviation);
    }
    return product;
  }
};

AlignedPair alignedPair(RandomBodies& random, int rank, double scale) {
  AlignedPair pair;
  Eigen::Vector3d sigma = Eigen::Vector3d::Zero();
  const double common = scale * random.logUniform(1e-8, 10.0);
  for (int k = 0; k < rank; ++k) sigma[k] = common * random.logUniform(0.01, 1.0);
  std::sort(sigma.data(), sigma.data() + 3, std::greater<double>());
  const Eigen::Quaterniond axes =
      random.integer(0, 1) ? random.quaternion() : Eigen::Quaterniond::Identity();
  for (int k = 0; k < 3; ++k) {
    const double thin = random.integer(0, 2) ? 1.0 : random.logUniform(1e-9, 1.0);
    pair.half[k] = scale * thin * random.logUniform(0.1, 3.0);
    pair.centre[k] = random.uniform(-1.1, 1.1) * pair.half[k];
  }
  const double share = random.uniform(0.1, 0.9);
  pair.a.sides = 2.0 * share * pair.half;
  pair.b.sides = 2.0 * (1.0 - share) * pair.half;
  pair.displacement = GaussianDisplacement::fromStandardDeviations(sigma, axes);
  pair.a.pose.linear() = pair.b.pose.linear() = pair.displacement.axes();
  pair.b.pose.translation() = pair.displacement.axes() * pair.centre;
  return pair;
}

TEST_CASE("the exact mass of boxes along the axes of motion, every rank, scale and thinness") {
  RandomBodies random(1202);
  int resolved = 0;
  for (int i = 0; i < 1500; ++i) {
    const double scale = random.integer(0, 2) ? std::pow(10.0, random.uniform(-140, 90)) : 1.0;
    const int rank = 1 + i % 3;
    const AlignedPair pair = alignedPair(random, rank, scale);
    const Bounds bounds = pair.mass();
    const double size = sizeOf(pair.a) + sizeOf(pair.b);
    // The product is that of matrices that are rotations only to rounding.
    const double turned = 8 * 2.2e-16 * size;
    INFO("case " << i << " rank " << rank << " scale " << scale << " truth " << pair.truth(0)
                 << " bounds " << bounds.lower << " " << bounds.upper);
    CHECK(bounds.lower <= bounds.upper);
    CHECK(holds(bounds, pair.truth(-turned), pair.truth(turned)));
    const double rounding = 1e-11 * size;
    if (rank < 3) {
      CHECK(Digits50(bounds.upper) <=
            pair.truth(rounding) * (1 + Digits50(1e-6)) + Digits50(1e-299));
      AlignedPair inner = pair;
      inner.half *= std::max(0.0, 1.0 - 2.0 * rounding / pair.half.minCoeff());
      CHECK(Digits50(bounds.lower) >=
            inner.truth(-rounding) * (1 - Digits50(1e-6)) - Digits50(1e-299));
    }
    resolved += bounds.lower > 0 && bounds.width() < 1e-5 * bounds.upper;
  }
  CHECK(resolved > 600);
}

TEST_CASE("the mass of a section does not depend on the unit of length") {
  RandomBodies random(1203);
  for (int i = 0; i < 200; ++i) {
    const int rank = 1 + i % 2;
    const Eigen::Quaterniond axes = random.quaternion();
    const Eigen::Vector3d sigma(0.5, rank == 2 ? 0.3 : 0.0, 0.0);
    const auto cloud_a = random.cloud(random.integer(4, 9), 1.0);
    const auto cloud_b = random.cloud(random.integer(4, 9), 1.0);
    const Eigen::Isometry3d pose_a = random.pose(0.5), pose_b = random.pose(0.5);
    const auto massAt = [&](int exponent) {
      const double scale = std::ldexp(1.0, exponent);
      const auto scaled = [scale](std::vector<Eigen::Vector3d> points) {
        for (Eigen::Vector3d& p : points) p *= scale;
        return ConvexBody(points);
      };
      Eigen::Isometry3d a = pose_a, b = pose_b;
      a.translation() *= scale;
      b.translation() *= scale;
      return convexPairMass(scaled(cloud_a), a, scaled(cloud_b), b,
                            GaussianDisplacement::fromStandardDeviations(scale * sigma, axes));
    };
    const Bounds here = massAt(0);
    for (const int exponent : {-460, -60, -3, 50, 200, 290}) {
      const Bounds there = massAt(exponent);
      INFO("case " << i << " 2^" << exponent);
      CHECK(there.lower == Approx(here.lower).epsilon(1e-10).margin(1e-290));
      CHECK(there.upper == Approx(here.upper).epsilon(1e-10).margin(1e-290));
    }
  }
}

TEST_CASE("the mass of balls holds for either meaning of a pose that is nearly rigid") {
  // A ball's image under the matrix is an ellipsoid, which is between these two balls.
  RandomBodies random(1205);
  for (int i = 0; i < 300; ++i) {
    const double radius_a = random.uniform(0.2, 1.0), radius_b = random.uniform(0.2, 1.0);
    Eigen::Isometry3d pose_a = random.pose(1.0), pose_b = random.pose(1.0);
    const double off = random.logUniform(1e-14, 2e-10);
    for (int k = 0; k < 9; ++k) pose_a.linear()(k / 3, k % 3) += random.uniform(-off, off);
    const Eigen::Matrix3d& r = pose_a.linear();
    const double stretch =
        1.5 * (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    const double sigma = random.uniform(0.1, 0.5);
    const Bounds bounds = convexPairMass(
        ConvexBody(fcl::Sphered(radius_a)), pose_a, ConvexBody(fcl::Sphered(radius_b)), pose_b,
        GaussianDisplacement::fromStandardDeviations(Eigen::Vector3d::Constant(sigma)));
    const double distance = (pose_a.translation() - pose_b.translation()).norm() / sigma;
    const auto massOf = [&](double share) {
      return fcl_prob::normalBallMass(distance, (radius_a * (1 + share) + radius_b) / sigma);
    };
    INFO("case " << i << " off by " << off);
    CHECK(bounds.lower <= massOf(-stretch).upper);
    CHECK(bounds.upper >= massOf(stretch).lower);
  }
}

TEST_CASE("hulls on a grid are exact however thin they are") {
  using fcl_prob::detail::exactHull;
  RandomBodies random(1204);
  for (int i = 0; i < 2000; ++i) {
    // Near a line of large whole numbers, by one step at most.
    const Eigen::Vector2d step(random.integer(1, 1 << 20), random.integer(-(1 << 20), 1 << 20));
    std::vector<Eigen::Vector2d> points;
    for (int k = random.integer(1, 12); k-- > 0;) {
      const double along = random.integer(-(1 << 28), 1 << 28);
      points.push_back(along * step +
                       Eigen::Vector2d(random.integer(-1, 1), random.integer(-1, 1)));
    }
    const std::vector<Eigen::Vector2d> hull = exactHull(points);
    for (std::size_t k = 0; k < hull.size() && hull.size() > 1; ++k) {
      const Eigen::Vector2d& p = hull[k];
      const Eigen::Vector2d& q = hull[(k + 1) % hull.size()];
      for (const Eigen::Vector2d& r : points) {
        const Digits50 turn = (Digits50(q.x()) - p.x()) * (Digits50(r.y()) - p.y()) -
                              (Digits50(q.y()) - p.y()) * (Digits50(r.x()) - p.x());
        CHECK(turn >= 0);
      }
    }
  }
}

}  // namespace
