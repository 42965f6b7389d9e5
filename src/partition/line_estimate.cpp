// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/line_estimate.h"

#include <Random123/philox.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gaussian/normal_density.h"
#include "partition/cell_draw.h"
#include "partition/cell_sampling.h"
#include "partition/line_columns.h"
#include "partition/unit_uniform.h"

namespace fcl_prob::detail {
namespace {

// Columns before the first lines, by how many times more there are at the next look, and how many
// there may be.
constexpr std::size_t kFirstColumns = 32;
constexpr double kLeastGrowth = 1.6;
constexpr double kMostGrowth = 8.0;
constexpr double kReserve = 1.15;
constexpr std::size_t kMostColumns = 1 << 16;

// Pairs of lines of a column: each of two that are mirrored at its middle, so that what is linear
// across the column counts for nothing. Their difference tells the variance.
constexpr int kPairs = 2;
constexpr int kLines = 2 * kPairs;

// Of its variance, what a column leaves to each of its halves.
constexpr double kVarianceOfHalf = 1.0 / 6.0;

// A column whose pairs agree is taken to vary by this share of its bound.
constexpr double kLeastDeviation = 0.07;

// Of the standard error asked for, what may be left out of lines; and of the bound on P.
constexpr double kLeftOutOfError = 0.05;
constexpr double kLeftOutOfBound = 1e-6;

struct PairsOfColumn {
  double mean = 0.0;    ///< of lines' masses
  double spread = 0.0;  ///< squares of what the means of pairs are off that
  double apart = 0.0;   ///< distance of lines, about
};

class ColumnSampler {
 public:
  ColumnSampler(WholeBodyLines& lines, const ProbabilityRequest& request)
      : lines_(lines), request_(request), least_(lines.leastSilhouette()) {}

  PairsOfColumn draw(const LineColumns::Node& node, int index) {
    const LeftOut negligible{kLeftOutOfError * request_.relative_tolerance,
                             kLeftOutOfBound * node.most};
    r123::Philox4x64 generator;
    const auto words = generator({{static_cast<std::uint64_t>(index), looks_, 0, 0}},
                                 {{request_.seed, 0x636f6c75}});
    PairsOfColumn pairs;
    double means[kPairs];
    for (int pair = 0; pair < kPairs; ++pair) {
      const Eigen::Vector2d x(unitUniform(words[2 * pair]), unitUniform(words[2 * pair + 1]));
      const Eigen::Vector2d mirrored = Eigen::Vector2d::Ones() - x;
      means[pair] = 0.5 * (massAt(node, x, negligible, pairs.apart) +
                           massAt(node, mirrored, negligible, pairs.apart));
    }
    pairs.mean = 0.5 * (means[0] + means[1]);
    pairs.spread = 0.5 * (means[0] - means[1]) * (means[0] - means[1]);
    pairs.apart /= kLines;
    return pairs;
  }

  void nextLook() { ++looks_; }

  /// What a piece that no line met would have changed, in lines. What sticks out is no smaller than
  /// the smallest member, a disc of radius r at least: of that, a segment of the area d³/12r
  /// reaches into the gap between two lines at the distance d, a share d/12r of a line's own. All
  /// of it may be between lines with the chance that none of them, of the density 1/d², meets its
  /// area.
  double unseen(const PairsOfColumn& pairs) const {
    const double d = pairs.apart;
    return std::min(1.0, d / (12.0 * least_.radius) + std::exp(-least_.area / (d * d)));
  }

 private:
  double massAt(const LineColumns::Node& node, const Eigen::Vector2d& x, const LeftOut& negligible,
                double& apart) {
    Eigen::Vector2d u;
    for (int k = 0; k < 2; ++k) u[k] = truncatedNormal(node.column.lo[k], node.column.hi[k], x[k]);
    const double density = normalDensity(u[0]) * normalDensity(u[1]) / node.measure;
    apart += 1.0 / std::sqrt(kPairs * density);
    return lines_.massOn(u, negligible);
  }

  WholeBodyLines& lines_;
  const ProbabilityRequest& request_;
  Silhouette least_;
  std::uint64_t looks_ = 0;
};

// What is seen of the error falls about with the 1.3rd power of the number of columns, what may be
// unseen with its square.
double growthFor(const SampledVariance& spread, double target) {
  SampledVariance seen = spread;
  seen.jumps = 0.0;
  const double of_seen = seen.standardError() / seen.unit;
  const double of_all = spread.standardError() / spread.unit;
  const double unseen = std::sqrt(std::max(0.0, of_all * of_all - of_seen * of_seen));
  return kReserve * std::max(std::pow(of_seen / target, 0.75), std::sqrt(unseen / target));
}

}  // namespace

std::optional<LineEstimate> lineEstimate(
    WholeBodyLines& lines, const ProbabilityRequest& request,
    const std::function<std::optional<ProbabilityStatus>(const Bounds&)>& interruption) {
  LineColumns columns(lines);
  columns.divideByMass(kFirstColumns);
  ColumnSampler sampler(lines, request);
  LineEstimate result;
  for (;;) {
    const double unit = columns.most();
    if (!(unit > std::numeric_limits<double>::min())) return std::nullopt;
    result.upper = std::min(result.upper, unit);
    SampledVariance spread;
    spread.unit = unit;
    result.value = 0.0;
    std::optional<ProbabilityStatus> interrupted;
    double left_out = 0.0;
    for (const int column : columns.inOrder()) {
      LineColumns::Node& node = columns[column];
      const PairsOfColumn pairs = sampler.draw(node, column);
      result.lines += kLines;
      result.value += node.measure * pairs.mean;
      const double share = node.measure / unit;
      const double jump = share * node.most * sampler.unseen(pairs) / kLines;
      const double of_mean = share * share * pairs.spread;
      addSets(of_mean, kPairs, kPairs + 1, jump, spread);
      const double least = kLeastDeviation * node.mass();
      node.weight = unit * unit * (0.5 * of_mean + 4.0 * jump * jump) + least * least;
      if (!interrupted) interrupted = interruption({0.0, result.upper});
    }
    result.columns = columns.inOrder().size();
    left_out = kLeftOutOfError * request.relative_tolerance * result.value + kLeftOutOfBound * unit;
    result.value = std::min(result.value, result.upper);
    result.standard_error = std::hypot(spread.standardError(), left_out);
    const double target = request.toleranceAt(result.value);
    if (interrupted) {
      result.status = *interrupted;
      return result;
    }
    if (result.standard_error <= target) return result;
    if (columns.inOrder().size() >= kMostColumns) return std::nullopt;
    sampler.nextLook();
    const double more = std::clamp(growthFor(spread, target / unit), kLeastGrowth, kMostGrowth);
    const double count = std::ceil(more * static_cast<double>(columns.inOrder().size()));
    columns.divide(std::min(kMostColumns, static_cast<std::size_t>(count)), kVarianceOfHalf);
  }
}

}  // namespace fcl_prob::detail
