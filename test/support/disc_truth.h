// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mass of a disc by quadrature in more than double precision; shares no code with the library.
#pragma once

#include <algorithm>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <vector>

namespace fcl_prob_test {

/// 34 digits: twenty times faster than 50.
using QuadPrecision = boost::multiprecision::cpp_bin_float_quad;

template <class Number>
Number densityOf(const Number& y) {
  return exp(-y * y / 2) / sqrt(2 * boost::math::constants::pi<Number>());
}

/// Mass of [lo, hi].
template <class Number>
Number intervalOf(Number lo, Number hi) {
  if (lo + hi < 0) {
    std::swap(lo, hi);
    lo = -lo;
    hi = -hi;
  }
  const Number half_root = sqrt(Number(2));
  // Near the origin erfc is 1, whatever the number of digits.
  if (hi < 1) return (boost::math::erf(hi / half_root) - boost::math::erf(lo / half_root)) / 2;
  return (boost::math::erfc(lo / half_root) - boost::math::erfc(hi / half_root)) / 2;
}

/// The chords of a disc across y, at the depth u r from its nearest edge: in pieces as long as
/// deviations are, each by the tanh-sinh rule.
template <class Number>
class DiscTruth {
 public:
  /// \param x, y  of the centre, not negative
  DiscTruth(const Number& x, const Number& y, const Number& r, const Number& sx, const Number& sy)
      : x_(x), y_(y), r_(r), sx_(sx), sy_(sy) {}

  Number mass() const {
    static boost::math::quadrature::tanh_sinh<Number> rule(8);
    const Number peak = leastSquare();
    const double level = squareAt(peak) + 160;
    std::vector<Number> ends{0, 2};
    if (peak > Number(1e-30) && peak < 2) ends.push_back(peak);
    for (const double k : {1.0, 3.0, 6.0, 12.0, 24.0, 48.0}) {
      for (const int side : {-1, 1}) {
        const Number u = peak + side * k * sy_ / r_;
        if (u > 0 && u < 2) ends.push_back(u);
      }
    }
    std::sort(ends.begin(), ends.end());
    Number sum = 0;
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const Number from = ends[i - 1], half = (ends[i] - from) / 2;
      const bool holds_peak = from <= peak && peak <= ends[i];
      if (!holds_peak && squareAt(from) > level && squareAt(ends[i]) > level) continue;
      sum += rule.integrate(
          [&](const Number& t) { return Number(half * chord(from + half * (1 + t))); },
          Number(1e-17));
    }
    return sum;
  }

 private:
  Number halfAt(const Number& u) const { return r_ * sqrt(abs(u * (2 - u))); }

  Number chord(const Number& u) const {
    const Number y = (y_ - r_ + r_ * u) / sy_, half = halfAt(u);
    return densityOf<Number>(y) * r_ / sy_ *
           intervalOf<Number>((x_ - half) / sx_, (x_ + half) / sx_);
  }

  double squareAt(const Number& u) const {
    const Number y = (y_ - r_ + r_ * u) / sy_;
    Number x = (x_ - halfAt(u)) / sx_;
    if (x < 0) x = 0;
    return static_cast<double>(Number(x * x + y * y));
  }

  Number leastSquare() const {
    Number from = 0, to = 2;
    for (int k = 0; k < 160; ++k) {
      const Number a = from + (to - from) * 0.382, b = from + (to - from) * 0.618;
      (squareAt(a) < squareAt(b) ? to : from) = squareAt(a) < squareAt(b) ? b : a;
    }
    return (from + to) / 2;
  }

  Number x_, y_, r_, sx_, sy_;
};

}  // namespace fcl_prob_test
