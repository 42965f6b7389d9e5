// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Queries of the partition on meshes, for tests.
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "geometry/closed_mesh.h"
#include "mesh_shapes.h"
#include "query/partition.h"
#include "random_bodies.h"

namespace fcl_prob_test {

/// A pair of meshes with everything that the partition needs.
class PartitionQuery {
 public:
  PartitionQuery(const TriangleMesh& mesh_a, const TriangleMesh& mesh_b)
      : model_a(makeModel<fcl::OBBRSSd>(mesh_a)),
        model_b(makeModel<fcl::OBBRSSd>(mesh_b)),
        tree_a_(fcl_prob::detail::buildPieceTree(*model_a)),
        tree_b_(fcl_prob::detail::buildPieceTree(*model_b)) {}

  /// Both meshes must be closed.
  void makeSolid() {
    using fcl_prob::detail::ClosedMesh;
    solid_a_ = std::make_unique<ClosedMesh>(fcl_prob::detail::meshView(*model_a), "A");
    solid_b_ = std::make_unique<ClosedMesh>(fcl_prob::detail::meshView(*model_b), "B");
  }

  /// Both turned at random, B so far away (metres).
  void placeAtRandom(double nearest, double farthest, RandomBodies& random) {
    pose_a.linear() = random.rotation();
    pose_b.linear() = random.rotation();
    pose_b.translation() = random.uniform(nearest, farthest) * random.direction();
  }

  fcl_prob::ProbabilityResult run(const fcl_prob::GaussianDisplacement& displacement,
                                  const fcl_prob::ProbabilityRequest& request) const {
    return fcl_prob::detail::partitionProbability(a(), b(), displacement, request);
  }

  fcl_prob::detail::PartitionObject a() const {
    return {tree_a_.get(), {{pose_a, solid_a_.get()}}};
  }
  fcl_prob::detail::PartitionObject b() const {
    return {tree_b_.get(), {{pose_b, solid_b_.get()}}};
  }

  std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> model_a;
  std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> model_b;
  fcl::Transform3d pose_a = fcl::Transform3d::Identity();
  fcl::Transform3d pose_b = fcl::Transform3d::Identity();

 private:
  std::shared_ptr<const fcl_prob::detail::PieceTree> tree_a_;
  std::shared_ptr<const fcl_prob::detail::PieceTree> tree_b_;
  std::unique_ptr<fcl_prob::detail::ClosedMesh> solid_a_;
  std::unique_ptr<fcl_prob::detail::ClosedMesh> solid_b_;
};

/// Standard deviations within a range (metres) along random axes.
inline fcl_prob::GaussianDisplacement obliqueDisplacement(double least, double most,
                                                          RandomBodies& random) {
  return fcl_prob::GaussianDisplacement::fromStandardDeviations(
      {random.uniform(least, most), random.uniform(least, most), random.uniform(least, most)},
      random.quaternion());
}

inline bool planMentions(const fcl_prob::ProbabilityResult& result, const std::string& words) {
  return std::any_of(result.plan.begin(), result.plan.end(), [&words](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

/// A request for a certified interval to a relative tolerance alone.
inline fcl_prob::ProbabilityRequest intervalRequest(double relative_tolerance) {
  fcl_prob::ProbabilityRequest request;
  request.method = fcl_prob::ProbabilityMethod::interval;
  request.absolute_tolerance = 0.0;
  request.relative_tolerance = relative_tolerance;
  return request;
}

}  // namespace fcl_prob_test
