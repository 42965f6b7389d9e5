// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/object_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "base/quantiles.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "geometry/validation.h"

namespace fcl_prob::detail {
namespace {

using Box = Eigen::AlignedBox3d;

/// Of the coordinates of a box: more than what computing it rounds away.
constexpr double kBoxRounding = 1e-12;

/// How many deviations are exceeded with the probability at which pairs are left out.
double deviationsOf(const BroadphaseRequest& request) {
  if (!(request.culling_probability > 0.0 && request.culling_probability < 0.5)) {
    throw InvalidRequest("culling_probability must be in (0, 0.5), is " +
                         numberText(request.culling_probability));
  }
  return std::sqrt(2.0) * erfcInverse(2.0 * request.culling_probability);
}

/// A box of the world frame around a placed one, rounding included.
Box placed(const Box& local, const fcl::Transform3d& pose) {
  if (local.isEmpty() || !local.sizes().allFinite()) return local;
  const Eigen::Vector3d middle = local.center();
  const Eigen::Vector3d half = 0.5 * local.sizes();
  const Eigen::Matrix3d size = pose.linear().cwiseAbs();
  const Eigen::Vector3d centre = pose * middle;
  const Eigen::Vector3d rounding =
      kBoxRounding * (pose.translation().cwiseAbs() + size * (middle.cwiseAbs() + half));
  const Eigen::Vector3d reach = size * half + rounding;
  return {centre - reach, centre + reach};
}

/// Along every axis, where the displacements of some objects are and how wide they are.
struct DisplacementRange {
  Eigen::Vector3d least_mean = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d largest_mean = -least_mean;
  Eigen::Vector3d deviation = Eigen::Vector3d::Zero();

  void include(const DisplacedObject& object) {
    least_mean = least_mean.cwiseMin(object.displacement.mean());
    largest_mean = largest_mean.cwiseMax(object.displacement.mean());
    deviation = deviation.cwiseMax(object.deviation);
  }
};

/// The box of an object, enlarged such that it misses that of an object of the range only if the
/// two boxes, displaced, meet with a probability of at most Φ(-deviations): they are apart along
/// one axis, where the displacement would have to be that many deviations from its mean.
Box enlarged(const DisplacedObject& object, const DisplacementRange& others, double deviations) {
  const Eigen::Vector3d& mean = object.displacement.mean();
  Box result = object.box;
  if (result.isEmpty()) return result;
  for (int k = 0; k < 3; ++k) {
    const double width = deviations * std::hypot(object.deviation[k], others.deviation[k]);
    const double lowest = mean[k] - others.largest_mean[k] - width;
    const double highest = mean[k] - others.least_mean[k] + width;
    const double rounding =
        kBoxRounding * (width + std::fabs(mean[k]) + std::fabs(others.least_mean[k]) +
                        std::fabs(others.largest_mean[k]));
    result.min()[k] += lowest - rounding - kBoxRounding * std::fabs(result.min()[k]);
    result.max()[k] += highest + rounding + kBoxRounding * std::fabs(result.max()[k]);
  }
  return result;
}

}  // namespace

GaussianDisplacement displacementOf(const fcl::CollisionObjectd& object,
                                    const BroadphaseRequest& request) {
  return request.displacement ? request.displacement(object) : GaussianDisplacement();
}

ObjectPairs::ObjectPairs(const Objects& a, const Objects& b, const BroadphaseRequest& request)
    : request_(request), deviations_(deviationsOf(request)) {
  a_ = sideOf(a);
  b_ = sideOf(b);
  find();
}

double ObjectPairs::culledUpper() const {
  constexpr double kRounding = 1e-12;
  const double each = normalTailMass(deviations_) * (1.0 + kRounding);
  return std::min(1.0, static_cast<double>(culled_) * each * (1.0 + kRounding));
}

/// Objects that are on both sides are known once.
ObjectPairs::Side ObjectPairs::sideOf(const Objects& objects) {
  Side side;
  for (const fcl::CollisionObjectd* object : objects) {
    // FCL's dynamic trees list an object that was registered twice once, and null for the other.
    if (object == nullptr) continue;
    auto& known = known_[object];
    if (!known) known = std::make_unique<const DisplacedObject>(displaced(*object));
    side.places.emplace(known.get(), side.objects.size());
    side.objects.push_back(known.get());
  }
  return side;
}

DisplacedObject ObjectPairs::displaced(const fcl::CollisionObjectd& object) {
  validatePose(object.getTransform(), "an object of the manager");
  auto& [geometry, local_box] = geometries_[object.collisionGeometry().get()];
  if (!geometry) {
    geometry = std::make_shared<const PreparedGeometry>(object.collisionGeometry(),
                                                        "an object of the manager");
    local_box = geometry->localBox();
  }
  DisplacedObject result{&object, displacementOf(object, request_), geometry,
                         placed(local_box, object.getTransform()), Eigen::Vector3d::Zero()};
  const Eigen::Matrix3d spread =
      result.displacement.axes() * result.displacement.standardDeviations().asDiagonal();
  for (int k = 0; k < 3; ++k) result.deviation[k] = spread.row(k).stableNorm();
  return result;
}

ObjectPairs::Targets::Targets(const Side& side) {
  std::vector<Box> of_bounded;
  for (std::size_t j = 0; j < side.objects.size(); ++j) {
    const DisplacedObject& object = *side.objects[j];
    if (object.isUnbounded()) {
      unbounded.push_back(j);
    } else if (!object.box.isEmpty()) {
      bounded.push_back(j);
      of_bounded.push_back(object.box);
    }
  }
  boxes = BoxTree(of_bounded);
}

std::vector<std::size_t> ObjectPairs::Targets::near(const DisplacedObject& object,
                                                    const Box& reach) const {
  std::vector<std::size_t> places = unbounded;
  if (object.isUnbounded()) {
    places.insert(places.end(), bounded.begin(), bounded.end());
  } else if (!reach.isEmpty()) {
    boxes.visitBox(reach, [&](int item) {
      places.push_back(bounded[static_cast<std::size_t>(item)]);
      return true;
    });
  }
  std::sort(places.begin(), places.end());
  return places;
}

void ObjectPairs::find() {
  DisplacementRange range;
  for (const DisplacedObject* object : b_.objects) range.include(*object);
  const Targets targets(b_);
  std::size_t not_considered = 0;
  for (std::size_t i = 0; i < a_.objects.size(); ++i) {
    const DisplacedObject& a = *a_.objects[i];
    for (const std::size_t j : targets.near(a, enlarged(a, range, deviations_))) {
      const DisplacedObject& b = *b_.objects[j];
      // Two objects that are on both sides come up twice.
      const auto b_in_a = a_.places.find(&b);
      const bool seen = b_in_a != a_.places.end() && b_in_a->second < i && b_.has(a);
      if (&a == &b || seen) continue;
      if (request_.considers && !request_.considers(*a.object, *b.object)) {
        ++not_considered;
      } else {
        near_.emplace_back(&a, &b);
      }
    }
  }
  culled_ = countAll() - not_considered - near_.size();
}

std::size_t ObjectPairs::countAll() const {
  std::size_t shared = 0;
  for (const DisplacedObject* object : b_.objects) shared += a_.places.count(object);
  const std::size_t ordered = a_.objects.size() * b_.objects.size() - shared;
  return shared == 0 ? ordered : ordered - shared * (shared - 1) / 2;
}

}  // namespace fcl_prob::detail
