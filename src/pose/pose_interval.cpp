// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/pose_interval.h"

#include <algorithm>
#include <optional>
#include <string>

#include "base/cell_queue.h"
#include "base/constants.h"
#include "base/decision.h"
#include "fcl_prob/exceptions.h"
#include "pose/contact_point.h"
#include "pose/mass_tree.h"
#include "pose/rotation_cell.h"
#include "pose/turning_contacts.h"
#include "query/partition.h"
#include "query/single_collide.h"

namespace fcl_prob::detail {
namespace {

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
        solid_b_(b.solid(request.contact)),
        queue_(request, budget_, statistics_, request.threads, makeWorker()) {
    size_ = pose_a.translation().norm() + pose_b.translation().norm() + a.pieces().radius() +
            b.pieces().radius() + a.pieces().parts[0].origin.norm() +
            b.pieces().parts[0].origin.norm();
    const ConditionalMotion nominal = frame_.at(Eigen::VectorXd::Zero(frame_.rank()));
    lookAtContacts(nominal);
  }

  ProbabilityResult run() {
    queue_.push(wholeRotationSpace(frame_.rank()));
    return resultOf(queue_.run(*this));
  }

 private:
  friend class CellQueue<PoseInterval>;

  // A cell takes a partition of its own: four are divided at once, and the clock is looked at
  // after each round.
  static constexpr RoundSizes kRounds{4, 4, 1, 1, 1, 1};

  using Cell = RotationCell;

  /// Counts what a thread does.
  struct Worker {
    ProbabilityStatistics statistics;
  };

  using Parts = std::vector<RotationCell>;

  /// Sums over the open cells are in the tree of masses.
  struct Totals {
    std::size_t cells = 0;

    void add(const RotationCell& /*cell*/) { ++cells; }
    void remove(const RotationCell& /*cell*/) { --cells; }
  };

  using Queue = CellQueue<PoseInterval>;

  static std::unique_ptr<Worker> makeWorker() { return std::make_unique<Worker>(); }
  static bool isOneByOne() { return false; }

  // A cell without a gap has nothing to tell.
  static auto enough() {
    return [](double /*taken*/, std::size_t /*count*/, double next) { return !(next > 0.0); };
  }

  // The tree of masses is divided before threads look at the parts.
  void beginRound(std::vector<Queue::InRound>& round, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      round[i].parts = split(round[i].cell, costs_);
      for (RotationCell& part : round[i].parts) {
        part.in_tree = tree_.addPart(part.in_tree, part.contribution());
      }
    }
  }

  void divide(Worker& worker, const RotationCell& /*cell*/, Parts& parts) {
    for (RotationCell& part : parts) {
      ProbabilityStatistics of_part;
      examinePart(part, of_part);
      of_part.cells = std::max<std::size_t>(of_part.cells, 1);
      addStatistics(of_part, worker.statistics);
    }
  }

  void add(Parts& parts) {
    for (RotationCell& part : parts) {
      tree_.tighten(part.in_tree, part.contribution());
      queue_.push(std::move(part));
    }
  }

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
    if (isDecided(decisionOf(interval(), request_))) return ProbabilityStatus::decided;
    if (const auto stopped = budget_.stopped()) return stopped;
    // No gap is left that smaller cells would close.
    if (!(queue_.largest().gap() > 0.0)) return ProbabilityStatus::resolution_limit;
    return std::nullopt;
  }

  std::size_t memory() const {
    const std::size_t of_vectors = 3 * sizeof(double) * static_cast<std::size_t>(frame_.rank());
    return tree_.memory() + queue_.size() * (sizeof(RotationCell) + of_vectors);
  }

  void examinePart(RotationCell& cell, ProbabilityStatistics& statistics) {
    if (!cell.isFinite() || !(cell.mass.upper > 0.0)) return;
    if (budget_.stopped() || !isWorthALook(cell)) return;
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
      return budget_.goOn() && inner.goOn(progress.interval.width());
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

  ProbabilityResult resultOf(ProbabilityStatus status) {
    ProbabilityResult result;
    result.method = ProbabilityMethod::interval;
    result.status = status;
    result.lower = interval().lower;
    result.upper = interval().upper;
    result.decision = decisionOf(interval(), request_);
    result.statistics = statistics_;
    result.statistics.seconds.emplace_back("rotations", budget_.seconds());
    result.plan.push_back("rotations in " + std::to_string(queue_.size()) + " cells of " +
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
  MassTree tree_{{0.0, 1.0}};
  ProbabilityStatistics statistics_;
  Budget budget_{request_};
  Queue queue_;
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
