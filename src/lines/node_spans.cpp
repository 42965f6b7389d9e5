// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/node_spans.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "cells/different_faces.h"
#include "cells/rounded_floats.h"

namespace fcl_prob::detail {
namespace {

// Of the reach: some hundred times what an offset and the products of its plane with the corners of
// a column are rounded by.
constexpr double kRoundedPlaneEnds = 1e-13;

// Half of what neighbouring floats differ by: a difference of two.
constexpr double kRoundedDifference = 6e-8;

double below(float difference) {
  return difference - kRoundedDifference * std::fabs(static_cast<double>(difference));
}

}  // namespace

NodeSpans::NodeSpans(const WhitenedFan& fan) : fan_(fan) {
  slopes_.setZero();
  places_.setConstant(-kInfinity);
  rounding_.setZero();
  addFaces(1.0, kFirstFaces, 0);
  addFaces(-1.0, kLastFaces, kFirstFaces);
}

// Of P put to t: n·y <= offset + n·t, which is where a line ends that goes along the first axis,
// divided by n_0; what is rounded moves it outwards. Places without a face tell nothing.
void NodeSpans::addFaces(double sign, int count, int place) {
  std::vector<int> candidates;
  for (int f = 0; f < fan_.faceCount(); ++f) {
    if (sign * fan_.faceNormal(f).x() < -kLeastSlope) candidates.push_back(f);
  }
  const double rounding = kRoundedPlaneEnds * fan_.reach();
  for (const int f : differentFaces(fan_, candidates, {-sign, 0.0, 0.0}, count)) {
    const Eigen::Vector3d& n = fan_.faceNormal(f);
    const double slope = std::fabs(n.x());
    slopes_.row(place) = -n.transpose() / slope;
    places_[place] = -(fan_.faceOffset(f) + fan_.padding(n) + rounding) / slope;
    rounding_[place] = rounding / slope;
    ++place;
  }
}

void NodeSpans::lookAt(const Column& column) {
  column_ = column;
  const Eigen::Vector2d middle = 0.5 * (column.lo + column.hi);
  const Eigen::Vector2d half = 0.5 * (column.hi - column.lo);
  const auto& first = slopes_.col(1).array();
  const auto& second = slopes_.col(2).array();
  Places most = rounding_ + middle[0] * first + middle[1] * second;
  if (!half.isZero()) most += half[0] * first.abs() + half[1] * second.abs();
  shifts_ = -floatsBelow(-most);
}

std::optional<LineSpan> NodeSpans::around(int node) {
  if (ends_.empty()) boundNodes();
  const NodeBox& box = boxes_[node];
  if (column_.lo[0] > box.hi[1] || column_.hi[0] < box.lo[1] || column_.lo[1] > box.hi[2] ||
      column_.hi[1] < box.lo[2]) {
    return std::nullopt;
  }
  const Ends ends = ends_[node] - shifts_;
  const LineSpan span{std::max(box.lo[0], below(ends.head<kFirstFaces>().maxCoeff())),
                      std::min(box.hi[0], -below(ends.tail<kLastFaces>().maxCoeff()))};
  if (!(span.lo <= span.hi)) return std::nullopt;
  return span;
}

NodeSpans::Ends NodeSpans::endsAt(const Eigen::Vector3d& vertex) const {
  return floatsBelow((slopes_ * vertex).array() + places_);
}

// P ⊕ the hull of some points ends where the last one of P put to those does.
void NodeSpans::boundNodes() {
  const WhitenedTree& mesh = fan_.mesh();
  std::vector<Ends> at_vertices;
  at_vertices.reserve(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    at_vertices.push_back(endsAt(fan_.corner(static_cast<int>(v))));
  }
  ends_.resize(mesh.tree->nodes.size());
  boxes_.resize(mesh.tree->nodes.size());
  for (std::size_t i = ends_.size(); i-- > 0;) {
    const PieceTree::Node& node = mesh.tree->nodes[i];
    boxes_[i] = fan_.obstacleBox(static_cast<int>(i));
    if (node.isLeaf()) {
      const Eigen::Vector3i& t = mesh.tree->triangles[node.piece];
      ends_[i] = at_vertices[t[0]].min(at_vertices[t[1]]).min(at_vertices[t[2]]);
    } else {
      ends_[i] = ends_[node.left].min(ends_[node.right]);
    }
  }
}

}  // namespace fcl_prob::detail
