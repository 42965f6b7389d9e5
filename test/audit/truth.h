// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Probabilities of scenes from first principles: exact along a line, sampled lines otherwise.
// Shares nothing with the library but its data (GaussianDisplacement's reported numbers).
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <optional>

#include "scene.h"

namespace fcl_prob_audit {

/// 60 digits, any exponent.
using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>,
                                            boost::multiprecision::et_off>;

/// A displacement in numbers that the library reports for it: mean + axes · diag(σ) · N(0, I).
struct Normal {
  Vector3d mean, sigma;
  Matrix3d axes;
  int rank;
};

/// One question of a pair of groups that share a displacement: one, or a mixture.
struct TruthQuestion {
  const std::vector<Member>& a;
  const std::vector<Member>& b;
  std::vector<Normal> normals;
  std::vector<double> weights;
  bool solid = false;
  std::optional<double> truncation;
};

TruthQuestion truthQuestion(const Scene& scene);

/// The probability to 40 digits or so. Known for a displacement along a line (rank 1), boxes along
/// the axes of the displacement, and a half-space or plane with anything; nothing for others, or
/// where shapes are curved. \param shift  added to the mean
std::optional<Exact> exactProbability(const TruthQuestion& question,
                                      const std::array<Exact, 3>& shift = {0, 0, 0});

/// The gradient of P with respect to the mean, by differences.
struct ExactGradient {
  Vector3d value;
  /// By how much each slope may be off because P is kept to 60 digits: near P = 1 more than the
  /// slope itself.
  double rounding = 0.0;
};
/// By steps of 1e-18 deviations; nothing where P has a kink.
std::optional<ExactGradient> exactGradient(const TruthQuestion& question);

/// Means of contact along random lines, each within [0, 1] with the mean P.
struct SampledTruth {
  int lines = 0;
  double mean = 0.0;

  /// Whether this mean is so far from every P in the bounds that chance makes it so with a
  /// probability below 1e-12 (Hoeffding's bound by relative entropy, which holds for any
  /// distribution within [0, 1]).
  bool excludes(double lower, double upper) const;
};
/// Nothing for shapes with curved sides (balls against balls apart).
std::optional<SampledTruth> sampledProbability(const TruthQuestion& question, int lines,
                                               std::uint64_t seed);

}  // namespace fcl_prob_audit
