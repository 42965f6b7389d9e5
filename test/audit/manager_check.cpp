// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// FCL's managers: every pair is answered or counted as culled, and the bounds are those of all.
#include <fcl/broadphase/broadphase_SSaP.h>
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/broadphase/broadphase_interval_tree.h>
#include <fcl/broadphase/broadphase_spatialhash.h>

#include <cmath>
#include <sstream>

#include "ask.h"
#include "checks.h"
#include "fcl_prob/fcl_prob.h"

namespace fcl_prob_audit {
namespace {

using namespace fcl_prob;
using Object = fcl::CollisionObjectd;
using Manager = fcl::BroadPhaseCollisionManagerd;

std::unique_ptr<Manager> newManager(ManagerKind kind) {
  switch (kind) {
    case ManagerKind::naive:
      return std::make_unique<fcl::NaiveCollisionManagerd>();
    case ManagerKind::ssap:
      return std::make_unique<fcl::SSaPCollisionManagerd>();
    case ManagerKind::sap:
      return std::make_unique<fcl::SaPCollisionManagerd>();
    case ManagerKind::interval_tree:
      return std::make_unique<fcl::IntervalTreeCollisionManagerd>();
    case ManagerKind::dynamic_tree:
      return std::make_unique<fcl::DynamicAABBTreeCollisionManagerd>();
    case ManagerKind::dynamic_tree_array:
      return std::make_unique<fcl::DynamicAABBTreeCollisionManager_Arrayd>();
    case ManagerKind::hash:
      return std::make_unique<fcl::SpatialHashingCollisionManager<double>>(
          1.0, Vector3d::Constant(-8.0), Vector3d::Constant(8.0));
  }
  return nullptr;
}

/// A pair of the question, answered by itself.
struct Single {
  Bounds bounds;
  bool answered = false;  ///< by the manager
};

class ManagerCheck {
 public:
  ManagerCheck(const Scene& scene, Tally& tally, std::vector<Violation>& found)
      : scene_(scene), tally_(tally), found_(found) {}

  void run() {
    FamilyTally& family = tally_.families[scene_.family];
    Answer answer;
    guarded(answer, [&] { ask(); });
    if (!answer.foreign_exception.empty())
      found_.push_back({"exception", answer.foreign_exception});
    if (!asked_) {
      ++family.refused;
      ++tally_.refusals[scene_.family + ": " + answer.refusal.substr(0, 70)];
      return;
    }
    ++family.answered;
    ++tally_.checks["manager " + nameOf(scene_.manager.kind)];
    guarded(answer, [&] { answerPairs(); });
    compare();
    family.non_trivial += result_.any.lower > 1e-3 && result_.any.upper < 0.999;
  }

 private:
  void ask() {
    moving_ = std::make_unique<Object>(makeGeometry(scene_.a.at(0).shape), scene_.a[0].pose);
    moving_->computeAABB();
    for (const Member& member : scene_.b) {
      objects_.push_back(std::make_unique<Object>(makeGeometry(member.shape), member.pose));
      objects_.back()->computeAABB();
    }
    manager_ = newManager(scene_.manager.kind);
    std::vector<Object*> pointers;
    for (const auto& object : objects_) pointers.push_back(object.get());
    for (const int i : scene_.manager.registered_twice) {
      if (i < static_cast<int>(objects_.size())) {
        pointers.push_back(objects_[static_cast<std::size_t>(i)].get());
      }
    }
    manager_->registerObjects(pointers);
    manager_->setup();
    BroadphaseRequest request;
    request.query = scene_.request;
    request.culling_probability = scene_.manager.culling_probability;
    request.displacement = [this](const Object& object) { return displacementOf(object); };
    if (scene_.manager.within) {
      collisionProbability(manager_.get(), request, result_);
    } else {
      collisionProbability(moving_.get(), manager_.get(), request, result_);
    }
    asked_ = true;
  }

  GaussianDisplacement displacementOf(const Object& object) const {
    return makeDisplacement(scene_.displacements[&object == moving_.get() ? 0 : 1]);
  }

  void answerPair(const Object& a, const Object& b) {
    ProbabilityRequest request = scene_.request;
    ProbabilityResult result;
    collisionProbability(
        &a, &b, GaussianDisplacement::fromIndependent(displacementOf(a), displacementOf(b)),
        request, result);
    singles_[key(a, b)] = {{result.lower.value_or(0.0), result.upper.value_or(1.0)}, false};
  }

  using Key = std::pair<const Object*, const Object*>;
  static Key key(const Object& a, const Object& b) { return std::minmax(&a, &b); }

  void answerPairs() {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      if (!scene_.manager.within) answerPair(*moving_, *objects_[i]);
      for (std::size_t j = 0; scene_.manager.within && j < i; ++j) {
        answerPair(*objects_[i], *objects_[j]);
      }
    }
    complete_ = true;
  }

  void compare() {
    const auto report = [&](const std::string& check, const std::string& detail) {
      found_.push_back({check, nameOf(scene_.manager.kind) + ": " + detail});
    };
    std::ostringstream out;
    out.precision(17);
    out << "any [" << result_.any.lower << ", " << result_.any.upper << "], answered "
        << result_.pairs.size() << ", culled " << result_.pairs_culled << " for "
        << result_.culled_upper;
    if (!(result_.any.lower >= 0.0 && result_.any.lower <= result_.any.upper &&
          result_.any.upper <= 1.0)) {
      report("manager's bounds", out.str());
    }
    for (const PairProbability& pair : result_.pairs) {
      const auto found = singles_.find(key(*pair.a, *pair.b));
      if (found != singles_.end()) found->second.answered = true;
    }
    double largest = 0.0, culled = 0.0, all = 0.0;
    std::size_t left = 0;
    for (const auto& [unused, single] : singles_) {
      largest = std::max(largest, single.bounds.lower);
      all += single.bounds.upper;
      if (single.answered) continue;
      culled += single.bounds.lower;
      ++left;
    }
    out << "; by themselves: the largest lower " << largest << ", of those not answered " << culled;
    if (result_.any.upper < largest) report("manager's upper bound", out.str());
    // Where a limit ended the call some pairs were neither asked nor culled.
    const bool is_whole = !result_.interrupted;
    if (is_whole && result_.culled_upper < culled * (1 - 1e-9)) report("culled_upper", out.str());
    if (complete_ && result_.any.lower > std::min(1.0, all * (1 + 1e-9))) {
      report("manager's lower bound", out.str());
    }
    if (complete_ && is_whole && !result_.stopped && result_.pairs_culled < left) {
      report("pairs_culled", out.str());
    }
    // Any of those not looked at may touch for certain.
    const bool unseen = complete_ && result_.interrupted && result_.pairs_culled < left;
    if (unseen && result_.any.upper < 1.0) report("pairs not looked at", out.str());
    if (result_.pairs_culled > 10'000) report("pairs_culled", out.str());
  }

  const Scene& scene_;
  Tally& tally_;
  std::vector<Violation>& found_;
  std::unique_ptr<Object> moving_;
  std::vector<std::unique_ptr<Object>> objects_;
  std::unique_ptr<Manager> manager_;
  BroadphaseResult result_;
  std::map<Key, Single> singles_;
  bool asked_ = false, complete_ = false;
};

}  // namespace

void checkManager(const Scene& scene, Tally& tally, std::vector<Violation>& found) {
  ManagerCheck(scene, tally, found).run();
}

}  // namespace fcl_prob_audit
