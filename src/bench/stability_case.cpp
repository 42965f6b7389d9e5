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

// How far a pose's rounded matrix moves the faces of the boxes, less what is rounded to nearest in
// the truth: 8 roundings of the extent.
double poseRounding(const BoxScene& scene) {
  if (!scene.isTurned()) return 0.0;
  return 8 * std::numeric_limits<double>::epsilon() * (scene.half_a.norm() + scene.half_b.norm());
}

using Ranges = std::array<AxisRange, 3>;

// Where |centre - x| <= extent + slack.
Ranges rangesAround(const std::array<Precise, 3>& centre, const std::array<Precise, 3>& extent,
                    const std::array<Precise, 3>& sigma, const Precise& slack) {
  Ranges ranges;
  for (std::size_t k = 0; k < 3; ++k) {
    const Precise reach = extent[k] + slack;
    ranges[k] = {centre[k] - reach, centre[k] + reach, sigma[k]};
  }
  return ranges;
}

// Strictly inside, one way or the other; nothing if a box is not larger along every axis.
Precise containedMass(const std::array<Precise, 3>& centre, const std::array<Precise, 3>& room,
                      const std::array<Precise, 3>& sigma, const Precise& slack) {
  for (const Precise& side : room) {
    if (side + slack <= 0) return 0;
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

Truth BoxScene::truth(bool solid) const {
  std::array<Precise, 3> centre, sum, a_in_b, b_in_a, deviation;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    centre[k] = Precise(at_b[axis]) - at_a[axis] - mean[axis];
    sum[k] = Precise(half_a[axis]) + half_b[axis];
    a_in_b[k] = Precise(half_b[axis]) - half_a[axis];
    b_in_a[k] = -a_in_b[k];
    const double variance = sigma[axis] * sigma[axis];
    deviation[k] = covariance_matrix ? Precise(sqrt(Precise(variance))) : Precise(sigma[axis]);
  }
  if (isTurned()) centre = preciseCoordinates(turn, centre);
  const Precise slack = poseRounding(*this);
  Truth truth{preciseBoxMass(rangesAround(centre, sum, deviation, -slack)),
              preciseBoxMass(rangesAround(centre, sum, deviation, slack))};
  if (solid) return truth;
  truth.lower -= containedMass(centre, a_in_b, deviation, slack) +
                 containedMass(centre, b_in_a, deviation, slack);
  truth.upper -= containedMass(centre, a_in_b, deviation, -slack) +
                 containedMass(centre, b_in_a, deviation, -slack);
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
  result.pose_a.linear() = result.pose_b.linear() = scene.turn.toRotationMatrix();
  result.pose_a.translation() = scene.at_a;
  result.pose_b.translation() = scene.at_b;
  result.displacement = {{1.0, scene.displacement()}};
  result.contact = form == BoxForm::solids ? ContactMeaning::solid : ContactMeaning::fcl;
  result.truth = scene.truth(form != BoxForm::surfaces);
  return result;
}

}  // namespace fcl_prob::cli
