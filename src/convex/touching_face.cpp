// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/touching_face.h"

#include <Eigen/QR>

namespace fcl_prob::detail {
namespace {

// Directions that differ by less, relative to the longest, count as one.
constexpr double kIndependent = 1e-9;

}  // namespace

TouchingFace TouchingFace::around(const Eigen::Matrix<double, 3, Eigen::Dynamic>& points) {
  TouchingFace face{points.rowwise().mean(), {}};
  face.spanning.resize(3, points.cols() > 1 ? points.cols() : 0);
  if (points.cols() > 1) face.spanning = points.colwise() - face.middle;
  return face;
}

Eigen::Vector3d touchingPoint(const TouchingFace& first, const TouchingFace& second,
                              const Eigen::Vector3d& offset) {
  const Eigen::Index count = first.spanning.cols();
  const Eigen::Index all = count + second.spanning.cols();
  if (count == 0) return first.middle;
  Eigen::Matrix<double, 3, Eigen::Dynamic> spanning(3, all);
  spanning << first.spanning, -second.spanning;
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<double, 3, Eigen::Dynamic>> solver;
  solver.setThreshold(kIndependent);
  solver.compute(spanning);
  const Eigen::VectorXd combination = solver.solve(second.middle - first.middle - offset);
  return first.middle + first.spanning * combination.head(count);
}

}  // namespace fcl_prob::detail
