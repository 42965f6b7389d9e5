// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/broadphase.h"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <unordered_map>

#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/number_text.h"
#include "query/pair_query.h"

namespace fcl_prob {
namespace {

using Object = fcl::CollisionObjectd;
using Manager = fcl::BroadPhaseCollisionManagerd;

/// Bounding boxes of FCL are rounded to nearest.
constexpr double kBoxRounding = 1e-12;

GaussianDisplacement displacementOf(const Object& object, const BroadphaseRequest& request) {
  return request.displacement ? request.displacement(object) : GaussianDisplacement();
}

/// The running bounds of P(any).
void include(const ProbabilityResult& pair, BroadphaseResult& result) {
  const Bounds event{pair.lower.value_or(0.0), pair.upper.value_or(1.0)};
  result.any = result.pairs.size() == 1 ? event : anyOf({result.any, event});
}

/// Answers pairs, preparing each geometry once.
class PairAnswers {
 public:
  explicit PairAnswers(const BroadphaseRequest& request) : request_(request) {}

  /// Returns whether to stop.
  bool add(const Object& a, const Object& b, const GaussianDisplacement& displacement,
           BroadphaseResult& result) {
    const detail::PairQuery query(prepared(a), prepared(b));
    result.pairs.push_back(
        {&a, &b, query.answer(a.getTransform(), b.getTransform(), displacement, request_.query)});
    include(result.pairs.back().result, result);
    result.stopped = request_.stop_above && result.any.lower > *request_.stop_above;
    return result.stopped;
  }

 private:
  std::shared_ptr<const detail::PreparedGeometry> prepared(const Object& object) {
    auto& known = known_[object.collisionGeometry().get()];
    if (!known) {
      known = std::make_shared<const detail::PreparedGeometry>(object.collisionGeometry(),
                                                               "an object of the manager");
    }
    return known;
  }

  const BroadphaseRequest& request_;
  std::unordered_map<const void*, std::shared_ptr<const detail::PreparedGeometry>> known_;
};

/// An axis-aligned box and nothing more: what stands for a displaced object before a manager.
class ReachBox : public fcl::CollisionGeometryd {
 public:
  explicit ReachBox(const fcl::AABBd& box) : box_(box) {}
  void computeLocalAABB() override {
    aabb_local = box_;
    aabb_center = box_.center();
    aabb_radius = (box_.max_ - aabb_center).norm();
  }

 private:
  fcl::AABBd box_;
};

/// Along every axis, where the displacements of some objects are and how wide they are.
struct DisplacementRange {
  Eigen::Vector3d least_mean = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d largest_mean = -least_mean;
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();

  void include(const GaussianDisplacement& displacement) {
    least_mean = least_mean.cwiseMin(displacement.mean());
    largest_mean = largest_mean.cwiseMax(displacement.mean());
    variance = variance.cwiseMax(displacement.covariance().diagonal());
  }
};

/// The box of an object, enlarged such that it misses that of an object of the range only if the
/// two boxes, displaced, meet with a probability of at most Φ(-deviations): they are apart along
/// one axis, where the displacement would have to be that many deviations from its mean.
fcl::AABBd enlarged(const fcl::AABBd& box, const GaussianDisplacement& own,
                    const DisplacementRange& others, double deviations) {
  const Eigen::Vector3d width =
      deviations * (own.covariance().diagonal() + others.variance).cwiseMax(0.0).cwiseSqrt();
  const Eigen::Vector3d lowest = own.mean() - others.largest_mean - width;
  const Eigen::Vector3d highest = own.mean() - others.least_mean + width;
  const auto rounding = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return kBoxRounding * (x.cwiseAbs() + lowest.cwiseAbs() + highest.cwiseAbs());
  };
  return {box.min_ + lowest - rounding(box.min_), box.max_ + highest + rounding(box.max_)};
}

/// One query of a manager.
class Broadphase {
 public:
  Broadphase(const Manager* manager, const BroadphaseRequest& request)
      : manager_(manager), request_(request), answers_(request) {
    if (manager == nullptr) throw InvalidRequest("the manager is null");
    validateRequest(request.query);
    if (!(request.culling_probability > 0.0 && request.culling_probability < 0.5)) {
      throw InvalidRequest("culling_probability must be in (0, 0.5), is " +
                           detail::numberText(request.culling_probability));
    }
    deviations_ = std::sqrt(2.0) * boost::math::erfc_inv(2.0 * request.culling_probability);
    std::vector<Object*> objects;
    manager->getObjects(objects);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      known_.emplace(objects[i], Known{i, displacementOf(*objects[i], request)});
      range_.include(known_.at(objects[i]).displacement);
    }
  }

  std::size_t size() const { return known_.size(); }
  bool contains(const Object& object) const { return known_.count(&object) > 0; }

  /// Against every object of the manager but itself, or only those that come after it.
  void run(const Object& object, bool only_later = false) {
    if (result_.stopped || known_.empty()) return;
    object_ = &object;
    only_later_ = only_later;
    own_ = displacementOf(object, request_);
    reach_ = enlarged(object.getAABB(), own_, range_, deviations_);
    Object stand_in(std::make_shared<ReachBox>(reach_));
    manager_->collide(&stand_in, this, [](Object* first, Object* second, void* self) {
      auto& broadphase = *static_cast<Broadphase*>(self);
      // Managers differ in which of the two they name first.
      return broadphase.visit(broadphase.contains(*first) ? *first : *second);
    });
  }

  /// \param pairs  in total
  BroadphaseResult finish(std::size_t pairs) {
    if (!result_.stopped) result_.pairs_culled = pairs - result_.pairs.size() - left_out_;
    const double each = normalTailMass(deviations_) * (1.0 + 1e-12);
    result_.culled_upper =
        std::min(1.0, static_cast<double>(result_.pairs_culled) * each * (1.0 + 1e-12));
    result_.any.upper =
        result_.stopped ? 1.0 : anyOf({result_.any, {0.0, result_.culled_upper}}).upper;
    return std::move(result_);
  }

 private:
  struct Known {
    std::size_t index;
    GaussianDisplacement displacement;
  };

  bool visit(const Object& other) {
    if (&other == object_) return false;
    // Not every manager looks at the boxes itself.
    if (!reach_.overlap(other.getAABB())) return false;
    const Known& known = known_.at(&other);
    if (only_later_ && known.index <= known_.at(object_).index) return false;
    if (request_.considers && !request_.considers(*object_, other)) {
      ++left_out_;
      return false;
    }
    return answers_.add(*object_, other,
                        GaussianDisplacement::fromIndependent(own_, known.displacement), result_);
  }

  const Manager* manager_;
  const BroadphaseRequest& request_;
  BroadphaseResult result_;
  PairAnswers answers_;
  std::unordered_map<const Object*, Known> known_;
  DisplacementRange range_;
  double deviations_ = 0.0;
  const Object* object_ = nullptr;
  GaussianDisplacement own_;
  fcl::AABBd reach_;
  bool only_later_ = false;
  std::size_t left_out_ = 0;  ///< by request.considers
};

}  // namespace

double collisionProbability(const Object* object, const Manager* manager,
                            const BroadphaseRequest& request, BroadphaseResult& result) {
  if (object == nullptr) throw InvalidGeometry("the object is null");
  Broadphase broadphase(manager, request);
  broadphase.run(*object);
  result = broadphase.finish(broadphase.size() - (broadphase.contains(*object) ? 1 : 0));
  return result.any.middle();
}

double collisionProbability(const Manager* manager_a, const Manager* manager_b,
                            const BroadphaseRequest& request, BroadphaseResult& result) {
  if (manager_a == nullptr) throw InvalidRequest("manager A is null");
  Broadphase broadphase(manager_b, request);
  std::vector<Object*> objects;
  manager_a->getObjects(objects);
  std::size_t pairs = 0;
  for (const Object* object : objects) {
    broadphase.run(*object);
    pairs += broadphase.size() - (broadphase.contains(*object) ? 1 : 0);
  }
  result = broadphase.finish(pairs);
  return result.any.middle();
}

double collisionProbability(const Manager* manager, const BroadphaseRequest& request,
                            BroadphaseResult& result) {
  Broadphase broadphase(manager, request);
  std::vector<Object*> objects;
  manager->getObjects(objects);
  for (const Object* object : objects) broadphase.run(*object, true);
  result = broadphase.finish(objects.size() *
                             (objects.size() - std::min<std::size_t>(1, objects.size())) / 2);
  return result.any.middle();
}

bool collisionProbabilityCallback(Object* a, Object* b, void* data) {
  auto& [request, result] = *static_cast<ProbabilityCallbackData*>(data);
  if (request.considers && !request.considers(*a, *b)) return false;
  return PairAnswers(request).add(*a, *b,
                                  GaussianDisplacement::fromIndependent(
                                      displacementOf(*a, request), displacementOf(*b, request)),
                                  result);
}

}  // namespace fcl_prob
