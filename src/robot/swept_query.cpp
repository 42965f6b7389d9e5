// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/swept_query.h"

#include <algorithm>
#include <memory>

#include "query/mixture_query.h"
#include "query/partition.h"
#include "query/plan_notes.h"
#include "query/truncation.h"
#include "robot/reversed.h"

namespace fcl_prob::detail {
namespace {

/// Of a copy of a tree and its nodes in the whitened frame, those above them included. Measured on
/// links of robots at 200 waypoints: 230 bytes a triangle.
constexpr std::size_t kNodeBytes = 100;
constexpr std::size_t kVertexBytes = 100;

/// Of the memory limit: the rest is for cells.
constexpr double kShareOfTrees = 0.6;

class SweptBodies {
 public:
  SweptBodies(const std::vector<SweptBody>& bodies, const PreparedGeometries& geometries,
              const PlacedObstacle& obstacle, ContactMeaning contact)
      : obstacle_(obstacle), poses_(obstacle.prepared.poses(obstacle.pose)), contact_(contact) {
    std::vector<const PieceTree*> trees;
    std::vector<fcl::Transform3d> middles;
    for (const SweptBody& body : bodies) {
      const PreparedGeometry& geometry = *geometries[body.body];
      trees.push_back(&geometry.pieces());
      middles.push_back(body.sweep.middle);
      const BodySweep& sweep = body.sweep;
      object_.parts.push_back(
          {sweep.middle, geometry.solid(contact), sweep.reach > 0.0 ? &sweep.motion : nullptr});
      reach_ = std::max(reach_, sweep.reach);
    }
    tree_ = joinPieceTrees(trees, middles);
    object_.tree = tree_.get();
  }

  /// \param ball  null: the displacement is not truncated
  ProbabilityResult answer(const GaussianDisplacement& of_bodies, const ProbabilityRequest& request,
                           const BallTruncation* ball = nullptr) const {
    PlacedGroup obstacle(obstacle_.prepared.group(), poses_, contact_);
    obstacle.boundBy(object_, of_bodies, reach_);
    return partitionProbability(object_, obstacle.object(), of_bodies, request, ball);
  }

 private:
  const PlacedObstacle& obstacle_;
  std::vector<fcl::Transform3d> poses_;  ///< of its bodies
  ContactMeaning contact_;
  std::shared_ptr<const PieceTree> tree_;
  PartitionObject object_{};
  double reach_ = 0.0;  ///< no point is farther from where the middle of its step has it
};

ProbabilityResult askSwept(const SweptBodies& bodies, const GaussianDisplacement& of_bodies,
                           const ProbabilityRequest& request) {
  return bodies.answer(of_bodies, request);
}

ProbabilityResult askSwept(const SweptBodies& bodies, const GaussianMixture& of_bodies,
                           const ProbabilityRequest& request) {
  return mixtureProbability(of_bodies, request,
                            [&](const GaussianDisplacement& one, const ProbabilityRequest& of_one) {
                              return bodies.answer(one, of_one);
                            });
}

ProbabilityResult askSwept(const SweptBodies& bodies, const TruncatedGaussian& of_bodies,
                           const ProbabilityRequest& request) {
  return truncatedAnswer(
      of_bodies, request,
      [&](const GaussianDisplacement& gaussian, const ProbabilityRequest& of_gaussian,
          const BallTruncation* ball) { return bodies.answer(gaussian, of_gaussian, ball); });
}

}  // namespace

ProbabilityResult sweptProbability(const std::vector<SweptBody>& bodies,
                                   const PreparedGeometries& geometries,
                                   const PlacedObstacle& obstacle,
                                   const ProbabilityRequest& request) {
  const SweptBodies swept(bodies, geometries, obstacle, request.contact);
  ProbabilityResult result = std::visit(
      [&](const auto& displacement) { return askSwept(swept, reversed(displacement), request); },
      obstacle.displacement);
  noteTolerance(request, result);
  return result;
}

std::size_t treeMemory(const PreparedGeometry& body) {
  const PieceTree& tree = body.pieces();
  return tree.nodes.size() * kNodeBytes + tree.vertices.size() * kVertexBytes;
}

std::size_t mostTreeMemory(const ProbabilityRequest& request) {
  return static_cast<std::size_t>(kShareOfTrees * static_cast<double>(request.max_memory));
}

}  // namespace fcl_prob::detail
