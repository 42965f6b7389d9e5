// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/line_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/constants.h"
#include "base/random_words.h"
#include "cells/cell_sampling.h"
#include "gaussian/normal_density.h"
#include "lines/column_draw.h"
#include "lines/line_columns.h"

namespace fcl_prob::detail {
namespace {

// Columns before the first lines, by how many times more there are at the next look (in steps of so
// much), and how many there may be.
constexpr std::size_t kFirstColumnsOfEstimate = 28;
constexpr double kLeastGrowth = 1.05;
constexpr double kMostGrowth = 8.0;
constexpr double kStepOfGrowth = 1.05;
constexpr double kReserve = 1.1;

constexpr std::size_t kMostColumnsOfEstimate = 1 << 16;

// Looks are independent: where two are farther apart than so many standard errors, the later one,
// too, may not have seen all. The first one, with which none agrees yet, does not end the query.
constexpr double kFarApart = 3.0;

// Deviations up to which few degrees of freedom count as the normal distribution.
constexpr double kDeviations = 3.0;

// Pairs of lines of a column: each of two that are mirrored at its middle, so that what is linear
// across the column counts for nothing. Their difference tells the variance. One of the four is in
// each quarter of either side of the column, since most of the error is at edges that pass
// between lines: so the mean is better than its difference tells, by this factor (at 1 % of 100
// scenes errors are 0.68 times those of independent pairs).
constexpr int kPairs = 2;
constexpr int kLines = 2 * kPairs;
constexpr double kErrorOfDifference = 0.5;

// Of its variance, what a column leaves to each of its halves.
constexpr double kVarianceOfHalf = 1.0 / 6.0;

// What a column is divided by, besides the difference of its pairs, which says little of one
// column: a share of how far its lines differ, and of the most they have.
constexpr double kDeviationOfRange = 0.05;
constexpr double kDeviationOfMost = 0.08;

// A line may have more than those nearby by this factor; in columns so far along the order, ...
constexpr double kHigherThanSeen = 1.5;
constexpr int kNearby = 2;

// ... and where a line of a column has less than this share of its bound, an edge of the
// C-obstacle may pass between its lines, however wide that is. Chosen such that standard errors
// are of the size of the errors: what may be unseen of a line at an edge, and of one that something
// smaller may be beside.
constexpr double kNearlyMissed = 0.02;
constexpr double kUnseenEdge = 0.18;
constexpr double kUnseenPiece = 0.7;

// The same of an edge in a strip along a side of the column, for each share of the column that the
// strip is. Beside boxes along the axes, at 0.3 %, one seed in 250 was off by more than 4 standard
// errors without it, up to 15 of them.
constexpr double kUnseenStrip = 1.0;

// Two looks that agree are believed with so many columns, times the reciprocal of the relative
// tolerance: where edges are along the sides of a few columns both may miss the same.
constexpr double kColumnsOfTolerance = 0.3;

// What is seen of the error falls about with this power of the number of columns. What a look tells
// of that of the next one counts half, if it is more: either may happen to see little.
constexpr double kConvergence = 4.0 / 3.0;
constexpr double kWeightOfLast = 0.5;

// No standard error is known to be less than such a share of the one asked for: an easy scene would
// state that of a few columns that happen to agree. Of 200 seeds of one scene six stated less than
// a third of their error with 0.1 alone, the worst a ninth.
constexpr double kLeastError = 0.1;
constexpr double kLeastErrorOfFew = 0.35;
constexpr double kFewColumns = 32.0;

double leastError(std::size_t columns) {
  const double few = std::sqrt(kFewColumns / static_cast<double>(columns));
  return std::max(kLeastError, kLeastErrorOfFew * std::min(1.0, few));
}

// Of the standard error asked for, what may be left out of lines; and of the bound on P.
constexpr double kLeftOutOfError = 0.1;
constexpr double kLeftOutOfBound = 1e-6;

struct LineOfColumn {
  Eigen::Vector2d share;  ///< of the column below it, along each axis
  Eigen::Vector2d u;
};

/// Of the lines through one column.
struct PairsOfColumn {
  double mean = 0.0;  ///< of their masses
  double off = 0.0;   ///< the means of the two pairs are, if they were independent
  double lowest = 1.0;
  double highest = 0.0;
  std::array<LineOfColumn, kLines> lines;
  int count = 0;        ///< of `lines` so far
  double hidden = 0.0;  ///< chance that something as small as can be is between them
};

// As far from an end of [0, 1] as leaves one of x, this and what mirrors them in each quarter.
double turned(double x, bool to_other_half) {
  const bool is_high = x > 0.5;
  const double of_half = is_high ? 1.0 - x : x;
  const double other = of_half < 0.25 ? of_half + 0.25 : of_half - 0.25;
  return is_high != to_other_half ? 1.0 - other : other;
}

class ColumnSampler {
 public:
  ColumnSampler(WholeBodyLines& lines, const ProbabilityRequest& request)
      : lines_(lines), request_(request), least_(lines.leastArea()) {}

  PairsOfColumn draw(const LineColumns::Node& node, int index) {
    const std::array<std::uint64_t, 4> words =
        randomWords({request_.seed, 0x636f6c75}, static_cast<std::uint64_t>(index), looks_);
    const Eigen::Vector2d x(unitUniform(words[0]), unitUniform(words[1]));
    const Eigen::Vector2d y(turned(x[0], false), turned(x[1], true));
    PairsOfColumn drawn;
    const double means[kPairs] = {meanOfPair(node, x, drawn), meanOfPair(node, y, drawn)};
    drawn.mean = 0.5 * (means[0] + means[1]);
    drawn.off = kErrorOfDifference * (means[0] - means[1]);
    return drawn;
  }

  /// The lines of draw() are others from now on.
  void nextLook() { ++looks_; }

 private:
  double meanOfPair(const LineColumns::Node& node, const Eigen::Vector2d& x, PairsOfColumn& drawn) {
    return 0.5 * (massAt(node, x, drawn) + massAt(node, Eigen::Vector2d::Ones() - x, drawn));
  }

  double massAt(const LineColumns::Node& node, const Eigen::Vector2d& x, PairsOfColumn& drawn) {
    const Eigen::Vector2d u = pointOf(node.column, x);
    const double mass = lines_.massOn(
        u, node.met, {kLeftOutOfError * request_.relative_tolerance, kLeftOutOfBound * node.most},
        Taken::cores);
    drawn.lowest = std::min(drawn.lowest, mass);
    drawn.highest = std::max(drawn.highest, mass);
    drawn.lines[drawn.count++] = {x, u};
    countUnseen(node, u, drawn);
    return mass;
  }

  // What sticks out is no smaller than the smallest member. All of it may be between lines with the
  // chance that none of them, of the density 1/d² at the distance d from each other (of two that
  // are mirrored one counts), meets its area.
  void countUnseen(const LineColumns::Node& node, const Eigen::Vector2d& u,
                   PairsOfColumn& drawn) const {
    const double square = node.measure / (kPairs * normalDensity(u[0]) * normalDensity(u[1]));
    drawn.hidden += std::exp(-least_ / square) / kLines;
  }

  WholeBodyLines& lines_;
  const ProbabilityRequest& request_;
  double least_;  ///< area of the smallest member
  std::uint64_t looks_ = 0;
};

/// What lines through all columns told.
struct Look {
  double mass = 0.0;
  std::size_t columns = 0;
  SampledVariance spread;
  double doubt = 0.0;  ///< what was left out of lines, and what no lines were drawn of
  std::optional<ProbabilityStatus> interrupted;

  double standardError() const { return std::hypot(spread.standardError(kDeviations), doubt); }

  double standardErrorAfter(const Look& last) const {
    const double more = static_cast<double>(columns) / static_cast<double>(last.columns);
    const double own = standardError();
    const double by_last = last.standardError() / std::pow(more, kConvergence);
    const double of_both =
        std::hypot(std::sqrt(1.0 - kWeightOfLast) * own, std::sqrt(kWeightOfLast) * by_last);
    return std::max(own, of_both);
  }

  double weight() const { return std::pow(static_cast<double>(columns), 2.0 * kConvergence); }

  bool isFarFrom(const Look& other) const {
    return std::fabs(mass - other.mass) >
           kFarApart * std::hypot(standardError(), other.standardError());
  }
};

/// Looks together. Their weights follow from their numbers of columns alone: by their own errors
/// those would count more that happen to have seen little.
struct Looks {
  double weight = 0.0;
  double mass = 0.0;
  double standard_error = 0.0;

  void add(const Look& look, double error) {
    const double share = look.weight() / (weight + look.weight());
    mass += share * (look.mass - mass);
    standard_error = std::hypot((1.0 - share) * standard_error, share * error);
    weight += look.weight();
  }
};

class LineEstimation {
 public:
  LineEstimation(WholeBodyLines& lines, const ProbabilityRequest& request, Budget& budget)
      : request_(request),
        budget_(budget),
        columns_(lines),
        sampler_(lines, request),
        most_columns_(std::min(kMostColumnsOfEstimate, request.max_cells)) {
    columns_.divideByMass(std::min(kFirstColumnsOfEstimate, most_columns_));
  }

  std::optional<LineEstimate> run() {
    LineEstimate result;
    std::optional<Look> before;
    Looks together;
    for (;;) {
      if (!(columns_.most() > std::numeric_limits<double>::min())) return std::nullopt;
      result.upper = std::min(result.upper, columns_.most());
      const Look look = lookAt(result.upper);
      const bool is_confirmed = before && !look.isFarFrom(*before);
      if (!is_confirmed) together = {};
      together.add(look, before ? look.standardErrorAfter(*before) : look.standardError());
      result.columns = look.columns;
      result.lines += kLines * look.columns;
      result.value = std::min(together.mass, result.upper);
      result.status = look.interrupted.value_or(ProbabilityStatus::converged);
      const double target = request_.toleranceAt(result.value);
      const double least = leastError(look.columns) * target;
      result.standard_error = std::hypot(together.standard_error, least);
      const auto most = static_cast<double>(most_columns_);
      const double fewest = std::min(most, kColumnsOfTolerance * result.value / target);
      const bool is_enough = static_cast<double>(look.columns) >= fewest;
      const bool is_known = is_confirmed && is_enough && result.standard_error <= target;
      if (look.interrupted || is_known) return result;
      if (!divide(look, together, target, fewest)) return std::nullopt;
      before = look;
    }
  }

 private:
  Look lookAt(double upper) {
    Look look;
    look.columns = columns_.inOrder().size();
    look.spread.unit = columns_.most();
    std::vector<PairsOfColumn> drawn;
    for (const int column : columns_.inOrder()) {
      const LineColumns::Node& node = columns_[column];
      if (!look.interrupted) look.interrupted = budget_.look({0.0, upper}, 0.0);
      if (look.interrupted) {
        look.mass += 0.5 * node.mass();
        look.doubt += 0.5 * node.mass();
      } else {
        drawn.push_back(sampler_.draw(node, column));
      }
    }
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      LineColumns::Node& node = columns_[columns_.inOrder()[i]];
      const double unseen = unseenOf(drawn[i], node, highestNear(drawn, i)) +
                            kUnseenStrip * stripBesideNothing(drawn[i], node) * drawn[i].highest;
      add(drawn[i], unseen, node, look);
    }
    look.doubt += kLeftOutOfError * request_.relative_tolerance * look.mass +
                  kLeftOutOfBound * columns_.most();
    sampler_.nextLook();
    return look;
  }

  static double highestNear(const std::vector<PairsOfColumn>& drawn, std::size_t i) {
    const auto last = static_cast<int>(drawn.size()) - 1;
    const auto at = static_cast<int>(i);
    double highest = 0.0;
    for (int k = std::max(0, at - kNearby); k <= std::min(last, at + kNearby); ++k) {
      highest = std::max(highest, drawn[k].highest);
    }
    return highest;
  }

  // What one line more of the column may change. Bounds on columns are much larger than what is
  // there, so they count only for what nothing nearby tells of: all that collides may be far out in
  // a column that reaches to the end of the space.
  static double unseenOf(const PairsOfColumn& pairs, const LineColumns::Node& node,
                         double highest) {
    const bool may_be_far_out = highest == 0.0 && reachesOut(node.column);
    const double of_nearby =
        may_be_far_out ? node.most : std::min(node.most, kHigherThanSeen * highest);
    const bool has_edge = pairs.lowest < kNearlyMissed * node.most;
    return (has_edge ? kUnseenEdge * of_nearby : 0.0) + kUnseenPiece * pairs.hidden * node.most;
  }

  // Of the strips between a side of the column and the line nearest to it the widest, as a share of
  // the column, that is beside a column in which nothing collides: there an edge is within it.
  double stripBesideNothing(const PairsOfColumn& pairs, const LineColumns::Node& node) const {
    double widest = 0.0;
    for (const int axis : {0, 1}) {
      for (const bool above : {false, true}) {
        const double side = (above ? node.column.hi : node.column.lo)[axis];
        if (std::fabs(side) >= kReach) continue;
        const auto distance = [&](const LineOfColumn& line) {
          return above ? 1.0 - line.share[axis] : line.share[axis];
        };
        const auto nearest = std::min_element(
            pairs.lines.begin(), pairs.lines.end(),
            [&](const auto& one, const auto& other) { return distance(one) < distance(other); });
        if (distance(*nearest) <= widest) continue;
        Eigen::Vector2d beyond = nearest->u;
        beyond[axis] = std::nextafter(side, above ? kInfinity : -kInfinity);
        if (!columns_.mayCollideAt(beyond)) widest = distance(*nearest);
      }
    }
    return widest;
  }

  // The weight by which a column is divided is about what it adds to the variance.
  static void add(const PairsOfColumn& pairs, double unseen, LineColumns::Node& node, Look& look) {
    const double unit = look.spread.unit;
    const double share = node.measure / unit;
    const double jump = share * unseen / kLines;
    // In units, since far out squares of masses vanish.
    const double off = share * pairs.off;
    const double sum_squares = 0.5 * off * off;
    // A variance that is known with ν degrees of freedom has the mean square (1 + 2/ν) of its own.
    constexpr double kFreedom = kPairs - 1 + 2;
    addSets(sum_squares, kPairs, kFreedom, jump, look.spread);
    look.mass += node.measure * pairs.mean;
    const double of_range = kDeviationOfRange * share * (pairs.highest - pairs.lowest);
    const double of_most =
        kDeviationOfMost * share * std::min(node.most, 2.0 * pairs.highest + 0.1 * node.most);
    node.weight = 0.5 * sum_squares + jump * jump + of_range * of_range + of_most * of_most;
  }

  // So many that with the next look the error is likely small enough. What may be unseen of it
  // falls with the square of the number of columns. False where that would be too many.
  // \param fewest  columns of the next look
  bool divide(const Look& look, const Looks& together, double target, double fewest) {
    SampledVariance seen = look.spread;
    seen.jumps = 0.0;
    const double of_seen = seen.standardError(kDeviations);
    const double of_all = look.spread.standardError(kDeviations);
    const double share = of_all > 0.0 ? of_seen / of_all : 1.0;
    const double unseen = of_all * std::sqrt(std::max(0.0, 1.0 - share * share));
    const auto errorWith = [&](double growth) {
      Look next = look;
      next.columns = static_cast<std::size_t>(growth * static_cast<double>(look.columns));
      Looks all = together;
      all.add(next, std::hypot(of_seen / std::pow(growth, kConvergence), unseen / growth / growth));
      return all.standard_error;
    };
    const auto now = static_cast<double>(look.columns);
    const auto most = static_cast<double>(most_columns_);
    double growth = kLeastGrowth;
    while (growth * now <= most && !(kReserve * errorWith(growth) <= target)) {
      growth *= kStepOfGrowth;
    }
    if (growth * now > most) return false;
    growth = std::max(growth, fewest / now);
    const double count = std::ceil(std::min(growth, kMostGrowth) * now);
    columns_.divide(static_cast<std::size_t>(count), kVarianceOfHalf);
    return columns_.inOrder().size() > static_cast<std::size_t>(now);
  }

  const ProbabilityRequest& request_;
  Budget& budget_;
  LineColumns columns_;
  ColumnSampler sampler_;
  std::size_t most_columns_;
};

}  // namespace

std::optional<LineEstimate> lineEstimate(WholeBodyLines& lines, const ProbabilityRequest& request,
                                         Budget& budget) {
  return LineEstimation(lines, request, budget).run();
}

}  // namespace fcl_prob::detail
