// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The slab kernels for any processor, and the choice among those that were built.
#include <cmath>

#include "convex/slab_kernels.inl.h"

namespace fcl_prob::detail {

namespace {

struct Vector4 {
  double lane[4];

  Vector4() = default;
  explicit Vector4(double value) : lane{value, value, value, value} {}

  static Vector4 load(const double* from) {
    Vector4 v;
    for (int i = 0; i < 4; ++i) v.lane[i] = from[i];
    return v;
  }
  void store(double* to) const {
    for (int i = 0; i < 4; ++i) to[i] = lane[i];
  }
  double largest() const {
    const double first = lane[0] > lane[1] ? lane[0] : lane[1];
    const double second = lane[2] > lane[3] ? lane[2] : lane[3];
    return first > second ? first : second;
  }
};

template <typename Operation>
Vector4 lanewise(const Vector4& a, const Vector4& b, Operation operation) {
  Vector4 v;
  for (int i = 0; i < 4; ++i) v.lane[i] = operation(a.lane[i], b.lane[i]);
  return v;
}

Vector4 operator+(const Vector4& a, const Vector4& b) {
  return lanewise(a, b, [](double x, double y) { return x + y; });
}
Vector4 operator-(const Vector4& a, const Vector4& b) {
  return lanewise(a, b, [](double x, double y) { return x - y; });
}
Vector4 operator*(const Vector4& a, const Vector4& b) {
  return lanewise(a, b, [](double x, double y) { return x * y; });
}
Vector4 operator/(const Vector4& a, const Vector4& b) {
  return lanewise(a, b, [](double x, double y) { return x / y; });
}
// The second operand when either is NaN, as the processor's own instructions do.
Vector4 max(const Vector4& a, const Vector4& b) {
  return lanewise(a, b, [](double x, double y) { return x > y ? x : y; });
}
Vector4 min(const Vector4& a, const Vector4& b) {
  return lanewise(a, b, [](double x, double y) { return x < y ? x : y; });
}
Vector4 abs(const Vector4& a) {
  return lanewise(a, a, [](double x, double) { return std::fabs(x); });
}
Vector4 sqrt(const Vector4& a) {
  return lanewise(a, a, [](double x, double) { return std::sqrt(x); });
}
Vector4 select(const Vector4& sign, const Vector4& a, const Vector4& b) {
  Vector4 v;
  for (int i = 0; i < 4; ++i) v.lane[i] = std::signbit(sign.lane[i]) ? b.lane[i] : a.lane[i];
  return v;
}
int greater(const Vector4& a, const Vector4& b) {
  int mask = 0;
  for (int i = 0; i < 4; ++i) mask |= static_cast<int>(a.lane[i] > b.lane[i]) << i;
  return mask;
}

int notLess(const Vector4& a, const Vector4& b) {
  int mask = 0;
  for (int i = 0; i < 4; ++i) mask |= static_cast<int>(a.lane[i] >= b.lane[i]) << i;
  return mask;
}

}  // namespace

#if defined(__x86_64__)
SlabKernels avx2SlabKernels();
#endif

SlabKernels portableSlabKernels() { return SlabKernelsOver<Vector4>::table(); }

const SlabKernels& slabKernels() {
  static const SlabKernels kernels = [] {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return avx2SlabKernels();
#endif
    return portableSlabKernels();
  }();
  return kernels;
}

}  // namespace fcl_prob::detail
