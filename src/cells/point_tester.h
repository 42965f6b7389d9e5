// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Which of many displacements collide, tested against one front.
#pragma once

#include <array>
#include <vector>

#include "cells/claim_observer.h"
#include "cells/open_cell.h"
#include "scene/containment.h"
#include "scene/obstacle_table.h"

namespace fcl_prob::detail {

struct TestedPoint {
  Eigen::Vector3d y;
  bool collides = false;
  bool doubtful = false;  ///< rounding leaves open whether it collides
};

class PointTester {
 public:
  /// Keeps references to its arguments.
  /// \param solids  null: surfaces only
  PointTester(const WhitenedPair& pair, ObstacleTable& obstacles, const SolidContact* solids)
      : pair_(pair), obstacles_(obstacles), solids_(solids) {}

  /// Sets `collides` of every point; one that has it set already is left alone. A point that may
  /// touch but, within rounding, may as well not, collides and is doubtful. All of them must be
  /// within the cell that the front is of.
  void test(const std::vector<FrontPair>& front, std::vector<TestedPoint>& points);

 private:
  /// A range of `chosen_`.
  struct Range {
    std::size_t begin;
    std::size_t end;
  };

  /// A pair to be tested against some of the undecided points.
  struct Task {
    FrontPair pair;
    Range points;
  };

  void decide(const std::vector<FrontPair>& front, std::vector<TestedPoint>& points);
  void claim(const std::vector<TestedPoint>& before, const std::vector<TestedPoint>& points) const;
  void decideContainment(std::vector<TestedPoint>& points) const;
  void collectUndecided(const std::vector<TestedPoint>& points);
  void padUndecided();
  void removeDecided(const std::vector<TestedPoint>& points);
  void testPair(const FrontPair& pair, std::vector<TestedPoint>& points);
  void testParts(const FrontPair& pair, Range chosen, std::vector<TestedPoint>& points);
  void testLeaves(const FrontPair& pair, Range chosen, std::vector<TestedPoint>& points);
  Range choose(const FrontPair& pair);
  Range dropExcluded(const FaceSlabs& slabs, Range chosen, const std::vector<TestedPoint>& points);
  Range chooseFrom(Range from, const NodeBox& box, const std::vector<TestedPoint>& points);

  const WhitenedPair& pair_;
  ObstacleTable& obstacles_;
  const SolidContact* solids_;
  ClaimObserver* const observer_ = claim_observer;
  std::vector<int> undecided_;                      ///< indices of points
  std::array<std::vector<double>, 3> coordinates_;  ///< of the undecided, padded with NaN
  std::vector<int> chosen_;  ///< indices of points, for each pair that is being looked at
  std::vector<Task> stack_;
  TriangleSlabsData once_;
};

}  // namespace fcl_prob::detail
