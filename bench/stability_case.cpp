// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/stability_case.h"

#include <fcl/geometry/geometric_shape_to_BVH_model.h>

#include <cmath>
#include <limits>

namespace fcl_prob::cli {
namespace {

TriangleMesh boxMesh(const Eigen::Vector3d& sides) {
  fcl::BVHModel<fcl::OBBRSSd> model;
  fcl::generateBVHModel(model, fcl::Boxd(sides), fcl::Transform3d::Identity());
  return {{model.vertices, model.vertices + model.num_vertices},
          {model.tri_indices, model.tri_indices + model.num_tris}};
}

/// The columns of the axes of a displacement in the order, and with the signs, of a rotation that
/// they are but for rounding.
Eigen::Matrix3d inOrderOf(const Eigen::Matrix3d& rotation, const Eigen::Matrix3d& axes) {
  Eigen::Matrix3d result;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::Vector3d shares = axes.transpose() * rotation.col(k);
    Eigen::Index same = 0;
    shares.cwiseAbs().maxCoeff(&same);
    result.col(k) = std::copysign(1.0, shares[same]) * axes.col(same);
  }
  return result;
}

using Ranges = std::array<AxisRange, 3>;

// Where |centre - x| <= extent + slack.
Ranges rangesAround(const std::array<Precise, 3>& centre, const std::array<Precise, 3>& extent,
                    const std::array<Precise, 3>& sigma, const std::array<Precise, 3>& slack) {
  Ranges ranges;
  for (std::size_t k = 0; k < 3; ++k) {
    const Precise reach = extent[k] + slack[k];
    ranges[k] = {centre[k] - reach, centre[k] + reach, sigma[k]};
  }
  return ranges;
}

// Strictly inside, one way or the other; nothing if a box is not larger along every axis.
Precise containedMass(const std::array<Precise, 3>& centre, const std::array<Precise, 3>& room,
                      const std::array<Precise, 3>& sigma, const std::array<Precise, 3>& slack) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (room[k] + slack[k] <= 0) return 0;
  }
  return preciseBoxMass(rangesAround(centre, room, sigma, slack), true);
}

}  // namespace

double StabilityRandom::uniform(double lo, double hi) {
  if (used_ == words_.size()) {
    words_ = detail::randomWords(stream_, index_, block_++);
    used_ = 0;
  }
  return lo + (hi - lo) * detail::uniformFrom(words_[used_++]);
}

double StabilityRandom::logUniform(double lo, double hi) {
  return std::exp(uniform(std::log(lo), std::log(hi)));
}

int StabilityRandom::integer(int lo, int hi) {
  return lo + static_cast<int>(uniform(0, 1) * (hi - lo + 1));
}

Eigen::Vector3d StabilityRandom::uniformVector(double lo, double hi) {
  const double x = uniform(lo, hi), y = uniform(lo, hi), z = uniform(lo, hi);
  return {x, y, z};
}

Eigen::Quaterniond StabilityRandom::rotation() {
  const Eigen::Vector3d first =
      detail::standardNormalFrom(detail::randomWords(stream_, index_, block_++));
  const Eigen::Vector3d second =
      detail::standardNormalFrom(detail::randomWords(stream_, index_, block_++));
  return Eigen::Quaterniond(second.x(), first.x(), first.y(), first.z()).normalized();
}

GaussianDisplacement BoxScene::displacement() const {
  if (!covariance_matrix) return GaussianDisplacement::fromStandardDeviations(sigma, turn, mean);
  return GaussianDisplacement(mean, sigma.cwiseAbs2().asDiagonal());
}

Eigen::Matrix3d BoxScene::frame() const {
  if (!isTurned()) return Eigen::Matrix3d::Identity();
  return inOrderOf(turn.toRotationMatrix(), displacement().axes());
}

Truth BoxScene::truth(bool solid) const { return truthWithin(solid, {0, 0, 0}); }

Truth BoxScene::nearby(bool solid) const {
  constexpr double kUlp = std::numeric_limits<double>::epsilon();
  std::array<Precise, 3> slack;
  const Eigen::Vector3d places = at_a.cwiseAbs() + at_b.cwiseAbs() + mean.cwiseAbs();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const double place = isTurned() ? places.norm() : places[axis];
    slack[k] = kUlp * (half_a[axis] + half_b[axis] + place);
  }
  return truthWithin(solid, slack);
}

Truth BoxScene::truthWithin(bool solid, const std::array<Precise, 3>& slack) const {
  std::array<Precise, 3> centre, sum, a_in_b, b_in_a, deviation, less;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    centre[k] = Precise(at_b[axis]) - at_a[axis] - mean[axis];
    sum[k] = Precise(half_a[axis]) + half_b[axis];
    a_in_b[k] = Precise(half_b[axis]) - half_a[axis];
    b_in_a[k] = -a_in_b[k];
    const double variance = sigma[axis] * sigma[axis];
    deviation[k] = covariance_matrix ? Precise(sqrt(Precise(variance))) : Precise(sigma[axis]);
    less[k] = -slack[k];
  }
  if (isTurned()) centre = preciseCoordinates(frame(), centre);
  Truth truth{preciseBoxMass(rangesAround(centre, sum, deviation, less)),
              preciseBoxMass(rangesAround(centre, sum, deviation, slack))};
  if (solid) return truth;
  truth.lower -= containedMass(centre, a_in_b, deviation, slack) +
                 containedMass(centre, b_in_a, deviation, slack);
  truth.upper -= containedMass(centre, a_in_b, deviation, less) +
                 containedMass(centre, b_in_a, deviation, less);
  if (truth.lower < 0) truth.lower = 0;
  return truth;
}

StabilityCase boxCase(const BoxScene& scene, BoxForm form, StabilityRandom& random,
                      const MeshChange& change) {
  const auto geometry =
      [&](const Eigen::Vector3d& half) -> std::shared_ptr<const fcl::CollisionGeometryd> {
    if (form == BoxForm::shapes) return std::make_shared<fcl::Boxd>(Eigen::Vector3d(2 * half));
    TriangleMesh mesh = boxMesh(2 * half);
    if (change) change(mesh, random);
    return buildModel<fcl::OBBRSSd>(mesh);
  };
  StabilityCase result;
  result.a = geometry(scene.half_a);
  result.b = geometry(scene.half_b);
  result.pose_a.linear() = result.pose_b.linear() = scene.frame();
  result.pose_a.translation() = scene.at_a;
  result.pose_b.translation() = scene.at_b;
  result.displacement = {{1.0, scene.displacement()}};
  result.contact = form == BoxForm::solids ? ContactMeaning::solid : ContactMeaning::fcl;
  result.truth = scene.truth(form != BoxForm::surfaces);
  result.nearby = scene.nearby(form != BoxForm::surfaces);
  return result;
}

}  // namespace fcl_prob::cli
