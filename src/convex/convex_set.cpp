// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/convex_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "convex/face_set.h"
#include "geometry/length.h"

namespace fcl_prob::detail {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// No polytope around a ball reaches farther than this times its radius.
constexpr double kCircumscribed = 2.0;

/// The outer polytope is this much larger than computed, so that rounding leaves no point outside.
constexpr double kOuterSlack = 1e-12;

Points pointsOnCircle(int count) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * M_PI * i / count;
    points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  return points;
}

/// Fibonacci lattice with its mirror image: nearly even, and symmetric about the centre.
Points pointsOnSphere(int count) {
  const double golden_angle = M_PI * (3.0 - std::sqrt(5.0));
  const int half = std::max(count / 2, 3);
  Points points;
  for (int i = 0; i < half; ++i) {
    const double height = (i + 0.5) / half;
    const double radius = std::sqrt(1.0 - height * height);
    const Eigen::Vector3d p(radius * std::cos(i * golden_angle),
                            radius * std::sin(i * golden_angle), height);
    points.push_back(p);
    points.push_back(-p);
  }
  return points;
}

/// Radius of the largest ball (disk) around the origin inside the hull of the points.
double inradius(const Points& points, bool disk) {
  if (disk) return std::cos(M_PI / static_cast<double>(points.size()));
  double least = std::numeric_limits<double>::infinity();
  const ConvexPolytope hull = convexHull(points);
  for (const ConvexPolytope::Face& face : hull.faces) {
    for (int vertex : face.vertices) {
      least = std::min(least, face.normal.dot(hull.vertices[vertex]));
    }
  }
  return least;
}

ConvexMesh hullOf(const SupportShape& shape, const Points& ball, double scale) {
  Points points(shape.points.begin() + shape.swept, shape.points.end());
  for (int i = 0; i < shape.swept; ++i) {
    for (const Eigen::Vector3d& p : ball) {
      points.push_back(shape.points[i] + shape.semi_axes * (scale * p));
    }
  }
  return makeConvexMesh(points);
}

}  // namespace

SupportShape supportShape(const RoundedZonotope& body) {
  SupportShape shape{body.core.corners(), 0, Eigen::Matrix3d::Zero()};
  if (!(body.radius > 0.0)) return shape;
  shape.swept = static_cast<int>(shape.points.size());
  shape.semi_axes = body.radius * Eigen::Matrix3d::Identity();
  return shape;
}

ConvexSet::ConvexSet(SupportShape shape, int resolution)
    : forms_(formsOf(std::move(shape), resolution)) {}

ConvexSet::ConvexSet(ConvexMesh polytope) : forms_{std::nullopt, std::move(polytope), {}} {}

ConvexSet::Forms ConvexSet::formsOf(SupportShape shape, int resolution) {
  const bool disk = shape.semi_axes.col(2).isZero(0.0);
  const Points ball = disk ? pointsOnCircle(resolution) : pointsOnSphere(resolution);
  Forms forms;
  forms.outer = hullOf(shape, ball, (1.0 + kOuterSlack) / inradius(ball, disk));
  forms.inner = hullOf(shape, ball, 1.0);
  forms.curved = std::move(shape);
  return forms;
}

ConvexSet::Forms ConvexSet::formsOf(const RoundedZonotope& body, int resolution) {
  if (body.radius != 0.0) return formsOf(supportShape(body), resolution);
  if (FaceSet faces; body.core.generatorCount() == 3 && body.core.faces(faces)) {
    const ConvexPolytope box = toPolytope(faces);
    if (box.faces.size() == 6) return {std::nullopt, makeConvexMesh(box), {}};
  }
  return {std::nullopt, makeConvexMesh(body.core.corners()), {}};
}

const ConvexSet::Forms& ConvexSet::forms() const {
  if (rounded_) {
    std::call_once(once_, [this] { forms_ = formsOf(*rounded_, resolution_); });
  }
  return forms_;
}

bool ConvexSet::isPolytope() const {
  return rounded_ ? rounded_->radius == 0.0 : !forms_.curved.has_value();
}

Eigen::Vector3d ConvexSet::supportPoint(const Eigen::Vector3d& direction) const {
  const Forms& known = forms();
  return known.curved ? known.curved->supportPoint(direction) : known.outer.supportPoint(direction);
}

const SupportShape* ConvexSet::curvedShape() const {
  const Forms& known = forms();
  return known.curved ? &*known.curved : nullptr;
}

const ConvexMesh& ConvexSet::innerMesh() const {
  const Forms& known = forms();
  return known.curved ? known.inner : known.outer;
}

double ConvexSet::size() const {
  double size = 0.0;
  if (!rounded_) {
    for (const Eigen::Vector3d& v : forms_.outer.vertices) size = std::max(size, lengthOf(v));
    return size;
  }
  size = lengthOf(rounded_->core.centre()) + kCircumscribed * rounded_->radius;
  for (int i = 0; i < rounded_->core.generatorCount(); ++i)
    size += lengthOf(rounded_->core.generator(i));
  return size;
}

}  // namespace fcl_prob::detail
