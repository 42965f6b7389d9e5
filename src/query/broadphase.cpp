// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/broadphase.h"

#include <string>
#include <unordered_set>
#include <utility>

#include "base/budget.h"
#include "base/refuse_band.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/exceptions.h"
#include "query/object_pairs.h"
#include "query/pair_query.h"

namespace fcl_prob {
namespace {

using Object = fcl::CollisionObjectd;
using Manager = fcl::BroadPhaseCollisionManagerd;
using detail::ObjectPairs;

/// Adds an answer, and keeps the bounds of P(any) up to date.
void include(PairProbability&& pair, const BroadphaseRequest& request, BroadphaseResult& result) {
  const Bounds event{pair.result.lower.value_or(0.0), pair.result.upper.value_or(1.0)};
  result.any = result.pairs.empty() ? event : anyOf({result.any, event});
  result.pairs.push_back(std::move(pair));
  result.stopped = request.stop_above && result.any.lower > *request.stop_above;
}

/// Each object once, in the order in which the manager lists them.
ObjectPairs::Objects objectsOf(const Manager* manager, const char* name) {
  if (manager == nullptr) throw InvalidRequest(std::string(name) + " is null");
  std::vector<Object*> listed;
  manager->getObjects(listed);
  ObjectPairs::Objects objects;
  std::unordered_set<const Object*> seen;
  for (const Object* object : listed) {
    if (seen.insert(object).second) objects.push_back(object);
  }
  return objects;
}

/// The answers for the pairs of one call.
class Broadphase {
 public:
  Broadphase(const ObjectPairs::Objects& a, const ObjectPairs::Objects& b,
             const BroadphaseRequest& request)
      : request_(request), budget_(request.query), pairs_(a, b, request) {
    result_.pairs_culled = pairs_.culled();
    result_.culled_upper = pairs_.culledUpper();
  }

  BroadphaseResult answer() {
    const std::size_t count = pairs_.near().size();
    for (std::size_t i = 0; i < count && !result_.stopped; ++i) {
      if (timeIsUp()) result_.interrupted = ProbabilityStatus::time_limit;
      if (result_.interrupted) break;
      add(i);
    }
    const bool all = result_.pairs.size() == count;
    result_.any.upper = all ? anyOf({result_.any, {0.0, result_.culled_upper}}).upper : 1.0;
    return std::move(result_);
  }

 private:
  bool timeIsUp() const {
    return request_.query.time_limit && budget_.seconds() >= *request_.query.time_limit;
  }

  void add(std::size_t i) {
    const auto& [a, b] = pairs_.near()[i];
    const detail::PairQuery query(a->geometry, b->geometry);
    const auto displacement =
        GaussianDisplacement::fromIndependent(a->displacement, b->displacement);
    include({a->object, b->object,
             query.answer(a->object->getTransform(), b->object->getTransform(), displacement,
                          ofPair(i))},
            request_, result_);
  }

  /// The request for a pair, which reports and is cancelled as a part of the whole.
  ProbabilityRequest ofPair(std::size_t i) {
    const std::size_t count = pairs_.near().size();
    ProbabilityRequest request = request_.query;
    budget_.shareTime(count - i, request);
    if (!request_.query.on_progress) return request;
    request.on_progress = [this, i, count](const ProbabilityProgress& of_pair) {
      ProbabilityProgress progress;
      progress.interval = {result_.any.lower, 1.0};
      progress.fraction = (static_cast<double>(i) + of_pair.fraction) / static_cast<double>(count);
      progress.seconds = budget_.seconds();
      const bool goes_on = request_.query.on_progress(progress);
      if (!goes_on) result_.interrupted = ProbabilityStatus::cancelled;
      return goes_on;
    };
    return request;
  }

  const BroadphaseRequest& request_;
  detail::Budget budget_;
  ObjectPairs pairs_;
  BroadphaseResult result_;
};

double answer(const ObjectPairs::Objects& a, const ObjectPairs::Objects& b,
              const BroadphaseRequest& request, BroadphaseResult& result) {
  validateRequest(request.query);
  detail::refuseBand(request.query, "managers, which cull by the shapes as they are");
  result = Broadphase(a, b, request).answer();
  return result.any.middle();
}

}  // namespace

double collisionProbability(const Object* object, const Manager* manager,
                            const BroadphaseRequest& request, BroadphaseResult& result) {
  if (object == nullptr) throw InvalidGeometry("the object is null");
  return answer({object}, objectsOf(manager, "the manager"), request, result);
}

double collisionProbability(const Manager* manager_a, const Manager* manager_b,
                            const BroadphaseRequest& request, BroadphaseResult& result) {
  const ObjectPairs::Objects objects_a = objectsOf(manager_a, "manager A");
  return answer(objects_a, objectsOf(manager_b, "manager B"), request, result);
}

double collisionProbability(const Manager* manager, const BroadphaseRequest& request,
                            BroadphaseResult& result) {
  const ObjectPairs::Objects objects = objectsOf(manager, "the manager");
  return answer(objects, objects, request, result);
}

bool collisionProbabilityCallback(Object* a, Object* b, void* data) {
  auto& [request, result] = *static_cast<ProbabilityCallbackData*>(data);
  if (request.considers && !request.considers(*a, *b)) return false;
  detail::refuseBand(request.query, "managers, which cull by the shapes as they are");
  const PreparedQuery query(a->collisionGeometry(), b->collisionGeometry());
  const auto displacement = GaussianDisplacement::fromIndependent(
      detail::displacementOf(*a, request), detail::displacementOf(*b, request));
  PairProbability pair{a, b, {}};
  query.collisionProbability(a->getTransform(), b->getTransform(), displacement, request.query,
                             pair.result);
  include(std::move(pair), request, result);
  return result.stopped;
}

}  // namespace fcl_prob
