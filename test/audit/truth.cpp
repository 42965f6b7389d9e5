// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "truth.h"

#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <random>

#include "placed_set.h"
#include "unbounded_truth.h"

namespace fcl_prob_audit {
namespace {

/// Beyond these many deviations there is less than 1e-21,000,000.
const Exact kReach = 10'000;
const Exact kLeastSine("1e-45");

bool allAre(const std::vector<Member>& members, Kind kind) {
  for (const Member& member : members) {
    if (member.shape.kind != kind) return false;
  }
  return true;
}

bool anyUnbounded(const std::vector<Member>& members) {
  for (const Member& member : members) {
    if (member.shape.isUnbounded()) return true;
  }
  return false;
}

bool allFree(const std::vector<Member>& members) {
  for (const Member& member : members) {
    if (member.shape.isOccupied()) return false;
  }
  return true;
}

Exact massOf(std::vector<Span<Exact>> spans, const std::optional<double>& truncation) {
  Exact mass = 0, all = 1;
  if (truncation && std::isfinite(*truncation)) {
    const Exact r(*truncation);
    all = normalMass({-r, r});
    for (Span<Exact>& span : spans) {
      span = {std::max(span.lo, Exact(-r)), std::min(span.hi, r)};
    }
  }
  for (const Span<Exact>& span : spans) {
    if (span.lo < span.hi) mass += normalMass(span);
  }
  return mass / all;
}

std::optional<Exact> alongLine(const TruthQuestion& question, const Normal& normal,
                               const std::array<Exact, 3>& shift) {
  const auto a = placedSet<Exact>(question.a, question.solid);
  const auto b = placedSet<Exact>(question.b, question.solid);
  if (!a || !b) return std::nullopt;
  Line<Exact> line;
  line.start = toVec<Exact>(normal.mean) + Vec<Exact>{shift[0], shift[1], shift[2]};
  line.direction = toVec<Exact>(normal.axes.col(0)) * Exact(normal.sigma[0]);
  if (normal.rank == 0) line.direction = {0, 0, 0};
  line.reach = kReach;
  const auto spans = contactAlong(*a, *b, line, kLeastSine);
  if (!spans) return std::nullopt;
  return massOf(*spans, question.truncation);
}

/// The world axis along which a column points, if it points along one exactly.
std::optional<int> axisOf(const Vector3d& column) {
  for (int k = 0; k < 3; ++k) {
    if (std::abs(column[k]) == 1.0 && column[(k + 1) % 3] == 0.0 && column[(k + 2) % 3] == 0.0) {
      return k;
    }
  }
  return std::nullopt;
}

/// Half the sides in the world, if those are along its axes.
std::optional<std::array<Exact, 3>> alignedHalfSides(const Member& box) {
  std::array<Exact, 3> half;
  for (int k = 0; k < 3; ++k) {
    const auto axis = axisOf(box.pose.linear().col(k));
    if (!axis) return std::nullopt;
    half[static_cast<std::size_t>(*axis)] = Exact(box.shape.sizes[k]) / 2;
  }
  return half;
}

std::optional<Exact> alignedBoxes(const TruthQuestion& question, const Normal& normal,
                                  const std::array<Exact, 3>& shift) {
  if (question.a.size() != 1 || question.b.size() != 1 || question.truncation) return std::nullopt;
  if (!allAre(question.a, Kind::box) || !allAre(question.b, Kind::box)) return std::nullopt;
  const auto a = alignedHalfSides(question.a[0]), b = alignedHalfSides(question.b[0]);
  if (!a || !b) return std::nullopt;
  Exact mass = 1;
  for (int k = 0; k < 3; ++k) {
    const auto axis = axisOf(normal.axes.col(k));
    if (!axis) return std::nullopt;
    const auto i = static_cast<std::size_t>(*axis);
    const Exact apart = Exact(question.b[0].pose.translation()[*axis]) -
                        Exact(question.a[0].pose.translation()[*axis]) - Exact(normal.mean[*axis]) -
                        shift[i];
    const Exact reach = (*a)[i] + (*b)[i];
    mass *= massOfSpan({apart - reach, apart + reach}, 0, Exact(normal.sigma[k]));
  }
  return mass;
}

}  // namespace

TruthQuestion truthQuestion(const Scene& scene) {
  TruthQuestion question{scene.a, scene.b, {}, {1.0}, false, scene.truncation};
  question.solid = scene.request.contact == fcl_prob::ContactMeaning::solid;
  if (scene.isMixture()) question.weights = scene.weights;
  for (std::size_t i = 0; i < question.weights.size(); ++i) {
    const fcl_prob::GaussianDisplacement d = makeDisplacement(scene.displacements.at(i));
    question.normals.push_back({d.mean(), d.standardDeviations(), d.axes(), d.rank()});
  }
  return question;
}

namespace {

std::optional<Exact> exactComponent(const TruthQuestion& question, const Normal& normal,
                                    const std::array<Exact, 3>& shift) {
  if (allFree(question.a) || allFree(question.b)) return Exact(0);
  if (anyUnbounded(question.a) || anyUnbounded(question.b)) {
    if (question.truncation) return std::nullopt;
    return unboundedProbability(question, normal, shift);
  }
  if (normal.rank <= 1) return alongLine(question, normal, shift);
  return alignedBoxes(question, normal, shift);
}

}  // namespace

std::optional<Exact> exactProbability(const TruthQuestion& question,
                                      const std::array<Exact, 3>& shift) {
  Exact sum = 0, weights = 0;
  for (std::size_t i = 0; i < question.normals.size(); ++i) {
    const Exact weight(question.weights[i]);
    weights += weight;
    if (weight == 0) continue;
    const auto of_component = exactComponent(question, question.normals[i], shift);
    if (!of_component) return std::nullopt;
    sum += weight * *of_component;
  }
  return sum / weights;
}

std::optional<ExactGradient> exactGradient(const TruthQuestion& question) {
  const auto middle = exactProbability(question);
  const double sigma = question.normals[0].sigma[0];
  if (!middle || !(sigma > 0.0)) return std::nullopt;
  const Exact step = Exact(sigma) * Exact("1e-18");
  // A hundred roundings of P, for those of the products that P is.
  ExactGradient gradient{Vector3d::Zero(),
                         static_cast<double>(Exact(*middle * Exact("1e-58") / step))};
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<Exact, 3> shift = {0, 0, 0};
    shift[k] = step;
    const Exact ahead = (*exactProbability(question, shift) - *middle) / step;
    shift[k] = -step;
    const Exact behind = (*middle - *exactProbability(question, shift)) / step;
    const Exact size = Exact(abs(ahead)) + Exact(abs(behind));
    if (abs(Exact(ahead - behind)) > size * Exact("1e-9") + gradient.rounding) return std::nullopt;
    gradient.value[static_cast<int>(k)] = static_cast<double>(Exact((ahead + behind) / 2));
  }
  return gradient;
}

bool SampledTruth::excludes(double lower, double upper) const {
  const auto term = [](double x, double y) { return x > 0.0 ? x * std::log(x / y) : 0.0; };
  const auto chance = [&](double p) {
    return -lines * (term(mean, p) + term(1.0 - mean, 1.0 - p));
  };
  constexpr double kLogLeastChance = -27.6;
  if (mean > upper * (1 + 1e-9) + 1e-12) return chance(upper) < kLogLeastChance;
  if (mean < lower * (1 - 1e-9) - 1e-12) return chance(lower) < kLogLeastChance;
  return false;
}

namespace {

// Exponents for the smallest scenes and a little more than their digits.
using Sampled = long double;

/// A standard normal point, within the truncation.
Vector3d whitenedPoint(int rank, double most, std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (;;) {
    Vector3d y = Vector3d::Zero();
    if (most > 1.0) {
      for (int k = 0; k < rank; ++k) y[k] = normal(engine);
      if (y.norm() <= most) return y;
    } else {
      for (int k = 0; k < rank; ++k) y[k] = most * (2.0 * uniform(engine) - 1.0);
      if (y.norm() <= most && uniform(engine) < std::exp(-0.5 * y.squaredNorm())) return y;
    }
  }
}

/// Of the normal distribution along the line, within the chord.
double shareOf(const std::vector<Span<Sampled>>& spans, double chord) {
  const auto mass = [](double lo, double hi) {
    const bool mirrored = lo + hi < 0;
    const double from = mirrored ? -hi : lo, to = mirrored ? -lo : hi;
    return 0.5 * (std::erfc(from / std::sqrt(2.0)) - std::erfc(to / std::sqrt(2.0)));
  };
  double sum = 0.0;
  for (const Span<Sampled>& span : spans) {
    const double lo = std::max(static_cast<double>(span.lo), -chord);
    const double hi = std::min(static_cast<double>(span.hi), chord);
    if (lo < hi) sum += mass(lo, hi);
  }
  return std::min(1.0, sum / mass(-chord, chord));
}

}  // namespace

namespace {

/// A random line through the displacement's ellipsoid along one of its axes.
Line<Sampled> randomLine(const Normal& normal, double most, std::mt19937_64& engine) {
  Vector3d y = whitenedPoint(normal.rank, most, engine);
  const int along =
      normal.rank == 0 ? 0 : static_cast<int>(engine() % static_cast<unsigned>(normal.rank));
  y[along] = 0.0;
  Line<Sampled> line;
  line.start = toVec<Sampled>(normal.mean);
  for (int k = 0; k < normal.rank; ++k) {
    const Sampled length = Sampled(y[k]) * Sampled(normal.sigma[k]);
    line.start = line.start + toVec<Sampled>(normal.axes.col(k)) * length;
  }
  line.direction = toVec<Sampled>(normal.axes.col(along)) * Sampled(normal.sigma[along]);
  constexpr double kFar = 12.0;
  line.reach = std::min(kFar, std::sqrt(most * most - y.squaredNorm()));
  return line;
}

}  // namespace

std::optional<SampledTruth> sampledProbability(const TruthQuestion& question, int lines,
                                               std::uint64_t seed) {
  const auto a = placedSet<Sampled>(question.a, question.solid);
  const auto b = placedSet<Sampled>(question.b, question.solid);
  if (!a || !b) return std::nullopt;
  const double most = question.truncation.value_or(std::numeric_limits<double>::infinity());
  std::mt19937_64 engine(seed);
  std::discrete_distribution<std::size_t> component(question.weights.begin(),
                                                    question.weights.end());
  SampledTruth truth;
  for (; truth.lines < lines; ++truth.lines) {
    const Line<Sampled> line = randomLine(question.normals[component(engine)], most, engine);
    const auto spans = contactAlong<Sampled>(*a, *b, line, 1e-15L);
    if (!spans) return std::nullopt;
    truth.mean += shareOf(*spans, static_cast<double>(line.reach)) / lines;
  }
  truth.mean = std::min(1.0, truth.mean);
  return truth;
}

}  // namespace fcl_prob_audit
