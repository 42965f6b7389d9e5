// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The numbers of the oracle: exact rationals, wide floats, and the doubles' longer brother.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

namespace oracle {

/// Every double is one of these exactly, and so is what is added, multiplied and divided of them.
using Rational = boost::multiprecision::cpp_rational;

/// 237 bits: what is rounded to it is off by 2^-237 of itself.
using Wide = boost::multiprecision::cpp_bin_float_oct;

using Long = long double;
using LongVector = Eigen::Matrix<Long, 3, 1>;
using LongMatrix = Eigen::Matrix<Long, 3, 3>;

template <typename Scalar>
using Vector = std::array<Scalar, 3>;
using ExactVector = Vector<Rational>;
using WideVector = Vector<Wide>;

static_assert(std::numeric_limits<Long>::digits >= 64, "the filters count on extended precision");

template <typename Scalar>
Vector<Scalar> operator+(const Vector<Scalar>& u, const Vector<Scalar>& v) {
  return {Scalar(u[0] + v[0]), Scalar(u[1] + v[1]), Scalar(u[2] + v[2])};
}

template <typename Scalar>
Vector<Scalar> operator-(const Vector<Scalar>& u, const Vector<Scalar>& v) {
  return {Scalar(u[0] - v[0]), Scalar(u[1] - v[1]), Scalar(u[2] - v[2])};
}

template <typename Scalar>
Vector<Scalar> scaled(const Scalar& factor, const Vector<Scalar>& v) {
  return {Scalar(factor * v[0]), Scalar(factor * v[1]), Scalar(factor * v[2])};
}

template <typename Scalar>
Scalar dot(const Vector<Scalar>& u, const Vector<Scalar>& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

template <typename Scalar>
Vector<Scalar> cross(const Vector<Scalar>& u, const Vector<Scalar>& v) {
  return {Scalar(u[1] * v[2] - u[2] * v[1]), Scalar(u[2] * v[0] - u[0] * v[2]),
          Scalar(u[0] * v[1] - u[1] * v[0])};
}

template <typename Scalar>
Scalar determinant(const Vector<Scalar>& u, const Vector<Scalar>& v, const Vector<Scalar>& w) {
  return dot(u, cross(v, w));
}

/// Exact for Rational, and for Wide.
template <typename Scalar>
Vector<Scalar> converted(const Eigen::Vector3d& v) {
  return {Scalar(v[0]), Scalar(v[1]), Scalar(v[2])};
}

template <typename Scalar>
Vector<Scalar> product(const Eigen::Matrix3d& matrix, const Vector<Scalar>& v) {
  Vector<Scalar> result;
  for (int i = 0; i < 3; ++i) {
    result[static_cast<std::size_t>(i)] =
        Scalar(matrix(i, 0)) * v[0] + Scalar(matrix(i, 1)) * v[1] + Scalar(matrix(i, 2)) * v[2];
  }
  return result;
}

inline LongVector toLong(const WideVector& v) {
  return {v[0].convert_to<Long>(), v[1].convert_to<Long>(), v[2].convert_to<Long>()};
}

inline WideVector toWide(const ExactVector& v) { return {Wide(v[0]), Wide(v[1]), Wide(v[2])}; }

}  // namespace oracle
