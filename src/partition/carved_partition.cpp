// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/carved_partition.h"

#include <algorithm>
#include <optional>
#include <string>

#include "partition/carving_engine.h"

namespace fcl_prob::detail {
namespace {

// Masses of cells are not computed to more digits than a tolerance of this needs.
constexpr double kLeastTolerance = 1e-4;

// A fan's arcs are those of its cones as long as whitening stretches it no more than this.
constexpr double kMostAnisotropic = 100.0;

bool isSingleMesh(const PartitionObject& object) {
  return object.parts.size() == 1 && object.tree->isMesh() && !object.tree->isEmpty();
}

// The larger of two, so that there are fewer triangles beside it.
bool isFanOfA(const PartitionObject& a, const PartitionObject& b) {
  if (!b.tree->fan) return true;
  return a.tree->fan && a.tree->triangles.size() >= b.tree->triangles.size();
}

}  // namespace

bool mayBeCarved(const PartitionObject& a, const PartitionObject& b,
                 const GaussianDisplacement& displacement, const ProbabilityRequest& request) {
  if (!isSingleMesh(a) || !isSingleMesh(b)) return false;
  if (!a.tree->fan && !b.tree->fan) return false;
  if (request.method == ProbabilityMethod::estimate || request.gradient) return false;
  if (a.motion || b.motion || a.parts[0].sweep || b.parts[0].sweep) return false;
  if (!request.threshold && request.relative_tolerance < kLeastTolerance) return false;
  const Eigen::Vector3d& sigma = displacement.standardDeviations();
  return displacement.rank() == 3 && sigma[0] <= kMostAnisotropic * sigma[2];
}

bool carve(const PartitionObject& a, const PartitionObject& b,
           const GaussianDisplacement& displacement, const ProbabilityRequest& request,
           ProbabilityResult& result) {
  const bool fan_is_a = isFanOfA(a, b);
  const PartitionObject& body = fan_is_a ? a : b;
  const PartitionObject& mesh = fan_is_a ? b : a;
  const double unit = std::max({a.tree->radius(), b.tree->radius(), 1e-150});
  const Whitening whitening(displacement, unit);
  const WhitenedPair pair = whiten(a, b, whitening);
  FatObstacles obstacles(pair, *body.tree->fan, fan_is_a,
                         whitening.matrix() * body.parts[0].pose.linear());
  if (!obstacles.usable()) return false;
  std::optional<SolidContact> solids;
  if (a.parts[0].solid || b.parts[0].solid) solids.emplace(a, b, whitening, pair);
  if (!body.parts[0].solid && !obstacles.isTooSmallFor(mesh.tree->spans)) return false;
  if (claim_observer) claim_observer->frame(whitening, displacement);
  CarvingEngine engine(obstacles, solids ? &*solids : nullptr, request, result.statistics);
  result.method = ProbabilityMethod::interval;
  result.status = engine.run();
  if (obstacles.failed()) return false;
  const Bounds interval = engine.interval();
  result.lower = interval.lower;
  result.upper = interval.upper;
  if (result.status == ProbabilityStatus::resolution_limit) return false;
  result.plan.push_back("object " + std::string(fan_is_a ? "A" : "B") +
                        " is convex: one piece of " + std::to_string(obstacles.faceCount()) +
                        " faces, no tree of its " + std::to_string(body.tree->triangles.size()) +
                        " triangles");
  result.plan.push_back("partition of the displacement space along the C-obstacles' own planes: " +
                        std::to_string(result.statistics.cells) + " cells, " +
                        std::to_string(result.statistics.leaf_pairs) + " C-obstacles");
  if (solids) result.plan.push_back("containment decided once for every free cell");
  return true;
}

}  // namespace fcl_prob::detail
