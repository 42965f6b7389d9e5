// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/pose_interval.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <thread>

#include "base/constants.h"
#include "base/decision.h"
#include "fcl_prob/exceptions.h"
#include "partition/partition.h"
#include "pose/contact_point.h"
#include "pose/mass_tree.h"
#include "pose/rotation_cell.h"
#include "pose/turning_contacts.h"
#include "query/single_collide.h"

namespace fcl_prob::detail {
namespace {

// Cells that are divided at a time, whatever the number of threads.
constexpr std::size_t kDividedAtATime = 4;

// Of the tolerance, what the partition in one cell may leave open.
constexpr double kPartitionShare = 0.35;
constexpr std::size_t kMostInnerCells = 20'000;

// Points may be this far from where the middle of a cell has them, in deviations of the
// displacement or in sizes of A, for a partition to be worth more than a look: around a cell that
// is smaller than the motion there are all the pairs of two meshes. Where contacts tell how much
// their motion leaves open, a cell is not even looked at while that is more than so many
// tolerances.
constexpr double kMostDeviations = 2.0;
constexpr double kMostOfSize = 0.05;
constexpr std::size_t kCellsOfLook = 16;
constexpr double kMostMoved = 0.7;
constexpr double kTimesBetweenLooks = 8.0;

// How far from the middle of contacts they are, in sizes of A.
constexpr double kAroundContact = 0.1;

// A partition stops where twice the work has left more than this share of the width: what is left
// then is mostly how far points move, and smaller cells of rotations make that less. Measured on
// the benchmark scenes.
constexpr double kStalled = 0.4;

class InnerProgress {
 public:
  /// Looked at now and then while a partition runs: whether it is worth going on.
  bool goOn(double width) {
    ++looks_;
    if (looks_ < 2 * at_) return true;
    const bool stalled = looks_ > 2 && width > kStalled * width_;
    at_ = looks_;
    width_ = width;
    return !stalled;
  }

 private:
  int looks_ = 0;
  int at_ = 1;
  double width_ = 1.0;
};

class PoseInterval {
 public:
  PoseInterval(const PreparedGeometry& a, const fcl::Transform3d& pose_a, const PreparedGeometry& b,
               const fcl::Transform3d& pose_b, const PoseError& error,
               const ProbabilityRequest& request)
      : a_(a),
        pose_a_(pose_a),
        b_(b),
        pose_b_(pose_b),
        request_(request),
        frame_(pose_a, error, "object A"),
        solid_a_(a.solid(request.contact)),
        solid_b_(b.solid(request.contact)) {
    size_ = pose_a.translation().norm() + pose_b.translation().norm() + a.pieces().radius() +
            b.pieces().radius() + a.pieces().parts[0].origin.norm() +
            b.pieces().parts[0].origin.norm();
    const ConditionalMotion nominal = frame_.at(Eigen::VectorXd::Zero(frame_.rank()));
    lookAtContacts(nominal);
  }

  ProbabilityResult run() {
    cells_.push_back(wholeRotationSpace(frame_.rank()));
    std::optional<ProbabilityStatus> status = satisfied();
    while (!status) {
      divide();
      status = satisfied();
      if (!status) status = limited();
    }
    return resultOf(*status);
  }

 private:
  // Coordinates of the rotation along which contacts move most and least: the isotropic ones are as
  // good as any others.
  void lookAtContacts(const ConditionalMotion& nominal) {
    const fcl::Transform3d turned = nominal.motion * pose_a_;
    const Eigen::MatrixXd factor = frame_.conditional().rotationFactor();
    // Shapes turn as their cores do, not as points of their surfaces.
    if (a_.pieces().isMesh()) {
      contacts_ =
          turningContacts({&a_.pieces(), {{turned, nullptr}}}, {&b_.pieces(), {{pose_b_, nullptr}}},
                          nominal.displacement, factor, request_.seed);
    }
    if (!contacts_) {
      costs_ = {factor.colwise().norm().transpose(), Eigen::VectorXd::Zero(factor.cols())};
      reference_ = likelyContact(a_, turned, b_, pose_b_, nominal.displacement, request_.seed);
      return;
    }
    frame_.turn(contacts_->axes);
    reference_ = contacts_->centre;
    // By half of the width, both ways.
    const Eigen::MatrixXd turns = frame_.conditional().rotationFactor();
    const Eigen::Vector3d lever = reference_ - pose_a_.translation();
    Eigen::VectorXd second(turns.cols());
    for (Eigen::Index j = 0; j < turns.cols(); ++j) {
      const Eigen::Vector3d turn = turns.col(j);
      second[j] = 0.125 * turn.cross(turn.cross(lever)).norm() +
                  0.25 * turn.squaredNorm() * kAroundContact * a_.pieces().radius();
    }
    costs_ = {contacts_->moved, contacts_->pushed * second};
  }

  const Bounds& interval() const { return tree_.sum(); }

  double target() const { return request_.toleranceAt(interval().upper); }

  std::optional<ProbabilityStatus> satisfied() const {
    if (interval().width() <= target()) return ProbabilityStatus::converged;
    const Decision decision = decisionOf(interval(), request_);
    if (isDecided(decision)) {
      return ProbabilityStatus::decided;
    }
    return std::nullopt;
  }

  std::optional<ProbabilityStatus> limited() {
    if (!goOn()) return cancelled_ ? ProbabilityStatus::cancelled : ProbabilityStatus::time_limit;
    if (statistics_.cells >= request_.max_cells) return ProbabilityStatus::cell_limit;
    const std::size_t memory =
        tree_.memory() +
        cells_.size() *
            (sizeof(RotationCell) + 3 * sizeof(double) * static_cast<std::size_t>(frame_.rank()));
    statistics_.peak_memory = std::max(statistics_.peak_memory, memory);
    if (memory >= request_.max_memory) return ProbabilityStatus::memory_limit;
    // No gap is left that smaller cells would close.
    if (!(cells_.front().gap() > 0.0)) return ProbabilityStatus::resolution_limit;
    return std::nullopt;
  }

  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  }

  // From any thread; the request's on_progress only from the one that made the query.
  bool goOn() {
    if (cancelled_ || timed_out_) return false;
    const double now = seconds();
    if (request_.time_limit && now >= *request_.time_limit) timed_out_ = true;
    if (request_.on_progress && std::this_thread::get_id() == caller_) {
      const double by_cells =
          static_cast<double>(statistics_.cells) / static_cast<double>(request_.max_cells);
      const double by_time = request_.time_limit ? now / *request_.time_limit : 0.0;
      const ProbabilityProgress progress{interval(), std::min(1.0, std::max(by_cells, by_time)),
                                         now};
      if (!request_.on_progress(progress)) cancelled_ = true;
    }
    return !cancelled_ && !timed_out_;
  }

  static bool smaller(const RotationCell& a, const RotationCell& b) { return a.gap() < b.gap(); }

  // The cells are a heap by gap.
  void divide() {
    std::vector<RotationCell> parts;
    for (std::size_t i = 0; i < kDividedAtATime && !cells_.empty(); ++i) {
      if (!(cells_.front().gap() > 0.0)) break;
      std::pop_heap(cells_.begin(), cells_.end(), smaller);
      for (RotationCell& part : split(cells_.back(), costs_)) {
        part.in_tree = tree_.addPart(part.in_tree, part.contribution());
        parts.push_back(std::move(part));
      }
      cells_.pop_back();
    }
    std::vector<ProbabilityStatistics> statistics(parts.size());
    const auto examine = [&](std::size_t i) { examinePart(parts[i], statistics[i]); };
    if (request_.threads == 1) {
      for (std::size_t i = 0; i < parts.size(); ++i) examine(i);
    } else {
      tbb::task_arena arena(static_cast<int>(request_.threads));
      arena.execute([&] {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, parts.size(), 1),
            [&](const tbb::blocked_range<std::size_t>& range) {
              for (std::size_t i = range.begin(); i < range.end(); ++i) examine(i);
            },
            tbb::simple_partitioner());
      });
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      add(statistics[i]);
      tree_.tighten(parts[i].in_tree, parts[i].contribution());
      cells_.push_back(std::move(parts[i]));
      std::push_heap(cells_.begin(), cells_.end(), smaller);
    }
  }

  void examinePart(RotationCell& cell, ProbabilityStatistics& statistics) {
    if (!cell.isFinite() || !(cell.mass.upper > 0.0)) return;
    if (cancelled_ || timed_out_ || !isWorthALook(cell)) return;
    // A round body stays round where its displacement does: no shift then joins that.
    const double expected = contacts_ ? std::min(0.5, interval().upper) : 0.0;
    const CellMotion motion = motionOf(frame_, cell, reference_, size_, expected);
    ProbabilityRequest request = request_;
    request.method = ProbabilityMethod::interval;
    request.relative_tolerance = 0.0;
    request.absolute_tolerance = kPartitionShare * target();
    request.threshold.reset();
    request.time_limit.reset();
    request.gradient = false;
    request.threads = 1;
    request.max_cells =
        std::min(isWide(motion) ? kCellsOfLook : kMostInnerCells, request_.max_cells);
    InnerProgress inner;
    request.on_progress = [&](const ProbabilityProgress& progress) {
      return goOn() && inner.goOn(progress.interval.width());
    };
    const PartitionObject a{&a_.pieces(), {{motion.turned * pose_a_, solid_a_}}, &motion.motion};
    const PartitionObject b{&b_.pieces(), {{pose_b_, solid_b_}}};
    const ProbabilityResult result = partitionProbability(a, b, motion.displacement, request);
    setConditional(motion, {*result.lower, *result.upper}, cell);
    statistics = result.statistics;
  }

  // Cells that are too large are looked at now and then, so that limits do not find all unknown.
  bool isWorthALook(RotationCell& cell) const {
    if (!contacts_) return true;
    const double costs = costs_.of(cell);
    if (costs > kMostMoved * target() && costs > cell.looked_at / kTimesBetweenLooks) return false;
    cell.looked_at = costs;
    return true;
  }

  // Steers; no bound depends on it.
  bool isWide(const CellMotion& motion) const {
    if (contacts_) return false;
    const double radius = a_.pieces().radius();
    const double deviation = motion.displacement.standardDeviations().maxCoeff();
    return motion.motion.reach(radius) >
           std::max(kMostDeviations * deviation, kMostOfSize * radius);
  }

  void add(const ProbabilityStatistics& of_one) {
    statistics_.cells += std::max<std::size_t>(of_one.cells, 1);
    statistics_.pairs_tested += of_one.pairs_tested;
    statistics_.leaf_pairs += of_one.leaf_pairs;
    statistics_.peak_front = std::max(statistics_.peak_front, of_one.peak_front);
    statistics_.peak_memory = std::max(statistics_.peak_memory, of_one.peak_memory);
  }

  ProbabilityResult resultOf(ProbabilityStatus status) {
    ProbabilityResult result;
    result.method = ProbabilityMethod::interval;
    result.status = status;
    result.lower = interval().lower;
    result.upper = interval().upper;
    result.decision = decisionOf(interval(), request_);
    statistics_.cells_open = cells_.size();
    result.statistics = statistics_;
    result.statistics.seconds.emplace_back("rotations", seconds());
    result.plan.push_back("rotations in " + std::to_string(cells_.size()) + " cells of " +
                          std::to_string(frame_.rank()) +
                          " dimensions, a partition of the displacements for each");
    if (request_.gradient) result.plan.push_back("no gradient: the estimate has one");
    return result;
  }

  const PreparedGeometry& a_;
  fcl::Transform3d pose_a_;
  const PreparedGeometry& b_;
  fcl::Transform3d pose_b_;
  const ProbabilityRequest& request_;
  MovedFrame frame_;
  const ClosedMesh* solid_a_;
  const ClosedMesh* solid_b_;
  std::optional<TurningContacts> contacts_;
  MotionCosts costs_;
  double size_ = 0.0;
  Eigen::Vector3d reference_;
  std::vector<RotationCell> cells_;
  MassTree tree_{{0.0, 1.0}};
  ProbabilityStatistics statistics_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::atomic<bool> cancelled_{false};
  std::atomic<bool> timed_out_{false};
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace

ProbabilityResult poseInterval(const PreparedGeometry& a, const fcl::Transform3d& pose_a,
                               const PreparedGeometry& b, const fcl::Transform3d& pose_b,
                               const PoseError& error, const ProbabilityRequest& request) {
  if (!a.hasPieces() || !b.hasPieces()) {
    throw UnsupportedGeometry(
        "method interval has no answer for errors of a rotation beside a half-space or plane: "
        "estimate has");
  }
  if (a.pieces().isEmpty() || b.pieces().isEmpty()) {
    return partitionProbability({&a.pieces(), {{pose_a, nullptr}}},
                                {&b.pieces(), {{pose_b, nullptr}}}, GaussianDisplacement(),
                                request);
  }
  return PoseInterval(a, pose_a, b, pose_b, error, request).run();
}

}  // namespace fcl_prob::detail
