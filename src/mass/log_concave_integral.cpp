// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/log_concave_integral.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

/// Beyond there is nothing, whatever a line of kSteepest makes of it.
constexpr double kEnd = 1e3;

/// Steeper lines are no use: exponents would be larger than their results.
constexpr double kSteepest = 15.0;

/// What a mass may be where the function says 0.
constexpr double kLeastMass = 1e-300;

/// Of a sum of a few terms and of what an exponential makes of it.
constexpr double kExponentRounding = 16.0 * kEpsilon;

}  // namespace

void LogConcaveIntegral::add(double z, const Bounds& value) {
  const auto logOf = [](double mass) { return mass > 0.0 ? std::log(mass) : -kInfinity; };
  const Place place{z, logOf(value.lower), std::min(logOf(value.upper), 0.0)};
  const auto after =
      std::find_if(places_.begin(), places_.end(), [&](const Place& other) { return other.z > z; });
  places_.insert(after, place);
}

/// Piece k is what is before place k; the last one is behind all of them.
double LogConcaveIntegral::pieceFrom(std::size_t k) const {
  return k == 0 ? -kEnd : places_[k - 1].z;
}
double LogConcaveIntegral::pieceTo(std::size_t k) const {
  return k == places_.size() ? kEnd : places_[k].z;
}

/// The log of ∫ φ exp(value + slope (z - at)), a shifted interval's mass but for a factor.
double LogConcaveIntegral::integral(const Line& line, double from, double to) const {
  const double mass = normalIntervalMass(from - line.slope, to - line.slope);
  return line.value - line.slope * line.at + 0.5 * line.slope * line.slope +
         std::log(std::max(mass, kLeastMass));
}

/// Seen from its ends a piece is where it is to a few errors of a place over its length and over
/// that of the piece that the line was drawn in.
double LogConcaveIntegral::slackOf(std::size_t k, double slope) const {
  double least = kInfinity, reach = 1.0;
  for (std::size_t i = k > 1 ? k - 1 : 1; i < std::min(k + 2, places_.size()); ++i) {
    least = std::min(least, places_[i].z - places_[i - 1].z);
  }
  double length = 2.0 * kFarthestPlace;
  if (k > 0 && k < places_.size()) length = places_[k].z - places_[k - 1].z;
  reach += kFarthestPlace + std::abs(slope) * (1.0 + length / least);
  const double exponents = 1500.0 + std::abs(slope) * kFarthestPlace + slope * slope;
  return 4.0 * place_error_ * (1.0 / least + reach) + kExponentRounding * exponents;
}

double LogConcaveIntegral::lowerOf(std::size_t k) const {
  if (k == 0 || k == places_.size()) return 0.0;
  const Place &from = places_[k - 1], &to = places_[k];
  const double slope = (to.lower - from.lower) / (to.z - from.z);
  if (!(std::abs(slope) < kSteepest)) return 0.0;
  if (!(normalIntervalMass(from.z - slope, to.z - slope) > kLeastMass)) return 0.0;
  return std::exp(integral({from.z, from.lower, slope}, from.z, to.z)) * (1.0 - slackOf(k, slope));
}

/// The lines of the neighbours before and behind.
std::vector<LogConcaveIntegral::Line> LogConcaveIntegral::linesOver(std::size_t k) const {
  std::vector<Line> lines;
  const auto addLine = [&](const Place& outer, const Place& inner) {
    const double slope = (inner.upper - outer.lower) / (inner.z - outer.z);
    if (std::abs(slope) < kSteepest) lines.push_back({inner.z, inner.upper, slope});
  };
  if (k >= 2) addLine(places_[k - 2], places_[k - 1]);
  if (k + 1 < places_.size()) addLine(places_[k + 1], places_[k]);
  return lines;
}

double LogConcaveIntegral::upperOf(std::size_t k) const {
  const double from = pieceFrom(k), to = pieceTo(k);
  double least = normalIntervalMass(from, to) * (1.0 + kIntervalMassRelativeError);
  const auto lines = linesOver(k);
  const auto over = [&](const Line& line, double begin, double end) {
    return std::exp(integral(line, begin, end)) * (1.0 + slackOf(k, line.slope));
  };
  for (const Line& line : lines) least = std::min(least, over(line, from, to));
  if (lines.size() == 2 && lines[0].slope > lines[1].slope) {
    const Line &first = lines[0], &last = lines[1];
    const double apart =
        (last.value - last.slope * last.at) - (first.value - first.slope * first.at);
    const double crossing = apart / (first.slope - last.slope);
    if (crossing > from && crossing < to) {
      least = std::min(least, over(first, from, crossing) + over(last, crossing, to));
    }
  }
  return least + kLeastMass;
}

Bounds LogConcaveIntegral::piece(std::size_t k) const { return {lowerOf(k), upperOf(k)}; }

Bounds LogConcaveIntegral::bounds() const {
  if (places_.size() < 2) return {0.0, 1.0};
  Bounds sum{0.0, 0.0};
  for (std::size_t k = 0; k <= places_.size(); ++k) {
    const Bounds part = piece(k);
    sum.lower += part.lower;
    sum.upper += part.upper;
  }
  const double rounding = 2.0 * kEpsilon * static_cast<double>(places_.size() + 1);
  return {sum.lower * (1.0 - rounding), std::min(1.0, sum.upper * (1.0 + rounding))};
}

double LogConcaveIntegral::widest() const {
  std::size_t worst = 0;
  double most = -1.0;
  for (std::size_t k = 0; k <= places_.size(); ++k) {
    if (const double gap = piece(k).width(); gap > most) {
      most = gap;
      worst = k;
    }
  }
  constexpr double kStep = 3.0;
  if (worst == 0) return places_.front().z - kStep;
  if (worst == places_.size()) return places_.back().z + kStep;
  return 0.5 * (places_[worst - 1].z + places_[worst].z);
}

double LogConcaveIntegral::mostBend() const {
  double most = 0.0;
  for (std::size_t k = 1; k + 1 < places_.size(); ++k) {
    const Place &before = places_[k - 1], &at = places_[k], &after = places_[k + 1];
    const double share = (at.z - before.z) / (after.z - before.z);
    most = std::max(most, at.upper - (before.lower + share * (after.lower - before.lower)));
  }
  return most;
}

}  // namespace fcl_prob::detail
