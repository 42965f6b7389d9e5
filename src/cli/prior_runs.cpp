// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/prior_runs.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "cli/number_text.h"

namespace fcl_prob::cli {
namespace {

// Tests a pair of boxes quickest.
constexpr const char* kVolume = "obb";

std::shared_ptr<const fcl::BVHModel<SphereBv>> sphereTree(const LoadedObject& object) {
  const auto* mesh = std::get_if<TriangleMesh>(&object.shape);
  return mesh != nullptr ? buildModel<SphereBv>(*mesh) : nullptr;
}

PriorAnswer approximation(double raw, double time_ms) {
  PriorAnswer answer;
  answer.raw = raw;
  answer.value = std::min(1.0, raw);
  answer.remark = "on either side of P";
  answer.time_ms = time_ms;
  return answer;
}

PriorAnswer bound(double raw, double time_ms) {
  PriorAnswer answer;
  answer.raw = raw;
  answer.value = std::min(1.0, raw);
  answer.upper = answer.value;
  answer.time_ms = time_ms;
  return answer;
}

}  // namespace

std::string toString(PriorMethod method) {
  switch (method) {
    case PriorMethod::du_toit_burdick:
      return "du-toit-burdick";
    case PriorMethod::park:
      return "park";
    case PriorMethod::enlargement:
      return "enlargement";
  }
  throw InvalidRequest("not a PriorMethod");
}

std::string PriorRun::budget() const {
  if (method == PriorMethod::enlargement) return numberText(100.0 * confidence, 6) + " %";
  if (reach == PriorReach::objects) return "whole objects";
  return "trees delta " + numberText(confidence, 6);
}

std::vector<PriorRun> priorRunsOfComparison() {
  using Method = PriorMethod;
  std::vector<PriorRun> runs;
  for (const Method method : {Method::du_toit_burdick, Method::park}) {
    runs.push_back({method, PriorReach::objects});
    for (const double delta : {0.9, 0.99}) runs.push_back({method, PriorReach::trees, delta});
  }
  for (const double confidence : {0.5, 0.95, 0.999}) {
    runs.push_back({Method::enlargement, PriorReach::objects, confidence});
  }
  return runs;
}

PriorScene::PriorScene(const PreparedScene& scene)
    : scene_(scene),
      a_(buildGeometry(scene.objectA(), kVolume)),
      b_(buildGeometry(scene.objectB(), kVolume)),
      tree_a_(sphereTree(scene.objectA())),
      tree_b_(sphereTree(scene.objectB())) {}

PriorAnswer PriorScene::answer(const PriorRun& run, ContactMeaning contact) const {
  const bool surfaces = run.method == PriorMethod::enlargement || run.reach == PriorReach::trees;
  if (contact == ContactMeaning::solid && surfaces && (tree_a_ || tree_b_)) {
    throw UnsupportedGeometry(toString(run.method) + " bounds contact of surfaces, not of solids");
  }
  if (run.method == PriorMethod::enlargement) return enlarged(run.confidence);
  return run.reach == PriorReach::objects ? ofObjects(run) : ofTrees(run);
}

PriorAnswer PriorScene::ofObjects(const PriorRun& run) const {
  const BoundingSphere a = boundingSphere(*a_);
  const BoundingSphere b = boundingSphere(*b_);
  const bool park = run.method == PriorMethod::park;
  const auto method = park ? parkBound : duToitBurdick;
  const detail::Stopwatch watch;
  const double raw =
      method(a, scene_.objectA().pose, b, scene_.objectB().pose, scene_.displacement());
  const double time_ms = watch.milliseconds();
  return park ? bound(raw, time_ms) : approximation(raw, time_ms);
}

PriorAnswer PriorScene::ofTrees(const PriorRun& run) const {
  if (!tree_a_ || !tree_b_) throw UnsupportedGeometry("trees of spheres are for two meshes");
  GeneralPcdRequest request;
  request.confidence = run.confidence;
  request.variant = run.variant;
  request.max_pairs = ProbabilityRequest().max_cells;  // what general-pcd has by default
  const fcl::Transform3d& pose_a = scene_.objectA().pose;
  const fcl::Transform3d& pose_b = scene_.objectB().pose;
  const detail::Stopwatch watch;
  if (run.method == PriorMethod::du_toit_burdick) {
    const double raw =
        duToitBurdickSum(*tree_a_, pose_a, *tree_b_, pose_b, scene_.displacement(), request);
    return approximation(raw, watch.milliseconds());
  }
  const GeneralPcdResult result =
      parkSum(*tree_a_, pose_a, *tree_b_, pose_b, scene_.displacement(), request);
  return bound(result.raw_sum, watch.milliseconds());
}

PriorAnswer PriorScene::enlarged(double confidence) const {
  const detail::Stopwatch watch;
  const EnlargedCollision result = enlargedCollision(
      *a_, scene_.objectA().pose, *b_, scene_.objectB().pose, scene_.displacement(), confidence);
  PriorAnswer answer;
  answer.time_ms = watch.milliseconds();
  answer.value = result.upper;
  answer.upper = result.upper;
  answer.remark = result.collides ? "collides: says nothing of P" : "free";
  return answer;
}

}  // namespace fcl_prob::cli
