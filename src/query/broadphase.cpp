// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/broadphase.h"

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>

#include "base/refuse_band.h"
#include "fcl_prob/collision_probability.h"
#include "fcl_prob/combined_bounds.h"
#include "fcl_prob/exceptions.h"
#include "query/object_pairs.h"
#include "query/pair_query.h"
#include "query/parts_loop.h"

namespace fcl_prob {
namespace {

using Object = fcl::CollisionObjectd;
using Manager = fcl::BroadPhaseCollisionManagerd;
using detail::ObjectPairs;
using detail::PartsLoop;

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

/// Those that were asked, in the order of the managers.
std::vector<PairProbability> answeredPairs(const ObjectPairs& pairs, const PartsLoop& loop) {
  std::vector<PairProbability> answered;
  for (std::size_t i = 0; i < loop.answers().size(); ++i) {
    const auto& [a, b] = pairs.near()[i];
    if (loop.answers()[i]) answered.push_back({a->object, b->object, *loop.answers()[i]});
  }
  return answered;
}

/// By a limit of the whole call, or not asked at all.
bool wasCut(const std::optional<ProbabilityResult>& answer) {
  return !answer || answer->status == ProbabilityStatus::time_limit ||
         answer->status == ProbabilityStatus::cell_limit ||
         answer->status == ProbabilityStatus::cancelled;
}

BroadphaseResult answerPairs(const ObjectPairs& pairs, const BroadphaseRequest& request) {
  const Bounds culled{0.0, pairs.culledUpper()};
  const PartsLoop::Ask ask = [&](std::size_t i, const ProbabilityRequest& of_pair) {
    const auto& [a, b] = pairs.near()[i];
    const detail::PairQuery query(a->geometry, b->geometry);
    return query.answer(a->object->getTransform(), b->object->getTransform(),
                        GaussianDisplacement::fromIndependent(a->displacement, b->displacement),
                        of_pair);
  };
  const PartsLoop::Combine any = [&](const std::vector<Bounds>& events) {
    return anyOf({anyOf(events), culled});
  };
  PartsLoop loop(request.query, ask, any, std::vector<Bounds>(pairs.near().size(), {0.0, 1.0}));
  const auto isStopped = [&] {
    return request.stop_above && any(loop.bounds()).lower > *request.stop_above;
  };
  loop.endWhen(isStopped);
  const auto wanted = [&](std::size_t) { return std::optional(request.query); };
  loop.askEach(wanted);
  loop.askAgain(wanted);
  BroadphaseResult result;
  result.pairs = answeredPairs(pairs, loop);
  result.pairs_culled = pairs.culled();
  result.culled_upper = pairs.culledUpper();
  result.any = any(loop.bounds());
  result.stopped = isStopped();
  const auto cut = std::find_if(loop.answers().begin(), loop.answers().end(), wasCut);
  if (cut != loop.answers().end() && !result.stopped) {
    // Where a share that is left is too small to be of use, none of the whole has been reached yet.
    result.interrupted = loop.isOut() ? loop.out() : (*cut)->status;
  }
  return result;
}

double answer(const ObjectPairs::Objects& a, const ObjectPairs::Objects& b,
              const BroadphaseRequest& request, BroadphaseResult& result) {
  validateRequest(request.query);
  detail::refuseBand(request.query, "managers, which cull by the shapes as they are");
  result = answerPairs(ObjectPairs(a, b, request), request);
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
