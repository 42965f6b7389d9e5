// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/curved_surface.h"

#include <Eigen/LU>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

const Eigen::Vector3d kAxis = Eigen::Vector3d::UnitZ();

/// Normals around the axis at one latitude: cosine w + |w| lift e_z + pole e_z, |w| = 1 at corners.
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

/// A circle around the axis.
struct Rim {
  Eigen::Vector3d centre;
  double radius;
};

/// A ring of patches: from the normals and rim at t = 0 to those at t = 1.
struct Ring {
  Latitude from, to;
  Rim first, last;
};

/// The normals of a side, seen from its frame.
Latitude latitudeOf(const Frustum& frustum) {
  const double rise = 2.0 * frustum.half_height, narrowing = frustum.bottom - frustum.top;
  if (narrowing == 0.0) return kEquator;
  const double slant = std::hypot(rise, narrowing);
  return {rise / slant, narrowing / slant, 0.0};
}

/// From the south: the one whose normals are lower comes first.
std::vector<Frustum> sidesOf(const CurvedSum& sum) {
  std::vector<Frustum> sides;
  const auto add = [&](const Frustum& frustum) {
    if (frustum.half_height > 0.0 || frustum.bottom > 0.0 || frustum.top > 0.0)
      sides.push_back(frustum);
  };
  add(sum.frustum);
  if (sum.coaxial) add(*sum.coaxial);
  if (sides.size() == 2 && latitudeOf(sides[1]).lift < latitudeOf(sides[0]).lift) {
    std::swap(sides[0], sides[1]);
  }
  return sides;
}

class CurvedSurface {
 public:
  explicit CurvedSurface(const CurvedSum& sum) : sides_(sidesOf(sum)), frame_(sum.map * sum.frame) {
    LongVector3 end = sum.centre();
    double radius = 0.0;
    for (const Frustum& side : sides_) {
      end -= frame_.col(2) * static_cast<long double>(side.half_height);
      radius += side.bottom;
    }
    rims_.push_back({end.cast<double>(), radius});
    for (std::size_t k = 0; k < sides_.size(); ++k) {
      end += frame_.col(2) * static_cast<long double>(2.0 * sides_[k].half_height);
      // What is left of the last one is that of the tops.
      radius = sides_[k].top + (k + 1 < sides_.size() ? sides_[k + 1].bottom : 0.0);
      if (k > 0) radius += sides_[k - 1].top;
      rims_.push_back({end.cast<double>(), radius});
    }
    rim_.setZero();
    rim_.leftCols<2>() = frame_.leftCols<2>().cast<double>();
    const LongMatrix3 inverse = sum.frame.inverse();
    for (const LongMatrix3& ellipsoid : sum.ellipsoids) {
      images_.push_back((sum.map * ellipsoid).cast<double>());
      normals_.push_back((inverse * ellipsoid).transpose().cast<double>());
    }
  }

  std::vector<SurfacePatch> patches() {
    addDisc(rims_.front(), kSouthPole);
    Latitude at = kSouthPole;
    for (std::size_t k = 0; k < sides_.size(); ++k) {
      const Latitude side = latitudeOf(sides_[k]);
      addEnd(at, side, rims_[k]);
      addRing({side, side, rims_[k], rims_[k + 1]});
      at = side;
    }
    addEnd(at, kNorthPole, rims_.back());
    addDisc(rims_.back(), kNorthPole);
    return std::move(patches_);
  }

 private:
  /// A rim or an end of the axis, swept by the ellipsoids.
  void addEnd(const Latitude& from, const Latitude& to, const Rim& rim) {
    if (images_.empty()) return;
    const double south = from.lift + from.pole, north = to.lift + to.pole;
    if (south == north) return;
    if (south < 0.0 && north > 0.0) {
      addRing({from, kEquator, rim, rim});
      addRing({kEquator, to, rim, rim});
    } else {
      addRing({from, to, rim, rim});
    }
  }

  void addDisc(const Rim& rim, const Latitude& pole) {
    if (!(rim.radius > 0.0)) return;
    const Rim middle{rim.centre, 0.0};
    const bool outwards = pole.pole < 0.0;
    addRing({pole, pole, outwards ? middle : rim, outwards ? rim : middle});
  }

  void addRing(const Ring& ring) {
    for (const Quarter& quarter : quartersAround()) {
      SurfacePatch patch;
      const Eigen::Vector3d &from = ring.first.centre, &to = ring.last.centre;
      patch.position = {from, from, to, to};
      patch.base = {quarter.from, quarter.to};
      patch.lifted = ring.from.lift != 0.0 || ring.to.lift != 0.0;
      if (ring.first.radius > 0.0 || ring.last.radius > 0.0) {
        CurvedTerm rim{rim_, {quarter.from, quarter.to, quarter.from, quarter.to}};
        rim.size = {ring.first.radius, ring.last.radius};
        patch.add(rim);
      }
      for (std::size_t k = 0; k < images_.size(); ++k) patch.add(ellipsoidTerm(k, ring, quarter));
      patches_.push_back(patch);
    }
  }

  CurvedTerm ellipsoidTerm(std::size_t k, const Ring& ring, const Quarter& quarter) const {
    const Eigen::Matrix3d& map = normals_[k];
    const auto corner = [&](const Latitude& at, const Eigen::Vector3d& w) -> Eigen::Vector3d {
      return map * (at.cosine * w + (at.lift + at.pole) * kAxis);
    };
    CurvedTerm term{images_[k],
                    {corner(ring.from, quarter.from), corner(ring.from, quarter.to),
                     corner(ring.to, quarter.from), corner(ring.to, quarter.to)}};
    term.lift = {map * (ring.from.lift * kAxis), map * (ring.to.lift * kAxis)};
    return term;
  }

  std::vector<Frustum> sides_;
  LongMatrix3 frame_;
  std::vector<Rim> rims_;  ///< from the bottom to the top
  Eigen::Matrix3d rim_;
  std::vector<Eigen::Matrix3d> images_, normals_;
  std::vector<SurfacePatch> patches_;
};

}  // namespace

double CurvedSum::rounding() const {
  double size = frustum.size();
  if (coaxial) size += coaxial->size();
  for (const LongMatrix3& ellipsoid : ellipsoids) size += static_cast<double>(ellipsoid.norm());
  return 16.0 * kEpsilon * (size + static_cast<double>(offset.norm()));
}

std::vector<SurfacePatch> surfaceOf(const CurvedSum& sum) { return CurvedSurface(sum).patches(); }

}  // namespace fcl_prob::detail
