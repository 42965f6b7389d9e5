// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/shell_lines.h"

#include <Eigen/LU>
#include <algorithm>

#include "base/constants.h"

namespace fcl_prob::detail {

ShellLines::ShellLines(const WhitenedPair& pair, const PieceTree::Part& part, bool fan_is_a,
                       const Eigen::Matrix3d& linear, const WhitenedFan& core)
    : pair_(pair), part_(part), fan_is_a_(fan_is_a), linear_(linear), core_(core) {}

void ShellLines::addShapes() {
  const auto& pieces = part_.nearly->pieces;
  solvers_.resize(pieces.size());
  std::vector<BoxTree::Box> boxes;
  for (const ConvexFan& piece : pieces) boxes.push_back(addShape(piece));
  boxes_ = BoxTree(boxes);
}

// As a WhitenedFan is moved.
BoxTree::Box ShellLines::addShape(const ConvexFan& piece) {
  const Eigen::Matrix3d moved = fan_is_a_ ? Eigen::Matrix3d(-linear_) : linear_;
  const Eigen::Matrix3d turned = moved.inverse().transpose();
  Shape shape;
  shape.shift = moved * (piece.centre - part_.nearly->core.centre);
  BoxTree::Box box;
  for (const Eigen::Vector3d& vertex : piece.vertices) {
    box.extend(moved * vertex + shape.shift);
  }
  for (std::size_t f = 0; f < piece.normals.size(); ++f) {
    shape.normals.emplace_back(turned * piece.normals[f]);
    shape.offsets.push_back(piece.offsets[f] + shape.normals.back().dot(shape.shift));
  }
  shapes_.push_back(std::move(shape));
  return box;
}

// Between the planes of its faces put to T.
LineSpan ShellLines::spanOf(const Shape& shape, const Eigen::Matrix3d& corners,
                            const Eigen::Vector2d& u) const {
  LineSpan span{-kInfinity, kInfinity};
  for (std::size_t f = 0; f < shape.normals.size() && span.lo < span.hi; ++f) {
    const Eigen::Vector3d& n = shape.normals[f];
    const double left =
        shape.offsets[f] + (n.transpose() * corners).maxCoeff() - n.tail<2>().dot(u);
    if (n.x() < 0.0) span.lo = std::max(span.lo, left / n.x());
    if (n.x() > 0.0) span.hi = std::min(span.hi, left / n.x());
  }
  return span;
}

const std::vector<ShellLines::Near>& ShellLines::near(int triangle, const Eigen::Vector2d& u,
                                                      const std::vector<LineSpan>& gaps) {
  near_.clear();
  if (shapes_.empty()) addShapes();
  const Eigen::Matrix3d corners = core_.corners(triangle);
  const Eigen::Vector3d most = corners.rowwise().maxCoeff();
  const Eigen::Vector3d least = corners.rowwise().minCoeff();
  for (const LineSpan& gap : gaps) {
    const BoxTree::Box met(Eigen::Vector3d(gap.lo, u[0], u[1]) - most,
                           Eigen::Vector3d(gap.hi, u[0], u[1]) - least);
    boxes_.visitBox(met, [&](int piece) {
      const LineSpan span = spanOf(shapes_[piece], corners, u);
      if (span.lo < std::min(span.hi, gap.hi) && span.hi > gap.lo) near_.push_back({piece, span});
      return true;
    });
  }
  std::sort(near_.begin(), near_.end(),
            [](const Near& one, const Near& other) { return one.span.lo < other.span.lo; });
  return near_;
}

FanLine& ShellLines::lineOf(int piece) {
  std::unique_ptr<Solver>& solver = solvers_[piece];
  if (!solver) {
    solver = std::make_unique<Solver>(WhitenedFan(
        pair_, part_, part_.nearly->pieces[static_cast<std::size_t>(piece)], fan_is_a_, linear_));
  }
  return solver->line;
}

}  // namespace fcl_prob::detail
