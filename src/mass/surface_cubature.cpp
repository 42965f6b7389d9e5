// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/surface_cubature.h"

#include <algorithm>
#include <cmath>

#include "gaussian/normal_density.h"
#include "mass/part_rules.h"

namespace fcl_prob::detail {
namespace {

constexpr int kMostSurfaceDepth = 150;
constexpr std::size_t kMostSurfaceBoxes = 20000;

constexpr int kSurfaceAttempts = 6;

constexpr double kInverseTwoPi = kInverseSqrtTwoPi * kInverseSqrtTwoPi;

/// Of sums over all boxes.
constexpr double kBoxSumRounding = 2.0 * kMostSurfaceBoxes * kEpsilon;

/// Of a term, besides that of the point: exp, erfc, weights and sums.
constexpr double kFluxRounding = 512.0 * kEpsilon;

/// Of a point seen along the field's axes: products, sums, and what the axes are off orthonormal.
constexpr double kAxesRounding = 16.0 * kEpsilon;

/// A box is divided across both parameters if normals change along them by about the same.
constexpr double kEvenChange = 0.4;

/// Where squares of normals change by more than this share of themselves, no ellipse is tried.
constexpr double kTooBent = 0.9;

/// Below the smallest normal double, for every term of a rule.
constexpr double kFluxUnderflow = 1e-306;

/// Where Q(z) φ(x) φ(y) is less than the smallest double.
constexpr double kFarthestPoint = 39.0;

/// The third parameter is none: of length 1, so that volumes are areas.
ParameterBox wholePatch() { return {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}}; }

/// A normal with n·e >= 0 along which the box is far from the origin.
Eigen::Vector3d farNormal(const SurfacePatch& patch, const ParameterBox& box,
                          const Eigen::Vector3d& e) {
  Lanes t(box.centre[1]);
  t[0] -= box.half[1];
  t[2] += box.half[1];
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();
  double least = kInfinity;
  for (const double step : {0.0, -1.0, 1.0}) {
    const PatchPoints points = PatchLine(patch, box.centre[0] + step * box.half[0]).at(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d x(points.value[0][k], points.value[1][k], points.value[2][k]);
      const Eigen::Vector3d up = x - std::min(e.dot(x), 0.0) * e;
      if (const double square = up.squaredNorm(); square < least) {
        least = square;
        nearest = up;
      }
    }
  }
  return least > 0.0 && least < kInfinity ? Eigen::Vector3d(nearest / std::sqrt(least)) : e;
}

/// The rule of one parameter in lanes; what is beyond its points has no weight.
struct LaneRule {
  LaneRule(const PartRule& rule, const ParameterBox& box) {
    const std::size_t points = rule.nodes.size();
    count = (points + Lanes::kCount - 1) / Lanes::kCount;
    for (std::size_t k = 0; k < count * Lanes::kCount; ++k) {
      const std::size_t group = k / Lanes::kCount, lane = k % Lanes::kCount;
      nodes[group][lane] = box.centre[1] + (k < points ? box.half[1] * rule.nodes[k] : 0.0);
      weights[group][lane] = k < points ? rule.weights[k] : 0.0;
    }
  }

  static constexpr std::size_t kMostGroups = (kMostPartPoints + Lanes::kCount - 1) / Lanes::kCount;
  std::array<Lanes, kMostGroups> nodes, weights;
  std::size_t count;
};

using LaneVector = std::array<Lanes, 3>;

LaneVector crossOf(const LaneVector& u, const LaneVector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

Lanes rowTimes(const Eigen::Matrix3d& axes, Eigen::Index row, const LaneVector& v) {
  return axes(row, 0) * v[0] + axes(row, 1) * v[1] + axes(row, 2) * v[2];
}

/// Sums of 2π F and of what its rounding is told from.
struct FluxSums {
  explicit FluxSums(const Eigen::Matrix3d& field_axes) : axes(field_axes) {}

  void add(const PatchPoints& points, const LaneVector& areas, double weight,
           const Lanes& weights) {
    const Lanes x = rowTimes(axes, 0, points.value), y = rowTimes(axes, 1, points.value),
                height = rowTimes(axes, 2, points.value), area = rowTimes(axes, 2, areas);
    const Lanes across = x * x + y * y;
    for (std::size_t k = 0; k < Lanes::kCount; ++k) {
      if (!(weights[k] > 0.0)) continue;
      const double z = height[k], square = across[k] + z * z;
      const double field =
          weight * weights[k] * 0.5 * std::exp(-0.5 * across[k]) * std::erfc(z * kInverseSqrtTwo);
      flux -= field * area[k];
      magnitude += field * std::abs(area[k]);
      density += field;
      farthest_square = std::max(farthest_square, square);
      if (square < nearest_square) {
        nearest_square = square;
        nearest = {points.value[0][k], points.value[1][k], points.value[2][k]};
      }
    }
  }

  const Eigen::Matrix3d& axes;
  double flux = 0.0, magnitude = 0.0, density = 0.0, farthest_square = 0.0;
  double nearest_square = kInfinity;
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();
};

/// Sums of (2π)^(3/2) φ times the area, and of what their rounding is told from.
struct MomentSums {
  Eigen::Vector3d flux = Eigen::Vector3d::Zero();
  double magnitude = 0.0, density = 0.0;

  void add(const PatchPoints& points, const LaneVector& areas, double weight,
           const Lanes& weights) {
    const Lanes square = points.value[0] * points.value[0] + points.value[1] * points.value[1] +
                         points.value[2] * points.value[2];
    Lanes field(0.0);
    for (std::size_t k = 0; k < Lanes::kCount; ++k) {
      if (!(weights[k] > 0.0)) continue;
      field[k] = weight * weights[k] * std::exp(-0.5 * square[k]);
      density += field[k];
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const Lanes& area = areas[c];
      for (std::size_t k = 0; k < Lanes::kCount; ++k) {
        if (!(weights[k] > 0.0)) continue;
        flux[static_cast<Eigen::Index>(c)] -= field[k] * area[k];
        magnitude += field[k] * std::abs(area[k]);
      }
    }
  }
};

PartPlan planPatch(const PatchCell& cell, const ParameterBox& box, double target,
                   EllipseGuess& guess) {
  PartPlan plan;
  for (std::size_t k = 0; k < 2; ++k) {
    const ParameterRule rule = fewestPoints(cell, box, k, target, guess[k]);
    plan.points[k] = rule.points;
    plan.error += rule.error;
    if (!(rule.points < kInfinity)) break;
  }
  return plan;
}

/// A box cut in two across a parameter.
std::array<ParameterBox, 2> halvesAcross(const ParameterBox& box, std::size_t k) {
  PartPlan plan;
  plan.points[k] = 1.0;
  return halves(box, plan);
}

}  // namespace

void SurfaceCubature::add(const SurfacePatch& patch) { addBox(patch, wholePatch(), 0); }

void SurfaceCubature::addBox(const SurfacePatch& patch, const ParameterBox& box, int depth) {
  ++cells_;
  if (isDue(interruption_)) sum_.error = kInfinity;
  if (!(sum_.error < kInfinity)) return;
  const double target = limits_.tolerance / kInverseTwoPi;
  const bool is_last = depth >= kMostSurfaceDepth || cells_ >= limits_.most_cells;
  const NormalChanges changes = normalChanges(patch, box);
  if (changes.of_square >= 1.0 && !is_last) {
    divideWhereBent(patch, box, changes, depth);
    return;
  }
  const PatchCell cell(patch, box, farNormal(patch, box, axes_.row(2)), axes_.row(2), components_);
  const PartBound real = cell.bound(ComplexBox(box));
  const double all = volumeOf(box) * supremumOf(real) * kBoundSlack;
  if (all <= target || is_last) {
    sum_.error += kInverseTwoPi * all + kFluxUnderflow;
    sum_.moment_error += kDensityScale * all + kFluxUnderflow;
    if (displacement_ > 0.0) sum_.error += kInverseTwoPi * layerOver(cell, box, real);
    if (!(all < kInfinity)) sum_.error = kInfinity;
    return;
  }
  PartPlan plan;
  if (changes.of_square < kTooBent) plan = planPatch(cell, box, target, guess_);
  if (!(plan.points[plan.worst()] < kInfinity) || plan.points[0] == 0.0) {
    divideWhereBent(patch, box, changes, depth);
  } else if (!plan.exists()) {
    for (const ParameterBox& half : halves(box, plan)) addBox(patch, half, depth + 1);
  } else {
    sum_.error += kInverseTwoPi * plan.error * kBoundSlack;
    sum_.moment_error += kDensityScale * plan.error * kBoundSlack;
    evaluate(patch, cell, box, plan.points);
  }
}

/// What a layer as thick as the displacement weighs at the most, but for 1 / 2π: φ(z) is no more
/// than (z + 1) Q(z).
double SurfaceCubature::layerOver(const PatchCell& cell, const ParameterBox& box,
                                  const PartBound& real) const {
  const PatchRounding& lengths = cell.rounding();
  const double area = lengths.first_length * lengths.second_length * volumeOf(box);
  const PartBound field{1.0, real.distance, real.growth, real.reach};
  return layerAt(std::min(real.reach, kFarthestPoint)) * area * supremumOf(field);
}

double SurfaceCubature::layerAt(double reach) const { return 2.2 * (reach + 1.0) * displacement_; }

// Where nothing is known, the normals tell why: near a pole they may turn along one parameter only.
void SurfaceCubature::divideWhereBent(const SurfacePatch& patch, const ParameterBox& box,
                                      const NormalChanges& changes, int depth) {
  const std::size_t worse = changes.along[1] > changes.along[0] ? 1 : 0;
  const bool both = changes.along[1 - worse] > kEvenChange * changes.along[worse];
  for (const ParameterBox& half : halvesAcross(box, worse)) {
    if (!both) {
      addBox(patch, half, depth + 1);
      continue;
    }
    for (const ParameterBox& quarter : halvesAcross(half, 1 - worse)) {
      addBox(patch, quarter, depth + 2);
    }
  }
}

void SurfaceCubature::evaluate(const SurfacePatch& patch, const PatchCell& cell,
                               const ParameterBox& box, const std::array<double, 3>& points) {
  const PartRule& first = partRule(points[0]);
  const LaneRule second(partRule(points[1]), box);
  FluxSums sums(axes_);
  MomentSums moments;
  for (std::size_t i = 0; i < first.nodes.size(); ++i) {
    const PatchLine line(patch, box.centre[0] + box.half[0] * first.nodes[i]);
    for (std::size_t j = 0; j < second.count; ++j) {
      const PatchPoints at = line.at(second.nodes[j]);
      const LaneVector areas = crossOf(at.first, at.second);
      sums.add(at, areas, first.weights[i], second.weights[j]);
      if (withMoment()) moments.add(at, areas, first.weights[i], second.weights[j]);
    }
  }
  const double scale = kInverseTwoPi * box.half[0] * box.half[1];
  const PatchRounding& rounding = cell.rounding();
  const double farthest = std::sqrt(sums.farthest_square);
  const double reach = std::min(farthest, kFarthestPoint);
  // |∇ log F| is at most reach + 1; the axes are orthonormal but for a few ε.
  const double position = rounding.position + kAxesRounding * farthest;
  const double relative =
      (reach + 1.0) * position + 4.0 * kEpsilon * reach * reach + kFluxRounding + kBoxSumRounding;
  const double of_area =
      rounding.first * rounding.second_length + rounding.second * rounding.first_length +
      (kFluxRounding + layerAt(reach)) * rounding.first_length * rounding.second_length;
  sum_.mass += scale * sums.flux;
  sum_.error += scale * (sums.magnitude * relative + sums.density * of_area) + kFluxUnderflow;
  const double moment_scale = kDensityScale * box.half[0] * box.half[1];
  sum_.moment += moment_scale * moments.flux;
  sum_.moment_error +=
      moment_scale * (moments.magnitude * relative + moments.density * of_area) + kFluxUnderflow;
  if (!(position < 1e-3)) sum_.error = kInfinity;
  if (sums.nearest_square < sum_.nearest.squaredNorm()) sum_.nearest = sums.nearest;
}

namespace {

/// The best of some attempts.
SurfaceSum sumOver(const std::vector<SurfacePatch>& surface, double guess,
                   const Interruption& interruption, const SurfaceEffort& effort) {
  const AreaComponents components =
      effort.with_moment ? AreaComponents::all : AreaComponents::along_field;
  const double count = static_cast<double>(surface.size()) + 30.0;
  SurfaceSum best{0.0, kInfinity};
  double about = std::clamp(guess, kUnderflow, 0.1);
  for (int attempt = 0; attempt < kSurfaceAttempts; ++attempt) {
    SurfaceCubature cubature({effort.target * about / count, kMostSurfaceBoxes}, interruption,
                             effort.axes, effort.displacement, components);
    for (const SurfacePatch& patch : surface) cubature.add(patch);
    // Rounding stays, whatever rules leave.
    const bool stays = cubature.sum().error > 0.5 * best.error;
    if (cubature.sum().error < best.error) best = cubature.sum();
    if (best.error <= effort.enough * best.mass || cubature.exhausted() || stays) break;
    // As far as it is known.
    const double most = best.mass + best.error;
    const double next = best.mass > 2.0 * best.error ? best.mass : std::min(1e-6 * about, most);
    if (isDue(interruption)) break;
    about = std::max(std::min(next, 0.3 * about), kUnderflow);
  }
  return best;
}

Bounds boundsOf(const SurfaceSum& sum) {
  if (!(sum.error < kInfinity)) return {0.0, 1.0};
  const double error = sum.error * (1.0 + 1e-9) + kUnderflow;
  return {sum.mass - error, sum.mass + error};
}

}  // namespace

SurfaceMass massWithin(const std::vector<SurfacePatch>& surface, double guess,
                       const Interruption& interruption, const SurfaceEffort& effort) {
  const SurfaceSum sum = sumOver(surface, guess, interruption, effort);
  SurfaceMass result{boundsOf(sum), std::nullopt, std::nullopt};
  if (sum.nearest.allFinite()) result.nearest = sum.nearest;
  if (!effort.with_moment) return result;
  const double error = sum.moment_error * (1.0 + 1e-9) + kUnderflow;
  if (!(sum.error < kInfinity && error < kInfinity)) return result;
  result.moment = {sum.moment.array() - error, sum.moment.array() + error};
  return result;
}

}  // namespace fcl_prob::detail
