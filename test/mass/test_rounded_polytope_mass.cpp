// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of polytopes swept by a ball against quadrature in more than double precision, and where
// they are masses of balls, discs and half-spaces.
#include "mass/rounded_polytope_mass.h"

#include <Eigen/Geometry>
#include <boost/math/quadrature/gauss.hpp>
#include <vector>

#include "catch.h"
#include "disc_truth.h"
#include "fcl_prob/normal_mass.h"
#include "mass/principal_ball.h"
#include "random_bodies.h"

namespace fcl_prob {
namespace {

using detail::PrincipalBall;
using detail::principalBallMass;
using detail::RoundedPolytope;
using detail::roundedPolytopeMass;
using Eigen::Vector3d;
using fcl_prob_test::densityOf;
using fcl_prob_test::intervalOf;
using fcl_prob_test::QuadPrecision;
using fcl_prob_test::RandomBodies;

/// A box along the axes of the displacement, swept by a ball; metres.
struct RoundedBox {
  Vector3d centre, half;
  double radius;
  Vector3d deviations;
};

/// By slices across z and lines across y, with angles where the sides are round: Gauss-Legendre in
/// pieces as long as deviations are; 34 digits.
class RoundedBoxTruth {
 public:
  using Number = QuadPrecision;

  explicit RoundedBoxTruth(const RoundedBox& box) : box_(box) {}

  Number mass() const {
    return roundedSide(2, box_.radius, [&](const Number& radius) {
      return roundedSide(1, radius, [&](const Number& reach) { return lineMass(reach); });
    });
  }

 private:
  Number lineMass(const Number& reach) const {
    const Number half = Number(box_.half.x()) + reach;
    return intervalOf<Number>((box_.centre.x() - half) / box_.deviations.x(),
                              (box_.centre.x() + half) / box_.deviations.x());
  }

  /// ∫ φ(x_k) inner(what is left of the radius) over the flat part and the two round ones.
  template <class Inner>
  Number roundedSide(int k, const Number& radius, const Inner& inner) const {
    const Number centre = box_.centre[k], half = box_.half[k], deviation = box_.deviations[k];
    Number sum = 0;
    if (half > 0) {
      const Number within = inner(radius);
      sum += within * intervalOf<Number>((centre - half) / deviation, (centre + half) / deviation);
    }
    const Number quarter = boost::math::constants::half_pi<Number>();
    const int pieces = 1 + static_cast<int>(radius / deviation);
    for (const int side : {-1, 1}) {
      for (int piece = 0; piece < pieces; ++piece) {
        const auto f = [&](const Number& angle) {
          const Number at = centre + side * (half + radius * sin(angle)), c = cos(angle);
          return Number(densityOf<Number>(at / deviation) * radius * c / deviation *
                        inner(radius * c));
        };
        sum += boost::math::quadrature::gauss<Number, 25>::integrate(
            f, quarter * piece / pieces, quarter * (piece + 1) / pieces);
      }
    }
    return sum;
  }

  const RoundedBox& box_;
};

ConvexPolytope boxAt(const Vector3d& centre, const Vector3d& half) {
  std::vector<Vector3d> corners;
  for (int k = 0; k < 8; ++k) {
    const Vector3d signs((k & 1) ? 1 : -1, (k & 2) ? 1 : -1, (k & 4) ? 1 : -1);
    corners.push_back(centre + half.cwiseProduct(signs));
  }
  return convexHull(corners);
}

ConvexPolytope segment(const Vector3d& from, const Vector3d& to) {
  ConvexPolytope core;
  core.vertices = {from, to};
  return core;
}

ConvexPolytope polygon(const std::vector<Vector3d>& corners) {
  ConvexPolytope core;
  core.vertices = corners;
  ConvexPolytope::Face face;
  face.normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  for (std::size_t k = 0; k < corners.size(); ++k) face.vertices.push_back(static_cast<int>(k));
  core.faces = {face, face};
  core.faces[1].normal = -face.normal;
  std::reverse(core.faces[1].vertices.begin(), core.faces[1].vertices.end());
  return core;
}

/// Rotates a core.
ConvexPolytope turned(ConvexPolytope core, const Eigen::Matrix3d& rotation) {
  for (Vector3d& v : core.vertices) v = rotation * v;
  for (ConvexPolytope::Face& face : core.faces) face.normal = rotation * face.normal;
  return core;
}

Bounds massOf(const ConvexPolytope& core, double radius, const Eigen::Matrix3d& whitening,
              double error = 0.0) {
  return roundedPolytopeMass({core, radius, error}, whitening.cast<long double>()).mass;
}

void isTight(const Bounds& mass, double width = 1e-9) {
  INFO(mass.lower << " to " << mass.upper);
  CHECK(mass.lower > 0.0);
  CHECK(mass.width() <= width * mass.upper);
}

void holdsTruth(const Bounds& mass, const QuadPrecision& truth) {
  INFO(mass.lower << " to " << mass.upper << ", truth " << truth);
  CHECK(QuadPrecision(mass.lower) <= truth * (1 + QuadPrecision(1e-15)));
  CHECK(QuadPrecision(mass.upper) >= truth * (1 - QuadPrecision(1e-15)));
}

/// The error of rotating the core, in units of its size.
constexpr double kTurning = 1e-15;

void checkRoundedBox(const RoundedBox& box, const Eigen::Matrix3d& rotation) {
  const double size = box.centre.norm() + box.half.norm() + box.radius;
  INFO("centre " << box.centre.transpose() << ", half " << box.half.transpose() << ", radius "
                 << box.radius << ", deviations " << box.deviations.transpose());
  const Eigen::Matrix3d whitening =
      box.deviations.cwiseInverse().asDiagonal() * rotation.transpose();
  const Bounds mass = massOf(turned(boxAt(box.centre, box.half), rotation), box.radius, whitening,
                             2.0 * kTurning * size);
  holdsTruth(mass, RoundedBoxTruth(box).mass());
  isTight(mass);
}

Eigen::Matrix3d obliqueWhitening(RandomBodies& random, double spread) {
  const Vector3d deviations(1.0, random.logUniform(1.0 / spread, 1.0),
                            random.logUniform(1.0 / spread, 1.0));
  return deviations.cwiseInverse().asDiagonal() * random.rotation();
}

bool overlap(const Bounds& a, const Bounds& b) { return a.lower <= b.upper && b.lower <= a.upper; }

TEST_CASE("rounded boxes against nested quadrature in 34 digits") {
  RandomBodies random(161);
  for (const double size : {0.01, 0.3, 1.0, 3.0}) {
    for (const double distance : {0.0, 1.0, 6.0, 25.0}) {
      RoundedBox box;
      box.half = size * Vector3d(1.0, random.uniform(0.1, 1.0), random.uniform(0.1, 1.0));
      box.radius = size * random.logUniform(0.05, 2.0);
      box.deviations = Vector3d(1.0, random.uniform(0.3, 1.0), random.uniform(0.3, 1.0));
      const Vector3d out = box.half + Vector3d::Constant(0.5 * box.radius);
      const Vector3d along(0.3, 0.5, 0.8);
      box.centre = distance > 0.0 ? Vector3d(out + distance * along.cwiseProduct(box.deviations))
                                  : Vector3d(0.3 * box.half);
      checkRoundedBox(box, random.rotation());
    }
  }
}

TEST_CASE("flat rounded cores against nested quadrature in 34 digits") {
  RandomBodies random(162);
  for (const double distance : {0.0, 2.0, 20.0}) {
    RoundedBox box{{0.4, 0.2, 0.5 * distance + 0.5}, {0.8, 0.5, 0.0}, 0.4, {1.0, 0.7, 0.5}};
    const auto corner = [&](double x, double y) -> Vector3d {
      return box.centre + Vector3d(x * box.half.x(), y * box.half.y(), 0.0);
    };
    const Eigen::Matrix3d whitening = box.deviations.cwiseInverse().asDiagonal();
    const Bounds plane =
        massOf(polygon({corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}), box.radius,
               whitening);
    holdsTruth(plane, RoundedBoxTruth(box).mass());
    isTight(plane);
    box.half.y() = 0.0;
    const Bounds line = massOf(segment(corner(-1, 0), corner(1, 0)), box.radius, whitening);
    holdsTruth(line, RoundedBoxTruth(box).mass());
    isTight(line);
  }
}

TEST_CASE("a rounded point is a ball") {
  RandomBodies random(163);
  for (int k = 0; k < 40; ++k) {
    const Vector3d deviations(1.0, random.uniform(0.4, 1.0), random.uniform(0.1, 0.4));
    const double radius = random.logUniform(1e-3, 1e3);
    const double distance = random.uniform(0.0, 30.0);
    const Vector3d direction = random.direction();
    const Vector3d centre =
        direction * (k % 4 == 0 ? 0.5 * radius : radius + distance * deviations.z());
    PrincipalBall ball{};
    for (int i = 0; i < 3; ++i) ball.centre[static_cast<std::size_t>(i)] = centre[i];
    ball.radius = radius;
    const Bounds truth =
        principalBallMass(ball, GaussianDisplacement::fromStandardDeviations(deviations));
    ConvexPolytope point;
    point.vertices = {centre};
    const Bounds mass = massOf(point, radius, deviations.cwiseInverse().asDiagonal());
    INFO("radius " << radius << ", centre " << centre.transpose() << ", deviations "
                   << deviations.transpose() << ": " << mass.lower << " to " << mass.upper);
    CHECK(overlap(mass, truth));
    isTight(mass);
  }
}

TEST_CASE("a long rounded segment is a disc seen along it, under oblique covariances") {
  RandomBodies random(164);
  for (int k = 0; k < 30; ++k) {
    const Eigen::Matrix3d whitening = obliqueWhitening(random, 5.0);
    const Vector3d along = random.direction(), u = along.unitOrthogonal(), v = along.cross(u);
    const double radius = random.logUniform(0.05, 20.0);
    const Vector3d off = (radius + random.uniform(-1.0, 8.0)) * u;
    const Bounds mass =
        massOf(segment(off - 100.0 * along, off + 100.0 * along), radius, whitening, 1e-13);
    // The covariance W⁻¹ W⁻ᵀ seen along the segment, with u and v as axes.
    const Eigen::Matrix3d root = whitening.inverse();
    const Eigen::Matrix<double, 3, 2> plane = (Eigen::Matrix<double, 3, 2>() << u, v).finished();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    covariance.topLeftCorner<2, 2>() = plane.transpose() * root * root.transpose() * plane;
    const GaussianDisplacement seen(Vector3d::Zero(), 0.5 * (covariance + covariance.transpose()));
    PrincipalBall ball{};
    const Vector3d centre = seen.axes().transpose() * Vector3d(off.dot(u), 0.0, 0.0);
    for (int i = 0; i < 3; ++i) ball.centre[static_cast<std::size_t>(i)] = centre[i];
    ball.centre_error = 1e-13;
    ball.radius = radius;
    const Bounds truth = principalBallMass(ball, seen);
    INFO("radius " << radius << ": " << mass.lower << " to " << mass.upper << ", disc "
                   << truth.lower << " to " << truth.upper);
    // Of the covariance, which is rounded once more than a ball's centre.
    CHECK(mass.lower <= truth.upper * (1.0 + 1e-11));
    CHECK(mass.upper >= truth.lower * (1.0 - 1e-11));
    isTight(mass);
  }
}

TEST_CASE("near a large rounded face there is a half-space") {
  RandomBodies random(165);
  for (const double height : {-3.0, 0.0, 4.0, 30.0}) {
    const Eigen::Matrix3d rotation = random.rotation();
    const Vector3d centre = rotation * Vector3d(0.0, 0.0, height + 51.0);
    ConvexPolytope core = turned(boxAt(Vector3d::Zero(), Vector3d(90.0, 80.0, 50.0)), rotation);
    for (Vector3d& v : core.vertices) v += centre;
    const Bounds mass = massOf(core, 1.0, Eigen::Matrix3d::Identity(), 1e-13);
    const double truth = normalTailMass(height);
    INFO(mass.lower << " to " << mass.upper << ", half-space " << truth);
    CHECK(mass.lower <= truth * (1.0 + 1e-14));
    CHECK(mass.upper >= truth * (1.0 - 1e-14));
    isTight(mass);
  }
}

// P(K ∪ L) + P(K ∩ L) = P(K) + P(L) for rounded K and L whose union is convex.
TEST_CASE("rounded bodies that are cut in two, under oblique covariances") {
  RandomBodies random(166);
  for (int k = 0; k < 20; ++k) {
    const Eigen::Matrix3d whitening = obliqueWhitening(random, 10.0);
    const Vector3d centre = random.uniform(0.0, 4.0) * random.direction();
    const double radius = random.logUniform(0.1, 3.0);
    const Vector3d half(1.0, 0.6, 0.4), left(0.4, 0.6, 0.4), right(0.6, 0.6, 0.4);
    const auto at = [&](double x, double y, double z) -> Vector3d {
      return centre + Vector3d(x, y, z);
    };
    const Bounds whole = massOf(boxAt(centre, half), radius, whitening, 1e-15);
    const Bounds first = massOf(boxAt(at(-0.6, 0, 0), left), radius, whitening, 1e-15);
    const Bounds second = massOf(boxAt(at(0.4, 0, 0), right), radius, whitening, 1e-15);
    const Bounds both = massOf(polygon({at(-0.2, -0.6, -0.4), at(-0.2, 0.6, -0.4),
                                        at(-0.2, 0.6, 0.4), at(-0.2, -0.6, 0.4)}),
                               radius, whitening, 1e-15);
    CHECK(whole.lower + both.lower <= first.upper + second.upper);
    CHECK(whole.upper + both.upper >= first.lower + second.lower);
    isTight(whole);
    isTight(both);
    // And what is inside weighs less.
    CHECK(first.lower <= whole.upper);
    CHECK(whole.upper <= massOf(boxAt(centre, half), 1.01 * radius, whitening).upper);
    CHECK(massOf(boxAt(centre, half + Vector3d::Constant(radius)), 1e-3, whitening).upper >=
          whole.lower);
  }
}

// The same of tetrahedra, whose corners are narrow on one side and wide on another.
TEST_CASE("rounded tetrahedra that are cut in two") {
  RandomBodies random(169);
  for (int k = 0; k < 60; ++k) {
    std::array<Vector3d, 4> v;
    for (Vector3d& corner : v) corner = random.normalVector().cwiseProduct(Vector3d(1.0, 0.7, 0.3));
    const Vector3d cut = 0.5 * (v[2] + v[3]);
    const double radius = random.logUniform(0.1, 1.0);
    const Eigen::Matrix3d whitening = Eigen::Matrix3d::Identity();
    const Bounds whole = massOf(convexHull({v[0], v[1], v[2], v[3]}), radius, whitening, 1e-15);
    const Bounds first = massOf(convexHull({v[0], v[1], v[2], cut}), radius, whitening, 1e-15);
    const Bounds second = massOf(convexHull({v[0], v[1], cut, v[3]}), radius, whitening, 1e-15);
    const Bounds both = massOf(polygon({v[0], v[1], cut}), radius, whitening, 1e-15);
    for (const Bounds& mass : {whole, first, second, both}) isTight(mass);
    CHECK(whole.lower + both.lower <= first.upper + second.upper);
    CHECK(whole.upper + both.upper >= first.lower + second.lower);
  }
}

TEST_CASE("rounded triangles under oblique covariances against samples") {
  RandomBodies random(167);
  for (int k = 0; k < 6; ++k) {
    const Eigen::Matrix3d whitening = obliqueWhitening(random, 4.0);
    const Eigen::Matrix3d root = whitening.inverse();
    const Vector3d a = 0.4 * random.normalVector(), b = random.normalVector(),
                   c = random.normalVector();
    const double radius = random.uniform(0.2, 0.8);
    const Bounds mass = massOf(polygon({a, b, c}), radius, whitening);
    isTight(mass);
    constexpr int kSamples = 400'000;
    int hits = 0;
    for (int n = 0; n < kSamples; ++n) {
      const Vector3d x = root * random.normalVector();
      // The nearest point by projection, or on one of the sides.
      const Vector3d ab = b - a, ac = c - a;
      Eigen::Matrix<double, 3, 2> sides;
      sides << ab, ac;
      const Eigen::Vector2d w =
          (sides.transpose() * sides).inverse() * (sides.transpose() * (x - a));
      double distance = 1e300;
      if (w.minCoeff() >= 0.0 && w.sum() <= 1.0) {
        distance = (x - a - sides * w).norm();
      } else {
        const Vector3d corners[] = {a, b, c, a};
        for (int side = 0; side < 3; ++side) {
          const Vector3d &from = corners[side], along = corners[side + 1] - from;
          const double t = std::clamp((x - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
          distance = std::min(distance, (x - from - t * along).norm());
        }
      }
      hits += distance <= radius;
    }
    const double p = mass.middle(), share = static_cast<double>(hits) / kSamples;
    INFO("P " << p << ", samples " << share);
    CHECK(std::abs(share - p) <= 5.0 * std::sqrt(p * (1.0 - p) / kSamples));
  }
}

TEST_CASE("moments of rounded polytopes against differences of their masses") {
  RandomBodies random(168);
  for (int k = 0; k < 10; ++k) {
    const Eigen::Matrix3d whitening = obliqueWhitening(random, 3.0);
    const Vector3d centre = random.uniform(0.5, 4.0) * random.direction();
    const Vector3d half(0.8, 0.5, 0.3);
    const detail::RoundedMass mass = roundedPolytopeMass({boxAt(centre, half), 0.4, 1e-15},
                                                         whitening.cast<long double>(), {true, {}});
    REQUIRE(mass.moment);
    const Vector3d gradient = whitening.transpose() * mass.moment->middle();
    CHECK((mass.moment->upper - mass.moment->lower).maxCoeff() <= 1e-6 * mass.mass.upper);
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kStep = 1e-3;
      const auto massAt = [&](double step) {
        return massOf(boxAt(centre - step * Vector3d::Unit(axis), half), 0.4, whitening).middle();
      };
      const double difference =
          (8.0 * (massAt(kStep) - massAt(-kStep)) - (massAt(2.0 * kStep) - massAt(-2.0 * kStep))) /
          (12.0 * kStep);
      CHECK(std::abs(difference - gradient[axis]) <= 1e-6 * gradient.norm());
    }
  }
}

TEST_CASE("rounded bodies that cannot be computed have wide bounds") {
  ConvexPolytope core;
  core.vertices = {Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY()};
  const Bounds open = massOf(core, 1.0, Eigen::Matrix3d::Identity());
  CHECK(open.lower == 0.0);
  CHECK(open.upper == 1.0);
  const Bounds vague =
      massOf(segment(Vector3d::Zero(), Vector3d::UnitX()), 1.0, Eigen::Matrix3d::Identity(), 2.0);
  CHECK(vague.lower == 0.0);
  CHECK(vague.upper == 1.0);
}

}  // namespace
}  // namespace fcl_prob
