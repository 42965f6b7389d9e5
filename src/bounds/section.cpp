// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bounds/section.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"
#include "mass/exact_hull.h"

namespace fcl_prob::detail {
namespace {

// Everything below is in units of the error (errorUnits()), in which a body is not larger than
// about 2^46: PairFrame's error is 2^-45 of the sizes and positions.

using Polygon = std::vector<Eigen::Vector2d>;
using Segments = std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>;

/// The grid on which turns are decided exactly, at least.
constexpr double kGrid = 0x1p-6;

/// Coordinates over the spacing of the grid, at most.
constexpr double kMostGridPoints = 0x1p51;

/// Where an edge meets a plane is rounded by 4 ε of its length, 2^-3; three times, and the grid.
constexpr double kSectionRounding = 0.5;

/// Whitened: the mass beyond is below 1e-360.
constexpr double kReach = 41.0;

/// For errors below the smallest double.
constexpr double kLeastUnit = 0x1p-1000;

Segments edgesOf(const FaceSet& faces) {
  Segments edges;
  for (std::size_t f = 0; f < faces.faceCount(); ++f) {
    const int count = faces.cornerCount(f);
    for (int i = 0; i < count; ++i) {
      edges.emplace_back(faces.position(f, i), faces.position(f, (i + 1) % count));
    }
  }
  if (!edges.empty()) return edges;
  for (const Eigen::Vector3d& a : faces.vertices()) {  // a point or a segment
    for (const Eigen::Vector3d& b : faces.vertices()) edges.emplace_back(a, b);
  }
  return edges;
}

/// Calls `add` with the extreme points of the part of a segment within |coordinate| <= band.
template <typename Point, typename Add>
void cutSegment(const Point& a, const Point& b, int coordinate, double band, const Add& add) {
  const double from = a[coordinate];
  const double to = b[coordinate];
  if (std::abs(from) <= band) add(a);
  if (std::abs(to) <= band) add(b);
  for (const double plane : {-band, band}) {
    if ((from < plane) != (to < plane)) add(a + (plane - from) / (to - from) * (b - a));
  }
}

Polygon hullOnGrid(const Polygon& points) {
  double largest = 0.0;
  for (const Eigen::Vector2d& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  double grid = kGrid;
  while (largest > kMostGridPoints * grid) grid *= 2.0;
  Polygon rounded;
  for (const Eigen::Vector2d& p : points) {
    rounded.emplace_back(std::nearbyint(p.x() / grid), std::nearbyint(p.y() / grid));
  }
  Polygon hull = exactHull(std::move(rounded));
  for (Eigen::Vector2d& p : hull) p *= grid;
  return hull;
}

/// The section of a body with the plane of its first two coordinates, widened by `band` across it.
Polygon planeSection(const FaceSet& faces, double band) {
  Polygon points;
  for (const auto& [a, b] : edgesOf(faces)) {
    cutSegment(a, b, 2, band, [&](const Eigen::Vector3d& p) { points.push_back(p.head<2>()); });
  }
  return hullOnGrid(points);
}

/// The hull of the rectangles around the corners.
Polygon widened(const Polygon& polygon, const Eigen::Vector2d& by) {
  Polygon corners;
  for (const Eigen::Vector2d& p : polygon) {
    for (const double x : {-by.x(), by.x()}) {
      for (const double y : {-by.y(), by.y()}) corners.emplace_back(p.x() + x, p.y() + y);
    }
  }
  return hullOnGrid(corners);
}

template <typename Add>
void cutPolygon(const Polygon& polygon, int coordinate, double band, const Add& add) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    cutSegment(polygon[i], polygon[(i + 1) % polygon.size()], coordinate, band, add);
  }
}

/// Without what is too far away to weigh anything, if there is more: a prism of ordinary size.
Polygon withinReach(Polygon polygon, const Eigen::Vector3d& units) {
  for (int k = 0; k < 2; ++k) {
    Polygon near;
    cutPolygon(polygon, k, kReach / units[k], [&](const Eigen::Vector2d& p) { near.push_back(p); });
    if (near.empty()) return polygon;
    polygon = hullOnGrid(near);
  }
  return polygon;
}

/// Where the first axis, widened by `band`, meets a polygon; lower > upper if nowhere.
Bounds axisSection(const Polygon& polygon, double band) {
  Bounds ends{kInfinity, -kInfinity};
  cutPolygon(polygon, 1, band, [&](const Eigen::Vector2d& p) {
    ends.lower = std::min(ends.lower, p.x());
    ends.upper = std::max(ends.upper, p.x());
  });
  return ends;
}

void setToPrism(const Polygon& polygon, const Eigen::Vector3d& units, FaceSet& faces) {
  const int count = static_cast<int>(polygon.size());
  for (const double height : {-kPrismHalfWidth, kPrismHalfWidth}) {
    for (const Eigen::Vector2d& p : polygon) {
      faces.addVertex({units.x() * p.x(), units.y() * p.y(), height});
    }
  }
  faces.beginFace();
  for (int i = count - 1; i >= 0; --i) faces.addCorner(i);
  faces.beginFace();
  for (int i = 0; i < count; ++i) faces.addCorner(count + i);
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    faces.addFace({i, next, count + next, count + i});
  }
}

/// A rod over the part of the first axis, or without motion a cube if that holds the mean.
void setToRod(int rank, const Bounds& ends, FaceSet& faces) {
  const bool everything = rank == 0;
  if (everything && !(ends.lower <= 0.0 && ends.upper >= 0.0)) return;
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(kPrismHalfWidth);
  Eigen::Vector3d lower = -half;
  Eigen::Vector3d upper = half;
  if (!everything) lower.x() = ends.lower;
  if (!everything) upper.x() = ends.upper;
  setToBox(lower, upper, faces);
}

}  // namespace

Eigen::Vector3d errorUnits(const Eigen::Vector3d& error) {
  Eigen::Vector3d units;
  for (int k = 0; k < 3; ++k) {
    units[k] = powerOfTwoAt(std::max(error[k], kLeastUnit));
  }
  return units;
}

void scaleCoordinates(const Eigen::Vector3d& factors, FaceSet& faces) {
  for (Eigen::Vector3d& v : faces.vertices()) v = v.cwiseProduct(factors);
}

void replaceBySection(int rank, const Eigen::Vector3d& error, SectionSide side, FaceSet& faces) {
  const Eigen::Vector3d units = errorUnits(error);
  const bool outer = side == SectionSide::outer;
  Eigen::Vector3d margin = Eigen::Vector3d::Zero();
  if (outer) margin = error.cwiseQuotient(units).array() + kSectionRounding;
  scaleCoordinates(units.cwiseInverse(), faces);
  Polygon polygon = planeSection(faces, margin[2]);
  faces.clear();
  if (polygon.empty()) return;
  if (rank == 2) {
    polygon = withinReach(std::move(polygon), units);
    if (outer) polygon = widened(polygon, margin.head<2>());
    if (polygon.size() >= 3) setToPrism(polygon, units, faces);
    return;
  }
  const Bounds ends = axisSection(polygon, margin[1]);
  if (!(ends.lower <= ends.upper)) return;
  setToRod(rank, {units[0] * (ends.lower - margin[0]), units[0] * (ends.upper + margin[0])}, faces);
}

double prismMass(int rank) {
  return std::pow(normalIntervalMass(-kPrismHalfWidth, kPrismHalfWidth), 3 - rank);
}

double errorOfMoving(int rank, const Eigen::Vector3d& error) {
  double squared = error[0] * error[0];
  for (int k = 1; k < rank; ++k) squared += error[k] * error[k];
  return std::sqrt(squared);
}

}  // namespace fcl_prob::detail
