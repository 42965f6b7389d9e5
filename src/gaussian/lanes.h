// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Four numbers at once, in loops that compilers turn into wide instructions.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace fcl_prob::detail {

struct Lanes {
  static constexpr std::size_t kCount = 4;

  Lanes() = default;
  Lanes(double all) { values.fill(all); }  // NOLINT(google-explicit-constructor)

  double& operator[](std::size_t k) { return values[k]; }
  double operator[](std::size_t k) const { return values[k]; }

  std::array<double, kCount> values{};
};

inline Lanes operator+(const Lanes& a, const Lanes& b) {
  Lanes sum;
  for (std::size_t k = 0; k < Lanes::kCount; ++k) sum[k] = a[k] + b[k];
  return sum;
}

inline Lanes operator-(const Lanes& a, const Lanes& b) {
  Lanes difference;
  for (std::size_t k = 0; k < Lanes::kCount; ++k) difference[k] = a[k] - b[k];
  return difference;
}

inline Lanes operator*(const Lanes& a, const Lanes& b) {
  Lanes product;
  for (std::size_t k = 0; k < Lanes::kCount; ++k) product[k] = a[k] * b[k];
  return product;
}

inline Lanes squareRoot(const Lanes& x) {
  Lanes root;
  for (std::size_t k = 0; k < Lanes::kCount; ++k) root[k] = std::sqrt(x[k]);
  return root;
}

inline Lanes inverseSquareRoot(const Lanes& x) {
  Lanes inverse;
  for (std::size_t k = 0; k < Lanes::kCount; ++k) inverse[k] = 1.0 / std::sqrt(x[k]);
  return inverse;
}

}  // namespace fcl_prob::detail
