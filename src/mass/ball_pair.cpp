// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/ball_pair.h"

#include <algorithm>
#include <limits>

#include "geometry/exact_sum.h"

namespace fcl_prob::detail {
namespace {

/// Of a long double, or of what ExactSum gives.
const long double kFine = std::max(std::numeric_limits<long double>::epsilon(), 0x1p-62L);

using LongMatrix = Eigen::Matrix<long double, 3, 3>;

/// RᵀR - I, up to 16 kFine: how far R is from a rotation.
LongMatrix defectOf(const Eigen::Matrix3d& rotation) {
  if (rotation == Eigen::Matrix3d::Identity()) return LongMatrix::Zero();
  const LongMatrix exact = rotation.cast<long double>();
  return exact.transpose() * exact - LongMatrix::Identity();
}

/// By at most this share a linear map that is nearly a rotation changes lengths.
double stretchOf(const LongMatrix& defect) {
  if (defect.isZero(0.0L)) return 0.0;
  // Half of the largest eigenvalue's size, which is at most three entries.
  return static_cast<double>(1.55L * (defect.cwiseAbs().maxCoeff() + 16.0L * kFine));
}

}  // namespace

bool isBall(const ConvexBody& body) {
  return body.set().rounded() && body.set().rounded()->core.generatorCount() == 0;
}

std::optional<PrincipalBall> ballOfPair(const ConvexBody& a, const fcl::Transform3d& pose_a,
                                        const ConvexBody& b, const fcl::Transform3d& pose_b,
                                        const GaussianDisplacement& displacement) {
  if (!isBall(a) || !isBall(b)) return std::nullopt;
  const RoundedZonotope& body_a = *a.set().rounded();
  const RoundedZonotope& body_b = *b.set().rounded();
  ExactPosition offset;
  offset.add(pose_b, body_b.core.centre());
  offset.add(pose_a, body_a.core.centre(), -1.0);
  offset.add(displacement.mean(), -1.0);
  const LongVector centre = offset.value();
  // The axes Q are a rotation up to rounding: |c - Q x| <= r is |Q⁻¹c - x| <= r but for what Q
  // stretches, and Q⁻¹ = (I + E)⁻¹ Qᵀ with E = QᵀQ - I.
  const LongMatrix defect = defectOf(displacement.axes());
  LongVector along = displacement.axes().transpose().cast<long double>() * centre;
  along -= defect * along;
  PrincipalBall ball;
  for (int k = 0; k < 3; ++k) ball.centre[k] = along[k];
  ball.centre_error = static_cast<double>(64.0L * kFine * centre.cwiseAbs().sum()) +
                      std::numeric_limits<double>::min();
  ball.radius = static_cast<long double>(body_a.radius) + body_b.radius;
  ball.radius_error = stretchOf(defectOf(pose_a.linear())) * body_a.radius +
                      stretchOf(defectOf(pose_b.linear())) * body_b.radius +
                      stretchOf(defect) * static_cast<double>(ball.radius);
  return ball;
}

}  // namespace fcl_prob::detail
