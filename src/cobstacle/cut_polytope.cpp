// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cobstacle/cut_polytope.h"

#include <algorithm>

namespace fcl_prob::detail {

void CutPolytope::start(const FaceSet& faces) {
  vertices_ = faces.vertices();
  face_count_ = faces.faceCount();
  if (faces_.size() < face_count_) faces_.resize(face_count_);
  for (std::size_t f = 0; f < face_count_; ++f) {
    faces_[f].clear();
    for (int i = 0; i < faces.cornerCount(f); ++i) faces_[f].push_back(faces.corner(f, i));
  }
}

int CutPolytope::crossingVertex(int kept, int cut_off) {
  for (const Crossing& crossing : crossings_) {
    if (crossing.kept == kept && crossing.cut_off == cut_off) return crossing.vertex;
  }
  const double t = excess_[kept] / (excess_[kept] - excess_[cut_off]);
  vertices_.push_back(vertices_[kept] + t * (vertices_[cut_off] - vertices_[kept]));
  crossings_.push_back({kept, cut_off, static_cast<int>(vertices_.size()) - 1});
  return crossings_.back().vertex;
}

void CutPolytope::cutLoop(const Loop& loop, Loop& kept) {
  kept.clear();
  int leaving = -1;
  int entering = -1;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const int from = loop[i];
    const int to = loop[i + 1 < loop.size() ? i + 1 : 0];
    const bool from_kept = !(excess_[from] > 0.0);
    const bool to_kept = !(excess_[to] > 0.0);
    if (from_kept) kept.push_back(from);
    if (from_kept && !to_kept) kept.push_back(leaving = crossingVertex(from, to));
    if (!from_kept && to_kept) kept.push_back(entering = crossingVertex(to, from));
  }
  // The face now walks from `leaving` to `entering`, so the new one walks the other way.
  if (leaving >= 0 && entering >= 0) rim_.emplace_back(entering, leaving);
}

void CutPolytope::cut(const Eigen::Vector3d& direction, double limit) {
  bool cuts = false;
  excess_.resize(vertices_.size());
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    excess_[i] = direction.dot(vertices_[i]) - limit;
    cuts = cuts || excess_[i] > 0.0;
  }
  if (!cuts) return;
  crossings_.clear();
  rim_.clear();
  std::size_t kept_faces = 0;
  for (std::size_t f = 0; f < face_count_; ++f) {
    cutLoop(faces_[f], scratch_);
    if (scratch_.size() < 3) continue;
    std::swap(faces_[kept_faces], scratch_);
    ++kept_faces;
  }
  face_count_ = kept_faces;
  if (rim_.size() < 3) return;
  if (faces_.size() == face_count_) faces_.emplace_back();
  Loop& cap = faces_[face_count_++];
  cap.clear();
  for (int at = rim_.front().first; cap.size() < rim_.size();) {
    cap.push_back(at);
    const auto next =
        std::find_if(rim_.begin(), rim_.end(), [at](const auto& edge) { return edge.first == at; });
    if (next == rim_.end()) break;
    at = next->second;
  }
}

void CutPolytope::writeTo(FaceSet& faces) {
  faces.clear();
  index_.assign(vertices_.size(), -1);
  for (std::size_t f = 0; f < face_count_; ++f) {
    faces.beginFace();
    for (const int vertex : faces_[f]) {
      if (index_[vertex] < 0) index_[vertex] = faces.addVertex(vertices_[vertex]);
      faces.addCorner(index_[vertex]);
    }
  }
}

}  // namespace fcl_prob::detail
