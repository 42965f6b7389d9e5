// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "exact/axes_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

using Vector = Eigen::Vector3d;

/// Which end of either axis.
using Ends = std::array<bool, 2>;

/// A frustum with an axis of its own.
struct AxisPart {
  NormalCircle circle;
  Vector lift;                   ///< along the axis, so that w + |w| lift is on the circle
  Eigen::Matrix3d rim;           ///< of normals, to where the rim is
  Eigen::Matrix3d image;         ///< mapped
  LongVector3 half;              ///< from the middle to the top, mapped
  std::array<double, 2> radius;  ///< at the bottom and at the top

  double radiusAt(bool top) const { return radius[top ? 1 : 0]; }
};

AxisPart partOf(const Frustum& frustum, const LongMatrix3& frame, const LongMatrix3& map) {
  AxisPart part;
  const double rise = 2.0 * frustum.half_height, narrowing = frustum.bottom - frustum.top;
  const double slant = std::hypot(rise, narrowing);
  part.circle = {frame.col(2).cast<double>().normalized(), rise / slant, narrowing / slant};
  part.lift = narrowing / rise * part.circle.axis;
  LongMatrix3 across = frame;
  across.col(2).setZero();
  part.rim = across.transpose().cast<double>();
  part.image = (map * across).cast<double>();
  part.half = map * frame.col(2) * static_cast<long double>(frustum.half_height);
  part.radius = {frustum.bottom, frustum.top};
  return part;
}

/// Normals from those at t = 0, along an arc of a circle or a great one, to what is at t = 1.
struct NormalFan {
  Vector from, to;
  std::array<Vector, 2> end;
  int circle = -1;
};

class AxesSurface {
 public:
  explicit AxesSurface(const AxesSum& axes) : centre_(axes.sum.centre()) {
    LongMatrix3 frame = axes.second_frame;
    Frustum second = axes.second;
    if (axes.sum.frame.col(2).dot(frame.col(2)) < 0.0L) {
      frame.col(2) *= -1.0L;
      std::swap(second.bottom, second.top);
    }
    parts_ = {partOf(axes.sum.frustum, axes.sum.frame, axes.sum.map),
              partOf(second, frame, axes.sum.map)};
    for (const LongMatrix3& ellipsoid : axes.sum.ellipsoids) {
      images_.push_back((axes.sum.map * ellipsoid).cast<double>());
      normals_.push_back(ellipsoid.transpose().cast<double>());
    }
  }

  std::optional<std::vector<SurfacePatch>> patches() {
    auto overlay = normalOverlay({parts_[0].circle, parts_[1].circle});
    if (!overlay) return std::nullopt;
    overlay_ = std::move(*overlay);
    for (const std::size_t half : {0u, 1u}) {
      for (const NormalTriangle& triangle : overlay_.triangles) addTriangle(triangle, half);
      for (const NormalArc& arc : overlay_.arcs) addArc(arc, half);
      if (overlay_.crossing) addParallelogram(half);
    }
    return std::move(patches_);
  }

 private:
  const AxisPart& part(int k) const { return parts_[static_cast<std::size_t>(k)]; }

  Vector position(const Ends& tops) const {
    return (centre_ + (tops[0] ? 1.0L : -1.0L) * parts_[0].half +
            (tops[1] ? 1.0L : -1.0L) * parts_[1].half)
        .cast<double>();
  }

  /// Of a circle that is not a great one.
  bool isLifted(int circle) const { return circle >= 0 && part(circle).circle.lift != 0.0; }

  void setBase(const NormalFan& fan, SurfacePatch& patch) const {
    patch.lifted = isLifted(fan.circle);
    if (!patch.lifted) return;
    const Vector& axis = part(fan.circle).circle.axis;
    patch.base = {fan.from - fan.from.dot(axis) * axis, fan.to - fan.to.dot(axis) * axis};
  }

  /// Of a fan's normals; if `held`, of those at t = 0 for all t.
  CurvedTerm termOf(const Eigen::Matrix3d& image, const Eigen::Matrix3d& map, const NormalFan& fan,
                    bool held) const {
    const Vector from = map * fan.from, to = map * fan.to;
    CurvedTerm term{image, {from, to, from, to}};
    if (!held) term.direction = {from, to, map * fan.end[0], map * fan.end[1]};
    if (isLifted(fan.circle)) {
      term.lift[0] = map * part(fan.circle).lift;
      if (held) term.lift[1] = term.lift[0];
    }
    return term;
  }

  CurvedTerm termAt(const Eigen::Matrix3d& image, const Eigen::Matrix3d& map,
                    const Vector& normal) const {
    return termOf(image, map, {normal, normal, {normal, normal}}, true);
  }

  /// \param radius  at t = 0 and 1
  void addRim(int k, CurvedTerm term, const std::array<double, 2>& radius, int circle,
              SurfacePatch& patch) const {
    if (!(radius[0] > 0.0 || radius[1] > 0.0)) return;
    term.size = radius;
    // Across its own axis a circle is even, to the last bit.
    if (circle == k) term.lift.fill(Vector::Zero());
    patch.add(term);
  }

  void addRimAt(int k, const Vector& normal, const std::array<double, 2>& radius,
                SurfacePatch& patch) const {
    addRim(k, termAt(part(k).image, part(k).rim, normal), radius, -1, patch);
  }

  void addEllipsoids(const NormalFan& fan, bool held, SurfacePatch& patch) const {
    for (std::size_t k = 0; k < images_.size(); ++k) {
      patch.add(termOf(images_[k], normals_[k], fan, held));
    }
  }
  void addEllipsoidsAt(const Vector& normal, SurfacePatch& patch) const {
    addEllipsoids({normal, normal, {normal, normal}}, true, patch);
  }

  /// Shortens one of two normals, by a power of two, until a rim turns about evenly between them.
  void balance(int k, Vector& first, Vector& second) const {
    const double a = (part(k).rim * first).norm(), b = (part(k).rim * second).norm();
    if (!(a > 0.0 && b > 0.0)) return;
    const int excess = std::ilogb(a / b * M_SQRT2);
    (excess > 0 ? first : second) *= std::ldexp(1.0, -std::abs(excess));
  }

  void addTriangle(const NormalTriangle& triangle, std::size_t half) {
    const Vector& apex = overlay_.normal(triangle.apex, half);
    const int pole = overlay_.poleAt(triangle.apex);
    NormalFan fan{overlay_.normal(triangle.from, half),
                  overlay_.normal(triangle.to, half),
                  {apex, apex},
                  triangle.circle};
    if (half == 1) std::swap(fan.from, fan.to);
    if (pole >= 0 && fan.circle < 0) balance(pole, fan.from, fan.to);
    const std::array<double, 2> radius{parts_[0].radiusAt(triangle.above[0]),
                                       parts_[1].radiusAt(triangle.above[1])};
    SurfacePatch patch;
    patch.position.fill(position(triangle.above));
    setBase(fan, patch);
    SurfacePatch sector = patch;
    if (!images_.empty() || (radius[0] > 0.0 && radius[1] > 0.0)) {
      for (const int k : {0, 1}) {
        const double r = radius[static_cast<std::size_t>(k)];
        addRim(k, termOf(part(k).image, part(k).rim, fan, pole == k), {r, r}, fan.circle, patch);
      }
      addEllipsoids(fan, false, patch);
      patches_.push_back(patch);
    }
    if (pole < 0 || !(radius[static_cast<std::size_t>(pole)] > 0.0)) return;
    // Of the disc, from its rim to its middle.
    const double other = radius[static_cast<std::size_t>(1 - pole)];
    addRim(pole, termOf(part(pole).image, part(pole).rim, fan, true),
           {radius[static_cast<std::size_t>(pole)], 0.0}, fan.circle, sector);
    addRimAt(1 - pole, apex, {other, other}, sector);
    addEllipsoidsAt(apex, sector);
    patches_.push_back(sector);
  }

  /// Of a side, from the bottom to the top.
  void addArc(const NormalArc& arc, std::size_t half) {
    const int k = arc.circle, other = 1 - k;
    int from = arc.from, to = arc.to;
    if (half == 1) std::swap(from, to);
    const NormalFan fan{overlay_.normal(from, half), overlay_.normal(to, half), {}, k};
    SurfacePatch patch;
    const Ends bottoms = endsOf(arc, false), tops = endsOf(arc, true);
    const Vector bottom = position(bottoms), top = position(tops);
    patch.position = {bottom, bottom, top, top};
    setBase(fan, patch);
    addRim(k, termOf(part(k).image, part(k).rim, fan, true), part(k).radius, k, patch);
    const double radius = part(other).radiusAt(arc.above_other);
    const bool from_pole = overlay_.poleAt(from) == other, to_pole = overlay_.poleAt(to) == other;
    if (from_pole || to_pole) {
      // Towards a pole its rim stays where it is.
      addRimAt(other, from_pole ? fan.to : fan.from, {radius, radius}, patch);
    } else {
      addRim(other, termOf(part(other).image, part(other).rim, fan, true), {radius, radius}, k,
             patch);
    }
    addEllipsoids(fan, true, patch);
    patches_.push_back(patch);
    if (from_pole || to_pole) {
      addStrip(arc, from_pole ? fan.from : fan.to, from_pole ? fan.to : fan.from);
    }
  }

  static Ends endsOf(const NormalArc& arc, bool top) {
    Ends ends;
    ends[static_cast<std::size_t>(arc.circle)] = top;
    ends[static_cast<std::size_t>(1 - arc.circle)] = arc.above_other;
    return ends;
  }

  /// Where a side meets the disc of the other axis: half a strip between the halves of that disc.
  void addStrip(const NormalArc& arc, const Vector& pole, const Vector& aside) {
    const int k = arc.circle, other = 1 - k;
    const double radius = part(other).radiusAt(arc.above_other);
    if (!(radius > 0.0)) return;
    const bool along = part(k).circle.axis.cross(aside).dot(pole) > 0.0;
    SurfacePatch patch;
    const Vector from = position(endsOf(arc, !along)), to = position(endsOf(arc, along));
    patch.position = {from, to, from, to};
    addRimAt(other, aside, {0.0, radius}, patch);
    addRimAt(k, pole, {part(k).radius[0], part(k).radius[0]}, patch);
    addEllipsoidsAt(pole, patch);
    patches_.push_back(patch);
  }

  /// Along s one side and along t the other one, whose normals follow anticlockwise.
  void addParallelogram(std::size_t half) {
    const Vector& normal = overlay_.normal(*overlay_.crossing, half);
    const int first = half == 0 ? 0 : 1, second = 1 - first;
    SurfacePatch patch;
    const auto corner = [&](bool top_first, bool top_second) {
      return half == 0 ? position({top_first, top_second}) : position({top_second, top_first});
    };
    patch.position = {corner(false, false), corner(true, false), corner(false, true),
                      corner(true, true)};
    addRimAt(second, normal, part(second).radius, patch);
    if (part(first).radius[0] > 0.0 || part(first).radius[1] > 0.0) {
      CurvedTerm rim = termAt(part(first).image, part(first).rim, normal);
      rim.taper = part(first).radius;
      patch.add(rim);
    }
    addEllipsoidsAt(normal, patch);
    patches_.push_back(patch);
  }

  LongVector3 centre_;
  std::array<AxisPart, 2> parts_;
  std::vector<Eigen::Matrix3d> images_, normals_;
  NormalOverlay overlay_;
  std::vector<SurfacePatch> patches_;
};

/// How far a frame is from a rotation: by as much a side's normals are off the circle, and what a
/// rim that is not across its axis makes of normals along the axis.
double skewOf(const LongMatrix3& frame) {
  const LongMatrix3 skew = frame.transpose() * frame - LongMatrix3::Identity();
  return static_cast<double>(skew.cwiseAbs().maxCoeff());
}

}  // namespace

double AxesSum::rounding() const {
  const double size = 1.001 * (sum.frustum.size() + second.size());
  double ellipsoids = 0.0;
  for (const LongMatrix3& ellipsoid : sum.ellipsoids) {
    ellipsoids += static_cast<double>(ellipsoid.norm());
  }
  const double skew = 8.0 * (skewOf(sum.frame) + skewOf(second_frame)) * size;
  const LongVector3 a = sum.frame.col(2).normalized(), b = second_frame.col(2).normalized();
  const double tie = std::abs(a.dot(b)) < 2.0L * kAxesTie ? 2.0 * kAxesTie * size : 0.0;
  return sum.rounding() + skew + tie + 32.0 * kEpsilon * (size + ellipsoids);
}

std::optional<std::vector<SurfacePatch>> axesSurface(const AxesSum& axes) {
  if (!(axes.sum.frustum.half_height > 0.0 && axes.second.half_height > 0.0)) return std::nullopt;
  return AxesSurface(axes).patches();
}

}  // namespace fcl_prob::detail
