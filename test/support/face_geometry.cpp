// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "face_geometry.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace fcl_prob_test {

using fcl_prob::detail::FaceSet;

double volumeOf(const FaceSet& faces) {
  if (faces.vertices().empty()) return 0.0;
  const Eigen::Vector3d& origin = faces.vertices().front();
  double volume = 0.0;
  for (std::size_t f = 0; f < faces.faceCount(); ++f) {
    volume += faces.vectorArea(f).dot(faces.position(f, 0) - origin) / 3.0;
  }
  return volume;
}

double supportOf(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& direction) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : points) largest = std::max(largest, direction.dot(p));
  return largest;
}

double excessOver(const FaceSet& faces, const std::vector<Eigen::Vector3d>& points) {
  double excess = 0.0;
  for (std::size_t f = 0; f < faces.faceCount(); ++f) {
    const Eigen::Vector3d area = faces.vectorArea(f);
    if (!(area.norm() > 0.0)) continue;
    const Eigen::Vector3d normal = area.normalized();
    double longest = 0.0;
    for (int i = 0; i < faces.cornerCount(f); ++i) {
      longest = std::max(longest, (faces.position(f, i) - faces.position(f, 0)).norm());
    }
    const double certainty = area.norm() / (longest * longest);
    const double beyond = supportOf(points, normal) - normal.dot(faces.position(f, 0));
    excess = std::max(excess, certainty * beyond);
  }
  return excess;
}

std::vector<Eigen::Vector3d> allSums(const std::vector<Eigen::Vector3d>& a,
                                     const std::vector<Eigen::Vector3d>& b) {
  std::vector<Eigen::Vector3d> sums;
  for (const Eigen::Vector3d& p : a) {
    for (const Eigen::Vector3d& q : b) sums.push_back(p + q);
  }
  return sums;
}

std::vector<Eigen::Vector3d> allDifferences(const std::vector<Eigen::Vector3d>& b,
                                            const std::vector<Eigen::Vector3d>& a) {
  std::vector<Eigen::Vector3d> differences;
  for (const Eigen::Vector3d& p : b) {
    for (const Eigen::Vector3d& q : a) differences.push_back(p - q);
  }
  return differences;
}

double sectionArea(const FaceSet& faces, const Eigen::Vector3d& normal, double height) {
  // Each face contributes the directed segment in which it meets the plane; Green's theorem needs
  // no order of them.
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  double area = 0.0;
  for (std::size_t f = 0; f < faces.faceCount(); ++f) {
    const int count = faces.cornerCount(f);
    Eigen::Vector2d up = Eigen::Vector2d::Zero();    // where the face's border climbs through
    Eigen::Vector2d down = Eigen::Vector2d::Zero();  // and descends
    bool crosses = false;
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d& a = faces.position(f, i);
      const Eigen::Vector3d& b = faces.position(f, (i + 1) % count);
      const double from = normal.dot(a) - height;
      const double to = normal.dot(b) - height;
      if ((from > 0.0) == (to > 0.0)) continue;
      const Eigen::Vector3d p = a + from / (from - to) * (b - a);
      (to > 0.0 ? up : down) = Eigen::Vector2d(u.dot(p), v.dot(p));
      crosses = true;
    }
    if (crosses) area += 0.5 * (up.x() * down.y() - up.y() * down.x());
  }
  return std::abs(area);
}

}  // namespace fcl_prob_test
