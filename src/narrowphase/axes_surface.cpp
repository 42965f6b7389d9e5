// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "narrowphase/axes_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

using Vector = Eigen::Vector3d;

/// A cylinder or a segment.
struct AxisPart {
  Vector axis;            ///< unit
  Eigen::Matrix3d rim;    ///< of normals, to where the rim is
  Eigen::Matrix3d image;  ///< mapped
  LongVector3 half;       ///< from the middle to an end, mapped
  double radius;
};

/// A normal in the plane of both axes, at an angle from the first axis towards the second.
struct Meridian {
  double angle;
  Vector normal;
  std::array<bool, 2> pole{false, false};    ///< along the axis
  std::array<bool, 2> across{false, false};  ///< across it

  bool isPole() const { return pole[0] || pole[1]; }
};

AxisPart partOf(const Frustum& frustum, const LongMatrix3& frame, const LongMatrix3& map) {
  AxisPart part;
  part.axis = frame.col(2).cast<double>().normalized();
  LongMatrix3 across = frame;
  across.col(2).setZero();
  part.rim = across.transpose().cast<double>();
  part.image = (map * across).cast<double>();
  part.half = map * frame.col(2) * static_cast<long double>(frustum.half_height);
  part.radius = frustum.top;
  return part;
}

class AxesSurface {
 public:
  explicit AxesSurface(const AxesSum& axes) : centre_(axes.sum.centre) {
    LongMatrix3 second = axes.second_frame;
    if (axes.sum.frame.col(2).dot(second.col(2)) < 0.0L) second.col(2) *= -1.0L;
    parts_ = {partOf(axes.sum.frustum, axes.sum.frame, axes.sum.map),
              partOf(axes.second, second, axes.sum.map)};
    for (const LongMatrix3& ellipsoid : axes.sum.ellipsoids) {
      images_.push_back((axes.sum.map * ellipsoid).cast<double>());
      normals_.push_back(ellipsoid.transpose().cast<double>());
    }
    const LongVector3 a = axes.sum.frame.col(2).normalized(), b = second.col(2).normalized();
    LongVector3 both = a.cross(b);
    both = (both - a * a.dot(both)).normalized();
    north_ = both.cast<double>();
    aside_ = both.cross(a).cast<double>();
    angle_ = static_cast<double>(std::atan2(b.dot(both.cross(a)), b.dot(a)));
    findMeridians();
  }

  std::vector<SurfacePatch> patches() {
    for (std::size_t k = 0; k < meridians_.size(); ++k) {
      const Meridian &from = meridians_[k], &to = meridians_[(k + 1) % meridians_.size()];
      const double end = k + 1 < meridians_.size() ? to.angle : to.angle + 2.0 * M_PI;
      const Eigen::Vector2d ends = endsAt(0.5 * (from.angle + end));
      for (const double side : {1.0, -1.0}) addGore(from, to, ends, side);
    }
    for (const Meridian& meridian : meridians_) {
      for (const std::size_t which : {0u, 1u}) {
        if (!meridian.across[which]) continue;
        for (const double side : {1.0, -1.0}) {
          addSide(meridian, which, side);
          if (meridian.isPole()) addStrip(meridian, which, side);
        }
      }
    }
    addParallelogram(1.0);
    addParallelogram(-1.0);
    return std::move(patches_);
  }

 private:
  void findMeridians() {
    constexpr double kRight = M_PI_2;
    const bool square = kRight - angle_ < kAxesTie;
    const auto add = [&](double angle, std::array<bool, 2> pole, std::array<bool, 2> across) {
      for (const double turn : {0.0, M_PI}) {
        const Vector first = parts_[0].axis,
                     at = std::cos(angle) * first + std::sin(angle) * aside_;
        meridians_.push_back({angle + turn, turn > 0.0 ? Vector(-at) : at, pole, across});
      }
    };
    add(0.0, {true, false}, {false, square});
    add(square ? kRight : angle_, {false, true}, {square, false});
    if (!square) {
      add(kRight, {false, false}, {true, false});
      add(kRight + angle_, {false, false}, {false, true});
    }
    std::sort(meridians_.begin(), meridians_.end(),
              [](const Meridian& a, const Meridian& b) { return a.angle < b.angle; });
    std::vector<Meridian> all;
    for (std::size_t k = 0; k < meridians_.size(); ++k) {
      const Meridian &from = meridians_[k], &to = meridians_[(k + 1) % meridians_.size()];
      all.push_back(from);
      if (!from.isPole() || !to.isPole()) continue;
      const double end = k + 1 < meridians_.size() ? to.angle : to.angle + 2.0 * M_PI;
      all.push_back({0.5 * (from.angle + end), (from.normal + to.normal).normalized()});
    }
    meridians_ = std::move(all);
  }

  /// Which end of each axis is farthest along normals at an angle.
  Eigen::Vector2d endsAt(double angle) const {
    return {std::cos(angle) > 0.0 ? 1.0 : -1.0, std::cos(angle - angle_) > 0.0 ? 1.0 : -1.0};
  }

  Vector position(const Eigen::Vector2d& ends) const {
    return (centre_ + static_cast<long double>(ends[0]) * parts_[0].half +
            static_cast<long double>(ends[1]) * parts_[1].half)
        .cast<double>();
  }

  static BilinearVector mapped(const Eigen::Matrix3d& map, const BilinearVector& normals) {
    BilinearVector image;
    for (std::size_t k = 0; k < 4; ++k) image[k] = map * normals[k];
    return image;
  }

  void addEllipsoids(const BilinearVector& normals, SurfacePatch& patch) const {
    for (std::size_t k = 0; k < images_.size(); ++k) {
      patch.add({images_[k], mapped(normals_[k], normals)});
    }
  }

  /// \param size  shares of the radius at t = 0 and 1
  void addRim(std::size_t which, const BilinearVector& normals, const std::array<double, 2>& size,
              SurfacePatch& patch) const {
    const AxisPart& part = parts_[which];
    if (!(part.radius > 0.0)) return;
    CurvedTerm rim{part.image, mapped(part.rim, normals)};
    rim.size = {size[0] * part.radius, size[1] * part.radius};
    patch.add(rim);
  }

  /// The normals between two meridians on one side of the plane of the axes, as a fan around that
  /// which is a pole.
  void addGore(const Meridian& from, const Meridian& to, const Eigen::Vector2d& ends, double side) {
    const Vector top = side * north_;
    const bool first = !to.isPole();
    const Meridian& apex = first ? from : to;
    // Anticlockwise, seen from outside: from, to, top, and on the other side from, top, to.
    Vector begin = first ? to.normal : top, end = first ? top : from.normal;
    if (side < 0.0) std::swap(begin, end);
    for (const std::size_t which : {0u, 1u}) {
      if (apex.pole[which]) balance(parts_[which].rim, begin, end);
    }
    const BilinearVector base{begin, end, begin, end}, fan{begin, end, apex.normal, apex.normal};
    if (!images_.empty() || (parts_[0].radius > 0.0 && parts_[1].radius > 0.0)) {
      SurfacePatch patch;
      patch.position.fill(position(ends));
      for (const std::size_t which : {0u, 1u}) {
        addRim(which, apex.pole[which] ? base : fan, {1.0, 1.0}, patch);
      }
      addEllipsoids(fan, patch);
      patches_.push_back(patch);
    }
    for (const std::size_t which : {0u, 1u}) {
      if (apex.pole[which] && parts_[which].radius > 0.0) addSector(which, apex, base, ends);
    }
  }

  /// Shortens one of two normals until the rim turns evenly between them.
  static void balance(const Eigen::Matrix3d& rim, Vector& first, Vector& second) {
    const double a = (rim * first).norm(), b = (rim * second).norm();
    (a > b ? first : second) *= std::min(a, b) / std::max(a, b);
  }

  /// Of a disc, from the rim to its middle.
  void addSector(std::size_t which, const Meridian& pole, const BilinearVector& base,
                 const Eigen::Vector2d& ends) {
    BilinearVector normals;
    normals.fill(pole.normal);
    SurfacePatch patch;
    patch.position.fill(position(ends));
    addRim(which, base, {1.0, 0.0}, patch);
    addRim(1 - which, normals, {1.0, 1.0}, patch);
    addEllipsoids(normals, patch);
    patches_.push_back(patch);
  }

  /// The ends of the other axis at a meridian across one.
  Eigen::Vector2d endsAcross(const Meridian& meridian, std::size_t which, double end) const {
    Eigen::Vector2d ends = endsAt(meridian.angle);
    ends[static_cast<Eigen::Index>(which)] = end;
    return ends;
  }

  /// Of a cylinder, where the normals are from the meridian's to ±A × B.
  void addSide(const Meridian& meridian, std::size_t which, double side) {
    const Vector top = side * north_;
    // Along the axis after along the normals is outwards.
    const bool rises = (north_.cross(parts_[which].axis)).dot(meridian.normal) > 0.0;
    Vector begin = meridian.normal, end = top;
    if ((side > 0.0) != rises) std::swap(begin, end);
    const BilinearVector normals{begin, end, begin, end};
    BilinearVector tops;
    tops.fill(top);
    SurfacePatch patch;
    const Vector bottom = position(endsAcross(meridian, which, -1.0)),
                 above = position(endsAcross(meridian, which, 1.0));
    patch.position = {bottom, bottom, above, above};
    // Towards a pole a rim stays where it is.
    for (const std::size_t k : {0u, 1u}) {
      addRim(k, meridian.pole[k] ? tops : normals, {1.0, 1.0}, patch);
    }
    addEllipsoids(normals, patch);
    patches_.push_back(patch);
  }

  /// Where a side meets the disc of the other axis: half a strip between the halves of that disc.
  void addStrip(const Meridian& meridian, std::size_t which, double side) {
    const std::size_t other = 1 - which;
    if (!(parts_[other].radius > 0.0)) return;
    BilinearVector normals, tops;
    normals.fill(meridian.normal);
    tops.fill(side * north_);
    const bool along = parts_[which].axis.cross(side * north_).dot(meridian.normal) > 0.0;
    SurfacePatch patch;
    const Vector from = position(endsAcross(meridian, which, along ? -1.0 : 1.0)),
                 to = position(endsAcross(meridian, which, along ? 1.0 : -1.0));
    patch.position = {from, to, from, to};
    addRim(other, tops, {0.0, 1.0}, patch);
    addRim(which, normals, {1.0, 1.0}, patch);
    addEllipsoids(normals, patch);
    patches_.push_back(patch);
  }

  void addParallelogram(double side) {
    BilinearVector normals;
    normals.fill(side * north_);
    SurfacePatch patch;
    const Vector one = position({1.0, -1.0}), other = position({-1.0, 1.0});
    patch.position = {position({-1.0, -1.0}), side > 0.0 ? one : other, side > 0.0 ? other : one,
                      position({1.0, 1.0})};
    for (const std::size_t which : {0u, 1u}) addRim(which, normals, {1.0, 1.0}, patch);
    addEllipsoids(normals, patch);
    patches_.push_back(patch);
  }

  LongVector3 centre_;
  std::array<AxisPart, 2> parts_;
  std::vector<Eigen::Matrix3d> images_, normals_;
  Vector north_, aside_;  ///< unit: along A × B, and across that and A
  double angle_;          ///< from A to B, up to a right one
  std::vector<Meridian> meridians_;
  std::vector<SurfacePatch> patches_;
};

/// What a rim that is not quite across its axis makes of normals along the axis.
double slantOf(const Frustum& frustum, const LongMatrix3& frame) {
  const LongVector3 axis = frame.col(2).normalized();
  return frustum.top *
         static_cast<double>(std::abs(axis.dot(frame.col(0))) + std::abs(axis.dot(frame.col(1))));
}

}  // namespace

double AxesSum::rounding() const {
  const double stretch = static_cast<double>(sum.map.norm());
  const double size =
      second.top + second.half_height * static_cast<double>(second_frame.col(2).norm()) +
      sum.frustum.top + sum.frustum.half_height * static_cast<double>(sum.frame.col(2).norm());
  double ellipsoids = 0.0;
  for (const LongMatrix3& ellipsoid : sum.ellipsoids) {
    ellipsoids += static_cast<double>(ellipsoid.norm());
  }
  const double slant = slantOf(sum.frustum, sum.frame) + slantOf(second, second_frame);
  const LongVector3 a = sum.frame.col(2).normalized(), b = second_frame.col(2).normalized();
  const double tie = std::abs(a.dot(b)) < 2.0L * kAxesTie ? 2.0 * kAxesTie * size : 0.0;
  return sum.rounding() + stretch * (4.0 * slant + tie + 32.0 * kEpsilon * (size + ellipsoids));
}

std::vector<SurfacePatch> axesSurface(const AxesSum& axes) { return AxesSurface(axes).patches(); }

}  // namespace fcl_prob::detail
