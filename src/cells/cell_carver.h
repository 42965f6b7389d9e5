// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What becomes of one cell of a partition along the planes of the C-obstacles themselves.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cells/cell_settler.h"
#include "cells/obstacle_chooser.h"
#include "cells/obstacle_lister.h"

namespace fcl_prob::detail {

/// What is inside the best obstacle of a cell is settled; what is outside is cut into convex cells
/// along that obstacle's planes, as long as they cut off much. Several of them may work at once
/// over the same obstacles.
class CellCarver {
 public:
  /// Keeps references to all arguments.
  /// \param list_memory  bytes of the lists that cells refer to
  CellCarver(FatMembers& obstacles, const SolidContact* solids, const ProbabilityRequest& request,
             std::atomic<std::size_t>& list_memory, ProbabilityStatistics& statistics);

  /// Adds what comes of a cell. Where obstacles turn out to have failed nothing does.
  /// \param certain  mass that is settled, besides that in `into`: steers, no bound depends on it
  void divide(CarvedCell&& cell, double certain, Carving& into);

 private:
  using List = ObstacleList;
  using Relation = ObstacleLister::Relation;

  /// What is left of a cell around its best obstacle.
  struct Rest {
    CellPolytope body;
    std::vector<ObstaclePlane> planes;  ///< along which it was not cut yet
    double mass;                        ///< no less than its own
    FatObstacle obstacle;
  };

  bool isTooLarge(const Cell& box) const;
  void divideBox(CarvedCell&& cell);
  void resolve(CarvedCell&& cell);
  std::shared_ptr<List> copied(const List& list);
  void trim(CarvedCell& cell, const List& list);
  void carve(CarvedCell& cell, const std::shared_ptr<List>& list);
  void carveBy(CarvedCell& cell, const std::shared_ptr<List>& list, std::size_t best,
               const CellPolytope& inside);
  static std::optional<ObstaclePlane> nextPlane(Rest& rest);
  void cutOff(const CarvedCell& cell, const std::shared_ptr<List>& list, const ObstaclePlane& plane,
              Rest& rest);
  bool clip(const CellPolytope& body, const List& list, std::size_t entry, CellPolytope& inside);
  bool mayMeet(const CellPolytope& body, const List& list, std::size_t entry);
  void dropEntry(CarvedCell& cell, List& list, std::size_t entry);
  double rimOf(const CarvedCell& cell, const List& list, std::size_t entry) const;
  void split(const CarvedCell& cell, const std::shared_ptr<List>& list);
  void push(CarvedCell&& cell) {
    carving_->cells.push_back(std::make_unique<CarvedCell>(std::move(cell)));
  }

  FatMembers& obstacles_;
  const ProbabilityRequest& request_;
  std::atomic<std::size_t>& list_memory_;
  ProbabilityStatistics& statistics_;
  ObstacleLister lister_;
  ObstacleChooser chooser_;
  CellSettler settler_;
  Carving* carving_ = nullptr;

  PolytopeCutter cutter_;
  List found_;
  std::vector<std::pair<double, int>> depths_;  ///< of a body behind planes, and which
  std::vector<double> supports_;                ///< by member, along one normal; NaN: not known yet
};

}  // namespace fcl_prob::detail
