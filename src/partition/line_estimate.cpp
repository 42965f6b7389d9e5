// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/line_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/random_words.h"
#include "carving/line_columns.h"
#include "gaussian/normal_density.h"
#include "partition/cell_draw.h"
#include "partition/cell_sampling.h"

namespace fcl_prob::detail {
namespace {

// Columns before the first lines, by how many times more there are at the next look, and how many
// there may be.
constexpr std::size_t kFirstColumns = 32;
constexpr double kLeastGrowth = 1.6;
constexpr double kMostGrowth = 8.0;
constexpr double kReserve = 1.15;

// The first look knows least of its own error: it ends the query only with this share of what was
// asked for.
constexpr double kTrustInFirst = 0.7;
constexpr std::size_t kMostColumns = 1 << 16;

// Pairs of lines of a column: each of two that are mirrored at its middle, so that what is linear
// across the column counts for nothing. Their difference tells the variance.
constexpr int kPairs = 2;
constexpr int kLines = 2 * kPairs;

// Of its variance, what a column leaves to each of its halves.
constexpr double kVarianceOfHalf = 1.0 / 6.0;

// A column whose pairs agree is taken to vary by this share of its bound.
constexpr double kLeastDeviation = 0.07;

// Where a line of a column has less than this share of its bound, an edge of the C-obstacle may
// pass between its lines, however wide that is: what may be unseen is then this share of a line at
// least.
constexpr double kNearlyMissed = 0.02;
constexpr double kUnseenEdge = 0.5;

// Of the standard error asked for, what may be left out of lines; and of the bound on P.
constexpr double kLeftOutOfError = 0.05;
constexpr double kLeftOutOfBound = 1e-6;

/// Of the lines through one column.
struct PairsOfColumn {
  double mean = 0.0;    ///< of their masses
  double spread = 0.0;  ///< squares of what the means of pairs are off that
  double unseen = 0.0;  ///< in lines: what a piece that none of them met would have changed
};

class ColumnSampler {
 public:
  ColumnSampler(WholeBodyLines& lines, const ProbabilityRequest& request)
      : lines_(lines), request_(request), least_(lines.leastSilhouette()) {}

  PairsOfColumn draw(const LineColumns::Node& node, int index) {
    const std::array<std::uint64_t, 4> words =
        randomWords({request_.seed, 0x636f6c75}, static_cast<std::uint64_t>(index), looks_);
    double means[kPairs];
    double apart = 0.0, least = node.most;
    for (int pair = 0; pair < kPairs; ++pair) {
      const Eigen::Vector2d x(unitUniform(words[2 * pair]), unitUniform(words[2 * pair + 1]));
      const Eigen::Vector2d u = placeOf(node, x);
      const Eigen::Vector2d mirrored = placeOf(node, Eigen::Vector2d::Ones() - x);
      const double mass = massOn(node, u), of_mirrored = massOn(node, mirrored);
      means[pair] = 0.5 * (mass + of_mirrored);
      least = std::min({least, mass, of_mirrored});
      apart += 0.5 * (distanceAt(node, u) + distanceAt(node, mirrored)) / kPairs;
    }
    const double off = means[0] - means[1];
    return {
        0.5 * (means[0] + means[1]), 0.5 * off * off,
        least < kNearlyMissed * node.most ? std::max(kUnseenEdge, unseen(apart)) : unseen(apart)};
  }

  /// The lines of draw() are others from now on.
  void nextLook() { ++looks_; }

 private:
  static Eigen::Vector2d placeOf(const LineColumns::Node& node, const Eigen::Vector2d& x) {
    const auto& [lo, hi] = node.column;
    return {truncatedNormal(lo[0], hi[0], x[0]), truncatedNormal(lo[1], hi[1], x[1])};
  }

  double massOn(const LineColumns::Node& node, const Eigen::Vector2d& u) {
    return lines_.massOn(
        u, {kLeftOutOfError * request_.relative_tolerance, kLeftOutOfBound * node.most});
  }

  // Of lines around u; of two that are mirrored one counts.
  static double distanceAt(const LineColumns::Node& node, const Eigen::Vector2d& u) {
    return std::sqrt(node.measure / (kPairs * normalDensity(u[0]) * normalDensity(u[1])));
  }

  // What sticks out is no smaller than the smallest member, a disc of radius r at least: of that, a
  // segment of the area d³/12r reaches into the gap between two lines at the distance d, a share
  // d/12r of a line's own. All of it may be between lines with the chance that none of them, of the
  // density 1/d², meets its area.
  double unseen(double d) const {
    return std::min(1.0, d / (12.0 * least_.radius) + std::exp(-least_.area / (d * d)));
  }

  WholeBodyLines& lines_;
  const ProbabilityRequest& request_;
  Silhouette least_;
  std::uint64_t looks_ = 0;
};

/// What lines through all columns told.
struct Look {
  double mass = 0.0;
  SampledVariance spread;
  double doubt = 0.0;  ///< what was left out of lines, and what no lines were drawn of
  std::optional<ProbabilityStatus> interrupted;

  double standardError() const { return std::hypot(spread.standardError(), doubt); }
};

class LineEstimation {
 public:
  LineEstimation(WholeBodyLines& lines, const ProbabilityRequest& request,
                 const LineInterruption& interruption)
      : request_(request),
        interruption_(interruption),
        columns_(lines),
        sampler_(lines, request),
        most_columns_(std::min(kMostColumns, request.max_cells)) {
    columns_.divideByMass(std::min(kFirstColumns, most_columns_));
  }

  std::optional<LineEstimate> run() {
    LineEstimate result;
    for (bool is_first = true;; is_first = false) {
      if (!(columns_.most() > std::numeric_limits<double>::min())) return std::nullopt;
      result.upper = std::min(result.upper, columns_.most());
      const Look look = lookAt(result.upper);
      result.columns = columns_.inOrder().size();
      result.lines += kLines * result.columns;
      result.value = std::min(look.mass, result.upper);
      result.standard_error = look.standardError();
      result.status = look.interrupted.value_or(ProbabilityStatus::converged);
      const double target = request_.toleranceAt(result.value);
      const double trusted = is_first ? kTrustInFirst * target : target;
      if (look.interrupted || result.standard_error <= trusted) return result;
      if (!divide(look.spread, target)) return std::nullopt;
    }
  }

 private:
  Look lookAt(double upper) {
    Look look;
    look.spread.unit = columns_.most();
    for (const int column : columns_.inOrder()) {
      LineColumns::Node& node = columns_[column];
      if (!look.interrupted) look.interrupted = interruption_({0.0, upper});
      if (look.interrupted) {
        look.mass += 0.5 * node.mass();
        look.doubt += 0.5 * node.mass();
      } else {
        add(sampler_.draw(node, column), node, look);
      }
    }
    look.doubt += kLeftOutOfError * request_.relative_tolerance * look.mass +
                  kLeftOutOfBound * columns_.most();
    sampler_.nextLook();
    return look;
  }

  // The weight by which a column is divided is about what it adds to the variance.
  static void add(const PairsOfColumn& pairs, LineColumns::Node& node, Look& look) {
    const double unit = look.spread.unit;
    const double share = node.measure / unit;
    const double jump = share * node.most * pairs.unseen / kLines;
    const double sum_squares = share * share * pairs.spread;
    // A variance that is known with ν degrees of freedom has the mean square (1 + 2/ν) of its own.
    constexpr double kFreedom = kPairs - 1 + 2;
    addSets(sum_squares, kPairs, kFreedom, jump, look.spread);
    look.mass += node.measure * pairs.mean;
    const double least = kLeastDeviation * node.mass();
    node.weight = unit * unit * (0.5 * sum_squares + 4.0 * jump * jump) + least * least;
  }

  // What is seen of the error falls about with the 1.3rd power of the number of columns, what may
  // be unseen with its square. False where that would be too many.
  bool divide(const SampledVariance& spread, double target) {
    SampledVariance seen = spread;
    seen.jumps = 0.0;
    const double of_seen = seen.standardError();
    const double of_all = spread.standardError();
    const double unseen = std::sqrt(std::max(0.0, of_all * of_all - of_seen * of_seen));
    const double growth =
        kReserve * std::max(std::pow(of_seen / target, 0.75), std::sqrt(unseen / target));
    const auto now = static_cast<double>(columns_.inOrder().size());
    const auto most = static_cast<double>(most_columns_);
    if (!(growth * now <= most) || kLeastGrowth * now > most) return false;
    const double count = std::ceil(std::clamp(growth, kLeastGrowth, kMostGrowth) * now);
    columns_.divide(static_cast<std::size_t>(count), kVarianceOfHalf);
    return true;
  }

  const ProbabilityRequest& request_;
  const LineInterruption& interruption_;
  LineColumns columns_;
  ColumnSampler sampler_;
  std::size_t most_columns_;
};

}  // namespace

std::optional<LineEstimate> lineEstimate(WholeBodyLines& lines, const ProbabilityRequest& request,
                                         const LineInterruption& interruption) {
  return LineEstimation(lines, request, interruption).run();
}

}  // namespace fcl_prob::detail
