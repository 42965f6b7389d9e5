// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A bounding volume tree whose volumes are convex hulls.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <cstddef>
#include <memory>

namespace fcl_prob {

namespace detail {
class HullTree;
}

/// The tree of a fcl::BVHModel with the convex hull (Qhull) of the triangles below it at every
/// node, in the frame of the model, metres. Hulls of inner nodes are made from those of their
/// children. Immutable; copies share their data; independent of the model afterwards.
class ConvexHullTree {
 public:
  /// \param mesh  a finished fcl::BVHModel of any of FCL's bounding volumes, which sets the
  /// topology \throws InvalidGeometry if the mesh is malformed, UnsupportedGeometry if it is no
  /// mesh
  explicit ConvexHullTree(const fcl::CollisionGeometryd& mesh);

  std::size_t nodeCount() const;

  /// Volume of a node's hull, cubic metres; node 0 is the root.
  double volume(std::size_t node) const;

  const detail::HullTree& tree() const { return *tree_; }

 private:
  std::shared_ptr<const detail::HullTree> tree_;
};

}  // namespace fcl_prob
