// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/different_faces.h"

#include <algorithm>

namespace fcl_prob::detail {
namespace {

// The cosine of the least angle between two normals.
constexpr double kLikeness = 0.999;

}  // namespace

std::vector<int> differentFaces(const WhitenedFan& fan, const std::vector<int>& candidates,
                                const Eigen::Vector3d& along, int count) {
  std::vector<double> closeness(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    closeness[i] = -along.dot(fan.faceNormal(candidates[i])) - 1.0;
  }
  std::vector<int> faces;
  while (static_cast<int>(faces.size()) < count && !candidates.empty()) {
    const auto next = std::min_element(closeness.begin(), closeness.end()) - closeness.begin();
    if (!(closeness[next] < kLikeness)) break;
    faces.push_back(candidates[next]);
    const Eigen::Vector3d& n = fan.faceNormal(faces.back());
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      closeness[i] = std::max(closeness[i], n.dot(fan.faceNormal(candidates[i])));
    }
  }
  return faces;
}

}  // namespace fcl_prob::detail
