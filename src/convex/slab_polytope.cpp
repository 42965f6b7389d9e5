// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/slab_polytope.h"

#include "convex/cut_polytope.h"

namespace fcl_prob::detail {

const std::vector<Eigen::Vector3d>& dopDirections() {
  static const std::vector<Eigen::Vector3d> directions = {
      {1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {1, 1, 0},  {1, 0, 1},  {0, 1, 1}, {1, -1, 0},
      {1, 0, -1}, {0, 1, -1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}};
  return directions;
}

void setToSlabs(const std::vector<Slab>& slabs, double padding, CutPolytope& work, FaceSet& faces) {
  const Eigen::Vector3d lower(slabs[0].lower, slabs[1].lower, slabs[2].lower);
  const Eigen::Vector3d upper(slabs[0].upper, slabs[1].upper, slabs[2].upper);
  setToBox(lower - Eigen::Vector3d::Constant(padding), upper + Eigen::Vector3d::Constant(padding),
           faces);
  work.start(faces);
  for (std::size_t k = 3; k < slabs.size(); ++k) {
    const double widening = padding * slabs[k].direction.norm();
    work.cut(slabs[k].direction, slabs[k].upper + widening);
    work.cut(-slabs[k].direction, -(slabs[k].lower - widening));
  }
  work.writeTo(faces);
}

void setToSlabs(const std::vector<Slab>& slabs, double padding, FaceSet& faces) {
  CutPolytope work;
  setToSlabs(slabs, padding, work, faces);
}

}  // namespace fcl_prob::detail
