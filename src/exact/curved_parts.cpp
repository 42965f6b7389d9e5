// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/curved_parts.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "base/constants.h"
#include "convex/perturbation.h"
#include "exact/axes_surface.h"

namespace fcl_prob::detail {
namespace {

/// −A is A turned upside down, since frustums are symmetric about their axis and ellipsoids about
/// their centres.
Frustum frustumOf(const CurvedBody& body, bool reflected) {
  Frustum frustum = *body.frustum;
  if (reflected) std::swap(frustum.bottom, frustum.top);
  return frustum;
}

void addFrustum(const CurvedBody& body, bool reflected, CurvedParts& parts) {
  parts.sum.frustum = frustumOf(body, reflected);
  parts.sum.frame = body.frame;
  parts.inradius += parts.sum.frustum.inradius();
}

/// Reflected, with an axis of its own or, if axes are parallel, about that of the first one. Turned
/// a little to decide ties, which counts as error.
void addSecond(const CurvedBody& body, int attempt, CurvedParts& parts) {
  Frustum added = frustumOf(body, true);
  const Eigen::Vector3d turn = perturbation(1, attempt);
  LongMatrix3 frame = body.frame;
  for (int k = 0; k < 3; ++k) {
    frame.col(k) += turn.cast<long double>().cross(LongVector3(body.frame.col(k)));
  }
  const LongVector3 first = parts.sum.frame.col(2).normalized(), second = frame.col(2).normalized();
  parts.inradius += added.inradius();
  parts.error = 1.01 * turn.norm() * added.size();
  const auto apart = static_cast<double>(first.cross(second).norm());
  if (apart > kAxesTie) {
    parts.second = added;
    parts.second_frame = frame;
    return;
  }
  if (first.dot(second) < 0.0L) std::swap(added.bottom, added.top);
  parts.error +=
      2.0 * apart * added.size() + 8.0 * kEpsilon * (parts.sum.frustum.size() + added.size());
  parts.sum.coaxial = added;
}

CurvedParts partsOf(const CurvedBody& a, const CurvedBody& b, int attempt) {
  CurvedParts parts;
  for (const CurvedBody* body : {&a, &b}) {
    if (!body->ellipsoid) continue;
    parts.sum.ellipsoids.push_back(*body->ellipsoid);
    parts.inradius += body->least_axis;
  }
  if (b.frustum) {
    addFrustum(b, false, parts);
    if (a.frustum) addSecond(a, attempt, parts);
  } else if (a.frustum) {
    addFrustum(a, true, parts);
  } else {
    // In the frame of an ellipsoid its own normals are even.
    parts.sum.frame = parts.sum.ellipsoids.front();
  }
  return parts;
}

/// A polytope seen from the frame of a frustum, turned a little: about its own origin, by a
/// perturbation() that decides ties.
void placePolytope(const ConvexMesh& mesh, const LongMatrix3& rotation, int attempt,
                   CurvedParts& parts) {
  const Eigen::Vector3d turn = perturbation(0, attempt);
  LongMatrix3 turned = rotation;
  for (int k = 0; k < 3; ++k) {
    turned.col(k) += turn.cast<long double>().cross(LongVector3(rotation.col(k)));
  }
  const LongMatrix3 of_normals = turned.inverse().transpose();
  ConvexMesh image = mesh;
  double size = 0.0;
  parts.middle.setZero();
  for (Eigen::Vector3d& v : image.vertices) {
    size = std::max(size, v.norm());
    v = (turned * v.cast<long double>()).cast<double>();
    parts.middle += v / static_cast<double>(image.vertices.size());
  }
  for (ConvexMesh::Face& face : image.faces) {
    face.normal = (of_normals * face.normal.cast<long double>()).cast<double>().normalized();
  }
  parts.error = (8.0 * kEpsilon + 1.01 * turn.norm()) * size + mesh.slack;
  parts.polytope = std::move(image);
}

/// A cylinder or a cone.
bool isFrustum(const std::optional<CurvedBody>& body) {
  return body && body->frustum && !body->ellipsoid;
}

}  // namespace

bool haveCurvedParts(const ConvexBody& a, const ConvexBody& b) {
  const Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  const auto body_a = curvedBody(a, turn), body_b = curvedBody(b, turn);
  if (body_a && body_b) return true;
  return (isFrustum(body_a) && b.isPolytope()) || (isFrustum(body_b) && a.isPolytope());
}

std::optional<CurvedParts> curvedParts(const ConvexBody& a, const Eigen::Matrix3d& rotation_a,
                                       const ConvexBody& b, const Eigen::Matrix3d& rotation_b,
                                       int attempt) {
  const auto body_a = curvedBody(a, rotation_a), body_b = curvedBody(b, rotation_b);
  if (body_a && body_b) return partsOf(*body_a, *body_b, attempt);
  CurvedParts parts;
  if (isFrustum(body_b) && a.isPolytope()) {
    addFrustum(*body_b, false, parts);
    ConvexMesh reflected;
    reflect(a.set().outerMesh(), Eigen::Matrix3d::Identity(), reflected);
    placePolytope(reflected, body_b->frame.inverse() * rotation_a.cast<long double>(), attempt,
                  parts);
    return parts;
  }
  if (isFrustum(body_a) && b.isPolytope()) {
    addFrustum(*body_a, true, parts);
    placePolytope(b.set().outerMesh(), body_a->frame.inverse() * rotation_b.cast<long double>(),
                  attempt, parts);
    return parts;
  }
  return std::nullopt;
}

}  // namespace fcl_prob::detail
