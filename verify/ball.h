// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A real number known up to a radius: Arb's balls with operators.
#pragma once

#include <arb.h>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <utility>

namespace verify {

constexpr double kUnit = DBL_EPSILON / 2;  // a rounded operation's relative error

/// Comparisons hold for every number of the balls, so that `not (a < b)` says nothing.
class Ball {
 public:
  /// Working precision of this thread. With ARF_PREC_EXACT, the default, sums and products are
  /// exact; quotients and roots have kMostBits at most.
  static constexpr slong kMostBits = 2400;
  static thread_local slong bits;

  Ball() { arb_init(x_); }
  Ball(double value) : Ball() { arb_set_d(x_, value); }  // NOLINT: numbers are balls
  explicit Ball(const mpz_class& value) : Ball() { arf_set_mpz(arb_midref(x_), value.get_mpz_t()); }
  Ball(const Ball& other) : Ball() { arb_set(x_, other.x_); }
  Ball(Ball&& other) noexcept : Ball() { arb_swap(x_, other.x_); }
  Ball& operator=(Ball other) noexcept {
    arb_swap(x_, other.x_);
    return *this;
  }
  ~Ball() { arb_clear(x_); }

  friend Ball operator+(const Ball& a, const Ball& b) { return apply(arb_add, a, b); }
  friend Ball operator-(const Ball& a, const Ball& b) { return apply(arb_sub, a, b); }
  friend Ball operator*(const Ball& a, const Ball& b) { return apply(arb_mul, a, b); }
  friend Ball operator/(const Ball& a, const Ball& b) {
    Ball result;
    arb_div(result.x_, a.x_, b.x_, std::min(bits, +kMostBits));
    return result;
  }
  friend Ball max(const Ball& a, const Ball& b) { return apply(arb_max, a, b); }
  friend Ball min(const Ball& a, const Ball& b) { return apply(arb_min, a, b); }
  friend Ball abs(const Ball& a) {
    Ball result;
    arb_abs(result.x_, a.x_);
    return result;
  }
  friend Ball sqrt(const Ball& a) {
    Ball result;
    arb_sqrt(result.x_, a.x_, std::min(bits, +kMostBits));
    return result;
  }
  Ball operator-() const { return Ball(0) - *this; }
  friend bool operator<(const Ball& a, const Ball& b) { return arb_lt(a.x_, b.x_) != 0; }
  friend bool operator<=(const Ball& a, const Ball& b) { return arb_le(a.x_, b.x_) != 0; }

  /// 1 or -1 if all of the ball has this sign, else 0; `is_zero` is certain.
  int sign() const { return arb_is_positive(x_) ? 1 : arb_is_negative(x_) ? -1 : 0; }
  bool is_zero() const { return arb_is_zero(x_) != 0; }
  bool is_finite() const { return arb_is_finite(x_) != 0; }
  double nearest() const { return arf_get_d(arb_midref(x_), ARF_RND_NEAR); }
  /// The double at or below (`-1`) or at or above (`1`) all of the ball.
  double outward(int direction) const {
    arf_t end;
    arf_init(end);
    (direction < 0 ? arb_get_lbound_arf : arb_get_ubound_arf)(end, x_, 200);
    const double result = arf_get_d(end, direction < 0 ? ARF_RND_FLOOR : ARF_RND_CEIL);
    arf_clear(end);
    return result;
  }
  double radius() const { return mag_get_d(arb_radref(x_)) * (1 + 1e-15); }
  arb_ptr raw() { return x_; }
  arb_srcptr raw() const { return x_; }

 private:
  template <class Operation>
  static Ball apply(Operation operation, const Ball& a, const Ball& b) {
    Ball result;
    operation(result.x_, a.x_, b.x_, bits);
    return result;
  }
  arb_t x_;
};

/// Sets the precision of this thread for a while.
class Precision {
 public:
  explicit Precision(slong bits) : before_(Ball::bits) { Ball::bits = bits; }
  ~Precision() { Ball::bits = before_; }
  Precision(const Precision&) = delete;
  Precision& operator=(const Precision&) = delete;

 private:
  slong before_;
};

using Vec = std::array<double, 3>;
using BallVec = std::array<Ball, 3>;

template <class V>
V cross(const V& a, const V& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class V>
auto dot(const V& a, const V& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class V>
V minus(const V& a, const V& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class V>
V plus(const V& a, const V& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class V>
V opposite(const V& v) {
  return {-v[0], -v[1], -v[2]};
}
inline double length(const Vec& v) { return std::hypot(v[0], v[1], v[2]); }
inline BallVec balls(const Vec& v) { return {Ball(v[0]), Ball(v[1]), Ball(v[2])}; }

}  // namespace verify
