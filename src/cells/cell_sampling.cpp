// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/cell_sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/random_words.h"
#include "cells/cell_draw.h"

namespace fcl_prob::detail {

namespace {

// Sets of samples a cell: their differences give the variance. A few cells have more, so that the
// variance of all of them together is known well enough.
constexpr int kLeastSets = 8;
constexpr int kMostSets = 32;
constexpr int kSetsInAll = 256;

int setsFor(std::size_t cells) {
  const int of_each = kSetsInAll / static_cast<int>(std::clamp<std::size_t>(cells, 1, kSetsInAll));
  return std::clamp(of_each, kLeastSets, kMostSets);
}

// No cell gets more samples than this in one set.
constexpr double kMostInSet = 4096;

// Cells between two looks at the clock, shared out among the threads.
constexpr std::size_t kCellsBetweenPolls = 32;

// A point of the unit cube for one set of samples of a cell.
Eigen::Vector3d uniformPoint(std::uint64_t seed, std::uint64_t cell, std::uint64_t set) {
  const std::array<std::uint64_t, 4> words = randomWords({seed}, cell, set, 0x63656c6c);
  return {unitUniform(words[0]), unitUniform(words[1]), unitUniform(words[2])};
}

// Point `index` of an additive sequence that fills the unit cube evenly: multiples of the powers of
// 1 / 1.2207..., the root of x⁴ = x + 1, shifted at random, which makes each of them uniform
// (Cranley and Patterson 1976).
Eigen::Vector3d evenPoint(const Eigen::Vector3d& shift, int index) {
  static const Eigen::Vector3d step(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
  Eigen::Vector3d point = shift + index * step;
  for (int k = 0; k < 3; ++k) {
    point[k] = std::clamp(point[k] - std::floor(point[k]), 0x1p-54, 1.0 - 0x1p-53);
  }
  return point;
}

// How much farther out than z deviations Student's t with so many degrees of freedom has the tail
// of the normal distribution there (expansion of Fisher and Cornish 1960).
double tailFactor(double freedom, double z) {
  const double square = z * z;
  const double second = (5.0 * square * square + 16.0 * square + 3.0) / 96.0;
  return 1.0 + ((square + 1.0) / 4.0 + second / freedom) / freedom;
}

// The differences between sets tell the variance without bias, but nothing where all samples agree,
// and little where few do not. After k hits the mean of a Poisson variable is above k + 4 sqrt(k +
// 4) about as rarely as a normal one is above its four deviations (k = 0: 10, k = 10: 25), so four
// squares of what one sample changes are added to the variance of all cells. Where that differs
// between cells it is their mean by variance, as in the third cumulant, ...
constexpr double kMissingJumps = 4.0;

// ... to which a cell whose samples agree adds as if half of the next one did not (Jeffreys'
// prior).
constexpr double kUnseenHits = 0.5;

SampledVariance average(const SampledVariance& a, double share_a, const SampledVariance& b,
                        double share_b) {
  const double square_a = share_a * share_a, square_b = share_b * share_b;
  return {a.unit, square_a * a.variance + square_b * b.variance,
          square_a * square_a * a.uncertainty + square_b * square_b * b.uncertainty,
          square_a * a.weight + square_b * b.weight,
          square_a * share_a * a.jumps + square_b * share_b * b.jumps};
}

}  // namespace

void addSets(double sum_squares, int sets, double freedom, double jump, SampledVariance& total) {
  const double of_mean = sum_squares / (sets * (sets - 1.0));
  total.variance += of_mean;
  total.uncertainty += of_mean * of_mean / freedom;
  const double likely = of_mean + kUnseenHits * jump * jump;
  total.weight += likely;
  total.jumps += likely * jump;
}

double SampledVariance::standardError(double deviations) const {
  if (!(weight > 0.0)) return 0.0;
  const double jump = jumps / weight;
  // Degrees of freedom by Welch (1947) and Satterthwaite.
  const double inverse_freedom = variance > 0.0 ? uncertainty / variance / variance : 0.0;
  const double factor = tailFactor(1.0 / std::max(inverse_freedom, 1e-300), deviations);
  return unit * std::sqrt(factor * factor * variance + kMissingJumps * jump * jump);
}

SampledMass average(const SampledMass& a, const SampledMass& b) {
  SampledMass sum;
  sum.samples = a.samples + b.samples;
  const double share_a = static_cast<double>(a.samples) / static_cast<double>(sum.samples);
  const double share_b = 1.0 - share_a;
  sum.mass = share_a * a.mass + share_b * b.mass;
  sum.spread = average(a.spread, share_a, b.spread, share_b);
  sum.doubt = share_a * a.doubt + share_b * b.doubt;
  sum.moment = share_a * a.moment + share_b * b.moment;
  for (std::size_t k = 0; k < 3; ++k) {
    sum.moment_spread[k] = average(a.moment_spread[k], share_a, b.moment_spread[k], share_b);
  }
  sum.moment_doubt = share_a * a.moment_doubt + share_b * b.moment_doubt;
  return sum;
}

CellSampler::CellSampler(std::unique_ptr<PointTester> tester, MakeTester another,
                         std::uint64_t seed, unsigned threads)
    : another_(std::move(another)),
      workers_(threads, std::make_unique<Worker>(std::move(tester))),
      seed_(seed) {}

void CellSampler::draw(const OpenCell& cell, std::uint64_t index, const SampleCount& count,
                       Worker& worker) const {
  worker.points.clear();
  worker.weights.clear();
  const PartMeasure measure(cell.cell);
  for (int set = 0; set < count.sets; ++set) {
    const std::uint64_t number = sets_drawn_ + static_cast<std::uint64_t>(set);
    const Eigen::Vector3d shift = uniformPoint(seed_, index, number);
    for (int i = 0; i < count.in_set; ++i) {
      const CellDraw drawn = drawFrom(cell, evenPoint(shift, i));
      const bool counted = drawn.weight > 0.0 && !measure.counts(cell.part, drawn.point);
      worker.points.push_back({drawn.point, !counted, false});
      worker.weights.push_back(counted ? drawn.weight / unit_ / count.in_set : 0.0);
    }
  }
}

CellSampler::CellMeans CellSampler::sampleCell(const OpenCell& cell, std::uint64_t index,
                                               const SampleCount& count, Worker& worker) const {
  draw(cell, index, count, worker);
  worker.tester->test(cell.front, worker.points);
  return meansOf(worker, count);
}

// Means and spreads are updated set by set (Welford): a difference of sums of squares may come out
// negative where all sets agree.
CellSampler::CellMeans CellSampler::meansOf(const Worker& tested, const SampleCount& count) {
  const auto& [unused, points, weights] = tested;
  CellMeans means;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].doubtful) means.doubt += weights[i] / count.sets;
    means.largest_weight = std::max(means.largest_weight, weights[i]);
  }
  for (int set = 0; set < count.sets; ++set) {
    double mass = 0.0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (int i = set * count.in_set; i < (set + 1) * count.in_set; ++i) {
      if (!points[i].collides) continue;
      mass += weights[i];
      moment += weights[i] * points[i].y;
    }
    const double share = 1.0 / (set + 1);
    const double off = mass - means.mass;
    const Eigen::Vector3d moment_off = moment - means.moment;
    means.mass += share * off;
    means.mass_spread += set * share * off * off;
    means.moment += share * moment_off;
    means.moment_spread += set * share * moment_off.cwiseAbs2();
  }
  return means;
}

void CellSampler::add(const CellMeans& means, const OpenCell& cell, const SampleCount& count,
                      SampledMass& total) const {
  const auto [sets, in_set] = count;
  const Eigen::Vector3d reach = cell.cell.largestCoordinates();
  // No sample changes more than all of the gap.
  const double jump = std::min(std::max(means.largest_weight, cell.drawn / unit_ / in_set) / sets,
                               cell.gap() / unit_);
  total.mass += unit_ * means.mass;
  addSets(means.mass_spread, sets, sets - 1.0, jump, total.spread);
  total.doubt += unit_ * means.doubt;
  total.moment += unit_ * means.moment;
  for (int k = 0; k < 3; ++k) {
    addSets(means.moment_spread[k], sets, sets - 1.0, jump * reach[k],
            total.moment_spread[static_cast<std::size_t>(k)]);
  }
  total.moment_doubt += unit_ * means.doubt * reach;
  total.samples += static_cast<std::size_t>(sets) * static_cast<std::size_t>(in_set);
}

// On all threads; added up in order.
void CellSampler::sampleStretch(const std::vector<OpenCell>& cells, const Stretch& stretch,
                                int sets, double sets_per_deviation, SampledMass& total) {
  struct Sampled {
    SampleCount count;
    CellMeans means;
  };
  std::array<Sampled, kCellsBetweenPolls> sampled;
  const auto work = [&](Worker& worker, std::size_t i) {
    const std::size_t index = stretch.begin + i;
    const double in_set = sets_per_deviation * cells[index].samplingDeviation();
    sampled[i].count = {sets, static_cast<int>(std::clamp(std::ceil(in_set), 1.0, kMostInSet))};
    sampled[i].means = sampleCell(cells[index], index, sampled[i].count, worker);
  };
  const std::size_t size = stretch.end - stretch.begin;
  workers_.run(
      size, [this] { return std::make_unique<Worker>(another_()); }, work);
  for (std::size_t i = 0; i < size; ++i) {
    add(sampled[i].means, cells[stretch.begin + i], sampled[i].count, total);
  }
}

SampledMass CellSampler::sample(const std::vector<OpenCell>& cells, double count,
                                const Interruption& interruption) {
  const int sets = setsFor(cells.size());
  double deviation = 0.0;
  for (const OpenCell& cell : cells) deviation += cell.samplingDeviation();
  const double sets_per_deviation = deviation > 0.0 ? count / sets / deviation : 0.0;
  double drawn = 0.0;
  for (const OpenCell& cell : cells) drawn += cell.drawn;
  unit_ = std::max(drawn, std::numeric_limits<double>::min());
  SampledMass total;
  total.spread.unit = unit_;
  for (SampledVariance& spread : total.moment_spread) spread.unit = unit_;
  for (std::size_t begin = 0; begin < cells.size(); begin += kCellsBetweenPolls) {
    const std::size_t end = std::min(begin + kCellsBetweenPolls, cells.size());
    if (!total.interrupted) total.interrupted = isDue(interruption);
    if (!total.interrupted) {
      sampleStretch(cells, {begin, end}, sets, sets_per_deviation, total);
      continue;
    }
    for (std::size_t i = begin; i < end; ++i) {
      total.mass += 0.5 * cells[i].gap();
      total.doubt += 0.5 * cells[i].gap();
      total.moment_doubt += cells[i].gap() * cells[i].cell.largestCoordinates();
    }
  }
  sets_drawn_ += static_cast<std::uint64_t>(sets);
  return total;
}

}  // namespace fcl_prob::detail
