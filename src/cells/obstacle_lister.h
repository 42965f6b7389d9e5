// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Which obstacles may meet a cell, and over which of their planes it sticks out.
#pragma once

#include <vector>

#include "cells/carved_cell.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// Lists the obstacles of one cell at a time; the tables of the last one are kept for its memory.
class ObstacleLister {
 public:
  enum class Relation { covered, free, cut };

  /// Keeps references to both.
  ObstacleLister(FatMembers& obstacles, ProbabilityStatistics& statistics);

  /// Those of the nodes, and of what is below them, that a box may meet; none smaller than the box
  /// needs. Valid until the next call of any member.
  const std::vector<FatNode>& nodesIn(const Cell& box, const std::vector<FatNode>& from);

  /// Whether the one obstacle of nodesIn() that reaches farthest beyond the same box covers it.
  bool isCovered(const Cell& box);

  /// \param into  empty; where the cell is cut, what cuts it
  Relation list(const CarvedCell& cell, ObstacleList& into);

  /// An obstacle that list() looked at could not be built: what it told is not certain.
  bool failed() const { return failed_; }

 private:
  using List = ObstacleList;

  void gatherNodes(const Cell& box, const std::vector<FatNode>& from, bool to_leaves);
  bool takesPiece(int member, int piece) const;
  bool isBeside(const Cell& box, FatObstacle obstacle);
  bool covers(const CellBox& box, FatObstacle obstacle);
  Relation listBox(const CarvedCell& cell, List& into);
  void rangeFaces(const CellBox& box, int member);
  Relation addFromBox(const CellBox& box, FatObstacle obstacle, List& into);
  template <typename Add>
  Relation addPieces(FatObstacle obstacle, const Add& add);
  Relation addEntry(FatObstacle obstacle, std::size_t first, List& into) const;
  Relation refine(const CarvedCell& cell, List& into);
  bool isClear(FatObstacle obstacle, const Cell& box) const;
  Relation addFromBody(const CellPolytope& body, const Cell& box, FatObstacle obstacle, List& into);
  bool addPlane(const CellPolytope& body, FatObstacle obstacle, int index,
                const ObstaclePlane& plane, List& into);

  FatMembers& obstacles_;
  ProbabilityStatistics& statistics_;
  bool failed_ = false;

  // Of a box, along the normals of each P.
  std::vector<double> face_lo_;
  std::vector<double> face_hi_;
  std::vector<bool> ranged_;       ///< by member: those of its faces are known
  std::vector<FatNode> gathered_;  ///< that a box may meet
  std::vector<FatNode> stack_;
  std::vector<NodeReach::Heights> lowest_;  ///< by member, of that box
  std::vector<int>
      apart_;  ///< by member: a face that the box was beyond; of the next obstacle, too?

  /// How far a body reaches along the normals of faces, as far as that was asked for since the
  /// body became another one.
  struct FaceExtent {
    std::size_t asked = 0;
    CellPolytope::Extent extent;
  };
  std::vector<FaceExtent> face_extents_;  ///< by face of all members
  std::size_t bodies_ = 0;                ///< that were looked at so
};

}  // namespace fcl_prob::detail
