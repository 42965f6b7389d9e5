// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Parts of cells within several planes in which surfaces meet.
#include "base/constants.h"
#include "cells/crossing_witness.h"
#include "cells/direction_groups.h"

namespace fcl_prob::detail {

std::optional<CoveredPart> CrossingWitness::partBesidePlane(const Cell& cell, int most) {
  if (moves_) return std::nullopt;
  const SweptVertex swept = sweep(*best_->side, best_->vertex, cell);
  auto part = partOf(*best_->side, best_->vertex, swept, touched_by_best_, cell.rank, most);
  if (part && !meetsPlane(*part, cell)) part.reset();
  return part;
}

std::optional<CoveredPart> CrossingWitness::part(const Cell& cell, int most) {
  if (moves_) return std::nullopt;
  for (Side& side : sides_) {
    const int vertex = side.last_found;
    if (vertex < 0) continue;
    const SweptVertex swept = sweep(side, vertex, cell);
    if (!findTouched(side, swept)) continue;
    auto part = partOf(side, vertex, swept, touched_, cell.rank, most);
    if (!part) continue;
    Eigen::Vector3d m = Eigen::Vector3d::Zero();
    for (int i = 0; i < part->count; ++i) m += part->planes[i].m;
    if (certify(side, vertex, *part, m, 0.0, cell)) return part;
  }
  return std::nullopt;
}

// Every triangle that the vertex touches is on the wrong side of one of the planes.
std::optional<CoveredPart> CrossingWitness::partOf(const Side& side, int vertex,
                                                   const SweptVertex& swept,
                                                   const std::vector<Eigen::Vector3i>& touched,
                                                   int rank, int most) {
  if (touched.size() < 2) return std::nullopt;
  across_.clear();
  for (const Eigen::Vector3i& t : touched) {
    across_.push_back(across(side, t));
    for (int k = rank; k < 3; ++k) across_.back()[k] = 0.0;
  }
  const std::vector<int> groups = groupByDirection(across_, most);
  CoveredPart part;
  for (int group = 0; group < most; ++group) {
    Eigen::Vector3d m = Eigen::Vector3d::Zero();
    group_.clear();
    for (std::size_t i = 0; i < groups.size(); ++i) {
      if (groups[i] != group) continue;
      m += across_[i];
      group_.push_back(touched[i]);
    }
    if (group_.empty()) continue;
    const double length = m.norm();
    if (!(length > 0.0)) return std::nullopt;
    m /= length;
    const double s = highestTouched(side, vertex, swept, group_, m, kInfinity);
    if (s > -kInfinity) part.planes[part.count++] = {m, s};
  }
  return part;
}

// Whether the part has a point beyond the best plane, where the vertex is known to be inside, as it
// then is in all of the part.
bool CrossingWitness::meetsPlane(const CoveredPart& part, const Cell& cell) const {
  const Eigen::Vector3d& m = best_->plane.m;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Vector3d y = pointBeyond(cell, m, best_->depth, trial);
    if (m.dot(y) > best_->plane.s && isWithin(part, y)) return true;
  }
  return false;
}

}  // namespace fcl_prob::detail
