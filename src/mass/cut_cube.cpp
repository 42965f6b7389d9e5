// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/cut_cube.h"

#include <Eigen/Geometry>

namespace fcl_prob::detail {

namespace {

// Of a plane whose largest component is 1: a vertex on its wrong side by more is none of rounding.
constexpr double kMostOnWrongSide = 1e-14;

double leastOnCube(const Eigen::Vector3d& a) { return a.cwiseMin(0.0).sum(); }
double mostOnCube(const Eigen::Vector3d& a) { return a.cwiseMax(0.0).sum(); }

// Tetrahedra between the origin and the triangles of the surface.
CutCube integrate(const FaceSet& faces) {
  CutCube sum;
  for (std::size_t f = 0; f < faces.faceCount(); ++f) {
    const Eigen::Vector3d& first = faces.position(f, 0);
    for (int i = 1; i + 1 < faces.cornerCount(f); ++i) {
      const Eigen::Vector3d& second = faces.position(f, i);
      const Eigen::Vector3d& third = faces.position(f, i + 1);
      const double volume = first.dot(second.cross(third)) / 6;
      sum.volume += volume;
      sum.moment += 0.25 * volume * (first + second + third);
    }
  }
  return sum;
}

}  // namespace

CubeCutter::CubeCutter() { setToBox(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(), cube_); }

std::optional<CutCube> CubeCutter::cut(const CubePlane* planes, int count) {
  polytope_.start(cube_);
  for (int i = 0; i < count; ++i) {
    const CubePlane& plane = planes[i];
    if (plane.r > mostOnCube(plane.a)) return CutCube{};
    if (plane.r <= leastOnCube(plane.a)) continue;
    const double length = plane.a.cwiseAbs().maxCoeff();
    if (!(length > 0.0)) return std::nullopt;
    const double wrong_side = polytope_.cut(-plane.a / length, -plane.r / length);
    if (wrong_side > kMostOnWrongSide) return std::nullopt;
  }
  polytope_.writeTo(faces_);
  return integrate(faces_);
}

}  // namespace fcl_prob::detail
