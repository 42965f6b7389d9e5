// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/obstacle_chooser.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

// Samples of a cell by which its best obstacle is chosen, about.
constexpr std::size_t kSamples = 10;

}  // namespace

void ObstacleChooser::takeSamples(const CellPolytope& body) {
  const std::vector<Eigen::Vector3d>& vertices = body.vertices();
  const Eigen::Vector3d middle = body.middle();
  samples_.assign(1, middle);
  const std::size_t step = 1 + vertices.size() / kSamples;
  for (std::size_t i = 0; i < vertices.size(); i += step) {
    samples_.push_back(middle + 0.6 * (vertices[i] - middle));
  }
  weights_.clear();
  for (const Eigen::Vector3d& sample : samples_) {
    weights_.push_back(std::exp(0.5 * (middle.squaredNorm() - sample.squaredNorm())));
  }
}

std::size_t ObstacleChooser::best(const CellPolytope& body, const ObstacleList& list) {
  takeSamples(body);
  const auto encloses = [this](const ObstacleList::Entry& entry) {
    return obstacles_.encloses(entry.obstacle.member);
  };
  const bool only_hulls = std::all_of(list.entries.begin(), list.entries.end(), encloses);
  std::size_t best = 0;
  double most = -kInfinity;
  for (std::size_t e = 0; e < list.entries.size(); ++e) {
    if (!only_hulls && encloses(list.entries[e])) continue;
    const double score = scoreOf(list, list.entries[e], most);
    if (score > most) {
      most = score;
      best = e;
    }
  }
  return best;
}

// The weight of the samples that are within an obstacle, or else less than 0 by how far the nearest
// of them is from it. No more than `most` is as good as any: such an obstacle is given up early,
// and what one sample is beyond the next one probably is, too.
double ObstacleChooser::scoreOf(const ObstacleList& list, const ObstacleList::Entry& entry,
                                double most) const {
  const FatObstacles::Planes planes = obstacles_.planesOf(entry.obstacle);
  const double enough = most >= 0.0 ? 0.0 : -most;
  double score = 0.0;
  double nearest = kInfinity;
  double ahead = std::accumulate(weights_.begin(), weights_.end(), 0.0);
  std::size_t beyond = entry.first;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (most > 0.0 && score + ahead <= most) break;
    ahead -= weights_[i];
    const auto excessOver = [&](std::size_t p) {
      const ObstaclePlane plane = planes[list.planes[p]];
      return plane.n.dot(samples_[i]) - plane.inner();
    };
    double excess = beyond < entry.last ? excessOver(beyond) : -kInfinity;
    for (std::size_t p = entry.first; p < entry.last && !(excess > enough); ++p) {
      const double over = excessOver(p);
      if (!(over > excess)) continue;
      excess = over;
      beyond = p;
    }
    if (excess <= 0.0) score += weights_[i];
    nearest = std::min(nearest, excess);
  }
  return score > 0.0 ? score : -nearest;
}

}  // namespace fcl_prob::detail
