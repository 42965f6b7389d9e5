// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/constants.h"
#include "fcl_prob/polytope_mass.h"

#include <Eigen/Geometry>
#include <boost/math/quadrature/gauss.hpp>
#include <limits>
#include <map>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "high_precision.h"
#include "mass/boundary_mass.h"
#include "mass/polytope_clip.h"
#include "mass/solid_mass.h"
#include "random_inputs.h"
#include "test_polytopes.h"

namespace fcl_prob {
namespace {

using detail::kEpsilon;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using fcl_prob_test::boxPolytope;
using fcl_prob_test::HighPrecision;
using fcl_prob_test::logUniform;
using fcl_prob_test::randomRotation;
using fcl_prob_test::randomVector;
using fcl_prob_test::reach;
using fcl_prob_test::simplexPolytope;
using fcl_prob_test::trueIntervalMass;
using fcl_prob_test::uniform;
using fcl_prob_test::withVertices;

struct Box {
  Vector3d lo, hi;

  HighPrecision mass() const {
    return trueIntervalMass(lo.x(), hi.x()) * trueIntervalMass(lo.y(), hi.y()) *
           trueIntervalMass(lo.z(), hi.z());
  }
};

// A box at a given distance from the origin; its nearest point is in a face, on an edge or a
// corner.
Box randomBox(std::mt19937& random, const Vector3d& half, double distance) {
  Vector3d nearest, direction = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    nearest[k] = uniform(random, -1, 1) * half[k];
    if (random() % 2 == 0) {
      nearest[k] = half[k];
      direction[k] = uniform(random, 0, 1);
    }
  }
  if (direction.isZero(0)) {
    nearest[0] = half[0];
    direction[0] = 1;
  }
  const Vector3d centre = -(nearest + distance * direction.normalized());
  return {centre - half, centre + half};
}

// What rotating the corners of a box leaves of their accuracy.
double rotationError(const ConvexPolytope& polytope) { return 2 * kEpsilon * reach(polytope); }

struct Accuracy {
  int count = 0;
  double error = 0, width = 0;
};

void record(Accuracy& accuracy, const Bounds& bounds, const HighPrecision& truth) {
  ++accuracy.count;
  accuracy.error = std::max(accuracy.error, fcl_prob_test::relativeError(bounds.middle(), truth));
  accuracy.width = std::max(accuracy.width, (bounds.width() / truth).convert_to<double>());
}

bool holds(const Bounds& bounds, const HighPrecision& truth) {
  return HighPrecision(bounds.lower) <= truth && truth <= HighPrecision(bounds.upper);
}

// Mass of a tetrahedron by nested quadrature of slices, the innermost integral in closed form.
class NestedQuadrature {
 public:
  explicit NestedQuadrature(std::array<Vector3d, 4> corners) : corners_(corners) {}

  long double mass() const {
    std::array<long double, 4> x;
    for (int k = 0; k < 4; ++k) x[k] = corners_[k].x();
    return overPieces(x, [&](long double at) { return density(at) * slice(at); });
  }

 private:
  using Real = long double;

  template <class Knots, class F>
  static Real overPieces(Knots knots, const F& f) {
    std::sort(knots.begin(), knots.end());
    Real sum = 0;
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
      // Steep edges make the integrand vary much over short pieces too.
      const int count = 8 + static_cast<int>(knots[k + 1] - knots[k]);
      const Real step = (knots[k + 1] - knots[k]) / count;
      for (int i = 0; i < count && step > 0; ++i) {
        const Real from = knots[k] + i * step;
        sum += boost::math::quadrature::gauss<Real, 20>::integrate(f, from, from + step);
      }
    }
    return sum;
  }

  static Real density(Real x) { return std::exp(-x * x / 2) / std::sqrt(2 * M_PIl); }

  // Φ-mass between two values, on the side of the tail.
  static Real interval(Real lo, Real hi) {
    if (lo + hi < 0) return interval(-hi, -lo);
    const Real root = std::sqrt(Real(2));
    return (std::erfc(lo / root) - std::erfc(hi / root)) / 2;
  }

  Real slice(Real x) const {
    std::vector<std::pair<Real, Real>> section;  // (y, z) where edges cross the plane
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < i; ++j) {
        const Real from = corners_[i].x(), to = corners_[j].x();
        if ((from - x) * (to - x) >= 0) continue;
        const Real s = (x - from) / (to - from);
        section.emplace_back(corners_[i].y() + s * (corners_[j].y() - Real(corners_[i].y())),
                             corners_[i].z() + s * (corners_[j].z() - Real(corners_[i].z())));
      }
    }
    std::vector<Real> knots;
    for (const auto& point : section) knots.push_back(point.first);
    return overPieces(knots, [&](Real y) { return density(y) * column(section, y); });
  }

  static Real column(const std::vector<std::pair<Real, Real>>& section, Real y) {
    Real lo = std::numeric_limits<Real>::infinity(), hi = -lo;
    for (std::size_t i = 0; i < section.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto [y0, z0] = section[i];
        const auto [y1, z1] = section[j];
        if ((y0 - y) * (y1 - y) >= 0) continue;
        const Real z = z0 + (y - y0) / (y1 - y0) * (z1 - z0);
        lo = std::min(lo, z);
        hi = std::max(hi, z);
      }
    }
    return lo < hi ? interval(lo, hi) : 0;
  }

  std::array<Vector3d, 4> corners_;
};

}  // namespace

TEST_CASE("mass of rotated boxes from P = 0.5 to 1e-300 and sizes from 1e-3 to 1e3") {
  std::mt19937 random(1);
  const std::vector<double> distances{0, 0.5, 1.5, 5, 15, 30, 36.8};
  std::map<double, Accuracy> by_distance, by_size;
  for (int i = 0; i < 3500; ++i) {
    const double size = logUniform(random, 1e-3, 1e3);
    const double distance = distances[i % distances.size()] * uniform(random, 0.9, 1);
    const Vector3d half = size * Vector3d(uniform(random, 0.1, 0.5), uniform(random, 0.1, 0.5),
                                          uniform(random, 0.1, 0.5));
    const Box box = randomBox(random, half, distance);
    const HighPrecision truth = box.mass();
    if (truth < 1e-300) continue;
    const ConvexPolytope polytope = boxPolytope(box.lo, box.hi, randomRotation(random));
    REQUIRE(holds(polytopeMass(polytope, rotationError(polytope)), truth));
    const Bounds bounds = polytopeMass(polytope);
    REQUIRE(bounds.lower <= bounds.upper);
    record(by_distance[distances[i % distances.size()]], bounds, truth);
    record(by_size[std::floor(std::log10(size))], bounds, truth);
  }
  for (const auto& [distance, accuracy] : by_distance) {
    CAPTURE(distance, accuracy.count, accuracy.error, accuracy.width);
    CHECK(accuracy.count > 300);
    CHECK(accuracy.error < 1e-10);
    CHECK(accuracy.width < 2e-9);
  }
  for (const auto& [size, accuracy] : by_size) {
    CAPTURE(size, accuracy.count, accuracy.error, accuracy.width);
    CHECK(accuracy.count > 300);
    CHECK(accuracy.error < (size < 0 ? 1e-10 : 1e-11));
  }
}

TEST_CASE("mass of axis-aligned boxes, whose feet are on edges and corners") {
  std::mt19937 random(2);
  double worst = 0;
  for (int i = 0; i < 1500; ++i) {
    Box box;
    for (int k = 0; k < 3; ++k) {
      const double size = logUniform(random, 1e-2, 1e2);
      const double begin = (random() % 3 == 0) ? 0.0 : uniform(random, 0, 8);
      box.lo[k] = random() % 3 == 0 ? -0.5 * size : begin;
      box.hi[k] = box.lo[k] + size;
    }
    const HighPrecision truth = box.mass();
    if (truth < 1e-300) continue;
    const Bounds bounds = polytopeMass(boxPolytope(box.lo, box.hi));
    CAPTURE(box.lo.transpose(), box.hi.transpose());
    REQUIRE(holds(bounds, truth));
    worst = std::max(worst, fcl_prob_test::relativeError(bounds.middle(), truth));
  }
  CAPTURE(worst);
  CHECK(worst < 1e-11);
}

TEST_CASE("origin on a face, an edge or a corner, exactly and within rounding") {
  std::mt19937 random(3);
  for (int i = 0; i < 600; ++i) {
    const double size = logUniform(random, 1e-3, 1e3);
    Box box;
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = k <= i % 3 ? 0.0 : -size * uniform(random, 0, 1);
      box.hi[k] = size * uniform(random, 0.1, 1);
      if (i % 2 == 0) box.lo[k] += 1e-16 * uniform(random, -1, 1);
    }
    const Matrix3d rotation = i % 5 == 0 ? Matrix3d::Identity() : randomRotation(random);
    const ConvexPolytope polytope = boxPolytope(box.lo, box.hi, rotation);
    const HighPrecision truth = box.mass();
    CAPTURE(box.lo.transpose(), box.hi.transpose());
    REQUIRE(holds(polytopeMass(polytope, rotationError(polytope)), truth));
    CHECK(fcl_prob_test::relativeError(polytopeMass(polytope).middle(), truth) < 1e-11);
  }
}

TEST_CASE("needles and plates") {
  std::mt19937 random(4);
  Accuracy accuracy;
  for (int i = 0; i < 300; ++i) {
    const Vector3d half(logUniform(random, 1e-3, 1e2), logUniform(random, 1e-3, 1e2),
                        logUniform(random, 1e-3, 1e2));
    const Box box = randomBox(random, half, logUniform(random, 1e-2, 20));
    const HighPrecision truth = box.mass();
    if (truth < 1e-300) continue;
    const ConvexPolytope polytope = boxPolytope(box.lo, box.hi, randomRotation(random));
    REQUIRE(holds(polytopeMass(polytope, rotationError(polytope)), truth));
    record(accuracy, polytopeMass(polytope), truth);
  }
  CAPTURE(accuracy.count, accuracy.error, accuracy.width);
  CHECK(accuracy.error < 1e-9);
  CHECK(accuracy.width < 1e-4);
}

TEST_CASE("a body around the origin has nearly all mass and never more than 1") {
  for (const double half : {3.0, 5.0, 8.0, 9.0, 20.0, 1e3}) {
    const Vector3d corner = Vector3d::Constant(half);
    const Bounds bounds = polytopeMass(boxPolytope(-corner, corner));
    const HighPrecision outside = 1 - Box{-corner, corner}.mass();
    CHECK(bounds.upper <= 1);
    CHECK(holds(bounds, 1 - outside));
    CHECK(bounds.width() < 1e-14);
  }
}

TEST_CASE("mass of random simplices against nested quadrature", "[slow]") {
  std::mt19937 random(5);
  int tail = 0, inside = 0;
  double worst = 0;
  for (int i = 0; i < 24; ++i) {
    const double size = logUniform(random, 0.3, 4);
    const Vector3d shift = (i % 3) * uniform(random, 0, 5) * randomVector(random);
    std::array<Vector3d, 4> corners;
    for (Vector3d& corner : corners) corner = shift + size * randomVector(random);
    const double truth = static_cast<double>(NestedQuadrature(corners).mass());
    const Bounds bounds =
        polytopeMass(simplexPolytope(corners[0], corners[1], corners[2], corners[3]));
    if (truth < 1e-250) continue;
    CAPTURE(truth, bounds.lower / truth - 1, bounds.upper / truth - 1);
    REQUIRE(bounds.lower <= truth * (1 + 1e-14));
    REQUIRE(bounds.upper >= truth * (1 - 1e-14));
    worst = std::max(worst, std::abs(bounds.middle() / truth - 1));
    tail += truth < 1e-8;
    inside += truth > 0.01;
  }
  CAPTURE(worst);
  CHECK(worst < 1e-10);
  CHECK(tail > 1);
  CHECK(inside > 2);
}

TEST_CASE("two independent formulas agree on random polytopes, and the parts add up") {
  std::mt19937 random(6);
  int compared = 0;
  for (int i = 0; i < 150; ++i) {
    const double size = logUniform(random, 0.2, 3);
    const Vector3d shift = uniform(random, 0, 4) * randomVector(random);
    const Matrix3d rotation = randomRotation(random);
    ConvexPolytope body =
        boxPolytope(Vector3d::Constant(-size), Vector3d::Constant(size), rotation);
    for (Vector3d& v : body.vertices) v += shift;
    for (auto& face : body.faces) face.offset += face.normal.dot(shift);
    for (int cut = 0; cut < 12; ++cut) {
      const Vector3d normal = randomVector(random).normalized();
      body = detail::clipped(body, {normal, normal.dot(shift) - size * uniform(random, 0.7, 1.2)});
    }
    REQUIRE(body.faces.size() > 6);
    const double error = 8 * kEpsilon * reach(body);
    const Bounds whole = polytopeMass(body, error);
    if (whole.upper < 1e-290) continue;

    const auto solid = detail::solidMass(body, 0.0, 4096);
    REQUIRE(solid);
    CHECK(solid->mass.value == Approx(whole.middle()).epsilon(1e-10));
    const auto boundary = detail::boundaryMass(detail::polytopeBoundary(body)).value();
    CHECK(std::abs(boundary.value - solid->mass.value) <=
          boundary.error + solid->mass.error + whole.width());

    const Vector3d normal = randomVector(random).normalized();
    const double offset = normal.dot(shift);
    const Bounds above = polytopeMass(detail::clipped(body, {normal, offset}), error);
    const Bounds below = polytopeMass(detail::clipped(body, {-normal, -offset}), error);
    CHECK(above.lower + below.lower <= whole.upper);
    CHECK(above.upper + below.upper >= whole.lower);
    CHECK(above.middle() + below.middle() == Approx(whole.middle()).epsilon(1e-10));
    ++compared;
  }
  CHECK(compared > 100);
}

TEST_CASE("mass does not depend on rotation, mirroring, or the order of vertices and faces") {
  std::mt19937 random(7);
  for (int i = 0; i < 100; ++i) {
    const Box box = randomBox(random, Vector3d(0.4, 1.5, 0.8), uniform(random, 0, 10));
    const ConvexPolytope polytope = boxPolytope(box.lo, box.hi);
    const double mass = polytopeMass(polytope).middle();
    const auto agrees = [&](const ConvexPolytope& other) {
      return std::abs(polytopeMass(other).middle() / mass - 1) < 1e-12;
    };
    CHECK(agrees(boxPolytope(box.lo, box.hi, randomRotation(random))));
    CHECK(agrees(boxPolytope(-box.hi, -box.lo)));
    ConvexPolytope shuffled = polytope;
    std::shuffle(shuffled.faces.begin(), shuffled.faces.end(), random);
    for (auto& face : shuffled.faces) {
      std::rotate(face.vertices.begin(), face.vertices.begin() + random() % 4, face.vertices.end());
    }
    CHECK(agrees(shuffled));
  }
}

TEST_CASE("a vertex error covers every polytope whose vertices are that close") {
  std::mt19937 random(8);
  for (int i = 0; i < 400; ++i) {
    const double size = logUniform(random, 1e-2, 10);
    const double error = size * logUniform(random, 1e-9, 0.1);
    const Vector3d shift = uniform(random, 0, 4) * randomVector(random);
    std::vector<Vector3d> vertices(4), moved(4);
    for (int k = 0; k < 4; ++k) {
      vertices[k] = shift + size * randomVector(random);
      moved[k] = vertices[k] + error * uniform(random, 0.5, 1) * randomVector(random).normalized();
    }
    const auto simplexOf = [](const std::vector<Vector3d>& v) {
      return simplexPolytope(v[0], v[1], v[2], v[3]);
    };
    const Bounds bounds = polytopeMass(simplexOf(vertices), error);
    const Bounds truth = polytopeMass(simplexOf(moved));
    CAPTURE(size, error, bounds.lower, truth.lower, truth.upper, bounds.upper);
    REQUIRE(bounds.lower <= truth.lower * (1 + 1e-9));
    REQUIRE(bounds.upper >= truth.upper * (1 - 1e-9));
  }
}

TEST_CASE("polytopes without volume, far away, or invalid") {
  ConvexPolytope flat;
  CHECK(polytopeMass(flat).upper == 0);
  flat.vertices = {{1, 0, 0}, {1, 1, 0}, {1, 0, 1}};
  CHECK(polytopeMass(flat).lower == 0);
  CHECK(polytopeMass(flat).upper == 0);
  const Bounds thick = polytopeMass(flat, 1e-3);
  CHECK(thick.lower == 0);
  CHECK(thick.upper > normalBoxMass({0.999, 0, 0}, {1.001, 0.5, 0.5}));

  const ConvexPolytope cube = boxPolytope(Vector3d::Zero(), Vector3d::Ones());
  for (const double distance : {37.6, 38.3, 39.0, 60.0, 1e10}) {
    const Bounds far =
        polytopeMass(boxPolytope(Vector3d(distance, 0, 0), Vector3d(distance + 1, 1, 1)));
    CAPTURE(distance);
    CHECK(holds(far, trueIntervalMass(distance, distance + 1) * trueIntervalMass(0, 1) *
                         trueIntervalMass(0, 1)));
    CHECK(far.upper < 1e-300);
  }
  CHECK_THROWS_AS(polytopeMass(cube, -1), InvalidGeometry);
  CHECK_THROWS_AS(polytopeMass(cube, std::nan("")), InvalidGeometry);
  ConvexPolytope bad = cube;
  bad.vertices[3].y() = std::nan("");
  CHECK_THROWS_AS(polytopeMass(bad), InvalidGeometry);
  bad = cube;
  bad.faces.pop_back();
  CHECK_THROWS_WITH(polytopeMass(bad), Catch::Matchers::Contains("do not close"));
  bad = cube;
  bad.faces[2].vertices[1] = 8;
  CHECK_THROWS_WITH(polytopeMass(bad), Catch::Matchers::Contains("8"));
  bad = cube;
  bad.faces[2].normal *= 2;
  CHECK_THROWS_AS(polytopeMass(bad), InvalidGeometry);
}

// An audit found upper bounds below the truth where the error was as small as the spacing of
// doubles at the distance of a face.
TEST_CASE("boxes whose corners are off by about a rounding error hold the moved ones") {
  std::mt19937 random(12);
  for (int i = 0; i < 4'000; ++i) {
    const double size = logUniform(random, 1e-9, 20.0);
    Vector3d half, centre;
    for (int k = 0; k < 3; ++k) {
      half[k] = size * (i % 2 == 0 ? 1.0 : logUniform(random, 1e-9, 1.0));
      centre[k] = uniform(random, -1.0, 1.0) * (i % 3 == 0 ? 8.0 : 1.0);
    }
    const double error = i % 4 == 0 ? logUniform(random, 1e-15, 1e-2)
                                    : half.minCoeff() * logUniform(random, 1e-3, 1e3);
    const Vector3d lo = centre - half, hi = centre + half;
    if (!((hi - lo).minCoeff() > 0.0)) continue;
    const Bounds bounds = polytopeMass(boxPolytope(lo, hi), error);
    const double moved = error / std::sqrt(3.0) * (1.0 - 1e-14);
    HighPrecision larger = 1, smaller = 1;
    for (int k = 0; k < 3; ++k) {
      const HighPrecision from = lo[k], to = hi[k];
      larger *= trueIntervalMass(from - moved, to + moved);
      const bool is_left = from + moved < to - moved;
      smaller *= is_left ? trueIntervalMass(from + moved, to - moved) : HighPrecision(0);
    }
    CAPTURE(i, half.transpose(), centre.transpose(), error, bounds.lower, bounds.upper);
    CHECK(bounds.upper >= larger * (1 - HighPrecision(1e-14)));
    CHECK(bounds.lower <= smaller * (1 + HighPrecision(1e-14)));
  }
}

}  // namespace fcl_prob
