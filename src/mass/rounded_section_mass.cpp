// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/rounded_section_mass.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"
#include "mass/rounded_section.h"
#include "mass/surface_cubature.h"

namespace fcl_prob::detail {
namespace {

using Vector = Eigen::Vector3d;

/// Of the error of all rules, next to the mass: tried for, and enough.
constexpr double kSectionTarget = 2e-11, kSectionEnough = 2e-10;

/// Of the mass of the box around a section.
constexpr double kSectionGuess = 0.1;

/// How often a nearest point is looked for, which decides about speed only.
constexpr int kNearestSteps = 40;

/// Of points of arcs, in long doubles, next to what they are made of.
constexpr long double kSectionRounding = 0x1p-58L;

/// Smaller sections than this, next to their rounding, are none that is known.
constexpr double kLeastPerimeter = 100.0;

/// Of a patch's constants, in doubles.
constexpr double kStoredRounding = 4.0 * kEpsilon;

/// A section in the plane of the whitened y and z; x is the height of a prism over it.
class WhitenedSection {
 public:
  WhitenedSection(const RoundedSection& section, const MovingAxes& axes, const LongVector3& origin)
      : section_(section), origin_(origin) {
    map_.setZero();
    for (int k = 0; k < 2; ++k) map_.row(k + 1) = axes.inverse.row(k) / axes.deviations[k];
    turnTowardsNearest();
  }

  /// The sides of a prism of height 1.
  std::vector<SurfacePatch> patches() {
    for (const SectionPiece& piece : section_.pieces) {
      if (!piece.is_arc) {
        addSegment(mapped(piece.from), mapped(piece.to));
        continue;
      }
      addArc(piece);
    }
    return std::move(patches_);
  }

  /// How far the patches may be from the section, whitened.
  double rounding() const { return kStoredRounding * reach_; }

  /// No more than the length of the boundary, whitened.
  double perimeter() const {
    double length = 0.0;
    for (const SectionPiece& piece : section_.pieces) {
      length += (mapped(piece.to) - mapped(piece.from)).norm();
    }
    return length;
  }

  /// About the mass of the prism, rather too small than too large.
  double guess() const {
    return kSectionGuess * normalTailMass(nearest_) *
           std::min(1.0, std::max(nearest_, 0.5) * height_) * std::min(1.0, 0.4 * width_);
  }

 private:
  LongVector3 image(const LongVector3& point) const { return map_ * (point + origin_); }
  Vector mapped(const LongVector3& point) const { return image(point).cast<double>(); }

  static LongVector3 onArc(const SectionPiece& piece, long double share) {
    const LongVector3 g = (1.0L - share) * piece.first + share * piece.last;
    return piece.centre + piece.image * (g / g.norm());
  }

  /// Whether points are all around the origin: no half turn between neighbours is free of them.
  static bool areAround(const std::vector<LongVector3>& points) {
    std::vector<long double> angles;
    for (const LongVector3& p : points) angles.push_back(std::atan2(p.z(), p.y()));
    std::sort(angles.begin(), angles.end());
    long double widest = angles.front() + 2.0L * M_PIl - angles.back();
    for (std::size_t k = 1; k < angles.size(); ++k) {
      widest = std::max(widest, angles[k] - angles[k - 1]);
    }
    return widest < M_PIl;
  }

  static LongVector3 nearestOf(const LongVector3& from, const LongVector3& to) {
    const LongVector3 way = to - from;
    const long double square = way.squaredNorm();
    const long double share =
        square > 0.0L ? std::clamp(-from.dot(way) / square, 0.0L, 1.0L) : 0.0L;
    return from + share * way;
  }

  /// Of the hull of points that are not around the origin, by segments between the nearest ones.
  static LongVector3 nearestOfHull(const std::vector<LongVector3>& points) {
    LongVector3 from = points.front(), to = from, nearest = from;
    for (int step = 0; step < kNearestSteps; ++step) {
      const LongVector3& next = *std::min_element(points.begin(), points.end(),
                                                  [&](const LongVector3& x, const LongVector3& y) {
                                                    return nearest.dot(x) < nearest.dot(y);
                                                  });
      if (!(nearest.dot(nearest - next) > 1e-6L * nearest.squaredNorm())) break;
      if (nearestOf(from, next).norm() > nearestOf(to, next).norm()) from = to;
      to = next;
      nearest = nearestOf(from, to);
    }
    return nearest;
  }

  /// Turns y and z so that z is about towards the nearest point or, from within, the middle.
  void turnTowardsNearest() {
    std::vector<LongVector3> points;
    for (const SectionPiece& piece : section_.pieces) {
      for (const long double share : {0.0L, 0.25L, 0.5L, 0.75L}) {
        points.push_back(image(piece.is_arc
                                   ? onArc(piece, share)
                                   : LongVector3(piece.from + share * (piece.to - piece.from))));
      }
    }
    const bool is_outside = !areAround(points);
    const LongVector3 nearest = is_outside ? nearestOfHull(points) : LongVector3::Zero();
    LongVector3 middle = LongVector3::Zero();
    for (const LongVector3& point : points)
      middle += point / static_cast<long double>(points.size());
    LongVector3 z = is_outside ? nearest : middle;
    if (!(z.norm() > 0.0L)) z = LongVector3::UnitZ();
    z.normalize();
    LongMatrix3 turn = LongMatrix3::Identity();
    turn.row(1) << 0.0L, z.z(), -z.y();
    turn.row(2) << 0.0L, z.y(), z.z();
    map_ = turn * map_;
    nearest_ = is_outside ? static_cast<double>(nearest.norm()) : 0.0;
    LongVector3 least = turn * points.front(), most = least;
    for (const LongVector3& point : points) {
      least = least.cwiseMin(turn * point);
      most = most.cwiseMax(turn * point);
    }
    width_ = static_cast<double>(most.y() - least.y());
    height_ = static_cast<double>(most.z() - least.z());
  }

  SurfacePatch prismOver(const Vector& from, const Vector& to) {
    SurfacePatch patch;
    patch.position = {from, to, from + Vector::UnitX(), to + Vector::UnitX()};
    for (std::size_t k = 2; k < 4; ++k) patch.position[k].x() = 1.0;
    reach_ = std::max({reach_, from.norm(), to.norm()});
    return patch;
  }

  void addSegment(const Vector& from, const Vector& to) {
    if (from != to) patches_.push_back(prismOver(from, to));
  }

  /// What the ends of the arc, as it is stored, are off by closes the boundary.
  void addArc(const SectionPiece& piece) {
    const Vector centre = mapped(piece.centre);
    SurfacePatch patch = prismOver(centre, centre);
    const Vector first = piece.first.cast<double>(), last = piece.last.cast<double>();
    CurvedTerm term;
    term.image = (map_ * piece.image).cast<double>();
    term.image.row(0).setZero();
    term.direction = {first, last, first, last};
    reach_ = std::max(reach_, centre.norm() + term.image.norm());
    patch.add(term);
    const auto end = [&](const Vector& g) -> Vector {
      return centre + term.image * g.normalized();
    };
    addSegment(mapped(piece.from), end(first));
    patches_.push_back(patch);
    addSegment(end(last), mapped(piece.to));
  }

  const RoundedSection& section_;
  const LongVector3& origin_;
  LongMatrix3 map_;
  double nearest_ = 0.0, width_ = 0.0, height_ = 0.0;
  double reach_ = 1.0;
  std::vector<SurfacePatch> patches_;
};

/// The mass of a section is that of a prism of height 1 over it, divided by that of the height.
Bounds planeMass(const RoundedSection& section, const MovingAxes& axes, const LongVector3& origin,
                 const Interruption& interruption) {
  if (section.pieces.empty()) return {0.0, 0.0};
  WhitenedSection whitened(section, axes, origin);
  const std::vector<SurfacePatch> patches = whitened.patches();
  // Of a layer of thickness δ around a convex region of perimeter L, π δ² is next to 2.2 δ L.
  if (!(whitened.perimeter() > kLeastPerimeter * whitened.rounding())) return {0.0, 1.0};
  SurfaceEffort effort;
  effort.target = kSectionTarget;
  effort.enough = kSectionEnough;
  effort.displacement = whitened.rounding();
  const Bounds prism = massWithin(patches, whitened.guess(), interruption, effort).mass;
  const double height = normalIntervalMass(0.0, 1.0);
  return {prism.lower / height * (1.0 - 32.0 * kEpsilon),
          prism.upper / height * (1.0 + 32.0 * kEpsilon)};
}

/// Of long doubles, next to what the section is made of.
double longRounding(const RoundedPolytope& body) {
  double size = body.radius;
  for (const Vector& v : body.core.vertices) size = std::max(size, v.norm() + body.radius);
  return static_cast<double>(kSectionRounding) * (size + static_cast<double>(body.origin.norm()));
}

Bounds twoDimensionalMass(const RoundedPolytope& body, const RoundedParts& parts,
                          const MovingAxes& axes, const Interruption& interruption) {
  const LongVector3 row = axes.inverse.row(2).transpose();
  const SectionPlane plane{row.normalized(), body.origin};
  const double error = body.error + longRounding(body);
  const double inner = (body.radius - error) * (1.0 - 8.0 * kEpsilon);
  Bounds mass{0.0, 1.0};
  if (inner > 0.0) {
    if (const auto section = roundedSection(body.core, parts.normals, inner, plane)) {
      mass.lower = planeMass(*section, axes, body.origin, interruption).lower;
    }
  }
  // Points are no nearer to the core than the radius less the defect.
  double outer = (body.radius + error + parts.defect) * (1.0 + 8.0 * kEpsilon);
  auto section = roundedSection(body.core, parts.normals, outer, plane);
  if (!section) return mass;
  if (section->defect > 0.0) {
    outer += 3.0 * section->defect;
    section = roundedSection(body.core, parts.normals, outer, plane);
    if (!section) return mass;
  }
  mass.upper = planeMass(*section, axes, body.origin, interruption).upper;
  return mass;
}

}  // namespace

Bounds roundedSectionMass(const RoundedPolytope& body, const MovingAxes& axes,
                          const Interruption& interruption) {
  if (body.core.vertices.size() < 2) return {0.0, 1.0};
  const auto parts = roundedParts(body.core, LongVector3::Zero(), LongMatrix3::Identity());
  if (!parts) return {0.0, 1.0};
  const Bounds mass = twoDimensionalMass(body, *parts, axes, interruption);
  if (!(mass.lower <= mass.upper)) return {0.0, 1.0};
  return {std::clamp(mass.lower, 0.0, 1.0), std::clamp(mass.upper, 0.0, 1.0)};
}

}  // namespace fcl_prob::detail
