// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/motion_flux.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "fcl_prob/normal_mass.h"
#include "gaussian/normal_density.h"
#include "lines/flux_means.h"
#include "lines/line_crossings.h"
#include "scene/containment.h"

namespace fcl_prob::detail {
namespace {

// Lines before the first question whether to go on, and between two of them: the same for any
// number of threads, and so is what is left off with.
constexpr std::size_t kFirstLines = 32;
constexpr std::size_t kLinesOfLook = 64;

// Lines that one thread takes at a time, and those for which it keeps the C-obstacles it has met.
constexpr std::size_t kLinesOfBatch = 4;
constexpr std::size_t kLinesOfTable = 8 * kLinesOfLook;

/// What is the same for all lines.
class FluxScene {
 public:
  FluxScene(const PartitionObject& a, const PartitionObject& b,
            const GaussianDisplacement& displacement, std::uint64_t seed)
      : whitening_(displacement, std::max({a.tree->radius(), b.tree->radius(), 1e-150})),
        origin_(a.parts[0].pose * a.tree->parts[0].origin),
        pair_(whiten(a, b, whitening_)),
        lines_(pair_, displacement.rank(), seed) {
    if (a.hasSolid() || b.hasSolid()) {
      solids_ = std::make_unique<const SolidContact>(a, b, whitening_, pair_);
    }
  }

  const WhitenedPair& pair() const { return pair_; }
  const PartLines& lines() const { return lines_; }

  FluxLine evaluate(std::size_t number, LineCrossings& crossings) const {
    const RandomLine line = lines_.line(number);
    std::vector<LineStretch> stretches = crossings.on(line.origin, line.direction);
    if (solids_) joinContained(line, stretches);
    FluxLine result;
    result.frequency = lines_.frequency(line);
    for (const LineStretch& stretch : stretches) {
      result.mass += normalIntervalMass(stretch.from.at, stretch.to.at);
      for (const LineEnd* end : {&stretch.from, &stretch.to}) addEnd(*end, crossings, result);
    }
    return result;
  }

  /// Of each part by those parameters that move it: of a point of it the speed is largest at a
  /// corner of its box.
  std::vector<std::vector<PartSpeed>> speeds(const PartVelocities& velocities) const {
    std::vector<std::vector<PartSpeed>> speeds(velocities.size());
    for (std::size_t part = 0; part < velocities.size(); ++part) {
      const int root = pair_.a.tree->parts[part].root;
      if (root < 0) continue;
      for (Eigen::Index k = 0; k < velocities[part].cols(); ++k) {
        if (velocities[part].col(k).isZero(0.0)) continue;
        speeds[part].push_back(fastest(pair_.a.boxOf(root), velocities[part].col(k), k));
      }
    }
    return speeds;
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

  PartSpeed fastest(const NodeBox& box, const Eigen::Matrix<double, 6, 1>& velocity,
                    Eigen::Index parameter) const {
    PartSpeed fastest{parameter, 0.0, 0.0};
    for (int corner = 0; corner < 8; ++corner) {
      Eigen::Vector3d y;
      for (int k = 0; k < 3; ++k) y[k] = (corner >> k) % 2 == 0 ? box.lo[k] : box.hi[k];
      const Eigen::Vector3d x = origin_ + whitening_.inverse() * y;
      Eigen::Vector3d along =
          whitening_.matrix() * (velocity.head<3>() + velocity.tail<3>().cross(x));
      Eigen::Vector3d across = Eigen::Vector3d::Zero();
      for (int k = whitening_.rank(); k < 3; ++k) std::swap(along[k], across[k]);
      fastest.along = std::max(fastest.along, along.norm());
      fastest.across = std::max(fastest.across, across.norm());
    }
    return fastest;
  }

  void addEnd(const LineEnd& end, const LineCrossings& crossings, FluxLine& line) const {
    const int rank = whitening_.rank();
    const double across = end.normal.head(rank).norm();
    if (!(across > 0.0)) return;
    // Where B touches A in the world, the displacement taken back.
    const Eigen::Vector3d x = origin_ + whitening_.inverse() * crossings.touchingPointOfA(end);
    const Eigen::Vector3d n = whitening_.matrix().transpose() * end.normal;
    const double weight = -kCrofton[rank] * normalDensity(end.at) / across;
    FluxEnd flux{partOf(end), {}, end.normal.norm() / across};
    flux.per_velocity << weight * n, weight * x.cross(n);
    line.ends.push_back(flux);
  }

  std::size_t partOf(const LineEnd& end) const {
    const PieceTree& tree = *pair_.a.tree;
    const int piece = tree.nodes[static_cast<std::size_t>(end.leaves.a)].piece;
    const bool triangle = tree.isTriangle(piece);
    const int index =
        triangle ? tree.triangles[static_cast<std::size_t>(piece)][0] : tree.bodyOf(piece);
    const auto behind =
        std::find_if(tree.parts.begin(), tree.parts.end(), [&](const PieceTree::Part& part) {
          return index < (triangle ? part.vertices.end : part.bodies.end);
        });
    return static_cast<std::size_t>(behind - tree.parts.begin());
  }

  Whitening whitening_;
  Eigen::Vector3d origin_;  ///< of the whitened frame as A's, world frame
  WhitenedPair pair_;
  PartLines lines_;
  std::unique_ptr<const SolidContact> solids_;
};

std::size_t nextLook(std::size_t done) {
  return done == 0 ? kFirstLines : (done / kLinesOfLook + 1) * kLinesOfLook;
}

}  // namespace

MeanAndError motionFlux(const PartitionObject& a, const PartitionObject& b,
                        const GaussianDisplacement& displacement, const PartVelocities& velocities,
                        const LineDraws& draws) {
  const FluxScene scene(a, b, displacement, draws.seed);
  const std::size_t count = displacement.rank() == 1 ? 1 : draws.count;
  std::vector<FluxLine> lines;
  tbb::enumerable_thread_specific<LineCrossings> crossings(
      [&scene] { return LineCrossings(scene.pair()); });
  const auto evaluate = [&](const tbb::blocked_range<std::size_t>& range) {
    LineCrossings& own = crossings.local();
    for (std::size_t i = range.begin(); i < range.end(); ++i) lines[i] = scene.evaluate(i, own);
  };
  tbb::task_arena arena(static_cast<int>(draws.threads));
  std::size_t done = 0;
  while (done < count) {
    const std::size_t next = std::min(count, nextLook(done));
    const tbb::blocked_range<std::size_t> range(done, next, kLinesOfBatch);
    lines.resize(next);
    if (draws.threads == 1) {
      evaluate(range);
    } else {
      arena.execute([&] { tbb::parallel_for(range, evaluate); });
    }
    done = next;
    if (done < count && draws.go_on && !draws.go_on(done)) break;
    if (done % kLinesOfTable == 0) crossings.clear();
  }
  return meansOfLines(scene.lines(), displacement.rank(), lines, velocities,
                      scene.speeds(velocities));
}

}  // namespace fcl_prob::detail
