// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What may collide in an open cell, within a few convex parts: along an edge between two faces of
// the C-obstacle no plane of either tells much of the other.
#pragma once

#include <array>
#include <vector>

#include "cells/cell_front.h"
#include "cells/claim_observer.h"

namespace fcl_prob::detail {

class PossibleParts {
 public:
  /// Keeps references to its arguments.
  PossibleParts(CellFront& front, CubeCutter& cutter) : front_(front), cutter_(cutter) {}

  /// Looks how far the pairs of the front's open cell reach below planes that bound most of it.
  void start(const OpenCell& open, const CoveredPart& first);

  /// All of what may collide is within those planes, moved as far as they have to be.
  CoveredPart whole() const;

  /// An upper bound on the mass that collides, if a second part gives one below `most`.
  double massAtMost(const OpenCell& open, double most);

 private:
  /// How low a pair reaches along the planes of either part, and the farthest below one of them.
  struct Reach {
    std::array<double, CoveredPart::kMostPlanes> lowest;
    double below;
  };

  Reach reachOf(const OpenCell& open, const FrontPair& pair, const CoveredPart& part) const;
  bool chooseSecond(const OpenCell& open);
  void include(const Reach& reach, CoveredPart& part) const;
  double massOfBoth(const Cell& cell) const;
  void claimBeside(const Cell& cell) const;

  CellFront& front_;
  CubeCutter& cutter_;
  ClaimObserver* const observer_ = claim_observer;
  CoveredPart first_;
  CoveredPart second_;
  std::vector<Reach> reaches_;  ///< of the pairs of the front, along the planes of the first part
  CoveredPart around_first_;    ///< with the planes where its pairs let them be
  CoveredPart around_second_;
  Reach of_second_;  ///< of all its pairs together, along the planes of the first part
};

}  // namespace fcl_prob::detail
