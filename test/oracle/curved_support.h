// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Support points and values of curved shapes over any kind of number.
#pragma once

#include <cmath>

#include "convex_set.h"

namespace oracle {

template <typename Scalar>
class CurvedSupport {
 public:
  explicit CurvedSupport(const CurvedShape& shape)
      : kind_(shape.kind), half_length_(shape.half_length) {
    for (int i = 0; i < 3; ++i) {
      radii_[static_cast<std::size_t>(i)] = Scalar(shape.radii[i]);
      for (int j = 0; j < 3; ++j) {
        linear_[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
            Scalar(shape.linear(i, j));
      }
    }
  }

  /// A point of the shape, to within rounding, that is farthest along `direction`.
  Vector<Scalar> point(const Vector<Scalar>& direction) const {
    const Vector<Scalar> g = local(direction);
    const Scalar end = g[2] < 0 ? Scalar(-half_length_) : half_length_;
    switch (kind_) {
      case CurvedShape::Kind::ellipsoid:
        return placed(onEllipsoid(g));
      case CurvedShape::Kind::capsule: {
        Vector<Scalar> point = onEllipsoid(g);
        point[2] += end;
        return placed(point);
      }
      case CurvedShape::Kind::cylinder:
        return placed(onDisk(g, end));
      case CurvedShape::Kind::cone:
        break;
    }
    const bool apex = half_length_ * g[2] > radii_[0] * across(g) - half_length_ * g[2];
    return placed(apex ? Vector<Scalar>{Scalar(0), Scalar(0), half_length_}
                       : onDisk(g, -half_length_));
  }

  /// The largest product of `direction` and a point of the shape.
  Scalar value(const Vector<Scalar>& direction) const {
    const Vector<Scalar> g = local(direction);
    const Scalar along = half_length_ * g[2];
    const Scalar length = along < 0 ? Scalar(-along) : along;
    switch (kind_) {
      case CurvedShape::Kind::ellipsoid:
        return norm(stretched(g));
      case CurvedShape::Kind::capsule:
        return length + norm(stretched(g));
      case CurvedShape::Kind::cylinder:
        return length + radii_[0] * across(g);
      case CurvedShape::Kind::cone:
        break;
    }
    const Scalar rim = radii_[0] * across(g) - along;
    return along > rim ? along : rim;
  }

 private:
  static Scalar root(const Scalar& square) {
    using std::sqrt;
    return sqrt(square);
  }
  static Scalar norm(const Vector<Scalar>& v) { return root(dot(v, v)); }
  static Scalar across(const Vector<Scalar>& v) { return root(v[0] * v[0] + v[1] * v[1]); }

  Vector<Scalar> stretched(const Vector<Scalar>& g) const {
    return {Scalar(radii_[0] * g[0]), Scalar(radii_[1] * g[1]), Scalar(radii_[2] * g[2])};
  }

  Vector<Scalar> onEllipsoid(const Vector<Scalar>& g) const {
    const Vector<Scalar> towards = stretched(g);
    const Scalar length = norm(towards);
    if (!(length > 0)) return {Scalar(0), Scalar(0), Scalar(0)};
    return stretched(scaled(Scalar(1 / length), towards));
  }

  Vector<Scalar> onDisk(const Vector<Scalar>& g, const Scalar& z) const {
    const Scalar length = across(g);
    if (!(length > 0)) return {Scalar(0), Scalar(0), z};
    return {Scalar(radii_[0] * (g[0] / length)), Scalar(radii_[0] * (g[1] / length)), z};
  }

  Vector<Scalar> local(const Vector<Scalar>& direction) const {
    Vector<Scalar> g{Scalar(0), Scalar(0), Scalar(0)};
    for (std::size_t i = 0; i < 3; ++i) g = g + scaled(direction[i], linear_[i]);
    return g;
  }

  Vector<Scalar> placed(const Vector<Scalar>& point) const {
    return {dot(linear_[0], point), dot(linear_[1], point), dot(linear_[2], point)};
  }

  CurvedShape::Kind kind_;
  Scalar half_length_;
  Vector<Scalar> radii_;
  std::array<Vector<Scalar>, 3> linear_;  // rows
};

}  // namespace oracle
