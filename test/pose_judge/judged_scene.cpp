// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "judged_scene.h"

namespace fcl_prob_judge {
namespace {

double sumOf(const std::vector<Component>& components,
             const std::function<double(const Integrand&)>& mean) {
  double total = 0.0;
  for (const Component& component : components) total += component.weight * mean(component.truth);
  return total;
}

}  // namespace

double JudgedScene::roughTruth() const { return sumOf(components, roughMeanOf); }

void JudgedScene::findTruth() { truth = sumOf(components, meanOf); }

AskableScene::AskableScene(JudgedScene scene) : scene_(std::move(scene)) {
  if (scene_.pair) {
    pair_query_.emplace(scene_.a.front(), scene_.b.front());
    return;
  }
  query_.emplace(scene_.a, scene_.b);
  for (const Component& component : scene_.components) {
    mixture_.push_back({component.weight, component.configuration});
  }
}

fcl_prob::ProbabilityResult AskableScene::ask(const fcl_prob::ProbabilityRequest& request) const {
  fcl_prob::ProbabilityResult result;
  if (pair_query_) {
    pair_query_->collisionProbability(scene_.pair->pose_a, scene_.pair->pose_b, scene_.pair->error,
                                      request, result);
  } else if (mixture_.size() == 1) {
    query_->collisionProbability(*mixture_.front().configuration, request, result);
  } else {
    query_->collisionProbability(mixture_, request, result);
  }
  return result;
}

}  // namespace fcl_prob_judge
