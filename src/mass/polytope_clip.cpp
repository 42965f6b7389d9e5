// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/polytope_clip.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace fcl_prob::detail {
namespace {

class Clipper {
 public:
  Clipper(const ConvexPolytope& polytope, const HalfSpace& half_space)
      : polytope_(polytope), half_space_(half_space), kept_(polytope.vertices.size(), -1) {
    double reach = 0;
    for (const Eigen::Vector3d& v : polytope.vertices) reach = std::max(reach, v.norm());
    // Within twice the rounding of normal·v - offset a vertex counts as on the plane, for either
    // side; so the vertices of a face that nearly lies in the plane change sides only once.
    const double tolerance = kClipTolerance * (reach + std::abs(half_space.offset));
    for (const Eigen::Vector3d& v : polytope.vertices) {
      const double inside = half_space.normal.dot(v) - half_space.offset;
      inside_.push_back(std::abs(inside) <= tolerance ? 0.0 : inside);
    }
  }

  ConvexPolytope clip() {
    const auto [least, most] = std::minmax_element(inside_.begin(), inside_.end());
    if (*least >= 0) return polytope_;
    if (*most <= 0) return {};
    for (const ConvexPolytope::Face& face : polytope_.faces) clipFace(face);
    addCap();
    return std::move(result_);
  }

 private:
  bool isKept(int vertex) const { return inside_[vertex] >= 0; }

  int keptVertex(int vertex) {
    if (kept_[vertex] < 0) kept_[vertex] = addVertex(polytope_.vertices[vertex]);
    return kept_[vertex];
  }

  int addVertex(const Eigen::Vector3d& vertex) {
    result_.vertices.push_back(vertex);
    return static_cast<int>(result_.vertices.size()) - 1;
  }

  // Where the plane cuts the edge from a kept to a dropped vertex. Computed from the lower index
  // on, whatever side is kept, so that both halves of a cut agree.
  int cutVertex(int kept, int dropped) {
    if (inside_[kept] == 0) return keptVertex(kept);
    const auto [low, high] = std::minmax(kept, dropped);
    const auto [entry, is_new] = cuts_.try_emplace({low, high}, -1);
    if (is_new) {
      const double fraction = inside_[low] / (inside_[low] - inside_[high]);
      const Eigen::Vector3d& from = polytope_.vertices[low];
      entry->second = addVertex(from + fraction * (polytope_.vertices[high] - from));
    }
    return entry->second;
  }

  void clipFace(const ConvexPolytope::Face& face) {
    ConvexPolytope::Face part{face.normal, face.offset, {}};
    int exit = -1, entrance = -1;
    const std::vector<int>& loop = face.vertices;
    const auto append = [&](int vertex) {
      if (part.vertices.empty() || part.vertices.back() != vertex) part.vertices.push_back(vertex);
    };
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int from = loop[k];
      const int to = loop[(k + 1) % loop.size()];
      if (isKept(from)) append(keptVertex(from));
      if (isKept(from) == isKept(to)) continue;
      int& crossing = isKept(from) ? exit : entrance;
      crossing = isKept(from) ? cutVertex(from, to) : cutVertex(to, from);
      append(crossing);
    }
    if (part.vertices.size() > 1 && part.vertices.front() == part.vertices.back()) {
      part.vertices.pop_back();
    }
    if (exit != entrance) cap_next_[entrance] = exit;
    if (part.vertices.size() >= 3) result_.faces.push_back(std::move(part));
  }

  // The face in the plane of the cut: on each face that was cut, it runs against that face's new
  // side.
  void addCap() {
    ConvexPolytope::Face cap{-half_space_.normal, -half_space_.offset, {}};
    if (cap_next_.empty()) return;
    const int start = cap_next_.begin()->first;
    int vertex = start;
    do {
      cap.vertices.push_back(vertex);
      const auto next = cap_next_.find(vertex);
      if (next == cap_next_.end() || cap.vertices.size() > cap_next_.size()) break;
      vertex = next->second;
    } while (vertex != start);
    if (cap.vertices.size() >= 3) result_.faces.push_back(std::move(cap));
  }

  const ConvexPolytope& polytope_;
  const HalfSpace& half_space_;
  std::vector<double> inside_;
  std::vector<int> kept_;
  std::map<std::pair<int, int>, int> cuts_;
  std::map<int, int> cap_next_;
  ConvexPolytope result_;
};

}  // namespace

ConvexPolytope clipped(const ConvexPolytope& polytope, const HalfSpace& half_space) {
  return Clipper(polytope, half_space).clip();
}

}  // namespace fcl_prob::detail
