// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/motion_flux.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>

#include "base/random_words.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/normal_density.h"
#include "partition/line_crossings.h"
#include "pieces/containment.h"

namespace fcl_prob::detail {
namespace {

// Lines before the first question whether to go on, and between two of them: the same for any
// number of threads, and so is what is left off with.
constexpr std::size_t kFirstLines = 32;
constexpr std::size_t kLinesOfLook = 64;

// Lines that one thread takes at a time, and those for which it keeps the C-obstacles it has met.
constexpr std::size_t kLinesOfBatch = 4;
constexpr std::size_t kLinesOfTable = 8 * kLinesOfLook;

// One over the mean of |n·u| for a unit vector u of random direction, by its dimension.
constexpr double kCrofton[] = {0.0, 1.0, 1.5707963267948966, 2.0};

constexpr double kTwoPi = 6.283185307179586;

struct RandomLine {
  Eigen::Vector3d origin;  ///< across the direction
  Eigen::Vector3d direction;
};

RandomLine randomLine(std::uint64_t seed, std::uint64_t number, int rank) {
  const std::array<std::uint64_t, 4> words = randomWords({seed, 0x6c696e65}, number);
  if (rank == 1) return {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()};
  const double radius = std::sqrt(-2.0 * std::log(unitUniform(words[0])));
  const double turn = kTwoPi * unitUniform(words[1]);
  const double angle = kTwoPi * unitUniform(words[2]);
  if (rank == 2) {
    const Eigen::Vector3d u(std::cos(angle), std::sin(angle), 0.0);
    return {radius * std::cos(turn) * Eigen::Vector3d(-u.y(), u.x(), 0.0), u};
  }
  const double z = 2.0 * unitUniform(words[3]) - 1.0;
  const double flat = std::sqrt((1.0 - z) * (1.0 + z));
  const Eigen::Vector3d u(flat * std::cos(angle), flat * std::sin(angle), z);
  const Eigen::Vector3d first = u.unitOrthogonal();
  return {radius * (std::cos(turn) * first + std::sin(turn) * u.cross(first)), u};
}

/// What is the same for all lines.
class FluxScene {
 public:
  FluxScene(const PartitionObject& a, const PartitionObject& b,
            const GaussianDisplacement& displacement, const PartVelocities& velocities)
      : whitening_(displacement, std::max({a.tree->radius(), b.tree->radius(), 1e-150})),
        velocities_(velocities),
        origin_(a.parts[0].pose * a.tree->parts[0].origin),
        pair_(whiten(a, b, whitening_)) {
    if (a.hasSolid() || b.hasSolid()) {
      solids_ = std::make_unique<const SolidContact>(a, b, whitening_, pair_);
    }
  }

  const WhitenedPair& pair() const { return pair_; }
  Eigen::Index columns() const { return 1 + velocities_[0].cols(); }

  /// Writes mass and flux on a line.
  void evaluate(const RandomLine& line, LineCrossings& crossings,
                Eigen::Ref<Eigen::VectorXd> values) const {
    values.setZero();
    std::vector<LineStretch> stretches = crossings.on(line.origin, line.direction);
    if (solids_) joinContained(line, stretches);
    for (const LineStretch& stretch : stretches) {
      values[0] += normalIntervalMass(stretch.from.at, stretch.to.at);
      for (const LineEnd* end : {&stretch.from, &stretch.to}) addEnd(*end, crossings, values);
    }
  }

 private:
  /// Where the line leaves the one stretch and does not enter the next, one solid is in the other.
  void joinContained(const RandomLine& line, std::vector<LineStretch>& stretches) const {
    std::vector<LineStretch> joined;
    const auto isInside = [&](double from, double to) {
      const Eigen::Vector3d y = line.origin + 0.5 * (from + to) * line.direction;
      return solids_->at(y) == Containment::inside;
    };
    for (const LineStretch& next : stretches) {
      if (!joined.empty() && isInside(joined.back().to.at, next.from.at)) {
        joined.back().to = next.to;
      } else {
        joined.push_back(next);
      }
    }
    stretches = std::move(joined);
  }

  void addEnd(const LineEnd& end, const LineCrossings& crossings,
              Eigen::Ref<Eigen::VectorXd> values) const {
    const int rank = whitening_.rank();
    const double across = end.normal.head(rank).norm();
    if (!(across > 0.0)) return;
    // Where B touches A in the world, the displacement taken back.
    const Eigen::Vector3d x = origin_ + whitening_.inverse() * crossings.touchingPointOfA(end);
    const Eigen::Vector3d n = whitening_.matrix().transpose() * end.normal;
    Eigen::Matrix<double, 6, 1> of_velocity;
    of_velocity << n, x.cross(n);
    const double weight = -kCrofton[rank] * normalDensity(end.at) / across;
    values.tail(columns() - 1) += weight * velocityOf(end).transpose() * of_velocity;
  }

  const Eigen::Matrix<double, 6, Eigen::Dynamic>& velocityOf(const LineEnd& end) const {
    const PieceTree& tree = *pair_.a.tree;
    const int piece = tree.nodes[static_cast<std::size_t>(end.leaves.a)].piece;
    const bool triangle = tree.isTriangle(piece);
    const int index =
        triangle ? tree.triangles[static_cast<std::size_t>(piece)][0] : tree.bodyOf(piece);
    const auto behind =
        std::find_if(tree.parts.begin(), tree.parts.end(), [&](const PieceTree::Part& part) {
          return index < (triangle ? part.vertices.end : part.bodies.end);
        });
    return velocities_[static_cast<std::size_t>(behind - tree.parts.begin())];
  }

  Whitening whitening_;
  const PartVelocities& velocities_;
  Eigen::Vector3d origin_;  ///< of the whitened frame as A's, world frame
  WhitenedPair pair_;
  std::unique_ptr<const SolidContact> solids_;
};

std::size_t nextLook(std::size_t done) {
  return done == 0 ? kFirstLines : (done / kLinesOfLook + 1) * kLinesOfLook;
}

MeanAndError meanOfLines(const Eigen::MatrixXd& values) {
  const auto n = static_cast<double>(values.cols());
  MeanAndError result;
  result.lines = static_cast<std::size_t>(values.cols());
  result.mean = values.rowwise().mean();
  const Eigen::MatrixXd off = values.colwise() - result.mean;
  result.standard_error = (off.rowwise().squaredNorm() / (n * (n - 1.0))).cwiseSqrt();
  return result;
}

}  // namespace

MeanAndError motionFlux(const PartitionObject& a, const PartitionObject& b,
                        const GaussianDisplacement& displacement, const PartVelocities& velocities,
                        const LineDraws& draws) {
  const FluxScene scene(a, b, displacement, velocities);
  Eigen::MatrixXd values(scene.columns(), static_cast<Eigen::Index>(draws.count));
  tbb::enumerable_thread_specific<LineCrossings> crossings(
      [&scene] { return LineCrossings(scene.pair()); });
  const auto evaluate = [&](const tbb::blocked_range<std::size_t>& range) {
    LineCrossings& own = crossings.local();
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const RandomLine line = randomLine(draws.seed, i, displacement.rank());
      scene.evaluate(line, own, values.col(static_cast<Eigen::Index>(i)));
    }
  };
  tbb::task_arena arena(static_cast<int>(draws.threads));
  std::size_t done = 0;
  while (done < draws.count) {
    const std::size_t next = std::min(draws.count, nextLook(done));
    const tbb::blocked_range<std::size_t> range(done, next, kLinesOfBatch);
    if (draws.threads == 1) {
      evaluate(range);
    } else {
      arena.execute([&] { tbb::parallel_for(range, evaluate); });
    }
    done = next;
    if (done < draws.count && draws.go_on && !draws.go_on(done)) break;
    if (done % kLinesOfTable == 0) crossings.clear();
  }
  return meanOfLines(values.leftCols(static_cast<Eigen::Index>(done)));
}

}  // namespace fcl_prob::detail
