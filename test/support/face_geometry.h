// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Plain geometry of face sets, to check them by other means than those that made them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "convex/face_set.h"

namespace fcl_prob_test {

/// Volume by the divergence theorem.
double volumeOf(const fcl_prob::detail::FaceSet& faces);

/// max of direction·v.
double supportOf(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& direction);

/// How far the points reach out of the planes of the faces, at most. A narrow face, whose normal is
/// not well determined, counts with the fraction (area / longest diagonal squared) of it.
double excessOver(const fcl_prob::detail::FaceSet& faces,
                  const std::vector<Eigen::Vector3d>& points);

/// a + b and b - a for all pairs of points.
std::vector<Eigen::Vector3d> allSums(const std::vector<Eigen::Vector3d>& a,
                                     const std::vector<Eigen::Vector3d>& b);
std::vector<Eigen::Vector3d> allDifferences(const std::vector<Eigen::Vector3d>& b,
                                            const std::vector<Eigen::Vector3d>& a);

/// Area of the section of the hull of the faces with the plane normal·x = height.
double sectionArea(const fcl_prob::detail::FaceSet& faces, const Eigen::Vector3d& normal,
                   double height);

}  // namespace fcl_prob_test
