// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/cut_polytope.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/constants.h"

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

double CutPolytope::cut(const Eigen::Vector3d& direction, double limit) {
  bool cuts = false;
  excess_.resize(vertices_.size());
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    excess_[i] = direction.dot(vertices_[i]) - limit;
    cuts = cuts || excess_[i] > 0.0;
  }
  if (!cuts) return 0.0;
  const std::size_t before = vertices_.size();
  double wrong_side = 0.0;
  if (!cutFaces()) {
    vertices_.resize(before);
    wrong_side = takeSides();
    if (!cutFaces()) {
      vertices_.resize(before);
      return kInfinity;
    }
  }
  faces_.swap(cut_faces_);
  face_count_ = cut_count_;
  return wrong_side;
}

// What is left of all faces, and the new one; false where these do not close the surface.
bool CutPolytope::cutFaces() {
  crossings_.clear();
  rim_.clear();
  cut_count_ = 0;
  if (cut_faces_.size() <= face_count_) cut_faces_.resize(face_count_ + 1);
  for (std::size_t f = 0; f < face_count_; ++f) {
    Loop& kept = cut_faces_[cut_count_];
    if (!cutLoop(faces_[f], kept)) return false;
    if (kept.size() >= 3) ++cut_count_;
  }
  return closeWithCap();
}

// False if the loop crosses the plane more than twice.
bool CutPolytope::cutLoop(const Loop& loop, Loop& kept) {
  kept.clear();
  int leaving = -1;
  int entering = -1;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const int from = loop[i];
    const int to = loop[i + 1 < loop.size() ? i + 1 : 0];
    const bool from_kept = !isCutOff(from);
    const bool to_kept = !isCutOff(to);
    if (from_kept) kept.push_back(from);
    if (from_kept && !to_kept) {
      if (leaving >= 0) return false;
      kept.push_back(leaving = crossingVertex(from, to));
    }
    if (!from_kept && to_kept) kept.push_back(entering = crossingVertex(to, from));
  }
  // The face now walks from `leaving` to `entering`, so the new one walks the other way.
  if (leaving >= 0) rim_.emplace_back(entering, leaving);
  return true;
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

// False unless the rim is one loop. Of a two-sided polygon it has two edges, which close each
// other.
bool CutPolytope::closeWithCap() {
  if (rim_.empty()) return true;
  Loop& cap = cut_faces_[cut_count_];
  cap.clear();
  int at = rim_.front().first;
  do {
    cap.push_back(at);
    const auto next =
        std::find_if(rim_.begin(), rim_.end(), [at](const auto& edge) { return edge.first == at; });
    if (next == rim_.end()) return false;
    at = next->second;
  } while (at != cap.front() && cap.size() < rim_.size());
  if (at != cap.front() || cap.size() != rim_.size()) return false;
  if (cap.size() >= 3) ++cut_count_;
  return true;
}

// Cut off is what is connected to the vertex farthest beyond the plane and, of the rest, all that
// is not connected to the farthest before it. Both sides are then connected, so that every face
// crosses the plane twice at the most, and the crossings are one loop (a bond of a planar graph is
// a cycle of its dual). Returns how far a vertex is that was on the other side.
double CutPolytope::takeSides() {
  std::vector<int> corners;
  for (std::size_t f = 0; f < face_count_; ++f) {
    corners.insert(corners.end(), faces_[f].begin(), faces_[f].end());
  }
  const auto lower = [this](int v, int w) { return excess_[v] < excess_[w]; };
  const auto [nearest, farthest] = std::minmax_element(corners.begin(), corners.end(), lower);
  double wrong_side = 0.0;
  std::vector<char> beyond(excess_.size(), 0);
  markReached(*farthest, true, beyond);
  for (const int v : corners) {
    if (!isCutOff(v) || beyond[v]) continue;
    wrong_side = std::max(wrong_side, excess_[v]);
    excess_[v] = 0.0;
  }
  std::vector<char> before(excess_.size(), 0);
  markReached(*nearest, false, before);
  for (const int v : corners) {
    if (isCutOff(v) || before[v]) continue;
    wrong_side = std::max(wrong_side, -excess_[v]);
    excess_[v] = std::numeric_limits<double>::min();
  }
  return wrong_side;
}

// Marks what edges between vertices of one side of the plane connect to `start`.
void CutPolytope::markReached(int start, bool cut_off, std::vector<char>& reached) const {
  reached[start] = 1;
  for (bool more = true; more;) {
    more = false;
    for (std::size_t f = 0; f < face_count_; ++f) {
      const Loop& loop = faces_[f];
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const int from = loop[i];
        const int to = loop[i + 1 < loop.size() ? i + 1 : 0];
        if (reached[from] == reached[to] || isCutOff(from) != cut_off || isCutOff(to) != cut_off) {
          continue;
        }
        reached[from] = reached[to] = 1;
        more = true;
      }
    }
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
