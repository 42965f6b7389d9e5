// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/medial_balls.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "geometry/closed_mesh.h"
#include "geometry/surface_caps.h"
#include "mass/principal_ball.h"

namespace fcl_prob::detail {
namespace {

// More than what a few sums and products of coordinates are rounded by, as a share of them; and
// what poses that are rotations to 1e-9 make of a length.
constexpr double kRoundedPlace = 1e-12;
constexpr double kUnrotated = 1e-8;

// Balls that a search begins at, and triangles whose balls are compared for that: with one ball in
// place of four a tenth of the states of a Fetch that four tell are not told.
constexpr std::size_t kLargest = 4;
constexpr int kCompared = 100;

// Nearer to the centre of a larger ball than this share of its radius a ball tells little more.
constexpr double kApart = 0.7;

// Steps from a ball to the nearest point of the other surface, and to the ball that touches there.
constexpr int kSteps = 3;

// By this factor a mass that is only about known is clearly more or less than another number.
constexpr double kClearly = 2.0;

// A ball shrinks until nothing is within it, to this share of its radius, or so many times.
constexpr double kTouching = 0.98;
constexpr int kMostShrinking = 12;

/// A point of a triangle, a + s (b - a) + t (c - a), that is nearest to p up to rounding (Ericson,
/// Real-Time Collision Detection, 5.1.5). Whatever is rounded, it is one of the triangle.
Eigen::Vector3d nearestOn(const std::array<Eigen::Vector3d, 3>& triangle,
                          const Eigen::Vector3d& p) {
  const Eigen::Vector3d &a = triangle[0], &b = triangle[1], &c = triangle[2];
  const Eigen::Vector3d ab = b - a, ac = c - a;
  const double along_b[3] = {ab.dot(p - a), ab.dot(p - b), ab.dot(p - c)};
  const double along_c[3] = {ac.dot(p - a), ac.dot(p - b), ac.dot(p - c)};
  const auto share = [](double x, double of) {
    return of > 0.0 ? std::clamp(x / of, 0.0, 1.0) : 0.0;
  };
  const auto at = [&](double s, double t) -> Eigen::Vector3d { return a + s * ab + t * ac; };
  if (along_b[0] <= 0.0 && along_c[0] <= 0.0) return a;
  if (along_b[1] >= 0.0 && along_c[1] <= along_b[1]) return b;
  const double of_c = along_b[0] * along_c[1] - along_b[1] * along_c[0];
  if (of_c <= 0.0 && along_b[0] >= 0.0 && along_b[1] <= 0.0) {
    return at(share(along_b[0], along_b[0] - along_b[1]), 0.0);
  }
  if (along_c[2] >= 0.0 && along_b[2] <= along_c[2]) return c;
  const double of_b = along_b[2] * along_c[0] - along_b[0] * along_c[2];
  if (of_b <= 0.0 && along_c[0] >= 0.0 && along_c[2] <= 0.0) {
    return at(0.0, share(along_c[0], along_c[0] - along_c[2]));
  }
  const double of_a = along_b[1] * along_c[2] - along_b[2] * along_c[1];
  const double to_c = along_c[1] - along_b[1], to_b = along_b[2] - along_c[2];
  if (of_a <= 0.0 && to_c >= 0.0 && to_b >= 0.0) {
    const double t = share(to_c, to_c + to_b);
    return at(1.0 - t, t);
  }
  const double t = share(of_c, of_a + of_b + of_c);
  return at(std::min(share(of_b, of_a + of_b + of_c), 1.0 - t), t);
}

/// How far a triangle certainly is from p, up to rounding: by the plane across the way to the point
/// that was found, so that it does not rest on that being the nearest.
double distanceBeyond(const Eigen::Vector3d& found, const std::array<Eigen::Vector3d, 3>& triangle,
                      const Eigen::Vector3d& p) {
  const Eigen::Vector3d way = found - p;
  const double length = way.norm();
  if (!(length > 0.0)) return 0.0;
  double least = kInfinity;
  for (const Eigen::Vector3d& corner : triangle) least = std::min(least, way.dot(corner - p));
  return std::max(0.0, least / length);
}

std::array<Eigen::Vector3d, 3> cornersOf(const MeshView& mesh, int triangle) {
  return {mesh.vertex(triangle, 0), mesh.vertex(triangle, 1), mesh.vertex(triangle, 2)};
}

const ClosedMesh* solidOf(const PreparedGeometry& geometry) {
  try {
    return geometry.solid(ContactMeaning::solid);
  } catch (const OpenMesh&) {
    return nullptr;
  }
}

}  // namespace

MedialBalls::MedialBalls(const PreparedGeometry& geometry) : around_(ballAround(geometry)) {
  slack_ = kRoundedPlace * (around_.centre.norm() + around_.radius);
  const GeometryKind kind = kindOf(geometry.geometry());
  if (kind == GeometryKind::mesh) searchMesh(geometry);
  if (kind == GeometryKind::convex) searchShape(geometry);
}

void MedialBalls::searchMesh(const PreparedGeometry& geometry) {
  mesh_ = meshView(geometry.geometry());
  solid_ = solidOf(geometry);
  std::vector<BoxTree::Box> boxes(static_cast<std::size_t>(mesh_.triangle_count));
  for (int t = 0; t < mesh_.triangle_count; ++t) {
    for (const auto& corner : cornersOf(mesh_, t))
      boxes[static_cast<std::size_t>(t)].extend(corner);
  }
  triangles_ = BoxTree(boxes);
  findExtremes();
  if (solid_) findLargest();
}

// Of a cylinder that is flat, too, a capsule along its radius is in it.
void MedialBalls::searchShape(const PreparedGeometry& geometry) {
  const fcl::NODE_TYPE type = geometry.geometry().getNodeType();
  const bool is_known = type == fcl::GEOM_BOX || type == fcl::GEOM_SPHERE ||
                        type == fcl::GEOM_CAPSULE || type == fcl::GEOM_CYLINDER;
  if (!is_known) return;
  const Eigen::Vector3d half = 0.5 * geometry.localBox().sizes();
  int axis = 0;
  const double longest = half.maxCoeff(&axis), radius = half.minCoeff();
  const Eigen::Vector3d half_axis = (longest - radius) * Eigen::Vector3d::Unit(axis);
  core_ = {half_axis, radius};
  largest_ = {{Eigen::Vector3d::Zero(), radius}, {half_axis, radius}, {-half_axis, radius}};
  const Eigen::Vector3d end = longest * Eigen::Vector3d::Unit(axis);
  extremes_.push_back({end, -end, end, -end, end, -end});
}

void MedialBalls::findExtremes() {
  SurfaceComponents parts = componentsOf(mesh_, weldVertices(mesh_));
  part_of_vertex_ = std::move(parts.of_vertex);
  extremes_.resize(static_cast<std::size_t>(parts.count));
  std::vector<bool> begun(extremes_.size());
  for (int v = 0; v < mesh_.vertex_count; ++v) {
    if (part_of_vertex_[v] < 0) continue;
    const auto part = static_cast<std::size_t>(part_of_vertex_[v]);
    const Eigen::Vector3d& x = mesh_.vertices[v];
    for (int k = 0; k < 6; ++k) {
      Eigen::Vector3d& extreme = extremes_[part][static_cast<std::size_t>(k)];
      const double sign = k < 3 ? 1.0 : -1.0;
      if (!begun[part] || sign * x[k % 3] > sign * extreme[k % 3]) extreme = x;
    }
    begun[part] = true;
  }
}

void MedialBalls::findLargest() {
  std::vector<Ball> found;
  const int step = std::max(1, mesh_.triangle_count / kCompared);
  for (int t = 0; t < mesh_.triangle_count; t += step) found.push_back(ballAt(t));
  std::stable_sort(found.begin(), found.end(),
                   [](const Ball& x, const Ball& y) { return x.radius > y.radius; });
  for (const Ball& ball : found) {
    if (largest_.size() == kLargest || !(ball.radius > 0.0)) return;
    const bool is_new = std::none_of(largest_.begin(), largest_.end(), [&](const Ball& larger) {
      return (larger.centre - ball.centre).norm() < kApart * larger.radius;
    });
    if (is_new) largest_.push_back(ball);
  }
}

MedialBalls::NearPoint MedialBalls::nearestTo(const Eigen::Vector3d& point) const {
  if (core_) {
    const Ball ball = ballNear(point);
    const Eigen::Vector3d way = point - ball.centre;
    const double length = way.norm();
    return {length > ball.radius ? ball.centre + ball.radius / length * way : point};
  }
  NearPoint nearest{point, -1, kInfinity};
  triangles_.visitNearest(point, [&](int triangle) {
    const auto corners = cornersOf(mesh_, triangle);
    const Eigen::Vector3d found = nearestOn(corners, point);
    const double distance = distanceBeyond(found, corners, point);
    if (distance < nearest.distance) nearest = {found, triangle, distance};
    return nearest.distance;
  });
  nearest.distance = std::max(
      0.0, (1.0 - kRoundedPlace) * nearest.distance - slack_ - kRoundedPlace * point.norm());
  return nearest;
}

const Eigen::Vector3d& MedialBalls::farFrom(const NearPoint& point) const {
  const int part = core_ ? 0 : part_of_vertex_[mesh_.triangles[point.triangle][0]];
  const Extremes& extremes = extremes_[static_cast<std::size_t>(part)];
  return *std::max_element(extremes.begin(), extremes.end(), [&](const auto& x, const auto& y) {
    return (x - point.point).squaredNorm() < (y - point.point).squaredNorm();
  });
}

Ball MedialBalls::ballNear(const Eigen::Vector3d& point) const {
  if (!core_) return ballAt(nearestTo(point).triangle);
  const double square = core_->half_axis.squaredNorm();
  const double share = square > 0.0 ? core_->half_axis.dot(point) / square : 0.0;
  return {std::clamp(share, -1.0, 1.0) * core_->half_axis, core_->radius};
}

// The shrinking ball of Ma, Bae and Choi (2012): it touches the triangle, and the nearest point of
// the surface to its centre says how small it has to be. What it ended at is measured anew.
Ball MedialBalls::ballAt(int triangle) const {
  const auto [a, b, c] = cornersOf(mesh_, triangle);
  const Eigen::Vector3d on = (a + b + c) / 3.0;
  const Eigen::Vector3d outwards = (b - a).cross(c - a).stableNormalized();
  double radius = around_.radius;
  for (int i = 0; i < kMostShrinking; ++i) {
    const Eigen::Vector3d centre = on - radius * outwards;
    const Eigen::Vector3d to_nearest = on - nearestTo(centre).point;
    const double along = outwards.dot(to_nearest);
    if (!(along > 0.0) || (on - to_nearest - centre).norm() > kTouching * radius) break;
    radius = std::min(radius, 0.5 * to_nearest.squaredNorm() / along);
  }
  const Eigen::Vector3d centre = on - radius * outwards;
  if (!centre.allFinite() || solid_->contains(centre) != Containment::inside) return {on, 0.0};
  return {centre, nearestTo(centre).distance};
}

bool MedialBalls::isOutside(const Ball& ball) const {
  if ((ball.centre - around_.centre).norm() > ball.radius + around_.radius + slack_) return true;
  return nearestTo(ball.centre).distance > ball.radius &&
         solid_->contains(ball.centre) == Containment::outside;
}

namespace {

/// About: across the way to it as a slab, along it as a disc.
double roughMass(const GaussianDisplacement& displacement, const Eigen::Vector3d& centre,
                 double radius) {
  const double distance = centre.norm();
  const Eigen::Vector3d& deviations = displacement.standardDeviations();
  const Eigen::Vector3d way = centre / std::max(distance, kUnderflow);
  const double along = deviations.cwiseProduct(displacement.axes().transpose() * way).norm();
  const double across = 0.5 * (deviations.squaredNorm() - along * along);
  return normalIntervalMass((distance - radius) / along, (distance + radius) / along) *
         -std::expm1(-0.5 * radius * radius / std::max(across, kUnderflow));
}

/// Balls of one mesh, and the surface of the other one.
class BallSearch {
 public:
  /// \param sign  1 where the balls are A's
  BallSearch(const PlacedBalls& of, const PlacedBalls& other, double sign,
             const GaussianDisplacement& of_a, ContactMeaning contact)
      : of_(of),
        other_(other),
        to_other_(other.pose.inverse() * of.pose),
        sign_(sign),
        of_a_(of_a),
        contact_(contact) {}

  ContactBall best() {
    if (!of_.balls.hasBalls() || !other_.balls.hasPoints()) return {};
    point_ = other_.balls.nearestTo(to_other_ * of_.balls.around().centre).point;
    for (const Ball& ball : of_.balls.largest()) look(ball);
    for (int i = 0; i < kSteps; ++i) {
      if (!look(of_.balls.ballNear(to_other_.inverse() * point_))) break;
    }
    return best_;
  }

 private:
  /// Whether it is better than those before.
  bool look(const Ball& ball) {
    const auto near = other_.balls.nearestTo(to_other_ * ball.centre);
    const Eigen::Vector3d from = of_.pose * ball.centre, to = other_.pose * near.point;
    ContactBall found;
    found.centre = sign_ * (to - from) - of_a_.mean();
    found.radius = (1.0 - kUnrotated) * ball.radius - of_.balls.slack() - other_.balls.slack();
    found.error = kRoundedPlace *
                  (of_.pose.translation().norm() + ball.centre.norm() +
                   other_.pose.translation().norm() + near.point.norm() + of_a_.mean().norm());
    found.mass = roughMass(of_a_, found.centre, found.radius);
    if (!(found.radius > 0.0) || !(found.mass > best_.mass)) return false;
    if (of_.balls.isSurface(contact_) && !reachesOut(ball, near)) return false;
    best_ = found;
    point_ = near.point;
    return true;
  }

  /// Whether what hangs together with the point is not all in the solid while that is in the ball.
  bool reachesOut(const Ball& ball, const MedialBalls::NearPoint& point) const {
    const Eigen::Vector3d reach = other_.balls.farFrom(point) - point.point;
    const double margin = kUnrotated * reach.norm() + other_.balls.slack();
    return of_.balls.isOutside(
        {ball.centre + to_other_.linear().inverse() * reach, ball.radius + margin});
  }

  const PlacedBalls& of_;
  const PlacedBalls& other_;
  fcl::Transform3d to_other_;
  double sign_;
  const GaussianDisplacement& of_a_;
  ContactMeaning contact_;
  Eigen::Vector3d point_;  ///< of the other surface: the last one that was near
  ContactBall best_;
};

}  // namespace

ContactBall contactBall(const PlacedBalls& a, const PlacedBalls& b,
                        const GaussianDisplacement& of_a, ContactMeaning contact, double enough) {
  ContactBall of_balls_of_a = BallSearch(a, b, 1.0, of_a, contact).best();
  if (of_balls_of_a.mass >= kClearly * enough) return of_balls_of_a;
  ContactBall of_balls_of_b = BallSearch(b, a, -1.0, of_a, contact).best();
  return of_balls_of_a.mass >= of_balls_of_b.mass ? of_balls_of_a : of_balls_of_b;
}

double lowerByMedialBalls(const PlacedBalls& a, const PlacedBalls& b,
                          const GaussianDisplacement& of_a, ContactMeaning contact, double enough) {
  if (of_a.rank() == 0) return 0.0;
  const ContactBall found = contactBall(a, b, of_a, contact, enough);
  if (!(kClearly * found.mass > enough)) return 0.0;
  const Eigen::Vector3d along = of_a.axes().transpose() * found.centre;
  PrincipalBall ball;
  ball.centre = {along[0], along[1], along[2]};
  ball.centre_error = found.error + kRoundedPlace * found.centre.norm();
  ball.radius = found.radius;
  ball.radius_error = kRoundedPlace * found.radius;
  return principalBallMass(ball, of_a).lower;
}

}  // namespace fcl_prob::detail
