// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "narrowphase/curved_surface.h"

#include <Eigen/LU>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

const Eigen::Vector3d kAxis = Eigen::Vector3d::UnitZ();

/// Normals around the axis at one latitude: cosine w + |w| lift e_z + pole e_z.
struct Latitude {
  double cosine, lift, pole;
};

constexpr Latitude kSouthPole{0.0, 0.0, -1.0}, kNorthPole{0.0, 0.0, 1.0}, kEquator{1.0, 0.0, 0.0};

/// A quarter of the directions around the axis, between two neighbours of four.
struct Quarter {
  Eigen::Vector3d from, to;
};

std::array<Quarter, 4> quartersAround() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  return {Quarter{x, y}, Quarter{y, -x}, Quarter{-x, -y}, Quarter{-y, x}};
}

/// A ring of patches: from the normals, end of the axis and radius at t = 0 to those at t = 1.
struct Ring {
  Latitude from, to;
  double from_height, to_height;
  double from_radius, to_radius;
};

class CurvedSurface {
 public:
  explicit CurvedSurface(const CurvedSum& sum)
      : frustum_(sum.frustum), centre_(sum.centre.cast<double>()) {
    const LongMatrix3 frame = sum.map * sum.frame;
    const LongVector3 half = frame.col(2) * static_cast<long double>(frustum_.half_height);
    top_ = (sum.centre + half).cast<double>();
    bottom_ = (sum.centre - half).cast<double>();
    rim_.setZero();
    rim_.leftCols<2>() = frame.leftCols<2>().cast<double>();
    const LongMatrix3 inverse = sum.frame.inverse();
    for (const LongMatrix3& ellipsoid : sum.ellipsoids) {
      images_.push_back((sum.map * ellipsoid).cast<double>());
      normals_.push_back((inverse * ellipsoid).transpose().cast<double>());
    }
  }

  std::vector<SurfacePatch> patches() {
    const double rise = 2.0 * frustum_.half_height, narrowing = frustum_.bottom - frustum_.top;
    const double slant = std::hypot(rise, narrowing);
    const bool has_side = slant > 0.0;
    const Latitude side =
        has_side && narrowing != 0.0 ? Latitude{rise / slant, narrowing / slant, 0.0} : kEquator;
    addDisc(frustum_.bottom, kSouthPole, 0.0);
    if (side.lift > 0.0) {
      addEnd(kSouthPole, kEquator, 0.0, frustum_.bottom);
      addEnd(kEquator, side, 0.0, frustum_.bottom);
    } else {
      addEnd(kSouthPole, side, 0.0, frustum_.bottom);
    }
    if (has_side) addRing({side, side, 0.0, 1.0, frustum_.bottom, frustum_.top});
    if (side.lift < 0.0) {
      addEnd(side, kEquator, 1.0, frustum_.top);
      addEnd(kEquator, kNorthPole, 1.0, frustum_.top);
    } else {
      addEnd(side, kNorthPole, 1.0, frustum_.top);
    }
    addDisc(frustum_.top, kNorthPole, 1.0);
    return std::move(patches_);
  }

 private:
  /// A rim or an end of the axis, swept by the ellipsoids.
  void addEnd(const Latitude& from, const Latitude& to, double height, double radius) {
    if (!images_.empty()) addRing({from, to, height, height, radius, radius});
  }

  void addDisc(double radius, const Latitude& pole, double height) {
    if (!(radius > 0.0)) return;
    const bool outwards = pole.pole < 0.0;
    addRing({pole, pole, height, height, outwards ? 0.0 : radius, outwards ? radius : 0.0});
  }

  const Eigen::Vector3d& endAt(double height) const { return height > 0.0 ? top_ : bottom_; }

  void addRing(const Ring& ring) {
    for (const Quarter& quarter : quartersAround()) {
      SurfacePatch patch;
      const Eigen::Vector3d &from = endAt(ring.from_height), &to = endAt(ring.to_height);
      patch.position = {from, from, to, to};
      patch.base = {quarter.from, quarter.to};
      patch.lifted = ring.from.lift != 0.0 || ring.to.lift != 0.0;
      if (ring.from_radius > 0.0 || ring.to_radius > 0.0) {
        CurvedTerm rim{rim_, {quarter.from, quarter.to, quarter.from, quarter.to}};
        rim.size = {ring.from_radius, ring.to_radius};
        patch.add(rim);
      }
      for (std::size_t k = 0; k < images_.size(); ++k) patch.add(ellipsoidTerm(k, ring, quarter));
      patches_.push_back(patch);
    }
  }

  CurvedTerm ellipsoidTerm(std::size_t k, const Ring& ring, const Quarter& quarter) const {
    const Eigen::Matrix3d& map = normals_[k];
    const auto corner = [&](const Latitude& at, const Eigen::Vector3d& w) -> Eigen::Vector3d {
      return map * (at.cosine * w + at.pole * kAxis);
    };
    CurvedTerm term{images_[k],
                    {corner(ring.from, quarter.from), corner(ring.from, quarter.to),
                     corner(ring.to, quarter.from), corner(ring.to, quarter.to)}};
    term.lift = {map * (ring.from.lift * kAxis), map * (ring.to.lift * kAxis)};
    return term;
  }

  const Frustum& frustum_;
  Eigen::Vector3d centre_, top_, bottom_;
  Eigen::Matrix3d rim_;
  std::vector<Eigen::Matrix3d> images_, normals_;
  std::vector<SurfacePatch> patches_;
};

}  // namespace

double CurvedSum::rounding() const {
  const LongMatrix3 mapped = map * frame;
  const double rims = std::max(frustum.bottom, frustum.top) + frustum.half_height;
  double size = rims * static_cast<double>(mapped.norm());
  for (const LongMatrix3& ellipsoid : ellipsoids) {
    size += static_cast<double>((map * ellipsoid).norm());
  }
  return 8.0 * kEpsilon * (size + static_cast<double>(centre.norm()));
}

std::vector<SurfacePatch> surfaceOf(const CurvedSum& sum) { return CurvedSurface(sum).patches(); }

}  // namespace fcl_prob::detail
