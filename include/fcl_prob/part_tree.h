// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A tree of bounding volumes over convex parts: the paper's own setting.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "fcl_prob/convex_parts.h"
#include "fcl_prob/general_pcd.h"

namespace fcl_prob {

namespace detail {
class PartBoundingTree;
}

/// The bounding volumes of the paper, and those of FCL.
enum class PartVolume {
  sphere,
  aabb,
  obb,
  rss,
  obbrss,
  kios,
  kdop16,
  kdop18,
  kdop24,
  kdop26,
  convex  ///< convex hulls: those of leaves are the parts themselves
};

/// A binary tree whose leaves are the parts of a mesh, with one bounding volume around what is
/// below each node, in the frame of the mesh, metres. Parts that make the smallest hulls together
/// are siblings. Immutable; copies share their data.
class PartTree {
 public:
  PartTree(const ConvexParts& parts, PartVolume volume);

  PartVolume boundingVolume() const;

  /// 2 n - 1 for n parts; node 0 is the root.
  std::size_t nodeCount() const;

  /// Volume of a node's bounding volume, cubic metres. (RSS and kIOS: of the box around it.)
  double volume(std::size_t node) const;

  const detail::PartBoundingTree& tree() const { return *tree_; }

 private:
  std::shared_ptr<const detail::PartBoundingTree> tree_;
};

/// GeneralPCD, Algorithm 2 of the paper, over the convex parts of two meshes. At least the
/// probability that parts of them touch, and so that the meshes' surfaces do. LeafBound::triangles
/// bounds pairs of leaves by the parts themselves.
/// \throws InvalidRequest if the bounding volumes are not the same; InvalidPose, InvalidRequest
GeneralPcdResult generalPcd(const PartTree& a, const fcl::Transform3d& pose_a, const PartTree& b,
                            const fcl::Transform3d& pose_b,
                            const GaussianDisplacement& displacement,
                            const GeneralPcdRequest& request = {});

}  // namespace fcl_prob
