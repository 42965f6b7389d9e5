// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What one cell of the displacement space is worth: free, colliding, exactly known, or open.
#pragma once

#include <map>
#include <optional>

#include "cells/cell_front.h"
#include "cells/claim_observer.h"
#include "cells/covered_part.h"
#include "cells/crossing_witness.h"
#include "scene/containment.h"

namespace fcl_prob::detail {

/// Mass that is settled for good, and ∫ y φ(y) dy over it.
struct SettledMass {
  Bounds mass;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double moment_error = 0.0;  ///< bound on the error of each component of `moment`

  SettledMass& operator+=(const SettledMass& other) {
    mass.lower += other.mass.lower;
    mass.upper += other.mass.upper;
    moment += other.moment;
    moment_error += other.moment_error;
    return *this;
  }
};

struct Examination {
  SettledMass settled;
  std::optional<OpenCell> open;
};

/// No m·y of a part is lower, its rounding included.
inline double lowestIn(const Cell& part, const Eigen::Vector3d& m) {
  return m.dot(part.lowestCorner(m)) - 1e-13;
}

/// Whether masses under a plane may be used in the cell: wider ones are divided before.
inline bool mayIntegrate(const Cell& cell) {
  constexpr double kWidestIntegrated = 2.5;
  return cell.largestWidth() <= kWidestIntegrated;
}

class CellExaminer {
 public:
  /// Keeps references to all arguments.
  /// \param solids              null: surfaces only
  /// \param sampled             whether samples may be drawn of what stays open
  /// \param relative_tolerance  of P: settled masses are not much more accurate than that needs
  CellExaminer(const WhitenedPair& pair, ObstacleTable& obstacles, const SolidContact* solids,
               bool with_moments, bool sampled, double relative_tolerance,
               ProbabilityStatistics& statistics);

  /// Examines `cell` against the front inherited from its parent.
  Examination examine(const Cell& cell, const std::vector<FrontPair>& inherited);

  /// The part of an open cell that its plane covers, as settled mass; nothing without a plane.
  SettledMass coveredPart(const OpenCell& open) const;

  /// All of what was examined before that the next examination depends on.
  CrossingWitness::Hint hint() const { return witness_ ? witness_->hint() : hint_; }
  void setHint(const CrossingWitness::Hint& hint);

 private:
  /// Accuracy, relative to the cell's mass, of the masses of cells that stay open.
  static constexpr double kOpenAccuracy = 1e-4;

  /// No pair and no layer.
  static constexpr FrontPair kNobody{{FrontPair::kNone, FrontPair::kNone}, FrontPair::kNone};

  void settle(const Claim& all, const FrontPair& by = kNobody);
  void settlePart(const Cell& cell, const CellPlane& plane, double sign, double accuracy);
  void settleFree(const Cell& cell);
  void settleAround(const Cell& box);
  void claim(Claim claim, const FrontPair& by = kNobody) const;
  void claimAbove(const char* method, const Cell& cell, const CuttingPair& leader) const;
  void claimBelow(const char* method, const Cell& cell, const CellPlane& plane) const;
  std::optional<CuttingPair> findLeader();
  void improveByTopology(std::optional<CuttingPair>& best);
  CrossingWitness* witness();
  void openWithoutPlane();
  ObstaclePart largestPart(const OpenCell& open, int most, double& mass);
  std::optional<double> massOfPart(const OpenCell& open, const PartMeasure& measure,
                                   const CoveredPart& part);
  void addPart(OpenCell& open);
  void addPossible(OpenCell& open);
  void weigh(OpenCell& open);
  void claimBeside(const CuttingPair& leader, const Cell& box, double settled_from,
                   bool nothing_below) const;
  void openWithPlane(const CuttingPair& leader);
  void leaveOpen(OpenCell open, const CuttingPair& leader, const Cell& box);

  const WhitenedPair& pair_;
  CellFront front_;
  std::optional<CrossingWitness> witness_;  ///< made when a front first is long enough for it
  CrossingWitness::Hint hint_{-1, -1};      ///< until then
  const SolidContact* solids_;
  bool with_moments_;
  bool sampled_;
  double relative_tolerance_;
  ProbabilityStatistics& statistics_;
  ClaimObserver* const observer_ = claim_observer;
  std::map<int, CrossingProof> proofs_;  ///< by layer; for the observer only
  CubeCutter cutter_;
  Examination result_;
  std::vector<FrontPair> near_;
  LowestInCell::PartsBelow below_;
};

}  // namespace fcl_prob::detail
