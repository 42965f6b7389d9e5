// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A convex polytope that is cut by planes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "convex/face_set.h"

namespace fcl_prob::detail {

/// Every cut keeps one side of a plane and closes the surface with a new face. The surface stays
/// closed whatever the rounding: a vertex is kept or cut off for all its faces, and where planes
/// nearly meet in a point, so that rounding leaves what is kept (or cut off) in several pieces, all
/// but one of them count as being on the other side.
class CutPolytope {
 public:
  CutPolytope() = default;
  explicit CutPolytope(const FaceSet& faces) { start(faces); }

  /// Begins anew, in the same memory. \param faces  closed; two-sided polygons are allowed
  void start(const FaceSet& faces);

  /// Keeps direction·x <= limit. Returns the largest |direction·x - limit| of a vertex that counts
  /// as being on the other side: 0 but for the rounding told above; infinite if the surface was not
  /// closed before, and then nothing is cut off.
  double cut(const Eigen::Vector3d& direction, double limit);

  void writeTo(FaceSet& faces);

 private:
  using Loop = std::vector<int>;

  /// An edge that crosses the plane, and the vertex made there.
  struct Crossing {
    int kept;
    int cut_off;
    int vertex;
  };

  bool isCutOff(int vertex) const { return excess_[vertex] > 0.0; }
  int crossingVertex(int kept, int cut_off);
  bool cutFaces();
  bool cutLoop(const Loop& loop, Loop& kept);
  bool closeWithCap();
  double takeSides();
  void markReached(int start, bool cut_off, std::vector<char>& reached) const;

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Loop> faces_;
  std::size_t face_count_ = 0;  // of faces_, whose rest is kept as memory

  // During a cut.
  std::vector<double> excess_;  // of each vertex beyond the plane
  std::vector<Crossing> crossings_;
  std::vector<std::pair<int, int>> rim_;  // directed edges of the new face
  std::vector<Loop> cut_faces_;
  std::size_t cut_count_ = 0;
  std::vector<int> index_;
};

}  // namespace fcl_prob::detail
