// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Two meshes in the whitened frame of N(0, I).
#pragma once

#include "mesh_shapes.h"
#include "scene/piece_tree.h"
#include "scene/whitened_tree.h"

namespace fcl_prob_test {

struct WhitenedMeshes {
  WhitenedMeshes(const TriangleMesh& a, const TriangleMesh& b)
      : model_a(makeModel<fcl::OBBRSSd>(a)),
        model_b(makeModel<fcl::OBBRSSd>(b)),
        tree_a(fcl_prob::detail::buildPieceTree(*model_a)),
        tree_b(fcl_prob::detail::buildPieceTree(*model_b)),
        pair(fcl_prob::detail::whiten({tree_a.get(), {{fcl::Transform3d::Identity(), nullptr}}},
                                      {tree_b.get(), {{fcl::Transform3d::Identity(), nullptr}}},
                                      whitening)) {}

  fcl_prob::detail::PartitionObject objectOf(bool is_a) const {
    return {(is_a ? tree_a : tree_b).get(), {{fcl::Transform3d::Identity(), nullptr}}};
  }

  std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> model_a;
  std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> model_b;
  std::shared_ptr<const fcl_prob::detail::PieceTree> tree_a;
  std::shared_ptr<const fcl_prob::detail::PieceTree> tree_b;
  fcl_prob::Whitening whitening{
      fcl_prob::GaussianDisplacement(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()), 1.0};
  fcl_prob::detail::WhitenedPair pair;
};

}  // namespace fcl_prob_test
