// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The estimate: stratified sampling of what the partition leaves open.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/interruption.h"
#include "base/round_workers.h"
#include "cells/point_tester.h"

namespace fcl_prob::detail {

/// Of one sampled quantity: what its standard error is made of.
struct SampledVariance {
  double unit = 1.0;  ///< of the mass, so that squares of small ones do not underflow
  double variance = 0.0;
  double uncertainty = 0.0;  ///< Σ v²/ν over the cells: variances v with ν degrees of freedom
  double weight = 0.0;       ///< Σ u over the cells: what their variances may well be
  double jumps = 0.0;        ///< Σ u d, with what one sample of another kind would have changed, d

  /// Such that so many of it are as rarely exceeded as of a normal distribution, however few
  /// samples and cells there are.
  double standardError(double deviations = 4.0) const;
};

/// Adds a mean of so many sets, the squares of whose differences from it have this sum.
/// \param freedom  its degrees, by which the variance is known
/// \param jump     what one sample of another kind would have changed
void addSets(double sum_squares, int sets, double freedom, double jump, SampledVariance& total);

struct SampledMass {
  double mass = 0.0;
  SampledVariance spread;
  double doubt = 0.0;  ///< of `mass`: samples that may collide or not within rounding, and what was
                       ///< not sampled for lack of time
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  std::array<SampledVariance, 3> moment_spread;
  Eigen::Vector3d moment_doubt = Eigen::Vector3d::Zero();
  std::size_t samples = 0;
  bool interrupted = false;  ///< not all cells were sampled

  /// Of chance and of doubt, which does not average out.
  double standardError() const { return std::hypot(spread.standardError(), doubt); }
};

/// Of two sets of samples of the same cells, each counted by its size.
SampledMass average(const SampledMass& a, const SampledMass& b);

/// Estimate of the mass (and of ∫ y φ(y) dy) that collides in the open part of each open cell: what
/// is known of neither its plane nor its part. Some sets of samples a cell, fixed by the seed,
/// whose differences give the variance; each set is spread evenly over the cell. A sample is tested
/// against the cell's own front only.
class CellSampler {
 public:
  using MakeTester = std::function<std::unique_ptr<PointTester>()>;

  /// \param tester   on the calling thread
  /// \param another  one for each other thread, by which it is called
  CellSampler(std::unique_ptr<PointTester> tester, MakeTester another, std::uint64_t seed,
              unsigned threads);

  /// About `count` samples, at least a few a cell. Every call draws others. Once interrupted it
  /// takes half the gap of the cells that are left, and doubts it.
  SampledMass sample(const std::vector<OpenCell>& cells, double count,
                     const Interruption& interruption);

 private:
  struct Worker {
    explicit Worker(std::unique_ptr<PointTester> its_tester) : tester(std::move(its_tester)) {}

    std::unique_ptr<PointTester> tester;
    std::vector<TestedPoint> points;
    std::vector<double> weights;
  };

  /// How many sets of samples, and how many samples in each.
  struct SampleCount {
    int sets;
    int in_set;
  };

  /// Means over the sets (masses in `unit_`), and the sums of the squares of what the sets are off
  /// them.
  struct CellMeans {
    double mass = 0.0;
    double mass_spread = 0.0;
    double doubt = 0.0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    Eigen::Vector3d moment_spread = Eigen::Vector3d::Zero();
    double largest_weight = 0.0;  ///< of one sample
  };

  /// Some of the cells, one after another.
  struct Stretch {
    std::size_t begin;
    std::size_t end;
  };

  void sampleStretch(const std::vector<OpenCell>& cells, const Stretch& stretch, int sets,
                     double sets_per_deviation, SampledMass& total);
  void draw(const OpenCell& cell, std::uint64_t index, const SampleCount& count,
            Worker& worker) const;
  CellMeans sampleCell(const OpenCell& cell, std::uint64_t index, const SampleCount& count,
                       Worker& worker) const;
  static CellMeans meansOf(const Worker& tested, const SampleCount& count);
  void add(const CellMeans& means, const OpenCell& cell, const SampleCount& count,
           SampledMass& total) const;

  MakeTester another_;
  RoundWorkers<Worker> workers_;
  std::uint64_t seed_;
  std::uint64_t sets_drawn_ = 0;  ///< of each cell, by earlier calls
  double unit_ = 1.0;
};

}  // namespace fcl_prob::detail
