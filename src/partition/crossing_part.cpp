// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Parts of cells within several planes in which surfaces meet.
#include "base/constants.h"
#include "partition/crossing_witness.h"
#include "partition/direction_groups.h"

namespace fcl_prob::detail {

namespace {

bool isWithin(const CoveredPart& part, const Eigen::Vector3d& y) {
  for (int i = 0; i < part.count; ++i) {
    if (!(part.planes[i].m.dot(y) > part.planes[i].s)) return false;
  }
  return true;
}

}  // namespace

std::optional<CoveredPart> CrossingWitness::partBesidePlane(const Cell& cell, int most) {
  if (moves_) return std::nullopt;
  auto part = partOf(*best_->side, best_->vertex, touched_by_best_, cell, most);
  if (part && !meetsPlane(*part, cell)) part.reset();
  return part;
}

std::optional<CoveredPart> CrossingWitness::part(const Cell& cell, int most) {
  if (moves_) return std::nullopt;
  for (Side& side : sides_) {
    if (side.last_found < 0 || !findTouched(side, sweep(side, side.last_found, cell))) continue;
    auto part = partOf(side, side.last_found, touched_, cell, most);
    if (part && certify(side, side.last_found, *part, cell)) return part;
  }
  return std::nullopt;
}

// Every triangle that the vertex touches is on the wrong side of one of the planes.
std::optional<CoveredPart> CrossingWitness::partOf(const Side& side, int vertex,
                                                   const std::vector<Eigen::Vector3i>& touched,
                                                   const Cell& cell, int most) {
  if (touched.size() < 2) return std::nullopt;
  const SweptVertex swept = sweep(side, vertex, cell);
  across_.clear();
  for (const Eigen::Vector3i& t : touched) {
    across_.push_back(across(side, t));
    for (int k = cell.rank; k < 3; ++k) across_.back()[k] = 0.0;
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

// Whether the part has a point beyond the best plane, where the vertex is known to be inside. The
// part is convex and free of the outer mesh, so that the vertex is inside in all of it.
bool CrossingWitness::meetsPlane(const CoveredPart& part, const Cell& cell) const {
  const Eigen::Vector3d& m = best_->plane.m;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Vector3d y = pointBeyond(cell, m, best_->depth, trial);
    if (m.dot(y) > best_->plane.s && isWithin(part, y)) return true;
  }
  return false;
}

// One point of the part tells of all of it.
bool CrossingWitness::certify(Side& side, int vertex, const CoveredPart& part, const Cell& cell) {
  Eigen::Vector3d m = Eigen::Vector3d::Zero();
  for (int i = 0; i < part.count; ++i) m += part.planes[i].m;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Vector3d y = pointBeyond(cell, m, 0.0, trial);
    if (!isWithin(part, y)) continue;
    const Eigen::Vector3d point = side.inner.mesh().vertices[vertex] + side.sign * y;
    if (const auto inside = side.outer.isInside(point, trial % 3)) {
      return *inside && crosses(side, vertex, cell);
    }
  }
  return false;
}

}  // namespace fcl_prob::detail
