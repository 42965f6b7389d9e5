// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "carving/node_spans.h"

#include <algorithm>

#include "base/constants.h"
#include "carving/different_faces.h"

namespace fcl_prob::detail {
NodeSpans::NodeSpans(const WhitenedFan& fan) : fan_(fan), rounding_(1e-13 * fan.reach()) {
  first_.faces = facesTowards(1.0, kFirstFaces);
  last_.faces = facesTowards(-1.0, kLastFaces);
}

std::vector<int> NodeSpans::facesTowards(double sign, int count) const {
  std::vector<int> candidates;
  for (int f = 0; f < fan_.faceCount(); ++f) {
    if (sign * fan_.faceNormal(f).x() < -kLeastSlope) candidates.push_back(f);
  }
  return differentFaces(fan_, candidates, {-sign, 0.0, 0.0}, count);
}

template <int count>
void NodeSpans::look(const Column& column, Side<count>& side) const {
  const Eigen::Vector2d middle = 0.5 * (column.lo + column.hi);
  const Eigen::Vector2d half = 0.5 * (column.hi - column.lo);
  side.shifts.setZero();
  for (std::size_t k = 0; k < side.faces.size(); ++k) {
    const Eigen::Vector3d& n = fan_.faceNormal(side.faces[k]);
    const double least = n.tail<2>().dot(middle) - n.tail<2>().cwiseAbs().dot(half);
    side.shifts[static_cast<int>(k)] = (least - rounding_) / n.x();
  }
}

void NodeSpans::lookAt(const Column& column) {
  column_ = column;
  look(column, first_);
  look(column, last_);
}

std::optional<LineSpan> NodeSpans::around(int node) {
  if (nodes_.empty()) boundNodes();
  const NodeEnds& known = nodes_[node];
  const NodeBox& box = known.box;
  if (column_.lo[0] > box.hi[1] || column_.hi[0] < box.lo[1] || column_.lo[1] > box.hi[2] ||
      column_.hi[1] < box.lo[2]) {
    return std::nullopt;
  }
  const LineSpan span{std::max(box.lo[0], (known.first - first_.shifts).maxCoeff()),
                      std::min(box.hi[0], (known.last - last_.shifts).minCoeff())};
  if (!(span.lo <= span.hi)) return std::nullopt;
  return span;
}

// Of P put to a vertex t: n·y <= offset + n·t, which is where a line ends that goes along the first
// axis, divided by n_0; what is rounded moves it outwards. Places without a face tell nothing.
template <int count>
std::vector<Eigen::Array<double, count, 1>> NodeSpans::endsAtVertices(const Side<count>& side,
                                                                      double nothing) const {
  const auto vertices = static_cast<int>(fan_.mesh().vertices.size());
  using Ends = typename Side<count>::Ends;
  std::vector<Ends> ends(static_cast<std::size_t>(vertices), Ends::Constant(nothing));
  for (std::size_t k = 0; k < side.faces.size(); ++k) {
    const Eigen::Vector3d& n = fan_.faceNormal(side.faces[k]);
    const double offset = fan_.faceOffset(side.faces[k]) + fan_.padding(n) + rounding_;
    for (int v = 0; v < vertices; ++v) {
      ends[v][static_cast<int>(k)] = (offset + n.dot(fan_.corner(v))) / n.x();
    }
  }
  return ends;
}

// P ⊕ the hull of some points ends where the last one of P put to those does.
void NodeSpans::boundNodes() {
  const WhitenedTree& mesh = fan_.mesh();
  const auto first = endsAtVertices(first_, -kInfinity);
  const auto last = endsAtVertices(last_, kInfinity);
  nodes_.resize(mesh.boxes.size());
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const PieceTree::Node& node = mesh.tree->nodes[i];
    nodes_[i].box = fan_.obstacleBox(static_cast<int>(i));
    if (node.isLeaf()) {
      const Eigen::Vector3i& t = mesh.tree->triangles[node.piece];
      nodes_[i].first = first[t[0]].min(first[t[1]]).min(first[t[2]]);
      nodes_[i].last = last[t[0]].max(last[t[1]]).max(last[t[2]]);
    } else {
      nodes_[i].first = nodes_[node.left].first.min(nodes_[node.right].first);
      nodes_[i].last = nodes_[node.left].last.max(nodes_[node.right].last);
    }
  }
}

}  // namespace fcl_prob::detail
