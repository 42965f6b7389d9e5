// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A convex polytope that is cut by planes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cobstacle/face_set.h"

namespace fcl_prob::detail {

/// Every cut keeps one side of a plane and closes the surface with a new face. The
/// surface stays closed whatever the rounding, since a vertex is kept or cut off for all its faces.
class CutPolytope {
 public:
  CutPolytope() = default;
  explicit CutPolytope(const FaceSet& faces) { start(faces); }

  /// Begins anew, in the same memory.
  void start(const FaceSet& faces);

  /// Keeps direction·x <= limit.
  void cut(const Eigen::Vector3d& direction, double limit);

  void writeTo(FaceSet& faces);

 private:
  using Loop = std::vector<int>;

  /// An edge that crosses the plane, and the vertex made there.
  struct Crossing {
    int kept;
    int cut_off;
    int vertex;
  };

  int crossingVertex(int kept, int cut_off);
  void cutLoop(const Loop& loop, Loop& kept);

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Loop> faces_;
  std::size_t face_count_ = 0;  // of faces_, whose rest is kept as memory

  // During a cut.
  std::vector<double> excess_;  // of each vertex beyond the plane
  std::vector<Crossing> crossings_;
  std::vector<std::pair<int, int>> rim_;  // directed edges of the new face
  Loop scratch_;
  std::vector<int> index_;
};

}  // namespace fcl_prob::detail
